//! The dinosaur in steps of time that follow from their error: step sizes, error estimates and work of each
//! frame.

use std::time::Instant;

use piola::step::{Integrator, NewtonSettings, SimulationSettings};
use piola_scenes::geometry::Geometry;
use piola_scenes::play::Play;
use piola_scenes::scene::DINOSAUR;
use piola_scenes::settings::Settings;

use super::motion::{TIME_STEP, Track};
use super::{Body, Measured, References, Way, empty_row};
use crate::data::AdaptiveRow;

/// Body heights per second.
const TOLERANCES: [f64; 3] = [0.3, 0.1, 0.03];

/// Those of which each frame is noted.
pub(crate) const NOTED: [f64; 2] = [0.1, 0.03];

/// A row for each tolerance, and the frames of some.
pub(super) fn measure(frames: usize, references: &References, measured: &mut Measured) {
    for tolerance in TOLERANCES {
        let setting = format!("tolerance {tolerance}");
        let way = Way { axis: "tolerance", setting, division: 1.0, settings: SimulationSettings::default() };
        let mut row = empty_row(Body::Dinosaur, &way);
        let followed = follow(frames, tolerance).map_err(|error| error.to_string());
        match followed {
            Ok((track, seconds, noted)) => {
                row.fill(&track, seconds, Some(references));
                // Steps of another length are no worse solved.
                row.algebraic_error = f64::NAN;
                if NOTED.contains(&tolerance) {
                    measured.frames.extend(noted);
                }
            }
            Err(error) => row.failure = Some(error),
        }
        measured.rows.push(row);
    }
}

/// The track, the wall time of its steps, s, and its frames.
fn follow(
    frames: usize,
    tolerance: f64,
) -> Result<(Track, f64, Vec<AdaptiveRow>), Box<dyn std::error::Error>> {
    let settings = Settings::new(&DINOSAUR).with_dt(TIME_STEP);
    let geometry = Geometry::load(&settings)?;
    let height = geometry.mesh.bounds().size()[1];
    // A play pulls, in steps that no tolerance shortens, and its springs are taken over.
    let mut pulling = Play::new(&settings.clone().with_tolerance(Some(1e3)), &geometry)?;
    let mut simulation = Play::new(&settings, &geometry)?.simulation().clone();
    simulation.set_settings(
        SimulationSettings::default()
            .with_newton(NewtonSettings::default())
            .with_integrator(Integrator::Sdirk2)
            .with_damping(DINOSAUR.damping),
    )?;
    let mut track = Track::new(height);
    let (mut rows, mut seconds) = (Vec::new(), 0.0);
    for frame in 1..=frames {
        pulling.step()?;
        simulation.set_springs(pulling.simulation().springs())?;
        let clock = Instant::now();
        let report = simulation.advance_within(TIME_STEP, tolerance * height)?;
        seconds += clock.elapsed().as_secs_f64();
        track.note(simulation.positions());
        track.steps += 1;
        track.newton_iterations += report.step.newton.iterations;
        track.linear_iterations += report.step.newton.linear_iterations;
        rows.push(AdaptiveRow {
            tolerance,
            time: frame as f64 * TIME_STEP,
            shortest: report.shortest,
            taken: report.taken,
            refused: report.refused,
            unresolved: report.unresolved,
            error: report.error / (height * TIME_STEP),
            newton_iterations: report.step.newton.iterations,
        });
    }
    Ok((track, seconds, rows))
}
