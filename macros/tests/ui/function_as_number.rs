use piola::{Material, Spline, material};

#[material]
pub fn Solid([l1, l2, l3]: [f64; 3], f: Spline) -> f64 {
    f + f(l1, l2)
}

fn main() -> Result<(), piola::material::MaterialError> {
    let spline = Spline::through(&[[0.5, -1.0], [1.0, 0.0], [2.0, 1.0]])?;
    let solid = Solid::new(spline)?;
    assert!(0.0 < solid.energy([1.0; 3]));
    Ok(())
}
