use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    let mu = mu / 2.0;
    mu * (I1 - 3.0 - 2.0 * J.ln())
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6)?;
    assert!(solid.mu() < solid.energy([1.0; 3]));
    Ok(())
}
