use piola::material::{Declared, MaterialError, Moduli};
use piola::{Inversion, Material, material};

/// Misspelt once, and used in every way.
#[material(domain(J > 0.0), extend)]
#[derive(Default)]
pub fn Solid([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64, b: f64, c: f64) -> f64 {
    mu / 2.0 * (b * (I1b - 3.0)).exp() + c * I1b.powi(2) + kapa / 2.0 * (J - 1.0).powi(2)
}

/// One that holds it.
#[derive(Clone, Debug, Default, PartialEq)]
struct Body {
    solid: Solid,
}

impl From<Body> for Moduli {
    fn from(body: Body) -> Self {
        body.solid.moduli()
    }
}

fn derivatives(material: &impl Material) -> usize {
    material.gradient([1.0; 3]).len()
}

fn main() -> Result<(), MaterialError> {
    let solid = Solid::new(1e6, 1e7, 1.0, 3.0)?;
    let inversion = Inversion::Extend { epsilon: 0.1 };
    let body = Body { solid: Solid::new(1e5, 1e7, 2.0, 3.0)?.with_inversion(inversion)? };
    let copy = solid.clone();
    assert!(copy.energy([1.0; 3]) > body.solid.kappa() + body.solid.gradient([1.0; 3])[0]);
    assert!(derivatives(&solid) < Solid::DESCRIPTION.parameters.len());
    assert!(Moduli::from(body).mu > solid.stated_moduli().map_or(0.0, |moduli| moduli.mu));
    Ok(())
}
