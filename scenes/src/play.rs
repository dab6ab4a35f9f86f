//! A scene in motion.

use std::fmt::Display;

use piola::material::Moduli;
use piola::mesh::{Anchor, Bounds, TetMesh};
use piola::step::{self, NewtonSettings, Simulation, StepReport};
use piola::system::{Body, Part, Pins};

use crate::clock::Clock;
use crate::energy::Parameters;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::output::Newton;
use crate::region;
use crate::scene::Pull;
use crate::settings::Settings;

mod start;

/// The springs of a pull are together this much stiffer than a cube of the body's material and height.
const GRIP: f64 = 10.0;

/// A body that does what its scene says, step by step.
#[derive(Debug)]
pub struct Play {
    simulation: Simulation,
    material: &'static str,
    parameters: Parameters,
    pulls: Vec<Grip>,
    hands: Vec<step::Spring>,
    moduli: Moduli,
    /// Of a cube of its material and height, N/m.
    stiffness: f64,
    clock: Clock,
}

impl Play {
    /// The scene before its first step.
    ///
    /// # Errors
    /// Where the settings make no sense or do not fit the body.
    pub fn new(settings: &Settings, geometry: &Geometry) -> Result<Self, Error> {
        settings.check()?;
        let mesh = &geometry.mesh;
        let substance = settings.energy.build()?;
        let pins = pins(settings, mesh)?;
        let young = substance.moduli.young();
        let pulls = settings.scene.pulls.iter().map(|&pull| Grip::new(pull, mesh, young)).collect();
        let part = Part { group: None, material: substance.elements, density: settings.density };
        let body = Body::from_parts(mesh, vec![part]).map_err(|error| setup(&error))?;
        let mut simulation =
            Simulation::new(body, &pins, step_settings(settings)).map_err(|error| setup(&error))?;
        let start = start::positions(settings.start, geometry, &pins);
        simulation.set_positions(&start).map_err(|error| setup(&error))?;
        Ok(Self {
            simulation,
            material: substance.name,
            parameters: substance.parameters,
            pulls,
            hands: Vec::new(),
            moduli: substance.moduli,
            stiffness: stiffness(young, mesh),
            clock: Clock::new(settings.dt),
        })
    }

    /// The body and its state.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The same, for those who put it elsewhere or push it before the next step.
    pub fn simulation_mut(&mut self) -> &mut Simulation {
        &mut self.simulation
    }

    /// Name of its material in the catalogue.
    #[must_use]
    pub fn material(&self) -> &'static str {
        self.material
    }

    /// Parameters of its material.
    #[must_use]
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The small-strain moduli of its material.
    #[must_use]
    pub fn moduli(&self) -> Moduli {
        self.moduli
    }

    /// Which step it is at, and what time that is.
    #[must_use]
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// Takes steps of another length from now on, s.
    pub fn set_dt(&mut self, dt: f64) {
        self.clock = self.clock.with_dt(dt);
    }

    /// Goes on from a state of the same body: positions, m, and velocities, m/s, one for each node.
    ///
    /// # Errors
    /// Where there is not one finite position and velocity for each node.
    pub fn resume(
        &mut self,
        clock: Clock,
        positions: &[[f64; 3]],
        velocities: &[[f64; 3]],
    ) -> Result<(), Error> {
        self.simulation.set_positions(positions).map_err(|error| setup(&error))?;
        self.simulation.set_velocities(velocities).map_err(|error| setup(&error))?;
        self.clock = clock;
        Ok(())
    }

    /// A pull at one point of the body, as stiff as a cube of its material and height.
    #[must_use]
    pub fn pull_at(&self, anchor: Anchor, target: [f64; 3]) -> step::Spring {
        step::Spring { anchor, target, stiffness: self.stiffness }
    }

    /// Replaces the pulls that come beside those of the scene, from the next step on.
    pub fn hold(&mut self, pulls: Vec<step::Spring>) {
        self.hands = pulls;
    }

    /// Solves the steps that follow in another way.
    ///
    /// # Errors
    /// Where a setting makes no sense.
    pub fn set_step_settings(&mut self, settings: step::SimulationSettings) -> Result<(), Error> {
        self.simulation.set_settings(settings).map_err(|error| setup(&error))
    }

    /// Makes the next time step, in the rayon pool where it is called.
    ///
    /// # Errors
    /// [`Error::Step`]; the state before the step is then untouched.
    pub fn step(&mut self) -> Result<StepReport, Error> {
        let clock = self.clock.next();
        let failed = |error: &dyn Display| Error::Step { frame: clock.frame(), reason: error.to_string() };
        let scene = self.pulls.iter().flat_map(|grip| grip.at(clock.time()));
        let springs: Vec<step::Spring> = scene.chain(self.hands.iter().copied()).collect();
        self.simulation.set_springs(&springs).map_err(|error| failed(&error))?;
        let report = self.simulation.step(clock.dt()).map_err(|error| failed(&error))?;
        self.clock = clock;
        Ok(report)
    }
}

