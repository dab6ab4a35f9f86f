//! Bodies in motion.

use std::sync::{Arc, Mutex};

use piola_bodies::mesh::Anchor;
use piola_bodies::step::{
    Convergence as Reason, Simulation as Stepped, SimulationSettings, StepError, check_term,
};
use piola_bodies::system::Pins;

use crate::body::Body;
use crate::error::{Code, Failure};
use crate::functions::functions;
use crate::lent::{Out, plain};
use crate::term::{Callbacks, Term};
use crate::{handle, lent};

/// A body with positions and velocities, which steps change. A call during a call of another thread returns
/// PIOLA_CODE_BUSY.
pub struct Simulation(Mutex<State>);

struct State {
    simulation: Stepped,
    terms: Vec<Arc<Callbacks>>,
}

/// Vectors of the nodes of a simulation, three numbers each.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Quantity {
    /// Positions, m. If positions are written, pins hold their nodes there.
    Positions = 0,
    /// Velocities, m/s.
    Velocities = 1,
    /// Accelerations at the end of the last step, m/s².
    Accelerations = 2,
    /// Given forces, N, of constant size and direction. Write an array of length 0 to remove them.
    Forces = 3,
    /// Forces of the pins, N: three numbers for each pinned node, in ascending order. Read-only.
    Reactions = 4,
}

/// A spring of rest length zero from a point of a body to a point in space.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Spring {
    /// Nodes whose positions make the point of the body.
    pub nodes: [usize; 4],
    /// Their weights: 1, 0, 0, 0 for the first node itself.
    pub weights: [f64; 4],
    /// The point in space, m. Between two steps in which the spring at this place of the array has the same
    /// nodes and weights it moves evenly.
    pub target: [f64; 3],
    /// Stiffness k, N/m: the energy is k/2 times the distance squared.
    pub stiffness: f64,
}
plain!(Spring);

/// Reason why the iteration of a step has ended.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum Convergence {
    /// The gradient, or the remaining distance, fell below the tolerance.
    Tolerance = 0,
    /// All further gain is below rounding.
    Rounding = 1,
    /// The limit of iterations is reached.
    Limit = 2,
}

/// Report of a step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StepReport {
    /// One of `piola_convergence`.
    pub convergence: i32,
    /// Number of iterations of Newton's method.
    pub iterations: usize,
    /// Number of iterations of the linear solver.
    pub linear_iterations: usize,
    /// Number of trials that left the domain of a material or a term.
    pub refused_trials: usize,
    /// Norm of the gradient over the free nodes before the first iteration, N.
    pub first_residual: f64,
    /// Norm of the gradient evaluated last, N.
    pub residual: f64,
    /// Smallest det F of a tetrahedron after the step.
    pub min_det: f64,
    /// Energy of deformation, J.
    pub elastic: f64,
    /// Energy of motion, J.
    pub kinetic: f64,
    /// Energy in the field of gravity, J: 0 at rest.
    pub gravity: f64,
    /// Energy of the springs, J.
    pub springs: f64,
    /// Energy in the field of given forces, J: 0 at rest.
    pub forces: f64,
    /// Energy of the terms, J.
    pub terms: f64,
}

impl From<piola_bodies::step::StepReport> for StepReport {
    fn from(report: piola_bodies::step::StepReport) -> Self {
        let piola_bodies::step::StepReport { newton, min_det, energies, .. } = report;
        let convergence = match newton.convergence {
            Reason::Tolerance => Convergence::Tolerance,
            Reason::Rounding => Convergence::Rounding,
            Reason::Limit => Convergence::Limit,
        };
        Self {
            convergence: convergence as i32,
            iterations: newton.iterations,
            linear_iterations: newton.linear_iterations,
            refused_trials: newton.refused_trials,
            first_residual: newton.first_residual,
            residual: newton.residual,
            min_det,
            elastic: energies.elastic,
            kinetic: energies.kinetic,
            gravity: energies.gravity,
            springs: energies.springs,
            forces: energies.forces,
            terms: energies.terms,
        }
    }
}

