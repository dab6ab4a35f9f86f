use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid<const R: usize>([J, l2, l3]: [f64; 3], energy: f64, mu: [f64; R]) -> f64 {
    energy * sum(|p| mu[p]) * (I1 - 3.0)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, [2e6; 3])?;
    assert!(solid.mu()[0] < solid.energy([1.0; 3]));
    Ok(())
}
