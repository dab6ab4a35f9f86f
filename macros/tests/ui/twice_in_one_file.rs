use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Soft([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * ln(J))
}

#[material(domain(J > 0.0))]
pub fn Hard([a, b, c]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (a * a + b * b - 2.0) - mu * J.ln()
}

fn main() -> Result<(), piola::material::MaterialError> {
    assert!(Soft::new(1e3)?.energy([1.0; 3]) < Hard::new(1e9)?.energy([1.0; 3]));
    Ok(())
}
