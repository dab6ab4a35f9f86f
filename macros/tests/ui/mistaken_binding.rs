use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid([l1, l2, l3]: [f64; 3], a: [f64; 2], kappa: f64) -> f64 {
    let n = [1.0, 2.0];
    let shape = sum(|p| a[p] / n[p] * (l1.powf(n[p]) + l2.powf(n[p]) + l3.powf(n[p]) - 3 - n[p] * J.ln()));
    shape * n[0] + kappa / (n - 1.0) * (J - 1).powi(2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new([1e6, 1e5], 1e7)?;
    assert!(solid.kappa() < solid.energy([1.0; 3]));
    Ok(())
}
