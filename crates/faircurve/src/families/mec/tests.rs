use super::*;

#[test]
fn bounds() {
    use std::f64::consts::*;
    for d in [FRAC_PI_4, 3.0 * FRAC_PI_4, -FRAC_PI_4, 0.0, FRAC_PI_2, 1.4, 1.45, 1.5, 1.55] {
        println!("{d} {:?}", envelope(d));
    }
    let t = std::time::Instant::now();
    let mut sum = 0.0;
    for i in 0..100000 {
        sum += segment::Fit::new([0.3 + 1e-6 * f64::from(i), -0.5, 0.0]).response().value[0].num;
    }
    println!("one {sum} {:?}", t.elapsed() / 100000);
    let t = std::time::Instant::now();
    let mut sum = 0.0;
    for i in 0..100000 {
        let a = ChordAngles::new(0.3 + 1e-6 * f64::from(i), -0.5);
        sum += Elasticas { constant: 0.0 }.curvatures(a, &SegmentContext::UNIT).value[0].num;
    }
    println!("{sum} {:?}", t.elapsed() / 100000);
}
