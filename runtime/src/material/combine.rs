//! Sums and multiples of materials, which are materials.
//!
//! Energies of the literature are sums: of an isochoric and a volumetric part, of a rubber and its filler.
//! Every response is linear in the energy, so that a sum needs no derivative of its own and is as exact as
//! its parts.

use super::parameter::PerLane;
use super::response::with_responses;
use super::{
    Argument, Blocks, Curvature, Graded, Inversion, Material, MaterialError, Moduli, ParameterValue,
};
use crate::lanes::Real;

/// The sum of two energies: ψ = ψa + ψb.
///
/// It is defined where both energies are. Longer sums nest: `Sum::new(Sum::new(a, b), c)`.
///
/// ```
/// use piola::material;
/// use piola::material::{Moduli, Sum};
///
/// /// μ Σ(λ − 1)²: has no resistance of its own to changes of volume.
/// #[material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// /// c/2 (J − 1)²: part of a sum, since it has no shear modulus.
/// #[material(part)]
/// fn Penalty([l1, l2, l3]: [f64; 3], /** First Lamé parameter, Pa. */ c: f64) -> f64 {
///     c / 2.0 * (J - 1.0).powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let solid = Sum::new(Springs::new(1.0)?, Penalty::new(3.0)?);
/// assert_eq!(Moduli::at_rest(&solid), Moduli { mu: 1.0, lambda: 3.0 });
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<A, B> {
    a: A,
    b: B,
}

impl<A, B> Sum<A, B> {
    /// The sum of two energies.
    ///
    /// Its rest state may be stressed or unstable if that of a part is: [`Moduli::at_rest`] gives the moduli,
    /// and the [`contract`](mod@crate::contract) judges both.
    #[must_use]
    pub fn new(a: A, b: B) -> Self {
        Self { a, b }
    }

    /// Both parts, in the order of [`Sum::new`].
    #[must_use]
    pub fn parts(&self) -> (&A, &B) {
        (&self.a, &self.b)
    }
}

/// A multiple of an energy: s ψ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled<M, P = f64> {
    pub(crate) factor: P,
    pub(crate) material: M,
}

impl<M> Scaled<M> {
    /// Multiplies the energy by a dimensionless factor s.
    ///
    /// # Errors
    /// [`MaterialError::NotFinite`] if the factor is infinite or NaN.
    pub fn new(factor: f64, material: M) -> Result<Self, MaterialError> {
        if !factor.is_finite() {
            return Err(MaterialError::NotFinite { given: Argument::scalar("factor", factor) });
        }
        Ok(Self { factor, material })
    }

    /// The factor s.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// The material whose energy is multiplied.
    #[must_use]
    pub fn material(&self) -> &M {
        &self.material
    }
}

/// A response that is linear in the energy.
trait Linear<R> {
    fn plus(self, other: Self) -> Self;
    fn times(self, factor: R) -> Self;
}

impl<R: Real> Linear<R> for R {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self * factor
    }
}

impl<R: Real, const N: usize> Linear<R> for [R; N] {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        std::array::from_fn(|k| self[k] + other[k])
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self.map(|number| number * factor)
    }
}

impl<R: Real> Linear<R> for Blocks<R> {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self {
            gradient: self.gradient.plus(other.gradient),
            hessian: self.hessian.plus(other.hessian),
            flip: self.flip.plus(other.flip),
            twist: self.twist.plus(other.twist),
        }
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        Self {
            gradient: self.gradient.times(factor),
            hessian: self.hessian.times(factor),
            flip: self.flip.times(factor),
            twist: self.twist.times(factor),
        }
    }
}

impl<R: Real> Linear<R> for (R, Blocks<R>) {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        (self.0 + other.0, self.1.plus(other.1))
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        (self.0 * factor, self.1.times(factor))
    }
}

