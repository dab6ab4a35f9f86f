//! Parameters that differ from point to point, as those of a graded or fitted body do.
//!
//! What a declaration computes reads its parameters through [`Parameters`]: with [`Uniform`] every number of a batch gets
//! those of one material, at no cost; with [`Each`] every number gets those of a material of its own.

use std::fmt;

use super::{Blocks, Material};
use crate::lanes::{Mask, Real};

/// A material whose parameters may differ from point to point: every declared one without functions as parameters.
///
/// Each method is that of [`Material`] without the ending `_of`, for the materials of several points. All of them must have
/// the same [`inversion`](Material::inversion), threshold included, as [`Each`] makes sure: it decides which program runs.
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
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let springs = [Springs::new(1.0)?, Springs::new(2.0)?];
/// let stretches = [[1.5, 1.5], [1.0, 1.0], [1.0, 0.5]].map(|lanes| Pair::<f64>::load(&lanes));
/// let mut energies = [0.0; 2];
/// Springs::energy_of(&Each::new(&springs)?, stretches).store(&mut energies);
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

/// A material for each number, in their order. Where there are fewer, the last one serves for the rest.
///
/// As the energy of a `piola::batch::Batch`, a material for each point.
#[derive(Clone, Copy, Debug)]
pub struct Each<'a, M>(&'a [M]);

impl<'a, M: Varying> Each<'a, M> {
    /// All materials must do the same outside their domain.
    ///
    /// # Errors
    /// Where there is none, or two differ in their [`Inversion`](super::Inversion).
    pub fn new(materials: &'a [M]) -> Result<Self, Mixed> {
        let first = materials.first().ok_or(Mixed { material: 0 })?.inversion();
        match materials.iter().position(|material| material.inversion() != first) {
            None => Ok(Self(materials)),
            Some(material) => Err(Mixed { material }),
        }
    }
}

#[cfg(feature = "batch")]
impl<'a, M> Each<'a, M> {
    /// One for each number, at least one.
    #[inline(always)]
    pub(crate) fn materials(&self) -> &'a [M] {
        self.0
    }

    /// Those from number `start` on, which must be one of them.
    #[inline(always)]
    pub(crate) fn from(&self, start: usize) -> Self {
        Self(&self.0[start..])
    }
}

impl<M> Parameters<M> for Each<'_, M> {
    #[inline(always)]
    fn read<R: Real>(&self, parameter: impl Fn(&M) -> f64) -> R {
        let last = self.0.len() - 1;
        R::from_fn(|lane| parameter(&self.0[lane.min(last)]))
    }

    #[inline(always)]
    fn first(&self) -> &M {
        &self.0[0]
    }
}

/// Why materials cannot be evaluated together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mixed {
    /// The first one whose [`Inversion`](super::Inversion) is not that of material 0; 0 where there is none at all.
    pub material: usize,
}

impl fmt::Display for Mixed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.material {
            0 => f.write_str("there is no material: give one for each point"),
            k => write!(
                f,
                "material {k} does something else outside its domain than material 0: build all with the same inversion"
            ),
        }
    }
}

impl std::error::Error for Mixed {}
