//! Whole materials side by side, for parameters that no lane can hold.

use super::parameter::LANES;
use super::response::with_responses;
use super::{Blocks, Curvature, Inversion, Material, Moduli};
use crate::lanes::{Mask, Real};

/// Material for each lane, at most 16: the form of [`Graded`](super::Graded) materials whose parameters are
/// not only numbers.
///
/// Each material is evaluated on all lanes, and the lanes with this material take its results: a lane has the
/// bits that it has alone. Materials count as one if they are equal (`==`), so that the time grows with the
/// number of different materials on the lanes, and lanes with one material cost as much as a single
/// evaluation.
#[derive(Clone, Copy, Debug)]
pub struct Mixed<'a, M> {
    materials: [&'a M; LANES],
}

impl<'a, M: PartialEq> Mixed<'a, M> {
    /// The material `material(lane)` on each lane.
    #[inline(always)]
    pub fn new(material: impl Fn(usize) -> &'a M) -> Self {
        Self { materials: std::array::from_fn(material) }
    }

    /// The lanes that have the material of lane k.
    #[inline(always)]
    fn lanes_like<R: Real>(&self, k: usize) -> R::Mask {
        let is_like = |other: &M| std::ptr::eq(self.materials[k], other) || *self.materials[k] == *other;
        mask::<R>(|lane| is_like(self.materials[lane.min(LANES - 1)]))
    }
}

#[inline(always)]
fn mask<R: Real>(is_set: impl Fn(usize) -> bool) -> R::Mask {
    R::splat(0.5).less(R::from_fn(|lane| f64::from(u8::from(is_set(lane)))))
}

/// Results that lanes take from different materials.
trait Lanewise<R: Real> {
    /// `yes` on the lanes of the mask, `no` elsewhere.
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self;
}

impl<R: Real> Lanewise<R> for R {
    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        <R as Real>::select(mask, yes, no)
    }
}

impl<R: Real, const N: usize> Lanewise<R> for [R; N] {
    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        std::array::from_fn(|k| <R as Real>::select(mask, yes[k], no[k]))
    }
}

impl<R: Real> Lanewise<R> for Blocks<R> {
    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        Self {
            gradient: Lanewise::<R>::select(mask, yes.gradient, no.gradient),
            hessian: Lanewise::<R>::select(mask, yes.hessian, no.hessian),
            flip: Lanewise::<R>::select(mask, yes.flip, no.flip),
            twist: Lanewise::<R>::select(mask, yes.twist, no.twist),
        }
    }
}

impl<R: Real> Lanewise<R> for (R, Blocks<R>) {
    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        (<R as Real>::select(mask, yes.0, no.0), Lanewise::<R>::select(mask, yes.1, no.1))
    }
}

/// Response of each lane's material, given a way to combine the responses of two materials.
macro_rules! each_lane {
    ($self:ident, $response:ident, $at:ident, |$lanes:ident, $of_lanes:ident, $others:ident| $together:expr) => {{
        let mut $others = $self.materials[0].$response($at);
        let mut known = $self.lanes_like::<R>(0);
        for k in 1..LANES {
            if !(!known).any() {
                break;
            }
            // Lanes beyond those of R are in no mask.
            if (!known & mask::<R>(|lane| lane == k)).any() {
                let $lanes = $self.lanes_like::<R>(k);
                let $of_lanes = $self.materials[k].$response($at);
                $others = $together;
                known = known | $lanes;
            }
        }
        $others
    }};
}

macro_rules! mixed_responses {
    ([] linear { $($linear:ident -> $Linear:ty,)* } domain { $($domain:ident),* } properties $_properties:tt) => {
        impl<M: Material + PartialEq> Material for Mixed<'_, M> {
            $(
                #[inline(always)]
                fn $linear<R: Real>(&self, at: [R; 3]) -> $Linear {
                    each_lane!(self, $linear, at, |lanes, found, others| {
                        Lanewise::<R>::select(lanes, found, others)
                    })
                }
            )*
            $(
                #[inline(always)]
                fn $domain<R: Real>(&self, at: [R; 3]) -> R::Mask {
                    each_lane!(self, $domain, at, |lanes, found, others| (lanes & found) | (!lanes & others))
                }
            )*
            fn has_invariants(&self) -> bool {
                self.materials.iter().all(|material| material.has_invariants())
            }
            fn has_second_invariant(&self) -> bool {
                self.materials.iter().any(|material| material.has_second_invariant())
            }
            fn curvature_by_invariants(&self) -> Curvature {
                let all = self.materials.iter().map(|material| material.curvature_by_invariants());
                all.fold(Curvature::Volume, Curvature::and)
            }
            fn has_energy_by_invariants(&self) -> bool {
                self.materials.iter().all(|material| material.has_energy_by_invariants())
            }
            fn has_pole(&self) -> bool {
                self.materials.iter().any(|material| material.has_pole())
            }
            fn ends_at_zero_volume(&self) -> bool {
                self.materials.iter().any(|material| material.ends_at_zero_volume())
            }
            fn inversion(&self) -> Inversion {
                self.materials[0].inversion()
            }
            /// Moduli of all lanes if they agree.
            fn stated_moduli(&self) -> Option<Moduli> {
                let first = self.materials[0].stated_moduli();
                first.filter(|_| self.materials.iter().all(|material| material.stated_moduli() == first))
            }
        }
    };
}
with_responses!(mixed_responses);
