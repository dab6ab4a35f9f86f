//! The rule on lanes: many points side by side against each by itself.

use super::results::{ALL, COUNT, everything, everything_name, name};
use super::samples::{samples, together};
use super::subject::{OnLanes, Subject};
use super::tolerances::known;
use super::{Finding, Judge, Rule, Settings, UNIT, Violation};
use crate::lanes::Backend;
use crate::random::Random;

/// [`Rule::Lanes`].
pub(super) fn lanes(
    material: &dyn Subject,
    on_lanes: &dyn OnLanes,
    settings: &Settings,
) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Lanes, settings.notation);
    let mut random = Random::new(settings.seed);
    let mut points = Vec::new();
    for stretches in samples(material, settings, &mut random) {
        points.push(stretches);
        let close = [1e-9, 0.0].into_iter().flat_map(|gap| together(stretches, gap));
        points.extend(close.filter(|&close| material.admits(close)));
    }
    let alone: Vec<_> = points.iter().map(|&stretches| everything(material, stretches)).collect();

    let portable = Backend::portable();
    let together = on_lanes.side_by_side_on(portable, &points);
    for ((&stretches, found), expected) in points.iter().zip(together).zip(&alone) {
        for k in 0..ALL {
            let name = || format!("{} on the {portable} back end against a scalar", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }

    let backend = Backend::best();
    let in_order = on_lanes.side_by_side_on(backend, &points);
    // Each in the lane before, with other neighbours.
    let by = 1.min(points.len());
    let mut moved = points.clone();
    moved.rotate_left(by);
    let mut shifted = on_lanes.side_by_side_on(backend, &moved);
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
    judge.finding()
}
