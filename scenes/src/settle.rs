//! Where a body that is not back comes to rest, and what it is there.

use piola::mesh::TetMesh;
use piola::step::{Convergence, Equilibrium, NewtonSettings, Stability};

use crate::error::Error;
use crate::measure;
use crate::output::{Place, Standing, Summary};
use crate::play::Play;

/// Statics stops after so many calls of so many Newton iterations: what one has gained, a failure of the next does not undo.
const CALLS: usize = 20;
const ITERATIONS: usize = 10;

/// Takes a body by statics, without inertia, to the equilibrium that it is drawn to, and looks at it there.
///
/// # Errors
/// [`Error::Standing`] where it cannot be looked at: a number is not finite, or memory does not suffice.
pub fn settle(play: &mut Play, mesh: &TetMesh) -> Result<Standing, Error> {
    let failed = |reason: String| Error::Standing { reason };
    let simulation = play.simulation_mut();
    let settings = *simulation.settings();
    let newton = NewtonSettings::default().with_max_iterations(ITERATIONS).with_tolerance(1e-10);
    simulation.set_settings(settings.with_newton(newton)).map_err(|error| failed(error.to_string()))?;
    let mut newton_iterations = 0;
    for _ in 0..CALLS {
        // Where statics fails, the body stays where it is, and what it is there will say so.
        let Ok(report) = simulation.equilibrate() else { break };
        newton_iterations += report.newton.iterations;
        if report.newton.convergence != Convergence::Limit {
            break;
        }
    }
    simulation.set_settings(settings).map_err(|error| failed(error.to_string()))?;

    let found = Equilibrium::of(simulation).map_err(|error| failed(error.to_string()))?;
    let pinned = simulation.pinned().len();
    let max_distance_from_rest = measure::distance_from_rest(mesh, simulation.positions(), pinned);
    let place = match found.stability() {
        _ if max_distance_from_rest <= Summary::RECOVERED => Place::Rest,
        Stability::Unbalanced => Place::NotAtRest,
        Stability::Stable => Place::StableElsewhere,
        Stability::Saddle => Place::Saddle,
        Stability::Undecided => Place::UndecidedElsewhere,
    };
    Ok(Standing {
        place,
        max_distance_from_rest,
        residual: found.residual,
        relative_residual: found.residual / found.largest_force.max(f64::MIN_POSITIVE),
        stress_free: found.is_stress_free(),
        smallest_eigenvalue: found.smallest_eigenvalue.map(|eigenvalue| eigenvalue.value),
        eigenvalue_error: found.smallest_eigenvalue.map(|eigenvalue| eigenvalue.error),
        inverted: found.inverted,
        smallest_sum: found.smallest_sum,
        newton_iterations,
    })
}
