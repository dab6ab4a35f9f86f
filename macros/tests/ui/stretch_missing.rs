use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid([l1, l2]: [f64; 2], mu: f64) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2))
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6)?;
    assert!(solid.mu() < solid.energy([1.0; 3]));
    Ok(())
}
