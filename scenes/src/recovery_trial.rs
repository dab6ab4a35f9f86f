//! Trial of the recovery of a body: a scene without files.

use std::sync::Arc;

use crate::error::Error;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{FinalState, Summary};
use crate::play::Play;
use crate::settings::Settings;
use crate::statics::find_equilibrium;

/// Number of consecutive frames near rest after which a body has recovered: passing by does not count.
const STAY: usize = 10;

/// Outcome of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrialOutcome {
    /// First frame from which on the body was near rest; `None` if it was not at the end.
    pub recovered: Option<usize>,
    /// Number of elements that were inside out before the first step.
    pub inverted_at_start: usize,
    /// True if every position after every step was finite.
    pub finite: bool,
    /// The largest increase of the minimised function, as a share of the energies before it and of Young's
    /// modulus over the volume: rounding, or a mistake.
    pub largest_rise: f64,
    /// Equilibrium of a body that has not recovered.
    pub final_state: Option<FinalState>,
}

/// Plays a scene on one thread, up to the settings' number of frames or until the body has recovered.
///
/// # Errors
/// Those of [`Play::new`] and [`Play::step`], and [`Error::Equilibrium`].
pub fn run_trial(settings: Settings, geometry: impl Into<Arc<Geometry>>) -> Result<TrialOutcome, Error> {
    let mut play = Play::new(settings, geometry)?;
    let geometry = play.geometry.clone();
    let mesh = &geometry.mesh;
    let pinned = play.simulation.pinned().len();
    let start = play.simulation.positions();
    let mut outcome = TrialOutcome {
        recovered: None,
        inverted_at_start: measure::inverted(&mesh.positions, start, &mesh.tets),
        finite: true,
        largest_rise: f64::NEG_INFINITY,
        final_state: None,
    };
    let unit = play.moduli.young() * play.overview.volume;
    for frame in 1..=play.settings.frames {
        let before = play.simulation.energies();
        let report = play.step()?;
        let energies = before.elastic.abs() + before.kinetic + before.springs + before.gravity.abs();
        outcome.largest_rise = outcome.largest_rise.max(report.newton.change / (unit + energies));
        let positions = play.simulation.positions();
        outcome.finite &= positions.iter().flatten().all(|x| x.is_finite());
        if measure::distance_from_rest(mesh, positions, pinned) > Summary::RECOVERED {
            outcome.recovered = None;
        } else if frame - *outcome.recovered.get_or_insert(frame) >= STAY {
            break;
        }
    }
    if outcome.recovered.is_none() {
        outcome.final_state = Some(find_equilibrium(&mut play, &mut |_| false)?);
    }
    Ok(outcome)
}
