use piola::{Material, material};

#[material(domain(J > 0.0), admissible(beta > 0.0, beta < 1.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], g: f64, beta: f64, kappa: f64) -> f64 {
    let chains = 2 / beta / (1 - beta * I1b / 3);
    g / 6 * (I1b + chains) + kappa / 2.0 * (J - 1.0).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, 0.1, 1e7)?;
    assert!(solid.g() > solid.energy([1.0; 3]));
    Ok(())
}
