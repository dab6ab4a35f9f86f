//! All results of a point in a row, with their tolerances, for the rules on formats and lanes.

use super::subject::Subject;
use super::{gradient_name, hessian_name, pair_name, stiffness, stress_scale};
use crate::lanes::Real;
use crate::material::Response;

/// Number of entries in a row.
pub(super) const COUNT: usize = 19;

/// Row of results: ψ; ψ1 … ψ3 from `gradient`; gradient, Hessian, flips, twists from `blocks`. Inlined.
#[inline(always)]
pub(super) fn results<R: Real>(material: &(impl Response<R> + ?Sized), stretches: [R; 3]) -> [R; COUNT] {
    let (energy, [g1, g2, g3]) = (material.energy(stretches), material.gradient(stretches));
    let blocks = material.blocks(stretches);
    let [p1, p2, p3] = blocks.gradient;
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let ([f12, f13, f23], [t12, t13, t23]) = (blocks.flip, blocks.twist);
    [energy, g1, g2, g3, p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23]
}

/// Name of an entry by its place in the row.
pub(super) fn name(number: usize) -> String {
    match number {
        0 => "energy".into(),
        1..=3 => format!("{}, as `gradient` gives it", gradient_name(number - 1)),
        4..=6 => format!("{}, as `blocks` gives it", gradient_name(number - 4)),
        7..=12 => hessian_name(number - 7),
        13..=15 => pair_name("flip", number - 13),
        _ => pair_name("twist", number - 16),
    }
}

/// Entries of a row and the tolerance of each in units of u; `None` if the domain ends too near.
///
/// A hundred times the sum of two parts. One is the size of the terms that a number is a sum of: the tangent
/// for second derivatives, what it makes of the stretches for first ones and the energy. The other is how it
/// answers to relative changes of the stretches, since what is computed of them first, such as J or a bound
/// that the energy nears, is rounded.
pub(super) fn known(material: &dyn Subject, stretches: [f64; 3]) -> Option<([f64; COUNT], [f64; COUNT])> {
    /// Long beside rounding, short beside what an energy changes over.
    const STEP: f64 = 1.0 / 4096.0;
    let values = results(material, stretches);
    let blocks = material.blocks(stretches);
    let (stress, curvature) = (stress_scale(&blocks, stretches), stiffness(&blocks));
    let mut sizes = [curvature; COUNT];
    sizes[0] = stress * stretches[0] + values[0].abs();
    sizes[1..7].fill(stress);
    // The first, the first two, all three: whose order stays descending.
    for moved in 1..=3 {
        let moved =
            std::array::from_fn(|k| if k < moved { stretches[k] * (1.0 + STEP) } else { stretches[k] });
        if !material.admits(moved) {
            return None;
        }
        for (size, (after, before)) in sizes.iter_mut().zip(results(material, moved).iter().zip(values)) {
            *size += (after - before).abs() / STEP;
        }
    }
    Some((values, sizes.map(|size| 100.0 * size)))
}
