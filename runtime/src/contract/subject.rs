//! Interface of a material to the rules, the stretches at which they judge it, and the accuracy of its
//! results there. Materials are behind `dyn`, so that rules are compiled once and not for each material.

use super::dual::Dual;
use super::results::{ALL, COUNT, results};
use super::{Settings, stiffness, stress_scale};
use crate::lanes::{Backend, Mask};
use crate::material::{Inversion, Material, Response};
use crate::random::Random;

/// Material under test: its responses in `f64`, and anything that a rule compares with them.
pub(super) trait Subject: Response<f64> {
    /// [`Material::energy`] and [`Material::gradient`] of dual numbers.
    fn in_dual_numbers(&self, stretches: [Dual; 3]) -> (Dual, [Dual; 3]);

    /// Row of results in `f32`; `None` outside the domain.
    fn in_single_precision(&self, stretches: [f32; 3]) -> Option<[f32; COUNT]>;
}

/// Rows of results at all points on the lanes of a back end. Apart from [`Subject`], since each back end is
/// compiled for it.
pub(super) type OnLanes<'a> = &'a dyn Fn(Backend, &[[f64; 3]]) -> Vec<[f64; ALL]>;

impl<M: Material> Subject for M {
    fn in_dual_numbers(&self, stretches: [Dual; 3]) -> (Dual, [Dual; 3]) {
        (Material::energy(self, stretches), Material::gradient(self, stretches))
    }

    fn in_single_precision(&self, stretches: [f32; 3]) -> Option<[f32; COUNT]> {
        Material::admits(self, stretches).any().then(|| results(self, stretches))
    }
}

/// Random descending stretches within the range, plus inverted ones, if the material admits them.
///
/// Around the threshold of an extension the third derivatives jump; samples keep a distance of 1/32 from it.
pub(super) fn samples(material: &dyn Subject, settings: &Settings, random: &mut Random) -> Vec<[f64; 3]> {
    let (low, high) = settings.range;
    let threshold = match material.inversion() {
        Inversion::Refuse => None,
        Inversion::Extend { epsilon } => Some(epsilon),
    };
    (0..settings.points)
        .map(|k| {
            let mut l: [f64; 3] = std::array::from_fn(|_| random.uniform(low.ln(), high.ln()).exp());
            l.sort_by(|a, b| b.total_cmp(a));
            if k % 4 == 3 {
                // Away from λ3 = 0 and λ2 + λ3 = 0, where difference quotients would need steps of their own.
                l[2] = random.uniform(0.05, 0.9).copysign(random.uniform(-1.0, 1.0)) * l[1];
            }
            l
        })
        .filter(|&l| material.admits(l))
        .filter(|l| threshold.is_none_or(|epsilon| l.iter().all(|l| (l - epsilon).abs() > 1.0 / 32.0)))
        .collect()
}

/// Two triples of stretches with λ1, or λ3, moved to a fraction `gap` of λ2 away from λ2; still descending.
pub(super) fn together([l1, l2, l3]: [f64; 3], gap: f64) -> [[f64; 3]; 2] {
    [[l2 * (1.0 + gap), l2, l3], [l1, l2, l2 * (1.0 - gap)]]
}

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
