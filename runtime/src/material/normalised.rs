//! An energy with wanted small-strain moduli, whatever its own are.
//!
//! Two energies can only be compared by how they go on if they begin alike \[CB24\]: with the same
//! linearisation of P at rest, that is, with the same Young's modulus E and Poisson's ratio ν. A factor gives
//! any energy the shear modulus that is wanted, and what then lacks in resistance to changes of volume is
//! added:
//!
//! ```text
//! ψ' = s ψ + c/2 (J − 1)²,    s = μ*/μ,    c = λ* − s λ
//! ```
//!
//! with μ, λ of the energy and μ*, λ* of E and ν. (J − 1)² has ψ11 = ψ12 = 1 at rest, so that it changes λ
//! alone.
//!
//! The latter is a polynomial: no quotient is formed, nothing but J − 1 cancels, there is no pole, and
//! inverted material is driven back by it as well.
//!
//! \[CB24\] Chen, Barbič, *Tuning Nonlinear Elastic Materials under Small and Large Deformations*, arXiv
//! 2412.18631, 2024. Aim and meaning of E and ν are those of its abstract, which alone was at hand: the term
//! by which it makes up for another λ may differ from ours. Its third property, how nonlinear an energy is at
//! large strain, is not set here.

use super::{Material, MaterialError, Moduli, Scaled, Sum};
use crate::lanes::Real;
use piola::material;

/// Volumetric penalty c/2 (J − 1)²: a part of a sum, with λ = c and no shear modulus.
#[material(part, admissible(c >= 0.0))]
pub fn VolumetricPenalty(
    [l1, l2, l3]: [f64; 3],
    /// First Lamé parameter c of the penalty, Pa.
    c: f64,
) -> f64 {
    c / 2.0 * (J - 1.0).powi(2)
}

/// A material with the small-strain moduli of a wanted E and ν: s ψ + c/2 (J − 1)².
///
/// Domain, inversion and poles are those of the material. Of one whose rest state carries stress, that stress
/// is multiplied by s.
///
/// ```
/// use piola::material::{Declared, Moduli, Normalised};
/// use piola::{Material, material};
///
/// /// μ Σ(λ − 1)²: no volumetric part at all, ν = 0.
/// #[material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let rubber: Normalised<Springs> = Springs::new(1.0)?.normalised_to(1e6, 0.45)?;
/// assert!((Moduli::at_rest(&rubber).young() - 1e6).abs() < 1e-8);
/// assert!((Moduli::at_rest(&rubber).poisson() - 0.45).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
pub type Normalised<M> = Sum<Scaled<M>, VolumetricPenalty>;

impl<M: Material> Normalised<M> {
    /// The material with Young's modulus E > 0, Pa, and Poisson's ratio −1 < ν < ½, both of small strain.
    ///
    /// # Errors
    /// * [`MaterialError::YoungPoisson`] if E or ν is outside these bounds;
    /// * [`MaterialError::UnstableRest`] if the material is unstable at rest, or s or c leaves the range of
    ///   numbers;
    /// * [`MaterialError::BelowOwnPoisson`] if ν is below that of the material itself, since c < 0 would take
    ///   away resistance to changes of volume, the more the larger they are.
    pub fn with_young_poisson(material: M, young: f64, poisson: f64) -> Result<Self, MaterialError> {
        let moduli = Moduli::from_young_poisson(young, poisson)?;
        let own = Moduli::at_rest(&material);
        if !(own.mu > 0.0 && own.bulk() >= 0.0 && own.bulk().is_finite()) {
            return Err(MaterialError::UnstableRest { moduli: own });
        }
        let lowest = own.poisson();
        // Its own ratio is no ratio below, however it was rounded.
        if poisson < lowest - 8.0 * f64::UNIT_ROUNDOFF {
            return Err(MaterialError::BelowOwnPoisson { poisson, lowest });
        }
        let scale = moduli.mu / own.mu;
        let volumetric = (moduli.lambda - scale * own.lambda).max(0.0);
        if !(moduli.mu > 0.0 && scale.is_finite() && volumetric.is_finite()) {
            return Err(MaterialError::UnstableRest { moduli });
        }
        Ok(Self::new(Scaled::new(scale, material)?, VolumetricPenalty::new(volumetric)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};

    #[track_caller]
    fn check(material: impl Material, young: f64, poisson: f64) {
        let normalised = Normalised::with_young_poisson(material, young, poisson).expect("admissible");
        let found = Moduli::at_rest(&normalised);
        let wanted = Moduli::from_young_poisson(young, poisson).expect("elastic");
        // Each modulus is a sum of two terms with two roundings each, of numbers no larger than ψ11.
        let tolerance = 8.0 * f64::UNIT_ROUNDOFF * (wanted.lambda.abs() + 2.0 * wanted.mu);
        assert!((found.mu - wanted.mu).abs() <= tolerance, "{found:?} for {wanted:?}");
        assert!((found.lambda - wanted.lambda).abs() <= tolerance, "{found:?} for {wanted:?}");
    }

    #[test]
    fn moduli_are_the_wanted_ones() {
        // All have ν = 0.3.
        for poisson in [0.3, 0.35, 0.45, 0.499, 0.499_999_9] {
            for young in [1e-3, 1.0, 2e11] {
                check(SaintVenantKirchhoff, young, poisson);
                check(NeoHookean, young, poisson);
                check(RotatedLinear, young, poisson);
                check(ExtendedNeoHookean { epsilon: 0.2 }, young, poisson);
            }
        }
    }

    #[test]
    fn twice_normalised_is_as_the_second_says() {
        let once = || Normalised::with_young_poisson(NeoHookean, 1e6, 0.4).expect("admissible");
        check(once(), 3e5, 0.4);
        check(once(), 3e5, 0.49);
    }

    #[test]
    fn dilation_keeps_its_digits_at_small_strain() {
        let normalised = Normalised::with_young_poisson(RotatedLinear, 1.0, 0.49).expect("admissible");
        let Moduli { mu, lambda } = Moduli::from_young_poisson(1.0, 0.49).expect("elastic");
        for size in [1e-3, 1e-9, 1e-15, 1e-200] {
            let strains = [3.0, 1.0, -2.0].map(|s| s * size);
            let linear = strains.map(|s| 2.0 * mu * s + lambda * 2.0 * size);
            for (found, expected) in normalised.gradient_at_strains(strains).into_iter().zip(linear) {
                // Terms of second order are below 20 λ size².
                let tolerance = 20.0 * (size + f64::UNIT_ROUNDOFF) * (mu + lambda) * size;
                assert!((found - expected).abs() <= tolerance, "{found:e} for {expected:e}");
            }
        }
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for (young, poisson) in [(f64::NAN, 0.4), (1.0, f64::INFINITY), (0.0, 0.4), (1.0, 0.5), (1.0, -1.0)] {
            let error =
                Normalised::with_young_poisson(NeoHookean, young, poisson).err().expect("inadmissible");
            assert!(matches!(error, MaterialError::YoungPoisson { .. }), "{error}");
        }
        let error = Normalised::with_young_poisson(NeoHookean, 1.0, 0.2).err().expect("inadmissible");
        let MaterialError::BelowOwnPoisson { poisson, lowest } = error else { panic!("{error}") };
        assert_eq!(poisson, 0.2);
        // Three roundings of a number below ½.
        assert!((lowest - 0.3).abs() <= 3.0 * f64::UNIT_ROUNDOFF);
    }
}
