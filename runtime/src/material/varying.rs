//! Parameters that differ from point to point, as those of a graded or fitted body do.
//!
//! What a declaration computes reads its parameters through [`Parameters`]: with [`Uniform`] every number of a batch gets
//! those of one material, at no cost; with [`Each`] every number gets those of a material of its own.

use super::{Blocks, Inversion, Material};
use crate::lanes::{Mask, Real};

/// A material whose parameters may differ from point to point: every declared one without functions as parameters.
///
/// Each method is that of [`Material`] without the ending `_of`, for the materials of several points. All of them must have
/// the same [`inversion`](Varying::inversion), threshold included: it decides which program runs, and that of the first
/// one is taken for all.
///
/// ```
/// use piola::lanes::{Lanes, Pair};
/// use piola::material::{Each, Varying};
/// use piola::{Material, material};
///
/// /// μ/2 Σ(λ − 1)².
/// #[material]
/// fn Springs([l1, l2, l3]: [f64; 3], /** Stiffness, Pa. */ mu: f64) -> f64 {
///     mu / 2.0 * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
/// }
///
/// # fn main() -> Result<(), piola::material::Inadmissible> {
/// let springs = [Springs::new(1.0)?, Springs::new(2.0)?];
/// let stretches = [[1.5, 1.5], [1.0, 1.0], [1.0, 0.5]].map(|lanes| Pair::<f64>::load(&lanes));
/// let mut energies = [0.0; 2];
/// Springs::energy_of(&Each(&springs), stretches).store(&mut energies);
/// assert_eq!(energies, [springs[0].energy([1.5, 1.0, 1.0]), springs[1].energy([1.5, 1.0, 0.5])]);
/// # Ok(())
/// # }
/// ```
pub trait Varying: Material + Sized {
    /// ψ, J/m³ of rest volume.
    fn energy_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> R;

    /// ψ1, ψ2, ψ3, Pa.
    fn gradient_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> [R; 3];

    /// ψ1, ψ2, ψ3 at the stretches 1 + si, Pa.
    fn gradient_at_strains_of<R: Real>(materials: &impl Parameters<Self>, strains: [R; 3]) -> [R; 3];

    /// Gradient, Hessian and quotients, Pa.
    fn blocks_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> Blocks<R>;

    /// Where the energies in use are defined.
    fn admits_of<R: Real>(materials: &impl Parameters<Self>, stretches: [R; 3]) -> R::Mask;

    /// ψ from the invariants, J/m³; NaN without [`HAS_INVARIANTS`](Material::HAS_INVARIANTS).
    #[inline(always)]
    fn energy_by_invariants_of<R: Real>(_: &impl Parameters<Self>, _: [R; 3]) -> R {
        R::splat(f64::NAN)
    }

    /// W1, W2, WJ from the invariants, Pa; NaN without [`HAS_INVARIANTS`](Material::HAS_INVARIANTS).
    #[inline(always)]
    fn gradient_by_invariants_of<R: Real>(_: &impl Parameters<Self>, _: [R; 3]) -> [R; 3] {
        [R::splat(f64::NAN); 3]
    }

    /// Where the invariants give the energies in use; nowhere without [`HAS_INVARIANTS`](Material::HAS_INVARIANTS).
    #[inline(always)]
    fn admits_invariants_of<R: Real>(_: &impl Parameters<Self>, _: [R; 3]) -> R::Mask {
        R::Mask::splat(false)
    }

    /// What the material does outside its domain.
    fn inversion(&self) -> Inversion;
}

/// The parameters of the materials that the numbers of a [`Real`] belong to.
pub trait Parameters<M> {
    /// A parameter of each number's material.
    fn read<R: Real>(&self, parameter: impl Fn(&M) -> f64) -> R;

    /// The material of the first number.
    fn first(&self) -> &M;
}

/// One material for all numbers.
#[derive(Clone, Copy, Debug)]
pub struct Uniform<'a, M>(pub &'a M);

impl<M> Parameters<M> for Uniform<'_, M> {
    #[inline(always)]
    fn read<R: Real>(&self, parameter: impl Fn(&M) -> f64) -> R {
        R::splat(parameter(self.0))
    }

    #[inline(always)]
    fn first(&self) -> &M {
        self.0
    }
}

/// A material for each number, in their order; evaluation panics where there are fewer.
#[derive(Clone, Copy, Debug)]
pub struct Each<'a, M>(pub &'a [M]);

impl<M> Parameters<M> for Each<'_, M> {
    #[inline(always)]
    fn read<R: Real>(&self, parameter: impl Fn(&M) -> f64) -> R {
        R::from_fn(|lane| parameter(&self.0[lane]))
    }

    #[inline(always)]
    fn first(&self) -> &M {
        &self.0[0]
    }
}
