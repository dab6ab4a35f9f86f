use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], a: [f64; 2], kappa: f64) -> f64 {
    let shape = sum(|n| a[n] / (2 * n) * (l1.powi(2 * n) + l2.powi(2 * n) + l3.powi(2 * n) - 3 - 2 * n * J.ln()));
    shape + kappa / 2 * (J - 1).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new([1e6, 1e5], 1e7)?;
    assert!(solid.kappa() < solid.energy([1.0; 3]));
    Ok(())
}
