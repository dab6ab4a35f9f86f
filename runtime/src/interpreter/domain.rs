//! The volumes for which an energy is defined.

use piola_codegen::read::domain::Volume;

use crate::lanes::{Mask, Real};
use crate::material::Inversion;

/// Volumes for which a material is defined, as a condition on the arguments of a response.
#[derive(Clone, Copy)]
pub(super) struct VolumeBound {
    pub(super) volume: Volume,
    pub(super) inversion: Inversion,
    /// True if the arguments are I1, I2 and J, not stretches.
    pub(super) is_by_invariants: bool,
}

impl VolumeBound {
    /// True if there is no bound.
    #[inline(always)]
    pub(super) fn is_any(self) -> bool {
        let is_refused = self.inversion == Inversion::Refuse;
        self.volume == Volume::Any || !self.is_by_invariants && !is_refused
    }

    /// True if volumes are inside the domain.
    #[inline(always)]
    pub(super) fn holds<R: Real>(self, [first, _, last]: [R; 3]) -> R::Mask {
        let zero = R::splat(0.0);
        match (self.volume, self.inversion) {
            _ if self.is_any() => R::Mask::splat(true),
            // λ1 λ2 ≤ (λ1² + λ2²)/2, so λ3 ≥ 2J/I1: no stretch is below ε where 2J > ε I1.
            (_, Inversion::Extend { epsilon }) => (R::splat(epsilon) * first).less(last + last),
            // J > 0 is λ3 > 0 and J ≠ 0 is |λ3| > 0.
            (Volume::Nonzero, Inversion::Refuse) => zero.less(last.abs()),
            (_, Inversion::Refuse) => zero.less(last),
        }
    }
}
