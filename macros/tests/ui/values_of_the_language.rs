use piola::{Material, material};

#[material(domain(J > 0.0))]
pub fn Solid<const n: usize>(
    [None, l2, l3]: [f64; 3],
    Some: f64,
    Ok: [f64; n],
    r#type: f64,
) -> f64 {
    Some * sum(|p| Ok[p]) * r#type * (I1 - 3.0)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid = Solid::new(1e6, [2e6; 3], 1.0)?;
    assert!(solid.energy([1.0; 3]) > 0.0);
    Ok(())
}