/// Of a cube of the body's height, N/m. `young`, Pa, is the small-strain Young's modulus of the body.
fn stiffness(young: f64, mesh: &TetMesh) -> f64 {
    young * mesh.bounds().size()[1]
}

fn setup(reason: &dyn Display) -> Error {
    Error::Setup { reason: reason.to_string() }
}

fn step_settings(settings: &Settings) -> step::SimulationSettings {
    let newton = match settings.newton {
        Newton::Single => NewtonSettings::single(),
        Newton::Full => NewtonSettings::default(),
    };
    let gravity = [0.0, -settings.gravity, 0.0];
    let step = step::SimulationSettings::default().with_gravity(gravity).with_newton(newton);
    step.with_damping(settings.scene.damping)
}

/// The nodes that the settings pin, or else the scene.
fn pins(settings: &Settings, mesh: &TetMesh) -> Result<Pins, Error> {
    if settings.pins.is_empty() {
        let Some(pinned) = settings.scene.pinned else { return Ok(Pins::none()) };
        let region = region::within(mesh.bounds(), pinned);
        let pin = format!("of the scene {}", settings.scene.name);
        return Pins::in_box(mesh, region).map_err(|error| Error::Pin { pin, reason: error.to_string() });
    }
    settings.pins.iter().try_fold(Pins::none(), |all, pin| {
        // What could be a box may also be the name of a group; then the user who named it means the group.
        let pins = match (mesh.group(pin), region::parse(pin)) {
            (None, Ok(region)) => Pins::in_box(mesh, region),
            (Some(_), _) => Pins::of_group(mesh, pin),
            (None, Err(_)) => {
                let groups = mesh.groups.iter().map(|group| group.name.clone()).collect();
                return Err(Error::UnknownPin { pin: pin.clone(), groups });
            }
        };
        let pins = pins.map_err(|error| Error::Pin { pin: format!("`{pin}`"), reason: error.to_string() })?;
        Ok(all.and(&pins))
    })
}

/// A pull of a scene on the nodes of a body.
#[derive(Debug)]
struct Grip {
    pull: Pull,
    /// The nodes with their places at rest, m.
    nodes: Vec<(usize, [f64; 3])>,
    /// Of the body, m.
    bounds: Bounds,
    /// Of the spring at each node, N/m.
    stiffness: f64,
}

impl Grip {
    /// `young`, Pa, is the small-strain Young's modulus of the body.
    fn new(pull: Pull, mesh: &TetMesh, young: f64) -> Self {
        let bounds = mesh.bounds();
        let region = region::within(bounds, pull.region);
        let places = mesh.positions.iter().copied().enumerate();
        let nodes: Vec<_> = places.filter(|&(_, place)| region.contains(place)).collect();
        let stiffness = GRIP * stiffness(young, mesh) / nodes.len().max(1) as f64;
        Self { pull, nodes, bounds, stiffness }
    }

    /// The springs at a time, s.
    fn at(&self, time: f64) -> impl Iterator<Item = step::Spring> {
        let share = self.pull.share_at(time);
        share.into_iter().flat_map(move |share| {
            self.nodes.iter().map(move |&(node, rest)| {
                let target = self.pull.motion.place(rest, share, self.bounds);
                step::Spring::on_node(node, target, self.stiffness)
            })
        })
    }
}
