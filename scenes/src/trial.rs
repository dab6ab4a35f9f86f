//! A scene played for its outcome alone: whether the body comes back, with every step watched.

use crate::error::Error;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{Standing, Summary};
use crate::play::Play;
use crate::settings::Settings;
use crate::settle::settle;

/// A body is back that has been near rest for so many frames in a row: passing by does not count.
const STAY: usize = 10;

/// What came of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The first frame from which on the body was back; `None` where it was not at the end.
    pub recovered: Option<usize>,
    /// How many elements were inside out before the first step.
    pub inverted_at_start: usize,
    /// Whether every position after every step was finite.
    pub finite: bool,
    /// The largest increase of what a step minimises, as a share of the energies before it and of Young's modulus over the
    /// volume: rounding, or a mistake.
    pub largest_rise: f64,
    /// What is known of a body that is not back.
    pub standing: Option<Standing>,
}

/// Plays a scene on one thread, up to the settings' number of frames or until the body is back and stays.
///
/// # Errors
/// As [`run`](crate::run::run), without those of files.
pub fn attempt(settings: &Settings, geometry: &Geometry) -> Result<Outcome, Error> {
    watch(Play::new(settings, geometry)?, settings.frames, geometry)
}

/// The same from wherever a scene is, up to a number of frames.
///
/// # Errors
/// As [`attempt`].
pub fn watch(mut play: Play, frames: usize, geometry: &Geometry) -> Result<Outcome, Error> {
    let mesh = &geometry.mesh;
    let pinned = play.simulation().pinned().len();
    let start = play.simulation().positions();
    let mut outcome = Outcome {
        recovered: None,
        inverted_at_start: measure::inverted(&mesh.positions, start, &mesh.tets),
        finite: true,
        largest_rise: f64::NEG_INFINITY,
        standing: None,
    };
    let unit = play.moduli().young() * measure::total_volume(&mesh.positions, &mesh.tets);
    for frame in 1..=frames {
        let before = play.simulation_mut().energies();
        let report = play.step()?;
        let energies = before.elastic.abs() + before.kinetic + before.springs + before.gravity.abs();
        outcome.largest_rise = outcome.largest_rise.max(report.newton.change / (unit + energies));
        let positions = play.simulation().positions();
        outcome.finite &= positions.iter().flatten().all(|x| x.is_finite());
        if measure::distance_from_rest(mesh, positions, pinned) > Summary::RECOVERED {
            outcome.recovered = None;
        } else if frame - *outcome.recovered.get_or_insert(frame) >= STAY {
            break;
        }
    }
    if outcome.recovered.is_none() {
        outcome.standing = Some(settle(&mut play, mesh)?);
    }
    Ok(outcome)
}
