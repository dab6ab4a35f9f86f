use piola::{Material, material};

#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu * (l1.max(1.0) - 1.0).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6)?;
    assert!(solid.mu() < solid.energy([1.0; 3]));
    Ok(())
}
