//! An energy with wanted small-strain moduli, whatever its own are.
//!
//! Two energies can only be compared by how they go on if they begin alike \[CB24\]: with the same linearisation of P at rest,
//! that is, with the same Young's modulus E and Poisson's ratio ν. A factor gives any energy the shear modulus that is wanted,
//! and what then lacks in resistance to changes of volume is added:
//!
//! ```text
//! ψ' = s ψ + c/2 (J − 1)²,    s = μ*/μ,    c = λ* − s λ
//! ```
//!
//! with μ, λ of the energy and μ*, λ* of E and ν. (J − 1)² has ψ11 = ψ12 = 1 at rest, so that it changes λ alone.
//!
//! | of c/2 (J − 1)² | |
//! |---|---|
//! | ψi | c (J − 1) λjλk |
//! | ψii | c (λjλk)² |
//! | ψij | c (2J − 1) λk |
//! | D⁻ij | −c (J − 1) λk |
//! | D⁺ij | c (J − 1) λk |
//! | ∂ψ/∂J | c (J − 1) |
//!
//! These are polynomials: no quotient is formed, nothing but J − 1 cancels, there is no pole, and inverted material is driven
//! back by them as well. J − 1 comes from strains without cancelling the one.
//!
//! \[CB24\] Chen, Barbič, *Tuning Nonlinear Elastic Materials under Small and Large Deformations*, arXiv 2412.18631, 2024. Aim
//! and meaning of E and ν are those of its abstract, which alone was at hand: the term by which it makes up for another λ may
//! differ from ours. Its third property, how nonlinear an energy is at large strain, is not set here.

use super::{Blocks, Inadmissible, Inversion, Material, Moduli, PAIRS, Parameters, Varying};
use crate::lanes::Real;

/// A material with the small-strain moduli of a wanted E and ν: s ψ + c/2 (J − 1)².
///
/// Domain, inversion and poles are those of the material. Of one whose rest state carries stress, that stress is multiplied by s.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalised<M> {
    material: M,
    moduli: Moduli,
    scale: f64,
    volumetric: f64,
}

impl<M: Material> Normalised<M> {
    /// The material with Young's modulus E > 0, Pa, and Poisson's ratio −1 < ν < ½, both of small strain.
    ///
    /// # Errors
    /// E or ν outside these bounds; a material that is unstable at rest; and ν below that of the material itself, since c < 0 would
    /// take away resistance to changes of volume, the more the larger they are.
    pub fn new(material: M, young: f64, poisson: f64) -> Result<Self, Inadmissible> {
        let moduli = Moduli::from_young_poisson(young, poisson)?;
        let own = Moduli::at_rest(&material);
        if !(own.mu > 0.0 && own.bulk() >= 0.0 && own.bulk().is_finite()) {
            return Err(Inadmissible::UnstableRest { moduli: own });
        }
        let lowest = own.poisson();
        // Its own ratio is no ratio below, however it was rounded.
        if poisson < lowest - 8.0 * f64::UNIT_ROUNDOFF {
            return Err(Inadmissible::BelowOwnPoisson { poisson, lowest });
        }
        let scale = moduli.mu / own.mu;
        let volumetric = (moduli.lambda - scale * own.lambda).max(0.0);
        if !(moduli.mu > 0.0 && scale.is_finite() && volumetric.is_finite()) {
            return Err(Inadmissible::UnstableRest { moduli });
        }
        Ok(Self { material, moduli, scale, volumetric })
    }
}

impl<M> Normalised<M> {
    /// The material as it was.
    #[must_use]
    pub fn material(&self) -> &M {
        &self.material
    }

    /// Those that were wanted.
    #[must_use]
    pub fn moduli(&self) -> Moduli {
        self.moduli
    }

    /// s, by which the energy is multiplied.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// c ≥ 0 of c/2 (J − 1)², Pa.
    #[must_use]
    pub fn volumetric(&self) -> f64 {
        self.volumetric
    }
}

/// s and c for each number of a [`Real`], and what becomes of the material's own numbers.
struct Factors<R> {
    s: R,
    c: R,
}

impl<R: Real> Factors<R> {
    #[inline(always)]
    fn of<M>(material: &Normalised<M>) -> Self {
        Self { s: R::splat(material.scale), c: R::splat(material.volumetric) }
    }

