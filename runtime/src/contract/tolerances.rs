//! Accuracy of results, for the rules on formats and lanes.

use super::results::{COUNT, results};
use super::subject::Subject;
use super::{stiffness, stress_scale};

/// Entries of a row and the tolerance of each in units of u; `None` if the domain ends too near.
///
/// A hundred times the sum of two parts. One is the size of the terms whose sum a number is: the tangent for
/// second derivatives, the tangent times the stretches for first ones and the energy. The other is its
/// sensitivity to relative changes of the stretches, since intermediate results, such as J or a bound that
/// the energy approaches, are rounded.
pub(super) fn known(material: &dyn Subject, stretches: [f64; 3]) -> Option<([f64; COUNT], [f64; COUNT])> {
    /// Relative step: large compared with rounding, small compared with the scale on which an energy changes.
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
