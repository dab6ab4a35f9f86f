use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, c: f64, n: f64, kappa: f64) -> f64 {
    mu * (I1 - 3 + c.powi(2)).powf(n) + kappa / 2 * (J - 1).powi(2)
}

#[material(domain(J > 0.0))]
pub fn Free([l1, l2, l3]: [f64; 3], mu: f64, c: f64, kappa: f64) -> f64 {
    let root = (I1 - 3 + c.powi(2)).sqrt();
    mu * root - mu / c * J.ln() + kappa / 2 * (J - 1).powi(2)
}

#[material(domain(J > 0.0))]
pub fn Pulled([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64) -> f64 {
    mu * ((l1 - 1).powi(2) + (l2 - 1).powi(2) + (l3 - 1).powi(2)) - kappa * J.ln()
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, 1.0, 1.5, 1e7)?;
    let free = Free::new(1e6, 1.0, 1e7)?;
    let pulled = Pulled::new(1e6, 1e7)?;
    assert!(solid.mu() > free.energy([1.0; 3]) + pulled.kappa());
    Ok(())
}
