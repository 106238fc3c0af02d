use super::*;

#[test]
fn time() {
    let t = std::time::Instant::now();
    let mut sum = 0.0;
    for i in 0..10000 {
        sum += MinimumVariation.respond([0.3 + 1e-6 * f64::from(i), -0.5, 2.0, 5.0]).jets[0];
    }
    println!("one {sum} {:?}", t.elapsed() / 10000);
}
