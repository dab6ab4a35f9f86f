//! Interface of an energy, implemented by `#[piola::material]` and used by the rest of piola.
//!
//! An isotropic energy density ψ(λ1, λ2, λ3), in Pa, is a function of the signed principal stretches λ1 ≥ λ2
//! ≥ |λ3| of a deformation gradient. Its stress and tangent need only its first and second derivatives in the
//! stretches and, for each pair of them, two difference quotients (names after \[SGK19\]):
//!
//! ```text
//! flip   D⁻ij = (ψi − ψj) / (λi − λj)
//! twist  D⁺ij = (ψi + ψj) / (λi + λj)
//! ```
//!
//! Pairs are ordered (1,2), (1,3), (2,3) everywhere: [`PAIRS`].
//!
//! \[SGK19\] Smith, de Goes, Kim, *Analytic Eigensystems for Isotropic Distortion Energies*, 2019.
//!
//! This module is independent of matrices: [`crate::point`] computes the stress from the derivatives.

use crate::lanes::{Mask, Real, Scalar};
use crate::message::number;

pub(crate) mod condition;
pub(crate) mod constructor;
mod description;
mod error;
pub(crate) mod parameter;
#[cfg(feature = "batch")]
pub(crate) mod properties;
mod response;

pub use description::{Description, Form, Parameter, Text, Typical, Unit};
pub use error::{Argument, MaterialError};
pub use parameter::{Graded, ParameterValue, PerPoint, PerPointError};
pub use response::Response;
pub(crate) use response::{RawTile, ResponseKind};

/// The pairs of stretches, in the order in which flips, twists and mixed second derivatives are stored.
pub const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// First and second derivatives of an energy density at one triple of stretches, with its quotients. All in
/// Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocks<R> {
    /// First derivatives ψ1, ψ2, ψ3.
    pub gradient: [R; 3],
    /// Second derivatives ψ11, ψ22, ψ33, ψ12, ψ13, ψ23.
    pub hessian: [R; 6],
    /// Flips D⁻ of the [`PAIRS`].
    pub flip: [R; 3],
    /// Twists D⁺ of the [`PAIRS`].
    pub twist: [R; 3],
}

/// An isotropic hyperelastic energy in principal stretches, usually written by `#[piola::material]`.
///
/// The stretches are signed: λ1 ≥ λ2 ≥ |λ3|, the sign of λ3 being that of det F. Outside the domain
/// ([`Material::admits`]) results are meaningless and may be NaN.
///
/// Methods that compute should be `#[inline(always)]`, and so should the functions that they call: only code
/// that is inlined into the functions of a [`Backend`](crate::lanes::Backend) has its instructions.
pub trait Material: Send + Sync {
    /// Energy density ψ, J/m³ of rest volume.
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R; // behind `dyn`: piola::DynMaterial

