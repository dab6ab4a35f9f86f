//! The rule on invariants: energy and derivatives by I1, I2 and J against those by stretches.

use super::slopes::ENTRIES;
use super::subject::Subject;
use super::{Judge, UNIT, Verdict, entries, gradient_name, hessian_name, pair_name, stiffness, stress_scale};
use crate::material::{Blocks, Curvature, PAIRS};

/// Change of the second derivatives by a relative change of the stretches, per change, Pa.
fn sensitivity(material: &dyn Subject, stretches: [f64; 3], blocks: &Blocks<f64>) -> f64 {
    const CHANGE: f64 = 1e-6;
    let mut largest = 0.0f64;
    for signs in [[1.0, 1.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, 1.0]] {
        let near = material.blocks(std::array::from_fn(|k| stretches[k] * (1.0 + CHANGE * signs[k])));
        let changes = entries(&near).zip(entries(blocks)).map(|(near, here)| (near - here).abs());
        largest = changes.filter(|change| change.is_finite()).fold(largest, f64::max);
    }
    largest / CHANGE
}

/// [`Invariants`](super::Rule::Invariants), of a material that has them.
pub(super) fn invariants(judge: &mut Judge<'_>) -> Verdict {
    let material = judge.material;
    for stretches in judge.samples() {
        let [a, b, c] = stretches.map(|l| l * l);
        let invariants = [a + b + c, a * b + a * c + b * c, stretches.iter().product()];
        if !material.admits_invariants(invariants) {
            continue;
        }
        let is_admitted = material.admits(stretches);
        let remedy =
            "the invariants of these stretches are admitted: narrow `admits_invariants`, or widen `admits`";
        judge.holds(|| "admission of the stretches".into(), stretches, is_admitted, remedy)?;

        let scale = stress_scale(&material.blocks(stretches), stretches);
        let expected = material.energy(stretches);
        let found = material.energy_by_invariants(invariants);
        let tolerance = 100.0 * UNIT * (scale * stretches[0] + expected.abs());
        if material.has_energy_by_invariants() {
            judge.compare(|| "energy by invariants".into(), stretches, found, expected, tolerance)?;
        }

        let [w1, w2, wj, w11, w22, wjj, w12, w1j, w2j] = material.derivatives_by_invariants(invariants);
        let mixed = [("W22", w22), ("W12", w12), ("W1J", w1j), ("W2J", w2j)];
        let vanishing = match material.curvature_by_invariants() {
            Curvature::First => &[&[("WJ", wj), ("WJJ", wjj)], &mixed[..]].concat()[..],
            Curvature::Volume => &[&[("W11", w11)], &mixed[..]].concat()[..],
            Curvature::Separate => &mixed,
            Curvature::All => &[],
        };
        for &(name, derivative) in vanishing {
            let component = || format!("vanishing of {name}, as `curvature_by_invariants` says");
            judge.holds(component, stretches, derivative == 0.0, "state another `Curvature`")?;
        }

        let gradient = material.gradient(stretches);
        let first = material.gradient_by_invariants(invariants);
        // ∂I1/∂λi, ∂I2/∂λi, ∂J/∂λi.
        let slopes: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let [l, m, n] = [i, (i + 1) % 3, (i + 2) % 3].map(|k| stretches[k]);
            [2.0 * l, 2.0 * l * (m * m + n * n), m * n]
        });
        // The terms cancel near rest, and each has its own roundings.
        let mut compare = |name: &str, terms: &[f64], expected: f64, scale: f64| {
            let magnitude: f64 = terms.iter().map(|term| term.abs()).sum();
            let tolerance = 100.0 * UNIT * (scale + magnitude);
            let name = || format!("{name}, from those by invariants");
            judge.compare(name, stretches, terms.iter().sum(), expected, tolerance)
        };
        for i in 0..3 {
            let terms: [f64; 3] = std::array::from_fn(|k| slopes[i][k] * first[k]);
            compare(&gradient_name(i), &terms, gradient[i], scale)?;
        }

        let second = [[w11, w12, w1j], [w12, w22, w2j], [w1j, w2j, wjj]];
        let blocks = material.blocks(stretches);
        // Invariants are rounded as stretches are.
        let stiffness = stiffness(&blocks) + sensitivity(material, stretches, &blocks);
        for (place, (i, j)) in ENTRIES.into_iter().enumerate() {
            let mut terms: Vec<f64> =
                (0..9).map(|k| slopes[i][k / 3] * second[k / 3][k % 3] * slopes[j][k % 3]).collect();
            if i == j {
                terms.extend([2.0 * w1, slopes[i][1] / stretches[i] * w2]);
            } else {
                terms.extend([4.0 * stretches[i] * stretches[j] * w2, stretches[3 - i - j] * wj]);
            }
            compare(&hessian_name(place), &terms, blocks.hessian[place], stiffness)?;
        }
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            let (product, other) = (stretches[i] * stretches[j], stretches[3 - i - j]);
            let flip = [2.0 * w1, 2.0 * w2 * (other * other - product), -wj * other];
            compare(&pair_name("flip", pair), &flip, blocks.flip[pair], stiffness)?;
            let twist = [2.0 * w1, 2.0 * w2 * (other * other + product), wj * other];
            compare(&pair_name("twist", pair), &twist, blocks.twist[pair], stiffness)?;
        }
    }
    Ok(())
}
