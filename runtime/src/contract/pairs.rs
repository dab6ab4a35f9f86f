//! The rule on quotients: flips and twists against means of second derivatives, which cancel nowhere.
//!
//! On the line x = m + t, y = m − t the difference ψx − ψy vanishes at t = 0 and has the slope ψxx − 2ψxy +
//! ψyy, so that
//!
//! ```text
//! D⁻(m + T, m − T) = (ψx − ψy)/2T = mean over 0 ≤ t ≤ T of (ψxx − 2ψxy + ψyy)/2
//! ```
//!
//! for every gap 2T, zero included. On x = t + m, y = t − m the sum ψx + ψy of an even energy does likewise
//! with ψxx + 2ψxy + ψyy, and gives D⁺. Gauss's rule with eight points takes the mean of a smooth function to
//! full accuracy over gaps of a tenth of the stretches; where higher derivatives jump in between, as at the
//! threshold of an extension or a knot of a spline, finer rules estimate its error. Elsewhere nothing cancels
//! and the quotients agree with their definition. Stretches 1 and 3 can only be close together with stretch 2
//! between them.

use super::{Judge, UNIT, Verdict, pair_name, stiffness};
use crate::material::{Blocks, PAIRS};

/// [`Quotients`](super::Rule::Quotients).
pub(super) fn quotients(judge: &mut Judge<'_>) -> Verdict {
    for stretches in judge.samples() {
        by_definition(judge, stretches)?;
        for exponent in 1..=17 {
            let gap = if exponent == 17 { 0.0 } else { 10f64.powi(-exponent) };
            close(judge, stretches, gap)?;
            opposite(judge, stretches, gap)?;
        }
    }
    Ok(())
}

/// The quotients against (ψi ∓ ψj)/(λi ∓ λj), as exactly as that is known.
fn by_definition(judge: &mut Judge<'_>, stretches: [f64; 3]) -> Verdict {
    let blocks = judge.material.blocks(stretches);
    for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
        let (a, b) = (blocks.gradient[i], blocks.gradient[j]);
        let terms = a.abs() + b.abs() + stiffness(&blocks) * stretches[0];
        for (name, found, numerator, denominator) in [
            ("flip", blocks.flip[pair], a - b, stretches[i] - stretches[j]),
            ("twist", blocks.twist[pair], a + b, stretches[i] + stretches[j]),
        ] {
            if denominator.abs() < 1e-3 * stretches[0] {
                continue;
            }
            let tolerance = 100.0 * UNIT * terms / denominator.abs();
            judge.compare(|| pair_name(name, pair), stretches, found, numerator / denominator, tolerance)?;
        }
    }
    Ok(())
}

/// Flips of stretches that are close to each other.
fn close(judge: &mut Judge<'_>, stretches: [f64; 3], gap: f64) -> Verdict {
    let material = judge.material;
    let [l1, l2, l3] = stretches;
    // The pair is moved together around its mean, the other stretch stays; descending order is kept. In the
    // last three cases all are close, with the other one in the middle or at the distance of the end of the
    // pair.
    let reach = 0.5 * gap * l2;
    let cases = [
        (0, 0.5 * (l1 + l2), l3),
        (2, 0.5 * (l1 + l2), l1 * 2.0),
        (0, l2, l2 - reach),
        (1, l2, l2),
        (2, l2, l2 + reach),
    ];
    for (pair, center, other) in cases {
        let half = 0.5 * gap * center;
        let at = |t: f64| {
            let (x, y) = (center + t, center - t);
            [[x, y, other], [x, other, y], [other, x, y]][pair]
        };
        let [x, y, z] = at(half);
        let descends = x >= y && y >= z.abs();
        if !descends || !material.admits(at(0.0)) || !material.admits(at(half)) {
            continue;
        }
        let (i, j) = PAIRS[pair];
        // The gap that floating point stores is not quite the requested one.
        let stored = at(half);
        let exact = 0.5 * (stored[i] - stored[j]);
        let slope = |t: f64| {
            let blocks = material.blocks(at(t));
            0.5 * (blocks.hessian[i] + blocks.hessian[j]) - blocks.hessian[3 + pair]
        };
        let (expected, inexact) = mean(exact, slope);
        // A power of I1b − 3 below 2 has no third derivative at equal stretches, and feels their last bits.
        let (shifted, _) = mean(exact + 2.0 * UNIT * center, slope);
        let blocks = material.blocks(stored);
        let tolerance = tolerance(&blocks) + inexact + 4.0 * (shifted - expected).abs();
        let name = || format!("{}, which are {gap:e} of their mean apart", pair_name("flip", pair));
        judge.compare(name, stored, blocks.flip[pair], expected, tolerance)?;
    }
    Ok(())
}

