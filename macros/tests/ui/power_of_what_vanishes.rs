use piola::{Material, material};

#[material(domain(J > 0.0), admissible(n >= 1.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, b: f64, n: f64, kappa: f64) -> f64 {
    let shape = (b * (I1 - 3.0)).powf(n);
    mu * (I1b - 3.0) + shape + kappa / 2.0 * (J - 1.0).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, 1.0, 1.5, 1e7)?;
    assert!(solid.mu() > solid.energy([1.0; 3]));
    Ok(())
}
