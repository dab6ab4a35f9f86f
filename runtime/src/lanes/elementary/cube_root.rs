//! ∛x without a division: an estimate of the reciprocal root is refined, then the root itself.

use super::arithmetic::{nearest_integer_to_product, polynomial, residual};
use crate::lanes::primitive::Primitive;

/// m^(−⅓) as a polynomial, for √½ ≤ m < √2, to 2⁻¹¹ (`f32`: 2⁻⁶).
#[inline(always)]
fn reciprocal_root<P: Primitive>(m: P) -> P {
    const SINGLE: [f64; 2] = [1.336_134_2, -0.323_152_9];
    const DOUBLE: [f64; 4] =
        [1.730_709_736_227_713, -1.285_732_061_066_093_8, 0.713_340_762_339_568, -0.158_539_809_173_584_35];
    polynomial(m, &SINGLE, &DOUBLE)
}

/// 1 + slope j + curvature j².
#[inline(always)]
fn parabola<P: Primitive>(j: P, slope: f64, curvature: f64) -> P {
    j.mul_add(P::splat(curvature), P::splat(slope)).mul_add(j, P::splat(1.0))
}

/// ∛x.
///
/// |x| = 2³ᵠ a with a = 2ʲ m and j = −1, 0 or 1, and ∛x = 2ᵠ ∛a.
#[inline(always)]
pub(in super::super) fn cbrt<P: Primitive>(x: P) -> P {
    let (m, e) = x.abs().split();
    let third = P::splat(1.0 / 3.0);
    let q = nearest_integer_to_product(e, third);
    let j = q.mul_add(P::splat(-3.0), e);
    // Parabolas through the three values of 2ʲ, exact, and of 2^(−j/3).
    let a = m * parabola(j, 0.75, 0.25);
    let root_of_power = parabola(j, -0.233_110_261_955_386_7, 0.026_810_787_939_486_45);

    // y ≈ a^(−⅓) with the relative error δ: with g = 1 − a y³ the next one is y (1 + g/3 + 2g²/9), to 5δ³.
    let y = reciprocal_root(m) * root_of_power;
    let g = (a * (y * y)).mul_add(-y, P::splat(1.0));
    let y = (y * g).mul_add(g.mul_add(P::splat(2.0 / 9.0), third), y);
    // c ≈ ∛a to 10δ³. Newton's step c − (c³ − a)/(3c²), with y² for 1/c², squares that error, and so it is
    // below the last bit.
    let y2 = y * y;
    let c = a * y2;
    let excess = residual(c * c, c, -a);
    let root = (y2 * third).mul_add(-excess, c).scale(q).copysign(x);
    P::select(e.is_finite(), root, x)
}
