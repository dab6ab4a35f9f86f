//! The equilibrium in which a body that has not recovered comes to rest.

use piola_bodies::step::{Convergence, Equilibrium, NewtonSettings, SimulationSettings, Stability};

use crate::error::Error;
use crate::measure;
use crate::output::{FinalPlace, FinalState, Summary};
use crate::play::Play;

/// Maximum number of calls of statics, and of Newton iterations in a call: a call that fails loses nothing of
/// the calls before.
const CALLS: usize = 20;
const ITERATIONS: usize = 10;

/// Observer of a run: a function that gets the number of the last frame that was written, 0 for the start,
/// before each step. It returns true to end the run with the frames that it has.
pub type Watch<'a> = dyn FnMut(usize) -> bool + Send + 'a;

/// Takes a body without inertia to the equilibrium to which it is drawn, and examines it there.
///
/// Works in the rayon pool of the caller; between calls of statics, `watch` may stop it.
///
/// # Errors
/// [`Error::Equilibrium`] if a force is not finite or memory does not suffice, [`Error::Interrupted`].
pub fn find_equilibrium(play: &mut Play, watch: &mut Watch<'_>) -> Result<FinalState, Error> {
    let Play { simulation, geometry, clock, .. } = play;
    let settings = *simulation.settings();
    let newton = NewtonSettings { max_iterations: ITERATIONS, tolerance: 1e-10, ..Default::default() };
    simulation.set_settings(SimulationSettings { newton, ..settings })?;
    for _ in 0..CALLS {
        if watch(clock.frame) {
            return Err(Error::Interrupted);
        }
        // If statics fails, the body stays where it is and is examined there.
        let Ok(report) = simulation.equilibrate() else { break };
        if report.newton.convergence != Convergence::Limit {
            break;
        }
    }
    simulation.set_settings(settings)?;

    let found = Equilibrium::of(simulation)?;
    let pinned = simulation.pinned().len();
    let max_distance_from_rest = measure::distance_from_rest(&geometry.mesh, simulation.positions(), pinned);
    let place = match found.stability {
        _ if max_distance_from_rest <= Summary::RECOVERED => FinalPlace::Rest,
        Stability::Unbalanced => FinalPlace::NotAtRest,
        Stability::Stable => FinalPlace::StableElsewhere,
        Stability::Saddle => FinalPlace::Saddle,
        Stability::Undecided => FinalPlace::UndecidedElsewhere,
    };
    Ok(FinalState {
        place,
        max_distance_from_rest,
        residual: found.residual,
        relative_residual: found.residual / found.largest_force.max(f64::MIN_POSITIVE),
        stress_free: found.is_stress_free(),
        inverted: found.inverted,
        smallest_sum: found.smallest_sum,
    })
}
