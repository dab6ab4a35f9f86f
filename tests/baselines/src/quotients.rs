//! Quotients as they are usually written: plain, and with a switch to their limits.

use piola::material::{Blocks, PAIRS, Response};
use piola::{Material, Real};

/// All of a material but its blocks, at the stretches that it is shown.
macro_rules! delegate {
    ($material:tt $(, $shown:ident)?) => {
        #[inline(always)]
        fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
            $(let stretches = self.$shown(stretches);)?
            self.$material.energy(stretches)
        }

        #[inline(always)]
        fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
            $(let stretches = self.$shown(stretches);)?
            self.$material.gradient(stretches)
        }

        #[inline(always)]
        fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
            $(let stretches = self.$shown(stretches);)?
            self.$material.admits(stretches)
        }

        fn has_pole(&self) -> bool {
            self.$material.has_pole()
        }

        fn ends_at_zero_volume(&self) -> bool {
            self.$material.ends_at_zero_volume()
        }
    };
}

pub(crate) use delegate;

/// A material with the quotients of [`naive`].
#[derive(Clone, Copy, Debug)]
pub struct Naive<M>(pub M);

/// A material with the quotients of [`lhopital`].
#[derive(Clone, Copy, Debug)]
pub struct Switched<M> {
    /// The material.
    pub material: M,
    /// Relative to the stretches.
    pub threshold: f64,
}

impl<M: Material> Material for Naive<M> {
    delegate!(0);

    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        naive(&self.0, stretches)
    }
}

impl<M: Material> Material for Switched<M> {
    delegate!(material);

    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        lhopital(&self.material, stretches, self.threshold)
    }
}

/// Flips and twists as (ψi ∓ ψj)/(λi ∓ λj), for any gap; NaN if it is zero.
#[inline(always)]
#[must_use]
pub fn naive<R: Real>(material: &(impl Response<R> + ?Sized), stretches: [R; 3]) -> Blocks<R> {
    // The compiler drops the quotients of `blocks`, which nobody reads.
    let Blocks { gradient, hessian, .. } = material.blocks(stretches);
    plain(stretches, gradient, hessian)
}

/// Flips and twists as (ψi ∓ ψj)/(λi ∓ λj), for any gap, from given derivatives.
#[inline(always)]
pub(crate) fn plain<R: Real>(stretches: [R; 3], gradient: [R; 3], hessian: [R; 6]) -> Blocks<R> {
    with_quotients(stretches, gradient, hessian, |numerator, gap, _, _| numerator / gap)
}

/// Flips and twists as quotients, or l'Hôpital's limits ψii ∓ ψij at gaps below `threshold`·max(|λi|, |λj|).
///
/// The limit of the twist is that of an energy which is even in the two stretches; at a pole there is none.
#[inline(always)]
#[must_use]
pub fn lhopital<R: Real>(
    material: &(impl Response<R> + ?Sized),
    stretches: [R; 3],
    threshold: f64,
) -> Blocks<R> {
    let Blocks { gradient, hessian, .. } = material.blocks(stretches);
    with_quotients(stretches, gradient, hessian, |numerator, gap, scale, limit| {
        let is_close = gap.abs().less(R::splat(threshold) * scale) | !R::splat(0.0).less(gap.abs());
        R::select(is_close, limit, numerator / gap)
    })
}

/// Quotients from numerator, gap, size of the two stretches, and limit.
#[inline(always)]
fn with_quotients<R: Real>(
    stretches: [R; 3],
    gradient: [R; 3],
    hessian: [R; 6],
    quotient: impl Fn(R, R, R, R) -> R,
) -> Blocks<R> {
    let (mut flip, mut twist) = ([R::splat(0.0); 3], [R::splat(0.0); 3]);
    for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
        let (x, y) = (stretches[i], stretches[j]);
        let scale = x.abs().max(y.abs());
        let mixed = hessian[3 + pair];
        flip[pair] = quotient(gradient[i] - gradient[j], x - y, scale, hessian[i] - mixed);
        twist[pair] = quotient(gradient[i] + gradient[j], x + y, scale, hessian[i] + mixed);
    }
    Blocks { gradient, hessian, flip, twist }
}