macro_rules! sum_responses {
    ([] linear { $($linear:ident -> $Linear:ty,)* } domain { $($domain:ident),* }) => {
        impl<A: Material, B: Material> Material for Sum<A, B> {
            const HAS_INVARIANTS: bool = A::HAS_INVARIANTS && B::HAS_INVARIANTS;
            const HAS_SECOND_INVARIANT: bool = A::HAS_SECOND_INVARIANT || B::HAS_SECOND_INVARIANT;
            const CURVATURE_BY_INVARIANTS: Curvature = A::CURVATURE_BY_INVARIANTS.and(B::CURVATURE_BY_INVARIANTS);
            const HAS_ENERGY_BY_INVARIANTS: bool = A::HAS_ENERGY_BY_INVARIANTS && B::HAS_ENERGY_BY_INVARIANTS;
            $(
                #[inline(always)]
                fn $linear<R: Real>(&self, at: [R; 3]) -> $Linear {
                    self.a.$linear(at).plus(self.b.$linear(at))
                }
            )*
            $(
                #[inline(always)]
                fn $domain<R: Real>(&self, at: [R; 3]) -> R::Mask {
                    self.a.$domain(at) & self.b.$domain(at)
                }
            )*
            fn has_invariants(&self) -> bool {
                self.a.has_invariants() && self.b.has_invariants()
            }
            fn has_second_invariant(&self) -> bool {
                self.a.has_second_invariant() || self.b.has_second_invariant()
            }
            fn curvature_by_invariants(&self) -> Curvature {
                self.a.curvature_by_invariants().and(self.b.curvature_by_invariants())
            }
            fn has_energy_by_invariants(&self) -> bool {
                self.a.has_energy_by_invariants() && self.b.has_energy_by_invariants()
            }
            fn has_pole(&self) -> bool {
                self.a.has_pole() || self.b.has_pole()
            }
            fn ends_at_zero_volume(&self) -> bool {
                self.a.ends_at_zero_volume() || self.b.ends_at_zero_volume()
            }
            /// Extension of both parts, or of one if the other is defined everywhere; of two, the one with
            /// the larger ε.
            fn inversion(&self) -> Inversion {
                match (self.a.inversion(), self.b.inversion()) {
                    _ if self.ends_at_zero_volume() => Inversion::Refuse,
                    (Inversion::Extend { epsilon: a }, Inversion::Extend { epsilon: b }) => {
                        Inversion::Extend { epsilon: a.max(b) }
                    }
                    (Inversion::Refuse, inversion) | (inversion, Inversion::Refuse) => inversion,
                }
            }
            fn stated_moduli(&self) -> Option<Moduli> {
                let (a, b) = (self.a.stated_moduli()?, self.b.stated_moduli()?);
                Some(Moduli { mu: a.mu + b.mu, lambda: a.lambda + b.lambda })
            }
        }

        impl<M: Material, P: ParameterValue> Material for Scaled<M, P> {
            const HAS_INVARIANTS: bool = M::HAS_INVARIANTS;
            const HAS_SECOND_INVARIANT: bool = M::HAS_SECOND_INVARIANT;
            const CURVATURE_BY_INVARIANTS: Curvature = M::CURVATURE_BY_INVARIANTS;
            const HAS_ENERGY_BY_INVARIANTS: bool = M::HAS_ENERGY_BY_INVARIANTS;
            $(
                #[inline(always)]
                fn $linear<R: Real>(&self, at: [R; 3]) -> $Linear {
                    self.material.$linear(at).times(self.factor.on())
                }
            )*
            $(
                #[inline(always)]
                fn $domain<R: Real>(&self, at: [R; 3]) -> R::Mask {
                    self.material.$domain(at)
                }
            )*
            fn has_invariants(&self) -> bool {
                self.material.has_invariants()
            }
            fn has_second_invariant(&self) -> bool {
                self.material.has_second_invariant()
            }
            fn curvature_by_invariants(&self) -> Curvature {
                self.material.curvature_by_invariants()
            }
            fn has_energy_by_invariants(&self) -> bool {
                self.material.has_energy_by_invariants()
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
                let Moduli { mu, lambda } = self.material.stated_moduli()?;
                let factor = self.factor.on::<f64>();
                Some(Moduli { mu: factor * mu, lambda: factor * lambda })
            }
        }
    };
}
with_responses!(sum_responses);

impl<A: Graded, B: Graded> Graded for Sum<A, B> {
    type OnLanes<'a>
        = Sum<A::OnLanes<'a>, B::OnLanes<'a>>
    where
        Self: 'a;

    #[inline(always)]
    fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes<'a>
    where
        Self: 'a,
    {
        Sum { a: A::on_lanes(|lane| &material(lane).a), b: B::on_lanes(|lane| &material(lane).b) }
    }
}

impl<M: Graded> Graded for Scaled<M> {
    type OnLanes<'a>
        = Scaled<M::OnLanes<'a>, PerLane>
    where
        Self: 'a;

    #[inline(always)]
    fn on_lanes<'a>(material: impl Fn(usize) -> &'a Self + Copy) -> Self::OnLanes<'a>
    where
        Self: 'a,
    {
        Scaled {
            factor: PerLane::gather(|lane| material(lane).factor),
            material: M::on_lanes(|lane| &material(lane).material),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};

    const STRETCHES: [f64; 3] = [1.3, 0.9, 0.7];

    #[test]
    fn every_response_of_a_sum_is_the_sum_of_its_parts() {
        let sum = Sum::new(NeoHookean, Scaled::new(2.0, SaintVenantKirchhoff).expect("finite"));
        let parts = [NeoHookean.blocks(STRETCHES), SaintVenantKirchhoff.blocks(STRETCHES)];
        let (energy, blocks) = sum.energy_and_blocks(STRETCHES);
        assert_eq!(energy, NeoHookean.energy(STRETCHES) + 2.0 * SaintVenantKirchhoff.energy(STRETCHES));
        assert_eq!(sum.gradient(STRETCHES), blocks.gradient);
        for k in 0..3 {
            assert_eq!(blocks.gradient[k], parts[0].gradient[k] + 2.0 * parts[1].gradient[k]);
            assert_eq!(blocks.flip[k], parts[0].flip[k] + 2.0 * parts[1].flip[k]);
            assert_eq!(blocks.twist[k], parts[0].twist[k] + 2.0 * parts[1].twist[k]);
        }
        for k in 0..6 {
            assert_eq!(blocks.hessian[k], parts[0].hessian[k] + 2.0 * parts[1].hessian[k]);
        }
    }

    #[test]
    fn a_sum_is_defined_where_both_parts_are() {
        let inverted: [f64; 3] = [1.3, 0.9, -0.7];
        let everywhere = Sum::new(RotatedLinear, SaintVenantKirchhoff);
        assert!(everywhere.admits(inverted) && everywhere.inversion() == Inversion::Refuse);
        let refusing = Sum::new(RotatedLinear, NeoHookean);
        assert!(!refusing.admits(inverted) && refusing.ends_at_zero_volume());
        let extended = Sum::new(RotatedLinear, ExtendedNeoHookean { epsilon: 0.2 });
        assert!(extended.admits(inverted) && extended.inversion() == Inversion::Extend { epsilon: 0.2 });
        let half = Sum::new(ExtendedNeoHookean { epsilon: 0.2 }, NeoHookean);
        assert!(!half.admits(inverted) && half.inversion() == Inversion::Refuse);
    }

    #[test]
    fn an_infinite_factor_is_refused() {
        for factor in [f64::NAN, f64::INFINITY] {
            assert!(matches!(Scaled::new(factor, NeoHookean), Err(MaterialError::NotFinite { .. })));
        }
    }
}