    /// Gradient ψ1, ψ2, ψ3, Pa.
    ///
    /// `#[piola::material]` overrides it with the operations of the gradient alone; as given here it is the
    /// gradient of [`Material::blocks`].
    #[inline(always)]
    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        self.blocks(stretches).gradient
    }

    /// Gradient ψ1, ψ2, ψ3 at the stretches 1 + si, Pa, for principal Biot strains s1 ≥ s2 ≥ s3 > −1.
    ///
    /// `#[piola::material]` overrides it so that terms that cancel at rest are never formed: each is accurate
    /// relative to the strains, even if these are tiny. As given here it is as accurate as 1 + si.
    #[inline(always)]
    fn gradient_at_strains<R: Real>(&self, [s1, s2, s3]: [R; 3]) -> [R; 3] {
        let one = R::splat(1.0);
        self.gradient([one + s1, one + s2, one + s3])
    }

    /// Gradient, Hessian and quotients, Pa. No gap between stretches is special, zero included.
    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R>;

    /// True if the energy in use is defined at these stretches.
    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask;

    /// True if ψ is a function of the invariants I1, I2 and J alone. `#[piola::material]` detects this if the
    /// declaration names no stretch, or only in sums such as Σ (λ² − 1)².
    ///
    /// The four methods below then give ψ, P and dP/dF without a singular value decomposition:
    ///
    /// ```text
    /// P = 2 W1 F + 2 W2 (I1 F − F Fᵀ F) + WJ cof F,   W1 = ∂ψ/∂I1, W2 = ∂ψ/∂I2, WJ = ∂ψ/∂J
    /// ```
    ///
    /// Each number is as accurate, relative to the terms of its sum, as by stretches: near rest these cancel,
    /// so that P errs by u times the moduli even at tiny strains; [`Material::gradient_at_strains`] is more
    /// accurate. The range is that of I2 and J, which ends at the cube root of that of stretches.
    #[inline(always)]
    fn has_invariants(&self) -> bool {
        false
    }

    /// True if ψ by invariants depends on I2. If not, W2, W22, W12 and W2J count as zero, the argument for I2
    /// is ignored, and dP/dF takes half as many operations.
    #[inline(always)]
    fn has_second_invariant(&self) -> bool {
        true
    }

    /// Second derivatives of ψ by invariants that do not vanish everywhere. The others count as zero, and
    /// dP/dF takes fewer operations.
    #[inline(always)]
    fn curvature_by_invariants(&self) -> Curvature {
        Curvature::All
    }

    /// True if ψ itself is computed from the invariants too. Near rest Σ (λ² − 1)², for example, has more
    /// digits.
    #[inline(always)]
    fn has_energy_by_invariants(&self) -> bool {
        self.has_invariants()
    }

    /// Energy density ψ, J/m³ of rest volume, from \[I1, I2, J\]; NaN without
    /// [`Material::has_energy_by_invariants`].
    #[inline(always)]
    fn energy_by_invariants<R: Real>(&self, _: [R; 3]) -> R {
        R::splat(f64::NAN)
    }

    /// Derivatives W1, W2, WJ, Pa, from \[I1, I2, J\]; NaN without [`Material::has_invariants`].
    #[inline(always)]
    fn gradient_by_invariants<R: Real>(&self, _: [R; 3]) -> [R; 3] {
        [R::splat(f64::NAN); 3]
    }

    /// Derivatives W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J, Pa, from \[I1, I2, J\]; NaN without
    /// [`Material::has_invariants`].
    #[inline(always)]
    fn derivatives_by_invariants<R: Real>(&self, _: [R; 3]) -> [R; 9] {
        [R::splat(f64::NAN); 9]
    }

    /// True if \[I1, I2, J\] give the energy in use; false without [`Material::has_invariants`].
    ///
    /// For an extended energy they do if all stretches are surely above ε, that is, for 2J > ε I1, so that no
    /// pole is near. Elsewhere [`Material::admits`] decides.
    #[inline(always)]
    fn admits_invariants<R: Real>(&self, _: [R; 3]) -> R::Mask {
        R::Mask::splat(false)
    }

    /// True if some twist has a true pole at λi + λj = 0, where the stress itself jumps.
    ///
    /// Its denominator has the lower bound [`pole_floor`](crate::quotient::pole_floor); a point there is
    /// `bounded`.
    fn has_pole(&self) -> bool;

    /// True if the domain ends at J = 0, so that the sign of a tiny λ3 decides and needs an exact
    /// determinant.
    fn ends_at_zero_volume(&self) -> bool;

    /// Treatment of deformations beyond the end of the domain at J = 0, as chosen for this material.
    fn inversion(&self) -> Inversion {
        Inversion::Refuse
    }

    /// Small-strain moduli from a source other than the Hessian at rest, such as a declaration; the
    /// [`contract`](mod@crate::contract) compares the two.
    fn stated_moduli(&self) -> Option<Moduli> {
        None
    }

    /// True if [`respond_together`](Self::respond_together) should receive many points at once.
    #[doc(hidden)]
    const RESPONDS_TOGETHER: bool = false;

    /// Computes a response of a tile, whose points have the materials `material(point)`; returns those inside
    /// the domain as bits.
    ///
    /// For materials whose cost is per operation and not per point, such as an interpreter. Called only if
    /// [`RESPONDS_TOGETHER`](Self::RESPONDS_TOGETHER) is true.
    #[doc(hidden)]
    fn respond_together<'m, E: Scalar>(
        material: impl Fn(usize) -> &'m Self + Copy,
        response: ResponseKind,
        tile: RawTile<'_, E>,
    ) -> u64
    where
        Self: 'm,
    {
        let _ = (material, response, tile);
        0
    }
}