functions! {
/// Makes a simulation of a body at rest, with the nodes `pins` held, from 0 and in any order.
///
/// `settings` is a text in JSON, null for the defaults. Keys that are left out have the first of their
/// values:
///
/// - `gravity`: `[0, 0, 0]`, m/s²;
/// - `damping`: `0`, the rate of damping that is proportional to mass, 1/s;
/// - `integrator`: `"implicit_euler"`, `"sdirk2"`, `"sdirk3"`;
/// - `newton`: `{"tolerance": 1e-6, "max_iterations": 50, "filtering": …, "linear": …}`, with
///   - `filtering`: `"on_demand"`, `{"always": "none"}`, `{"always": "clamp"}`, `{"always": "absolute"}`,
///   - `linear`: `"automatic"`, `"cholesky"`, and others: see `LinearSolver` of the crate `piola`.
///
/// Errors: PIOLA_CODE_VALUE for a node that does not exist and for other settings.
fn piola_simulation_new(body: &Body, pins: &[usize], settings: Option<&str>, simulation: New<Simulation>) {
    let (pins, settings) = (Pins::at(pins.iter().copied()), read_settings(settings)?);
    simulation.give(|| {
        let simulation = Stepped::new((*body.0).clone(), &pins, settings)?;
        Ok(Simulation(Mutex::new(State { simulation, terms: Vec::new() })))
    })
}

/// Replaces the settings from the next step on; those that are left out become the defaults.
fn piola_simulation_set_settings(simulation: &Simulation, settings: Option<&str>) {
    Ok(handle::enter(&simulation.0)?.simulation.set_settings(read_settings(settings)?)?)
}

/// Reads vectors of the nodes, one of `piola_quantity`.
fn piola_simulation_read(simulation: &Simulation, quantity: i32, numbers: &mut [f64]) {
    let simulation = &mut handle::enter(&simulation.0)?.simulation;
    let reactions;
    let vectors = match quantity_of(quantity)? {
        Quantity::Positions => simulation.positions(),
        Quantity::Velocities => simulation.velocities(),
        Quantity::Accelerations => simulation.accelerations(),
        Quantity::Forces if simulation.forces().is_empty() => {
            lent::demand_length("numbers", numbers.len(), 3, simulation.positions().len())?;
            numbers.fill(0.0);
            return Ok(());
        }
        Quantity::Forces => simulation.forces(),
        Quantity::Reactions => {
            reactions = simulation.reactions()?;
            &reactions
        }
    };
    lent::demand_length("numbers", numbers.len(), 3, vectors.len())?;
    numbers.copy_from_slice(vectors.as_flattened());
    Ok(())
}

/// Writes vectors of the nodes, one of `piola_quantity`, all of which must be finite. The body may be
/// deformed, collapsed or inverted in any way.
fn piola_simulation_write(simulation: &Simulation, quantity: i32, numbers: &[f64]) {
    let simulation = &mut handle::enter(&simulation.0)?.simulation;
    let vectors = lent::rows("numbers", numbers)?;
    match quantity_of(quantity)? {
        Quantity::Positions => simulation.set_positions(vectors)?,
        Quantity::Velocities => simulation.set_velocities(vectors)?,
        Quantity::Accelerations => simulation.set_accelerations(vectors)?,
        Quantity::Forces => simulation.set_forces(vectors)?,
        Quantity::Reactions => {
            return Err(Failure::new(Code::Value, "reactions follow from the state, and cannot be written"));
        }
    }
    Ok(())
}

/// Replaces the set of pinned nodes. A node that was not pinned before is held where it is.
fn piola_simulation_set_pins(simulation: &Simulation, pins: &[usize]) {
    Ok(handle::enter(&simulation.0)?.simulation.set_pins(&Pins::at(pins.iter().copied()))?)
}

/// Prescribes the positions of pinned nodes after the next step and from then on: three numbers for each of
/// `nodes`, m. They move evenly through the step.
fn piola_simulation_prescribe(simulation: &Simulation, nodes: &[usize], positions: &[f64]) {
    let simulation = &mut handle::enter(&simulation.0)?.simulation;
    lent::demand_length("positions", positions.len(), 3, nodes.len())?;
    let positions = lent::rows("positions", positions)?;
    Ok(nodes.iter().zip(positions).try_for_each(|(&node, &position)| simulation.prescribe(node, position))?)
}

/// Replaces all springs.
fn piola_simulation_set_springs(simulation: &Simulation, springs: &[Spring]) {
    let spring = |&Spring { nodes, weights, target, stiffness }: &Spring| {
        piola_bodies::step::Spring { anchor: Anchor { nodes, weights }, target, stiffness }
    };
    Ok(handle::enter(&simulation.0)?.simulation.set_springs(&springs.iter().map(spring).collect::<Vec<_>>())?)
}

/// Replaces all terms of the energy except for deformation, gravity and springs.
fn piola_simulation_set_terms(simulation: &Simulation, terms: &[Term]) {
    let mut state = handle::enter(&simulation.0)?;
    // SAFETY: functions that do what the header requires.
    let callbacks = |&term: &Term| unsafe { Callbacks::new(term) }.map(Arc::new);
    let terms = terms.iter().map(callbacks).collect::<Result<Vec<_>, _>>()?;
    state
        .simulation
        .set_terms(terms.iter().map(|term| term.clone() as Arc<dyn piola_bodies::step::Term>).collect());
    state.terms = terms;
    Ok(())
}

/// Compares the derivatives of each term, at the current positions, with differences of its energy and of its
/// gradient, in a test by its author. If `is_filtered` is not 0, the second derivatives may exceed the
/// differences, as those without negative eigenvalues do.
///
/// Errors: PIOLA_CODE_STEP for a derivative that does not fit, or a term that does not act at the positions;
/// PIOLA_CODE_CALLBACK if a function of a term has failed.
fn piola_simulation_check_terms(simulation: &Simulation, is_filtered: i32) {
    let State { simulation, terms } = &*handle::enter(&simulation.0)?;
    for (index, term) in terms.iter().enumerate() {
        let verdict = check_term(&**term, simulation.positions(), is_filtered != 0);
        demand_success(terms)?;
        verdict.map_err(|error| Failure::new(Code::Step, format_args!("term {index} (from 0): {error}")))?;
    }
    Ok(())
}

/// Advances by `dt`, s; the report may be null. Shared among threads, with the same bits for any number of
/// them.
///
/// Errors: PIOLA_CODE_STEP if there is no admissible next state: the state before is untouched, and a shorter
/// step may succeed, unless the gradient of a term does not fit its energy. PIOLA_CODE_CALLBACK if a function
/// of a term has failed: likewise, unless it was the last one of the step, for the energy in the report.
fn piola_simulation_step(simulation: &Simulation, dt: f64, report: Out<StepReport>) {
    advance(simulation, &report, |simulation| simulation.step(dt))
}

/// Moves the body towards a minimum of its energy with gravity, forces, springs and terms, within the limits
/// of the settings. Then it is at rest. Otherwise like `piola_simulation_step`; PIOLA_CODE_STEP also if
/// nothing holds a body whose loads do not balance.
fn piola_simulation_equilibrate(simulation: &Simulation, report: Out<StepReport>) {
    advance(simulation, &report, Stepped::equilibrate)
}
}