/// Twists of stretches that are nearly opposite, where the energy is smooth there.
fn opposite(judge: &mut Judge<'_>, [l1, l2, _]: [f64; 3], gap: f64) -> Verdict {
    let material = judge.material;
    let half = 0.5 * gap * l2;
    let at = |t: f64| [l1.max(1.1 * l2), t + l2, t - l2];
    if !material.admits(at(0.0)) || !material.admits(at(half)) {
        return Ok(());
    }
    if material.has_pole() {
        // Large at the pole, and bounded.
        let stored = at(half);
        let Blocks { gradient, twist, .. } = material.blocks(stored);
        let name = || format!("{} at a pole", pair_name("twist", 2));
        let remedy = || match gradient.iter().all(|slope| slope.is_finite()) {
            true => "bound its denominator from below by `quotient::pole_floor`".to_owned(),
            false => {
                "the derivatives of the energy are not finite here, either: see the rule `domain`".to_owned()
            }
        };
        return judge.finite(name, stored, twist[2], remedy);
    }
    let stored = at(half);
    let exact = 0.5 * (stored[1] + stored[2]);
    let (expected, inexact) = mean(exact, |t| {
        let blocks = material.blocks(at(t));
        0.5 * (blocks.hessian[1] + blocks.hessian[2]) + blocks.hessian[5]
    });
    let blocks = material.blocks(stored);
    let tolerance = tolerance(&blocks) + inexact;
    let name = || format!("{}, which are opposite except for {gap:e} of stretch 2", pair_name("twist", 2));
    judge.compare(name, stored, blocks.twist[2], expected, tolerance)
}

/// Error of second derivatives: some u times the largest of them, and as much again from the rounding of the
/// stretches.
fn tolerance(blocks: &Blocks<f64>) -> f64 {
    200.0 * UNIT * stiffness(blocks)
}

/// Mean of f over [0, end] with a bound of its error: four times the difference to rules with fewer panels,
/// zero up to rounding for a smooth f.
pub(super) fn mean(end: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    let [whole, halves, quarters] = [1, 2, 4].map(|panels| {
        let width = end / f64::from(panels);
        (0..panels).map(|k| gauss(width * f64::from(k), width, &f)).sum::<f64>() / f64::from(panels)
    });
    (quarters, 4.0 * (whole - quarters).abs().max((halves - quarters).abs()))
}

/// The mean of f over [start, start + width] by Gauss's rule with eight points [Abramowitz, Stegun, table
/// 25.4].
fn gauss(start: f64, width: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RULE: [(f64, f64); 4] = [
        (0.183434642495649804939476142360, 0.362683783378361982965150449277),
        (0.525532409916328985817739049189, 0.313706645877887287337962201987),
        (0.796666477413626739591553936476, 0.222381034453374470544355994426),
        (0.960289856497536231683560868569, 0.101228536290376259152531354310),
    ];
    let half = 0.5 * width;
    let middle = start + half;
    RULE.iter().map(|&(x, w)| 0.5 * w * (f(middle + half * x) + f(middle - half * x))).sum()
}
