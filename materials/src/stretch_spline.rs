//! A solid drawn by splines.

use piola::{Spline, material};

/// A solid drawn by hand: one curve for lengths, one for areas, one for the volume.
///
/// ψ = Σ f(λi) + Σ g(λiλj) + h(J).
///
/// Xu, Sin, Zhu, Barbič, *Nonlinear Material Design Using Principal Stretches*, ACM Trans. Graph. 34 (4),
/// 2015. Here the control points are those of the derivatives f′, g′, h′, natural cubic splines, straight
/// beyond the last points; so ψ is defined for every deformation gradient, inverted ones included. A control
/// point (1, 0) on each curve keeps the rest state free of stress, which in general requires f′(1) + 2 g′(1)
/// + h′(1) = 0; falling f′ and h′ towards 0 push an inverted element open.
#[material(
    typical(
        "drawn for this catalogue: a soft rubber that stiffens from three times its length on",
        f = [0.25, -3.6e5, 0.5, -1.8e5, 1.0, 0.0, 2.0, 1.2e5, 3.0, 2.0e5, 5.0, 8.0e5],
        g = [0.1, -2.0e4, 1.0, 0.0, 4.0, 3.0e4],
        h = [0.1, -4.0e6, 0.5, -1.5e6, 1.0, 0.0, 2.0, 2.5e6]
    )
)]
pub fn StretchSpline(
    [l1, l2, l3]: [f64; 3],
    /// Energy f of a stretch, by control points of its derivative, Pa.
    f: Spline,
    /// Energy g of the stretch of an area, by control points of its derivative, Pa.
    g: Spline,
    /// Energy h of the volume, by control points of its derivative, Pa.
    h: Spline,
) -> f64 {
    f(l1) + f(l2) + f(l3) + g(l1 * l2) + g(l2 * l3) + g(l3 * l1) + h(J)
}
