use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid<T>([l1, l2, l3]: [T; 3], mu: T) -> T {
    mu / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6)?;
    assert!(solid.mu() < solid.energy([1.0; 3]));
    Ok(())
}