/// Frees a simulation, or does nothing with null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_simulation_free(simulation: Option<Box<Simulation>>) {
    handle::free(simulation);
}

fn advance(
    simulation: &Simulation,
    report: &Out<StepReport>,
    advance: impl FnOnce(&mut Stepped) -> Result<piola_bodies::step::StepReport, StepError>,
) -> Result<(), Failure> {
    let State { simulation, terms } = &mut *handle::enter(&simulation.0)?;
    let result = advance(simulation);
    demand_success(terms)?;
    report.write(result?.into())
}

/// Checks that no function of a term has failed since the last call.
fn demand_success(terms: &[Arc<Callbacks>]) -> Result<(), Failure> {
    for (index, term) in terms.iter().enumerate() {
        if let Some(returned) = term.take_returned() {
            let message = format_args!("a function of term {index} (from 0) has returned {returned}");
            return Err(Failure::new(Code::Callback, message));
        }
    }
    Ok(())
}

fn quantity_of(quantity: i32) -> Result<Quantity, Failure> {
    use Quantity::{Accelerations, Forces, Positions, Reactions, Velocities};
    lent::choice("quantity", quantity, [Positions, Velocities, Accelerations, Forces, Reactions])
}

fn read_settings(settings: Option<&str>) -> Result<SimulationSettings, Failure> {
    Ok(settings.map(serde_json::from_str).transpose()?.unwrap_or_default())
}