    #[inline(always)]
    fn read<M>(materials: &impl Parameters<Normalised<M>>) -> Self {
        Self {
            s: materials.read(|material| material.scale),
            c: materials.read(|material| material.volumetric),
        }
    }

    /// J − 1, by one rounding where there is a fused instruction.
    #[inline(always)]
    fn dilation([l1, l2, l3]: [R; 3]) -> R {
        l3.mul_add(l1 * l2, R::splat(-1.0))
    }

    #[inline(always)]
    fn energy(self, own: R, dilation: R) -> R {
        self.s.mul_add(own, R::splat(0.5) * self.c * dilation * dilation)
    }

    #[inline(always)]
    fn gradient(&self, own: [R; 3], dilation: R, [l1, l2, l3]: [R; 3]) -> [R; 3] {
        let pressure = self.c * dilation;
        let areas = [l2 * l3, l1 * l3, l1 * l2];
        std::array::from_fn(|i| self.s.mul_add(own[i], pressure * areas[i]))
    }

    #[inline(always)]
    fn blocks(self, own: Blocks<R>, l: [R; 3]) -> Blocks<R> {
        let dilation = Self::dilation(l);
        let pressure = self.c * dilation;
        let areas = [l[1] * l[2], l[0] * l[2], l[0] * l[1]];
        // 2J − 1.
        let mixed = self.c * (dilation + dilation + R::splat(1.0));
        // Of the stretch that is not in the pair.
        let third: [R; 3] = PAIRS.map(|(i, j)| l[3 - i - j]);
        Blocks {
            gradient: self.gradient(own.gradient, dilation, l),
            hessian: std::array::from_fn(|k| {
                let volumetric = if k < 3 { self.c * areas[k] * areas[k] } else { mixed * third[k - 3] };
                self.s.mul_add(own.hessian[k], volumetric)
            }),
            flip: std::array::from_fn(|k| self.s.mul_add(own.flip[k], -(pressure * third[k]))),
            twist: std::array::from_fn(|k| self.s.mul_add(own.twist[k], pressure * third[k])),
        }
    }

    #[inline(always)]
    fn gradient_at_strains(self, own: [R; 3], [s1, s2, s3]: [R; 3]) -> [R; 3] {
        let one = R::splat(1.0);
        // λ1 λ2 − 1, and with it J − 1.
        let area = s1.mul_add(s2, s1 + s2);
        let dilation = area.mul_add(s3, area + s3);
        self.gradient(own, dilation, [one + s1, one + s2, one + s3])
    }

    #[inline(always)]
    fn gradient_by_invariants(self, [w1, w2, wj]: [R; 3], [_, _, volume]: [R; 3]) -> [R; 3] {
        [self.s * w1, self.s * w2, self.s.mul_add(wj, self.c * (volume - R::splat(1.0)))]
    }
}

impl<M: Material> Material for Normalised<M> {
    #[inline(always)]
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        Factors::of(self).energy(self.material.energy(stretches), Factors::dilation(stretches))
    }

    #[inline(always)]
    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        let own = self.material.gradient(stretches);
        Factors::of(self).gradient(own, Factors::dilation(stretches), stretches)
    }

    #[inline(always)]
    fn gradient_at_strains<R: Real>(&self, strains: [R; 3]) -> [R; 3] {
        Factors::of(self).gradient_at_strains(self.material.gradient_at_strains(strains), strains)
    }

    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        Factors::of(self).blocks(self.material.blocks(stretches), stretches)
    }

    #[inline(always)]
    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        self.material.admits(stretches)
    }

    const HAS_INVARIANTS: bool = M::HAS_INVARIANTS;

    #[inline(always)]
    fn energy_by_invariants<R: Real>(&self, invariants: [R; 3]) -> R {
        let own = self.material.energy_by_invariants(invariants);
        Factors::of(self).energy(own, invariants[2] - R::splat(1.0))
    }

    #[inline(always)]
    fn gradient_by_invariants<R: Real>(&self, invariants: [R; 3]) -> [R; 3] {
        let own = self.material.gradient_by_invariants(invariants);
        Factors::of(self).gradient_by_invariants(own, invariants)
    }

    #[inline(always)]
    fn admits_invariants<R: Real>(&self, invariants: [R; 3]) -> R::Mask {
        self.material.admits_invariants(invariants)
    }

    fn has_pole(&self) -> bool {
        self.material.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.material.ends_at_zero_volume()
    }

    fn inversion(&self) -> Inversion {
        self.material.inversion()
    }

    fn stated_moduli(&self) -> Option<Moduli> {
        Some(self.moduli)
    }
}

