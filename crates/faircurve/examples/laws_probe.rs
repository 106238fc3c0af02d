//! probe
fn main() {
    for info in faircurve::catalog::ENTRIES {
        let spline = faircurve::catalog::spline(info.name).unwrap();
        let t = std::time::Instant::now();
        let laws = faircurve::measure::Laws::measure(&*spline);
        println!("== {} {:?}\n{laws:#?}", info.name, t.elapsed());
        for claim in info.claims { println!("{claim}: {:?}", faircurve::measure::Verdict::on(claim, &laws)); }
    }
}
