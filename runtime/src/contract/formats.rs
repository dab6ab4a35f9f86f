//! The rules on formats and lanes: `f32` against `f64`, at stretches that both represent exactly, which shows
//! where a formula loses digits; many points side by side against each by itself.

use super::results::{ALL, COUNT, everything, everything_name, name};
use super::subject::{OnLanes, known, together};
use super::{Judge, Notation, UNIT, Verdict};
use crate::lanes::{Backend, Real};

/// [`SinglePrecision`](super::Rule::SinglePrecision).
pub(super) fn single_precision(judge: &mut Judge<'_>) -> Verdict {
    for stretches in judge.samples() {
        compare(judge, stretches, false)?;
        for gap in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 0.0] {
            for close in together(stretches, gap) {
                compare(judge, close, false)?;
            }
        }
        for far in far_from_rest(stretches) {
            compare(judge, far, true)?;
        }
    }
    Ok(())
}

/// Stretches of flat elements, of lines, of huge and tiny elements, and moderate stretches.
///
/// Digits that a formula loses there are lost in `f32` first: 1 + B with B near −1 has lost half of its 24
/// bits where λ3 = 0.01, and half of the 53 of `f64` only where λ3 = 1e-4.
fn far_from_rest([l1, l2, l3]: [f64; 3]) -> impl Iterator<Item = [f64; 3]> {
    let thin = [1e-2, 1e-3, 1e-4].into_iter().flat_map(move |factor| {
        let line = [l1, l2 * factor, l3 * factor];
        [[l1, l2, l3 * factor], line]
    });
    thin.chain([1e-2, 0.1, 10.0, 100.0].map(|factor| [l1, l2, l3].map(|l| l * factor)))
}

/// Moderate stretches are inside the range of `f32`. A point that may overflow, and does, is not judged.
fn compare(judge: &mut Judge<'_>, stretches: [f64; 3], may_overflow: bool) -> Verdict {
    let (material, notation) = (judge.material, judge.settings.notation);
    let single = stretches.map(|l| l as f32);
    let stretches = single.map(f64::from);
    if !material.admits(stretches) {
        return Ok(());
    }
    let Some(found) = material.in_single_precision(single) else { return Ok(()) };
    let Some((expected, tolerances)) = known(material, stretches) else { return Ok(()) };
    if may_overflow && !found.iter().all(|found| found.is_finite()) {
        return Ok(());
    }
    for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        let name = || format!("{} in `f32`", name(k));
        if expected.is_finite() {
            judge.finite(name, stretches, found.into(), || out_of_range(notation))?;
        }
        let tolerance = <f32 as Real>::UNIT_ROUNDOFF * tolerances[k];
        judge.compare(name, stretches, found.into(), expected, tolerance)?;
    }
    Ok(())
}

/// Advice for a result that is finite in `f64` only.
fn out_of_range(notation: Notation) -> String {
    let narrower = notation.narrower();
    format!(
        "in `f64` this is a number, but `f32` ends at 3.4e38, which it or something on the way to it exceeds, or a denominator of \
         parameters vanishes in `f32`: choose parameters farther from there, {narrower}, or extend from a greater `epsilon`"
    )
}

/// [`Lanes`](super::Rule::Lanes).
pub(super) fn lanes(judge: &mut Judge<'_>, on_lanes: OnLanes<'_>) -> Verdict {
    let material = judge.material;
    let mut points = Vec::new();
    for stretches in judge.samples() {
        points.push(stretches);
        let close = [1e-9, 0.0].into_iter().flat_map(|gap| together(stretches, gap));
        points.extend(close.filter(|&close| material.admits(close)));
    }
    let alone: Vec<_> = points.iter().map(|&stretches| everything(material, stretches)).collect();

    let portable = Backend::portable();
    let together = on_lanes(portable, &points);
    for ((&stretches, found), expected) in points.iter().zip(together).zip(&alone) {
        for k in 0..ALL {
            let name = || format!("{} on the {portable} back end against a scalar", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }

    let backend = Backend::best();
    let in_order = on_lanes(backend, &points);
    // Each in the lane before, with other neighbours.
    let by = 1.min(points.len());
    let mut moved = points.clone();
    moved.rotate_left(by);
    let mut shifted = on_lanes(backend, &moved);
    shifted.rotate_right(by);
    for ((&stretches, found), expected) in points.iter().zip(shifted).zip(&in_order) {
        for k in 0..ALL {
            let name = || format!("{} in another lane of {backend}", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }
    for (&stretches, found) in points.iter().zip(&in_order) {
        let Some((expected, tolerances)) = known(material, stretches) else { continue };
        for k in 0..COUNT {
            let name = || format!("{} on {backend} against a scalar", name(k));
            judge.compare(name, stretches, found[k], expected[k], UNIT * tolerances[k])?;
        }
    }
    Ok(())
}
