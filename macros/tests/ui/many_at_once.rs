use piola::lanes::Real;
use piola::material::{Declared, Varying};
use piola::{Inversion, Material, material};

/// Seven mistakes, and everything that could follow from them.
#[material(domain(J > 0), extend(mu[p] > 0.0), prestresed)]
pub fn Solid<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli, Pa.
    mu: [f64; N],
    /// Bulk modulus, Pa.
    kapa: f64,
    /// Exponents.
    alpha: &[f64],
) -> f64 {
    let volume = (J - 1.0) ^ 2;
    let shape = sum(|p| mu[q] * alpha[p] * (I1 - 3.0));
    shape - beta * J.Ln() + kappa / 2.0 * volume
}

fn stiffness<M: Declared + Varying + Copy + std::fmt::Debug>(material: M) -> f64 {
    material.moduli().mu + material.blocks([f64::splat(1.0); 3]).hessian[0]
}

fn main() -> Result<(), piola::material::MaterialError> {
    let solid: Solid<2> = Solid::new([1e6, 2e6], 1e7, &[2.0, 4.0])?;
    let solid = solid.with_inversion(Inversion::Extend { epsilon: 0.1 })?;
    assert!(solid.energy([1.0; 3]) < stiffness(solid) + solid.mu()[0] + solid.kapa());
    let again = Solid::<2>::from_values(&[], Inversion::Refuse)?;
    assert_eq!(again, solid);
    Ok(())
}