/// Second derivatives of an energy by I1, I2 and J that do not vanish everywhere:
/// [`Material::curvature_by_invariants`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curvature {
    /// W11: f(I1) + d I2, without J and without a condition on I2 or J. Derivatives and domain are then
    /// computed from I1 alone: their arguments for I2 and J are zero.
    First,
    /// WJJ: c I1 + d I2 + g(J).
    Volume,
    /// W11 and WJJ: f(I1) + d I2 + g(J).
    Separate,
    /// All of them.
    All,
}

impl Curvature {
    /// Second derivatives of a sum of energies.
    #[cfg(feature = "batch")]
    pub(crate) const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::All, _) | (_, Self::All) => Self::All,
            (Self::First, Self::First) => Self::First,
            (Self::Volume, Self::Volume) => Self::Volume,
            _ => Self::Separate,
        }
    }

    /// The terms of dP/dF that are computed: true if those with derivatives by I2 are, with W11, with
    /// derivatives by J, and with other second derivatives.
    #[inline(always)]
    pub(crate) fn terms(self, has_second: bool) -> [bool; 4] {
        match self {
            // With I2 like `Separate`: W2 and W11 share a term.
            Self::Volume => [has_second, has_second, true, false],
            Self::Separate => [has_second, true, true, false],
            Self::All => [has_second, true, true, true],
            // Without I2 like `Separate`: it has no kernel of its own.
            Self::First => [has_second, true, !has_second, false],
        }
    }

    /// True if derivative k of W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J is never read, since it is zero
    /// everywhere.
    #[cfg(feature = "batch")]
    #[inline(always)]
    pub(crate) fn leaves_out(self, k: usize, has_second: bool) -> bool {
        let [_, has_first, has_volume, has_mixed] = self.terms(has_second);
        match k {
            1 => !has_second,
            2 | 5 => !has_volume,
            3 => !has_first,
            7 => !has_mixed,
            4 | 6 | 8 => !has_second || !has_mixed,
            _ => false,
        }
    }
}

/// Treatment of deformations beyond a domain that ends at J = 0: J > 0 or J ≠ 0.
///
/// Only that end is a matter of choice: if another condition of the domain fails, such as Gent's on I1, a
/// point is refused with either choice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum Inversion {
    /// Refuses such points by their status, so that a line search takes a shorter step.
    #[default]
    Refuse,
    /// Continues ln λ and real or negative powers of a stretch below `epsilon` as their quadratic Taylor
    /// polynomials.
    ///
    /// The energy stays twice continuously differentiable, isotropic and restoring, and stress and tangent
    /// stay its exact derivatives.
    Extend {
        /// The stretch below which the polynomials are in use, 0 < ε < 1.
        epsilon: f64,
    },
}

/// Small-strain moduli of an isotropic solid, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Moduli {
    /// Shear modulus μ.
    pub mu: f64,
    /// First Lamé parameter λ.
    pub lambda: f64,
}

impl Moduli {
    /// Small-strain moduli from the Hessian at F = I: μ = (ψ11 − ψ12)/2, λ = ψ12.
    #[must_use]
    pub(crate) fn at_rest(material: &(impl Response<f64> + ?Sized)) -> Self {
        let [h11, _, _, h12, _, _] = material.blocks([1.0f64; 3]).hessian;
        Self { mu: 0.5 * (h11 - h12), lambda: h12 }
    }

    /// Small-strain moduli as the material states them, or else from its Hessian at F = I.
    #[doc(hidden)] // `Declared::moduli` for materials of any kind
    #[must_use]
    pub fn of(material: &impl Material) -> Self {
        material.stated_moduli().unwrap_or_else(|| Self::at_rest(material))
    }

