//! Divided differences φ[a, b] = (φ(a) − φ(b)) / (a − b) that never subtract close values.
//!
//! Generated materials call these. Each is accurate to a few u for every gap a − b, zero included: where a kernel
//! switches between two formulas, both are accurate on both sides of the switch, and neither is a limit.

use crate::lanes::Real;

/// Below this, λi + λj is rounding noise of stretches whose largest is λ1: 2u λ1, and never zero.
///
/// A backward-stable singular value decomposition knows each stretch to a few u λ1 and no better. The absolute part
/// keeps the quotient finite where all stretches vanish.
#[inline(always)]
pub fn pole_floor<R: Real>(stretches: [R; 3]) -> R {
    (R::splat(2.0 * R::UNIT_ROUNDOFF) * stretches[0].abs()).max(R::splat(R::MIN_POSITIVE.sqrt()))
}
