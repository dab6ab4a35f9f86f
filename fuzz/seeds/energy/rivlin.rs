/// Rivlin's series.
#[material(domain(J > 0.0), admissible(K > 0.0), extend(c[p] >= 0.0))]
fn Rivlin([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, K: f64) -> f64 {
    let shear = sum(|p| c[p] * (I1b - 3.0).powi(i[p]));
    shear + K / 2.0 * (J - 1.0).powi(2) + 0.1 * K * (I2b - 3.0)
}
