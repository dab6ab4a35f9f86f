use piola::{Material, material};

#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], c10: f64, c01: f64, kappa: f64) -> f64 {
    c10 * (I1 - 3) + c01 * (I2 - 3).powi(2) + c01 * (I2 - 3) + kappa / 2 * (J - 1).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, 1e5, 1e7)?;
    assert!(solid.c10() < solid.energy([1.0; 3]));
    Ok(())
}
