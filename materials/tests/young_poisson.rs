//! Constructors from Young's modulus and Poisson's ratio: what they build is as stiff as asked. The
//! parameters that these moduli determine are judged for the whole catalogue by `tests/tests/declarations`.

use piola::material;
use piola::material::{Declared, MaterialError, Moduli};
use piola_materials::{NeoHookean, RotatedLinear, StVenantKirchhoff};

/// Poisson's ratios from that of cork to that of rubber.
const RATIOS: [f64; 5] = [0.0, 0.2, 0.3, 0.45, 0.499];

/// E = μ (3λ + 2μ)/(λ + μ) and 1 − 2ν = μ/(λ + μ) of the material, against what was asked.
///
/// A parameter and the modulus that follows from it have six roundings each; λ may be a difference of
/// parameters no more than 3 (λ + μ) in size, so that both moduli err by 20 u (λ + μ). E changes by at most
/// three times as much as μ and λ (1 − 2ν)², so both err by 100 u of E and of one.
#[track_caller]
fn check<M: Declared>(build: impl Fn(f64, f64) -> Result<M, MaterialError>) -> Result<(), MaterialError> {
    let name = M::DESCRIPTION.name;
    let tolerance = 100.0 * f64::EPSILON;
    for young in [1.0, 3.7e5, 2.1e11] {
        for poisson in RATIOS {
            let Moduli { mu, lambda } = match build(young, poisson) {
                // Some ask more of their parameters.
                Err(MaterialError::Violated { .. }) if poisson == 0.0 => continue,
                material => material?.moduli(),
            };
            let moduli = Moduli { mu, lambda };
            assert!(
                (moduli.young() / young - 1.0).abs() <= tolerance,
                "{name}: E is {}, not {young}, with ν = {poisson}",
                moduli.young()
            );
            assert!(
                (moduli.poisson() - poisson).abs() <= tolerance,
                "{name}: ν is {}, not {poisson}",
                moduli.poisson()
            );
        }
    }
    for (young, poisson) in
        [(0.0, 0.3), (-1.0, 0.3), (1.0, 0.5), (1.0, -1.0), (f64::NAN, 0.3), (1.0, f64::NAN)]
    {
        let refused = build(young, poisson).err();
        assert!(matches!(refused, Some(MaterialError::YoungPoisson { .. })), "{name}: {refused:?}");
    }
    Ok(())
}

#[test]
fn materials_are_as_stiff_as_asked() -> Result<(), MaterialError> {
    check(NeoHookean::from_young_poisson)?;
    check(RotatedLinear::from_young_poisson)?;
    check(StVenantKirchhoff::from_young_poisson)
}

/// Parameters that are differences of moduli, one of them with a constant, and names of what is emitted.
/// Without units, since the constant has one.
#[material(domain(J > 0.0))]
pub fn Own(
    [l1, l2, l3]: [f64; 3],
    /// A quarter of the shear modulus, less 3.
    c: f64,
    /// Stiffening.
    young: f64,
    /// First Lamé parameter less 4/3 of the shear modulus.
    a: f64,
) -> f64 {
    let shear = c + 3.0;
    let stiffening = (I1b - 3.0).powi(2) * young * a;
    2.0 * shear * (I1 - 3.0 - 2.0 * J.ln()) + (a / 2.0 + 8.0 / 3.0 * shear) * J.ln().powi(2) + stiffening
}

#[test]
fn differences_and_constants_are_solved() -> Result<(), MaterialError> {
    check(|young, poisson| Own::from_young_poisson(young, poisson, 0.1))?;
    // E = 2.5, ν = 0.25: μ = λ = 1.
    let own = Own::from_young_poisson(2.5, 0.25, 0.1)?;
    assert_eq!((own.c(), own.young()), (0.25 - 3.0, 0.1));
    assert!((own.a() + 1.0 / 3.0).abs() < 4.0 * f64::EPSILON, "{}", own.a());
    Ok(())
}
