use piola::{Material, material};

#[material(domain(J > 0.0, I1b - 3.0 < jm), extend)]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, jm: f64, kappa: f64) -> f64 {
    kappa / 2 * (J - 1).powi(2) - mu / 2 * jm * (1 - (I1b - 3) / jm).ln()
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, 30.0, 1e7)?;
    assert!(solid.mu() > solid.energy([1.0; 3]));
    Ok(())
}
