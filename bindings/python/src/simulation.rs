//! Bodies in motion and at rest.

use std::sync::{Mutex, PoisonError};

use piola_bodies::step::{self, Convergence, SimulationSettings};
use piola_bodies::system::Pins;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{from_rows, indices, read_only, rows};
use crate::body::Body;
use crate::errors::{of_body, of_step};
use crate::settings::{from_keywords, to_dict};
use crate::threads::{on_threads, with_locked};

/// A body in motion, in implicit steps.
///
///     Simulation(body, *, pins=(), **settings)
///
/// pins: indices of nodes that are held.
/// settings: `gravity=(0, -9.81, 0)`, m/s²; `integrator="implicit_euler"`, "sdirk2" or "sdirk3";
///     `damping=1.0`, 1/s; `newton={"tolerance": 1e-6, …}`: the fields of `SimulationSettings` in Rust.
///
/// Raises BodyError for pins and settings that are out of range.
#[pyclass(frozen, module = "piola")]
pub(crate) struct Simulation {
    simulation: Mutex<step::Simulation>,
}

impl Simulation {
    /// The simulation, waited for without the interpreter: its holder may be in a step.
    fn with<T: Send>(&self, py: Python<'_>, act: impl FnOnce(&mut step::Simulation) -> T + Send) -> T {
        py.detach(|| act(&mut self.simulation.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (body, *, pins = None, **settings))]
    fn new(
        py: Python<'_>,
        body: &Body,
        pins: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings: SimulationSettings = from_keywords(py, settings)?;
        let pins = self::pins(pins)?;
        let body = body.body.clone();
        let simulation = py.detach(|| on_threads(|| step::Simulation::new(body, &pins, settings)))?;
        Ok(Self { simulation: Mutex::new(simulation.map_err(of_body)?) })
    }

    /// Positions of the nodes, m, of shape (n, 3), to be read. Set all of them, `simulation.positions = x`,
    /// to start from any other shape.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        read_only(from_rows(py, &self.with(py, |simulation| simulation.positions().to_vec()))?)
    }

    #[setter]
    fn set_positions(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<()> {
        let x = rows("positions", positions)?;
        self.with(py, |simulation| simulation.set_positions(&x)).map_err(of_body)
    }

    /// Velocities of the nodes, m/s, of shape (n, 3), to be read. Set all of them to push the body.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        read_only(from_rows(py, &self.with(py, |simulation| simulation.velocities().to_vec()))?)
    }

    #[setter]
    fn set_velocities(&self, py: Python<'_>, velocities: &Bound<'_, PyAny>) -> PyResult<()> {
        let v = rows("velocities", velocities)?;
        self.with(py, |simulation| simulation.set_velocities(&v)).map_err(of_body)
    }