/// The materials inside those that are normalised.
struct Inside<'a, P>(&'a P);

impl<M, P: Parameters<Normalised<M>>> Parameters<M> for Inside<'_, P> {
    #[inline(always)]
    fn read<R: Real>(&self, parameter: impl Fn(&M) -> f64) -> R {
        self.0.read(|normalised| parameter(&normalised.material))
    }

    #[inline(always)]
    fn first(&self) -> &M {
        &self.0.first().material
    }
}

impl<M: Varying> Varying for Normalised<M> {
    #[inline(always)]
    fn energy_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> R {
        let own = M::energy_of(&Inside(materials), stretches);
        Factors::read(materials).energy(own, Factors::dilation(stretches))
    }

    #[inline(always)]
    fn gradient_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> [R; 3] {
        let own = M::gradient_of(&Inside(materials), stretches);
        Factors::read(materials).gradient(own, Factors::dilation(stretches), stretches)
    }

    #[inline(always)]
    fn gradient_at_strains_of<R: Real>(materials: &impl Parameters<Self>, strains: [R; 3]) -> [R; 3] {
        let own = M::gradient_at_strains_of(&Inside(materials), strains);
        Factors::read(materials).gradient_at_strains(own, strains)
    }

    #[inline(always)]
    fn blocks_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> Blocks<R> {
        Factors::read(materials).blocks(M::blocks_of(&Inside(materials), stretches), stretches)
    }

    #[inline(always)]
    fn admits_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> R::Mask {
        M::admits_of(&Inside(materials), stretches)
    }

    #[inline(always)]
    fn energy_by_invariants_of<R: Real>(materials: &impl Parameters<Self>, invariants: [R; 3]) -> R {
        let own = M::energy_by_invariants_of(&Inside(materials), invariants);
        Factors::read(materials).energy(own, invariants[2] - R::splat(1.0))
    }

    #[inline(always)]
    fn gradient_by_invariants_of<R: Real>(materials: &impl Parameters<Self>, invariants: [R; 3]) -> [R; 3] {
        let own = M::gradient_by_invariants_of(&Inside(materials), invariants);
        Factors::read(materials).gradient_by_invariants(own, invariants)
    }

    #[inline(always)]
    fn admits_invariants_of<R: Real>(materials: &impl Parameters<Self>, invariants: [R; 3]) -> R::Mask {
        M::admits_invariants_of(&Inside(materials), invariants)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};

    #[track_caller]
    fn check(material: impl Material, young: f64, poisson: f64) {
        let normalised = Normalised::new(material, young, poisson).expect("admissible");
        let (found, wanted) = (Moduli::at_rest(&normalised), normalised.moduli());
        assert_eq!(Ok(wanted), Moduli::from_young_poisson(young, poisson));
        // Each modulus is a sum of two terms with two roundings each, of numbers no larger than ψ11.
        let tolerance = 8.0 * f64::UNIT_ROUNDOFF * (wanted.lambda.abs() + 2.0 * wanted.mu);
        assert!((found.mu - wanted.mu).abs() <= tolerance, "{found:?} for {wanted:?}");
        assert!((found.lambda - wanted.lambda).abs() <= tolerance, "{found:?} for {wanted:?}");
        assert_eq!(normalised.stated_moduli(), Some(wanted));
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
        let once = || Normalised::new(NeoHookean, 1e6, 0.4).expect("admissible");
        check(once(), 3e5, 0.4);
        check(once(), 3e5, 0.49);
    }

    #[test]
    fn dilation_keeps_its_digits_at_small_strain() {
        let normalised = Normalised::new(RotatedLinear, 1.0, 0.49).expect("admissible");
        let Moduli { mu, lambda } = normalised.moduli();
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
            let error = Normalised::new(NeoHookean, young, poisson).err().expect("inadmissible");
            assert!(matches!(error, Inadmissible::YoungPoisson { .. }), "{error}");
        }
        let error = Normalised::new(NeoHookean, 1.0, 0.2).err().expect("inadmissible");
        let Inadmissible::BelowOwnPoisson { poisson, lowest } = error else { panic!("{error}") };
        assert_eq!(poisson, 0.2);
        // Three roundings of a number below ½.
        assert!((lowest - 0.3).abs() <= 3.0 * f64::UNIT_ROUNDOFF);
    }
}
