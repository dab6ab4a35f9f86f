//! Rules on derivatives: a difference quotient approaches a correct derivative at a known rate, until
//! rounding takes over; dual numbers, and strains near rest, leave no truncation.
//!
//! Closeness at one step size cannot distinguish a small mistake from truncation; the rate can. A wrong
//! derivative leaves an error that does not shrink with h.

#![expect(non_snake_case, reason = "F, P, Q, W as in the literature")]

use super::dual::Dual;
use super::frames::diagonal;
use super::pairs::mean;
use super::{Judge, UNIT, Verdict, gradient_name, hessian_name, stiffness, stress_scale};
use crate::material::Inversion;
use crate::point::matrix::multiply;
use crate::point::{Filter, Matrix3, evaluate, evaluate_energy, evaluate_stress};
use crate::random::Random;

/// The entries ψ11, ψ22, ψ33, ψ12, ψ13, ψ23 as pairs of stretches.
pub(super) const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// [`StressSlope`](super::Rule::StressSlope).
pub(super) fn stress_slope(judge: &mut Judge<'_>) -> Verdict {
    let mut last = None;
    for stretches in judge.samples() {
        energy_along(judge, stretches, &Approach::smooth(stretches))?;
        if let Some(from) = last.replace(stretches) {
            work(judge, from, stretches)?;
        }
    }
    Ok(())
}

/// ψ(to) − ψ(from) against the integral of ψ1 dλ1 + ψ2 dλ2 + ψ3 dλ3 on the straight line, where the material
/// admits it.
///
/// Gauss's rule estimates its error, and each ψ is known to some u times its own size and that of its terms.
fn work(judge: &mut Judge<'_>, from: [f64; 3], to: [f64; 3]) -> Verdict {
    let material = judge.material;
    let at = |t: f64| std::array::from_fn(|k| from[k] + t * (to[k] - from[k]));
    // On the way through λ3 = 0 there may be a pole.
    let crosses = from[2].signum() != to[2].signum();
    let zero = -from[2] / (to[2] - from[2]);
    let is_inside = (1..16).all(|k| material.admits(at(f64::from(k) / 16.0)));
    if !is_inside || (crosses && !material.admits([at(zero)[0], at(zero)[1], 0.0])) {
        return Ok(());
    }
    let power = |t: f64| {
        let gradient = material.gradient(at(t));
        (0..3).map(|k| gradient[k] * (to[k] - from[k])).sum::<f64>()
    };
    // Smooth from one stretch at the threshold of an extension to the next.
    let mut ends = vec![0.0, 1.0];
    if let Inversion::Extend { epsilon } = material.inversion() {
        ends.extend((0..3).map(|k| (epsilon - from[k]) / (to[k] - from[k])).filter(|t| 0.0 < *t && *t < 1.0));
        ends.sort_by(f64::total_cmp);
    }
    let (mut expected, mut inexact) = (0.0, 0.0);
    for piece in ends.windows(2) {
        let length = piece[1] - piece[0];
        let (mean, error) = mean(1.0, |t| power(piece[0] + t * length));
        expected += length * mean;
        inexact += length * error;
    }
    let rounding: f64 = [from, to]
        .into_iter()
        .map(|l| stress_scale(&material.blocks(l), l) * l[0] + material.energy(l).abs())
        .sum();
    let found = material.energy(to) - material.energy(from);
    let name = || format!("growth of the energy from stretches {}, {}, {}", from[0], from[1], from[2]);
    judge.compare(name, to, found, expected, inexact + 100.0 * UNIT * rounding)
}

/// [`TangentSlope`](super::Rule::TangentSlope).
pub(super) fn tangent_slope(judge: &mut Judge<'_>) -> Verdict {
    let mut samples = judge.samples().into_iter();
    samples.try_for_each(|stretches| stress_along(judge, stretches, &Approach::smooth(stretches)))
}

/// Convergence of difference quotients to a derivative.
pub(super) struct Approach {
    /// Exponent of h in the error.
    order: i32,
    /// Distance in F of a step h = 1.
    reach: f64,
}

impl Approach {
    /// Error proportional to h², within the distance to det F = 0 and to the pole at λ2 + λ3 = 0.
    pub(super) fn smooth(stretches: [f64; 3]) -> Self {
        Self { order: 2, reach: stretches[2].abs().min(stretches[1] + stretches[2]) }
    }

    /// Error proportional to h², on one side of a threshold of each stretch.
    pub(super) fn beside(epsilon: f64, stretches: [f64; 3]) -> Self {
        let Self { order, reach } = Self::smooth(stretches);
        Self { order, reach: stretches.into_iter().map(|l| (l - epsilon).abs()).fold(reach, f64::min) }
    }

    /// Error proportional to h, where the second derivative of the differenced function jumps.
    pub(super) fn across(stretches: [f64; 3]) -> Self {
        Self { order: 1, ..Self::smooth(stretches) }
    }
}

/// Random frame and direction at these stretches, as long as the reach. Stretches move by no more than F does
/// [Weyl's inequality], so steps below 1 stay where the stated order holds.
fn line(stretches: [f64; 3], reach: f64, random: &mut Random) -> (Matrix3<f64>, Matrix3<f64>) {
    let F = multiply(&multiply(&random.rotation(), &diagonal(stretches)), &random.rotation());
    let A = random.matrix();
    let scale = reach / A.iter().flatten().map(|a| a * a).sum::<f64>().sqrt();
    (F, A.map(|row| row.map(|a| a * scale)))
}