    /// Accelerations of the nodes at the end of the last step, m/s², of shape (n, 3), to be read. Set all of
    /// them, with positions and velocities, to resume a motion.
    #[getter]
    fn accelerations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        read_only(from_rows(py, &self.with(py, |simulation| simulation.accelerations().to_vec()))?)
    }

    #[setter]
    fn set_accelerations(&self, py: Python<'_>, accelerations: &Bound<'_, PyAny>) -> PyResult<()> {
        let a = rows("accelerations", accelerations)?;
        self.with(py, |simulation| simulation.set_accelerations(&a)).map_err(of_body)
    }

    /// Indices of the pinned nodes, ascending. Set them to hold others, where they are.
    #[getter]
    fn pins(&self, py: Python<'_>) -> Vec<usize> {
        self.with(py, |simulation| simulation.pinned().to_vec())
    }

    #[setter]
    fn set_pins(&self, py: Python<'_>, pins: &Bound<'_, PyAny>) -> PyResult<()> {
        let pins = self::pins(Some(pins))?;
        self.with(py, |simulation| simulation.set_pins(&pins)).map_err(of_body)
    }

    /// Forces by which the pins hold the body, N, of shape (k, 3): of the node pins[i] at index i.
    ///
    /// At rest they and all other forces add up to zero: under gravity their sum is minus the weight. After a
    /// step they also give the pinned nodes their accelerations.
    ///
    /// Raises StepError if a tetrahedron is outside the domain of its material, or not finite.
    fn reactions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let reactions = with_locked(py, &self.simulation, |simulation| simulation.reactions())?;
        from_rows(py, &reactions.map_err(of_step)?)
    }

    /// Sets constant forces on the nodes, N, of shape (n, 3).
    #[pyo3(signature = (forces, /))]
    fn set_forces(&self, py: Python<'_>, forces: &Bound<'_, PyAny>) -> PyResult<()> {
        let forces = rows("forces", forces)?;
        self.with(py, |simulation| simulation.set_forces(&forces)).map_err(of_body)
    }

    /// Prescribes the positions of pinned nodes after the next step, and from then on.
    ///
    ///     prescribe(nodes, positions, /)
    ///
    /// nodes: indices, of shape (k,). positions: m, of shape (k, 3).
    #[pyo3(signature = (nodes, positions, /))]
    fn prescribe(
        &self,
        py: Python<'_>,
        nodes: &Bound<'_, PyAny>,
        positions: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let nodes: Vec<[usize; 1]> = indices("nodes", nodes)?;
        let positions: Vec<[f64; 3]> = rows("positions", positions)?;
        if nodes.len() != positions.len() {
            let (nodes, positions) = (nodes.len(), positions.len());
            return Err(of_body(format!("there are {nodes} nodes and {positions} positions")));
        }
        let prescribe = |simulation: &mut step::Simulation| {
            nodes
                .iter()
                .zip(positions)
                .try_for_each(|([node], position)| simulation.prescribe(*node, position))
        };
        self.with(py, prescribe).map_err(of_body)
    }

    /// Replaces the settings from the next step on: those that are not named get their defaults.
    #[pyo3(signature = (**settings))]
    fn set_settings(&self, py: Python<'_>, settings: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let settings = from_keywords(py, settings)?;
        self.with(py, |simulation| simulation.set_settings(settings)).map_err(of_body)
    }

    /// The settings as a dictionary.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_dict(py, &self.with(py, |simulation| *simulation.settings()))
    }

    /// Current energies, J, as a dictionary: elastic, kinetic, gravity, springs, forces, terms. An energy
    /// that is not defined is None.
    fn energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_dict(py, &self.with(py, step::Simulation::energies))
    }

    /// Advances by a time, s, in one step, and returns its report as a dictionary: "newton", "min_det" and
    /// "energies".
    ///
    /// Raises StepError if there is no next state: then the state before is untouched, and a shorter step may
    /// succeed.
    #[pyo3(signature = (dt, /))]
    fn step<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyAny>> {
        let report = with_locked(py, &self.simulation, |simulation| simulation.step(dt))?;
        to_dict(py, &report.map_err(of_step)?)
    }

    /// Moves the body to a minimum of its energy, without inertia and damping; report and errors are those of
    /// `step`.
    ///
    /// Warns if the limit of iterations ends it before, and raises StepError if nothing holds a body whose
    /// loads do not balance.
    fn equilibrate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = with_locked(py, &self.simulation, step::Simulation::equilibrate)?.map_err(of_step)?;
        if report.newton.convergence == Convergence::Limit {
            py.import("piola.results")?.call_method1("warn_of_limit", (report.newton.residual,))?;
        }
        to_dict(py, &report)
    }
}

fn pins(given: Option<&Bound<'_, PyAny>>) -> PyResult<Pins> {
    let Some(given) = given else { return Ok(Pins::none()) };
    let nodes: Vec<[usize; 1]> = indices("pins", given)?;
    Ok(Pins::at(nodes.into_iter().flatten()))
}
