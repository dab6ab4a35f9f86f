use piola::{Material, material};

#[material(domain(J > 0.0))]
pub async fn Solid([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6)?;
    assert!(solid.mu() < solid.energy([1.0; 3]));
    Ok(())
}