fn moved(F: &Matrix3<f64>, h: f64, A: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| F[i][j] + h * A[i][j]))
}

/// The derivative of the energy along a random line.
pub(super) fn energy_along(judge: &mut Judge<'_>, stretches: [f64; 3], approach: &Approach) -> Verdict {
    let material = judge.material;
    let (F, A) = line(stretches, approach.reach, &mut judge.random);
    let P = evaluate_stress(material, &F).stress;
    let derivative = (0..9).map(|k| P[k / 3][k % 3] * A[k / 3][k % 3]).sum();
    let blocks = material.blocks(stretches);
    let size = material.energy(stretches).abs();
    let rounding = 100.0 * UNIT * (stress_scale(&blocks, stretches) * stretches[0] + size);
    let along = |h: f64| evaluate_energy(material, &moved(&F, h, &A)).energy;
    let name = || "difference quotient of the energy along a random line".into();
    slope(judge, name, stretches, along, derivative, approach.order, rounding)
}

/// The derivative of one component of the stress along a random line.
pub(super) fn stress_along(judge: &mut Judge<'_>, stretches: [f64; 3], approach: &Approach) -> Verdict {
    let material = judge.material;
    let (F, A) = line(stretches, approach.reach, &mut judge.random);
    let B = judge.random.matrix();
    let inner = |X: &Matrix3<f64>| (0..9).map(|k| X[k / 3][k % 3] * B[k / 3][k % 3]).sum::<f64>();
    let dP_dF = evaluate(material, &F, Filter::None).tangent;
    let blocks = material.blocks(stretches);
    let rounding = 300.0 * UNIT * (stress_scale(&blocks, stretches) + stiffness(&blocks) * stretches[0]);
    let along = |h: f64| inner(&evaluate_stress(material, &moved(&F, h, &A)).stress);
    let name = || "difference quotient of the stress along a random line".into();
    slope(judge, name, stretches, along, inner(&dP_dF.apply(&A)), approach.order, rounding)
}

/// Compares difference quotients at steps from 2⁻⁶ down to 2⁻²² with a derivative.
///
/// The three longest steps give the truncation per h^order; twice that bounds all others. One step alone
/// would not do: its error may happen to vanish between two orders of opposite sign.
fn slope(
    judge: &mut Judge<'_>,
    name: impl Fn() -> String + Copy,
    stretches: [f64; 3],
    f: impl Fn(f64) -> f64,
    derivative: f64,
    order: i32,
    rounding: f64,
) -> Verdict {
    let quotient = |h: f64| (f(h) - f(-h)) / (2.0 * h);
    let steps = || (6..=22).step_by(2).map(|k| 2f64.powi(-k));
    let truncation = steps()
        .take(3)
        .map(|h| (quotient(h) - derivative).abs() / h.powi(order))
        .fold(0.0, |largest: f64, e| if e.is_nan() { e } else { largest.max(e) });
    for h in steps().skip(3) {
        let tolerance = 2.0 * truncation * h.powi(order) + rounding / h;
        judge.compare(name, stretches, quotient(h), derivative, tolerance)?;
    }
    Ok(())
}

/// [`DualNumbers`](super::Rule::DualNumbers).
pub(super) fn dual_numbers(judge: &mut Judge<'_>) -> Verdict {
    let material = judge.material;
    for stretches in judge.samples() {
        let blocks = material.blocks(stretches);
        let gradient = material.gradient(stretches);
        let first = 100.0 * UNIT * stress_scale(&blocks, stretches);
        let second = 100.0 * UNIT * stiffness(&blocks);
        let lines = [0, 1, 2].map(|k| material.in_dual_numbers(Dual::along(stretches, k)));
        for (k, (energy, _)) in lines.iter().enumerate() {
            let expected = energy.slope;
            for (method, found) in [("gradient", gradient[k]), ("blocks", blocks.gradient[k])] {
                let name = || format!("{}, as `{method}` gives it", gradient_name(k));
                judge.compare(name, stretches, found, expected, first)?;
            }
        }
        let rows = lines.map(|(_, gradient)| gradient);
        for (entry, (i, j)) in ENTRIES.into_iter().enumerate() {
            for expected in [rows[i][j].slope, rows[j][i].slope] {
                let found = blocks.hessian[entry];
                judge.compare(|| hessian_name(entry), stretches, found, expected, second)?;
            }
        }
    }
    Ok(())
}

/// [`Strains`](super::Rule::Strains).
pub(super) fn strains(judge: &mut Judge<'_>) -> Verdict {
    let material = judge.material;
    for stretches in judge.samples().into_iter().filter(|stretches| stretches[2] > 0.0) {
        for exponent in 0..=16 {
            let factor = if exponent == 16 { 0.0 } else { 10f64.powi(-exponent) };
            let strains = stretches.map(|l| factor * (l - 1.0));
            let stretches = strains.map(|s| 1.0 + s);
            if !material.admits(stretches) {
                continue;
            }
            let found = material.gradient_at_strains(strains);
            let expected = material.gradient(stretches);
            let tolerance = 100.0 * UNIT * stress_scale(&material.blocks(stretches), stretches);
            for k in 0..3 {
                let name = || format!("{}, from the strain {:e}", gradient_name(k), strains[k]);
                judge.compare(name, stretches, found[k], expected[k], tolerance)?;
            }
        }
    }
    Ok(())
}
