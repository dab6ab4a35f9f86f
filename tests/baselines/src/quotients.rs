//! Quotients as they are usually written: plain, and with a switch to their limits; and materials that a
//! method changes.

use piola::material::{Blocks, PAIRS};
use piola::{Material, Real};

/// A material that a method changes.
#[derive(Clone, Copy, Debug)]
pub struct Changed<M, C>(pub M, pub C);

/// Change of a material.
pub trait Change: Send + Sync {
    /// The stretches that the material is shown.
    #[inline(always)]
    fn shown<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        stretches
    }

    /// The blocks of a material at these stretches, with the quotients of the method.
    #[inline(always)]
    fn blocks<R: Real>(&self, _stretches: [R; 3], blocks: Blocks<R>) -> Blocks<R> {
        blocks
    }
}

impl<M: Material, C: Change> Material for Changed<M, C> {
    #[inline(always)]
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        self.0.energy(self.1.shown(stretches))
    }

    #[inline(always)]
    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        self.0.gradient(self.1.shown(stretches))
    }

    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        let shown = self.1.shown(stretches);
        self.1.blocks(shown, self.0.blocks(shown))
    }

    #[inline(always)]
    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        self.0.admits(self.1.shown(stretches))
    }

    fn has_pole(&self) -> bool {
        self.0.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.0.ends_at_zero_volume()
    }
}

/// Flips and twists as (ψi ∓ ψj)/(λi ∓ λj), for any gap; NaN if it is zero.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl Change for Plain {
    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3], blocks: Blocks<R>) -> Blocks<R> {
        with_quotients(stretches, blocks, |numerator, gap, _, _| numerator / gap)
    }
}

/// Flips and twists as quotients, or l'Hôpital's limits ψii ∓ ψij at gaps below `threshold`·max(|λi|, |λj|).
///
/// The limit of the twist is that of an energy which is even in the two stretches; at a pole there is none.
#[derive(Clone, Copy, Debug)]
pub struct Switch {
    /// Relative to the stretches.
    pub threshold: f64,
}

impl Change for Switch {
    #[inline(always)]
    fn blocks<R: Real>(&self, stretches: [R; 3], blocks: Blocks<R>) -> Blocks<R> {
        with_quotients(stretches, blocks, |numerator, gap, scale, limit| {
            let is_close = gap.abs().less(R::splat(self.threshold) * scale) | !R::splat(0.0).less(gap.abs());
            R::select(is_close, limit, numerator / gap)
        })
    }
}

/// Quotients from numerator, gap, size of the two stretches, and limit. The compiler drops those of `blocks`,
/// which nobody reads.
#[inline(always)]
fn with_quotients<R: Real>(
    stretches: [R; 3],
    Blocks { gradient, hessian, .. }: Blocks<R>,
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
