use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; 2]) -> f64 {
    sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new([1e6, 2e6], [2.0, 4.0])?;
    assert!(solid.mu()[0] < solid.energy([1.0; 3]));
    Ok(())
}