    /// Moduli from Young's modulus E, Pa, and Poisson's ratio ν: μ = E/(2 (1 + ν)) and
    /// λ = E ν/((1 + ν) (1 − 2 ν)).
    ///
    /// ```
    /// use piola::material::Moduli;
    ///
    /// # fn main() -> Result<(), piola::material::MaterialError> {
    /// let steel = Moduli::from_young_poisson(2.1e11, 0.3)?;
    /// assert!((steel.mu - 2.1e11 / 2.6).abs() < 1e-3);
    /// assert!(Moduli::from_young_poisson(1e6, 0.5).is_err());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`MaterialError::Other`] unless E > 0 and −1 < ν < 1/2, both finite.
    pub fn from_young_poisson(young: f64, poisson: f64) -> Result<Self, MaterialError> {
        let is_elastic = young > 0.0 && young.is_finite() && poisson > -1.0 && poisson < 0.5;
        if !is_elastic {
            let [young, poisson] = [young, poisson].map(number);
            return Err(MaterialError::Other(format!(
                "Young's modulus is {young} Pa and Poisson's ratio {poisson}; give a finite E > 0 and -1 < ν < 0.5, such as \
                 0.499 for a nearly incompressible solid"
            )));
        }
        Ok(Self {
            mu: young / (2.0 * (1.0 + poisson)),
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
        })
    }

    /// Bulk modulus K = λ + 2μ/3, Pa.
    #[must_use]
    pub fn bulk(&self) -> f64 {
        self.lambda + 2.0 / 3.0 * self.mu
    }

    /// Young's modulus E = μ (3λ + 2μ) / (λ + μ), Pa: from 0 at λ = −2μ/3, where K is, to 3μ as λ grows.
    #[must_use]
    pub fn young(&self) -> f64 {
        self.mu * ((3.0 * self.lambda + 2.0 * self.mu) / (self.lambda + self.mu))
    }

    /// Poisson's ratio ν = λ / (2 (λ + μ)): from −1 at λ = −2μ/3, by 0 at λ = 0, to ½ as λ grows.
    #[must_use]
    pub fn poisson(&self) -> f64 {
        self.lambda / (2.0 * (self.lambda + self.mu))
    }
}

/// A material declared by `#[piola::material]`, buildable from values found at run time.
pub trait Declared: Material + Sized {
    /// Names, formula, parameters and domain of the declaration.
    const DESCRIPTION: Description;

    /// Builds the material from these values, one slice for each entry of [`Description::parameters`].
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if the lengths do not match; other errors are those of the constructor of the
    /// type.
    fn from_values(values: &[&[f64]], inversion: Inversion) -> Result<Self, MaterialError>;

    /// Small-strain moduli, derived from ψ: λ = ψ12 and μ = (ψ11 − ψ12)/2 at rest.
    fn moduli(&self) -> Moduli {
        Moduli::of(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_are_those_that_they_came_from() {
        for poisson in [-0.99, -0.5, 0.0, 0.25, 0.3, 0.45, 0.499_999_9] {
            for young in [1e-3, 1.0, 2e11] {
                let moduli = Moduli::from_young_poisson(young, poisson).expect("elastic");
                // 3λ + 2μ is E/(1 − 2ν), and cancels towards ν = −1; 1 − 2ν has ν's rounding.
                let error = 8.0 * f64::UNIT_ROUNDOFF / (1.0 + poisson);
                assert!((moduli.young() - young).abs() <= error * young, "{moduli:?}");
                assert!((moduli.poisson() - poisson).abs() <= error, "{moduli:?}");
                let bulk = young / (3.0 * (1.0 - 2.0 * poisson));
                assert!((moduli.bulk() - bulk).abs() <= error * bulk, "{moduli:?}");
            }
        }
    }

    #[test]
    fn moduli_have_limits() {
        let no_bulk = Moduli { mu: 3.0, lambda: -2.0 };
        assert_eq!((no_bulk.bulk(), no_bulk.young(), no_bulk.poisson()), (0.0, 0.0, -1.0));
        let no_lateral = Moduli { mu: 3.0, lambda: 0.0 };
        assert_eq!((no_lateral.bulk(), no_lateral.young(), no_lateral.poisson()), (2.0, 6.0, 0.0));
        let nearly_incompressible = Moduli { mu: 3e10, lambda: 1e300 };
        assert_eq!((nearly_incompressible.young(), nearly_incompressible.poisson()), (9e10, 0.5));
    }
}
