//! A body that is followed.

use std::f64::consts::PI;

use piola::Inversion;
use piola::batch::TileMaterial;
use piola::material::{MaterialError, Moduli};
use piola::mesh::{Bounds, TetMesh, tetrahedral_box};
use piola::step::{Simulation, SimulationSettings, Spring};
use piola::system::{self, Pins};
use piola_materials::{NeoHookean, StableNeoHookean};
use piola_scenes::geometry::Geometry;
use piola_scenes::play::Play;
use piola_scenes::scene::{DINOSAUR, HORSE};
use piola_scenes::settings::Settings;

use super::{Body, Way};
use crate::data::{HistoryInstant, HistoryRow};

/// Of all scenes, s.
pub(super) const TIME_STEP: f64 = 1.0 / 30.0;

/// In motion.
pub(super) struct Motion {
    stage: Stage,
    division: f64,
    dt: f64,
    track: Track,
}

enum Stage {
    Scene(Play),
    Undamped(Undamped),
}

/// A body that moves by its own stiffness alone; but for the one that is let go, nothing holds it.
struct Undamped {
    simulation: Simulation,
    /// Of the body at rest, J: the energy of its material is not zero there.
    rest_energy: f64,
}

/// Where it has been.
#[derive(Clone)]
pub(super) struct Track {
    /// Positions at the time steps of the scene, m.
    frames: Vec<Vec<[f64; 3]>>,
    height: f64,
    /// Before the first step and after each frame; none of a scene.
    momenta: Vec<Momenta>,
    pub(super) steps: usize,
    pub(super) newton_iterations: usize,
    pub(super) linear_iterations: usize,
}

/// Energy beyond that of rest, J, linear and angular momentum, N s and N m s.
#[derive(Clone, Copy)]
struct Momenta {
    energy: f64,
    linear: [f64; 3],
    angular: [f64; 3],
    /// Σ m |v|, beside which the linear momentum is judged: it may be zero itself.
    size: f64,
}

/// What a free body has gained or lost at the end, relative to what it had; NaN of one that is held.
pub(super) struct Drift {
    pub(super) energy: f64,
    pub(super) linear_momentum: f64,
    pub(super) angular_momentum: f64,
}

impl Motion {
    pub(super) fn new(body: Body, division: f64, settings: SimulationSettings) -> Result<Self, String> {
        let (stage, height) = stage(body, division, settings).map_err(|error| error.to_string())?;
        let mut motion = Self { stage, division, dt: TIME_STEP / division, track: Track::new(height) };
        motion.note_momenta();
        Ok(motion)
    }

    /// So many steps further.
    pub(super) fn follow(&mut self, steps: usize) -> Result<(), String> {
        for step in 1..=steps {
            let report = match &mut self.stage {
                Stage::Scene(play) => play.step().map_err(|error| error.to_string())?,
                Stage::Undamped(body) => body.simulation.step(self.dt).map_err(|error| error.to_string())?,
            };
            self.track.steps += 1;
            self.track.newton_iterations += report.newton.iterations;
            self.track.linear_iterations += report.newton.linear_iterations;
            // With less than one step for a frame every step is one that the reference has, too.
            if self.division < 1.0 || step % self.division as usize == 0 {
                let positions = match &self.stage {
                    Stage::Scene(play) => play.simulation().positions(),
                    Stage::Undamped(body) => body.simulation.positions(),
                };
                self.track.frames.push(positions.to_vec());
                self.note_momenta();
            }
        }
        Ok(())
    }

    pub(super) fn into_track(self) -> Track {
        self.track
    }

    fn note_momenta(&mut self) {
        if let Stage::Undamped(body) = &mut self.stage {
            self.track.momenta.push(Momenta::of(body));
        }
    }
}

fn stage(
    body: Body,
    division: f64,
    settings: SimulationSettings,
) -> Result<(Stage, f64), Box<dyn std::error::Error>> {
    let scene = if matches!(body, Body::FlatHorse | Body::Horse) { &HORSE } else { &DINOSAUR };
    let scene_settings = Settings::new(scene).with_dt(TIME_STEP / division);
    let geometry = Geometry::load(&scene_settings)?;
    let mesh = if body == Body::Quiet {
        tetrahedral_box([1, 4, 1], [0.25, 1.0, 0.25])?
    } else {
        geometry.mesh.clone()
    };
    let stage = match body {
        Body::Free => Stage::Undamped(Undamped::flying(
            &mesh,
            free_material()?,
            settings,
            turning_and_stretching(&mesh),
        )?),
        Body::Spinning => {
            // Two turns in a second.
            let turning = velocities(&mesh, 4.0 * PI, [0.0; 3]);
            Stage::Undamped(Undamped::flying(&mesh, neo_hookean(1e7, 0.49)?, settings, turning)?)
        }
        Body::Quiet => {
            // A vibration along the bar of some twenty steps to a period, by a few per cent of its length.
            let gentle = velocities(&mesh, 0.2, [-0.15, 0.3, -0.15]);
            Stage::Undamped(Undamped::flying(&mesh, neo_hookean(1e4, 0.45)?, settings, gentle)?)
        }
        Body::LetGo => Stage::Undamped(Undamped::let_go(&mesh, settings)?),
        Body::FlatHorse | Body::Horse | Body::Dinosaur => {
            let mut play = Play::new(&scene_settings, &geometry)?;
            play.set_step_settings(settings.with_damping(scene.damping))?;
            if body == Body::Horse {
                let pressed = pressed(&mesh, play.simulation().pinned());
                play.simulation_mut().set_positions(&pressed)?;
            }
            Stage::Scene(play)
        }
    };
    Ok((stage, mesh.bounds().size()[1]))
}

/// The horse's nodes above the ground at two thirds of their height: no element is flat or inverted.
fn pressed(mesh: &TetMesh, pinned: &[usize]) -> Vec<[f64; 3]> {
    let ground = pinned.iter().map(|&node| mesh.positions[node][1]).fold(f64::NEG_INFINITY, f64::max);
    let press = |&[x, y, z]: &[f64; 3]| [x, if y > ground { ground + (y - ground) / 1.5 } else { y }, z];
    mesh.positions.iter().map(press).collect()
}

impl Undamped {
    fn flying(
        mesh: &TetMesh,
        material: StableNeoHookean,
        settings: SimulationSettings,
        velocities: Vec<[f64; 3]>,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let mut body = Self::at_rest(mesh, material, &Pins::none())?;
        body.simulation.set_settings(settings)?;
        body.simulation.set_velocities(&velocities)?;
        Ok(body)
    }

    /// Of rubber, its feet pinned: drawn sideways by half its height at the node that is farthest up and
    /// ahead, until it is at rest.
    fn let_go(mesh: &TetMesh, settings: SimulationSettings) -> Result<Self, Box<dyn std::error::Error>> {
        /// So that each equilibrium is near the one before.
        const PARTS: usize = 10;
        let bounds = mesh.bounds();
        let height = bounds.size()[1];
        let feet = Bounds {
            min: [f64::NEG_INFINITY; 3],
            max: [f64::INFINITY, bounds.min[1] + 0.08 * height, f64::INFINITY],
        };
        let rubber = NeoHookean::new(344_830.0, 3_103_400.0)?;
        let rubber = rubber.with_inversion(Inversion::Extend { epsilon: 0.1 })?;
        let mut body = Self::at_rest(mesh, rubber, &Pins::in_box(mesh, feet)?)?;
        let places = mesh.positions.iter().enumerate();
        let head = places.max_by(|(_, a), (_, b)| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        let (head, &[x, y, z]) = head.ok_or("a mesh without nodes")?;
        for part in 1..=PARTS {
            let target = [x, y, z + 0.5 * height * part as f64 / PARTS as f64];
            body.simulation.set_springs(&[Spring::on_node(head, target, 1e6)])?;
            body.simulation.equilibrate()?;
        }
        body.simulation.set_springs(&[])?;
        body.simulation.set_settings(settings)?;
        Ok(body)
    }

    fn at_rest(
        mesh: &TetMesh,
        material: impl TileMaterial<f64> + 'static,
        pins: &Pins,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let body = system::Body::new(mesh, material, DINOSAUR.density)?;
        let mut simulation = Simulation::new(body, pins, SimulationSettings::default())?;
        let rest_energy = simulation.energies().elastic;
        Ok(Self { simulation, rest_energy })
    }
}

/// What flies free, as stiff as the bodies of the scenes.
pub(super) fn free_material() -> Result<StableNeoHookean, MaterialError> {
    neo_hookean(1e6, 0.45)
}

/// From Young's modulus, Pa, and Poisson's ratio.
fn neo_hookean(young: f64, poisson: f64) -> Result<StableNeoHookean, MaterialError> {
    let moduli = Moduli::from_young_poisson(young, poisson)?;
    StableNeoHookean::new(moduli.mu, moduli.lambda)
}

/// A turn in two seconds, and a stretching along x that the body's own stiffness turns back, m/s.
pub(super) fn turning_and_stretching(mesh: &TetMesh) -> Vec<[f64; 3]> {
    velocities(mesh, PI, [6.0, -3.0, -3.0])
}

/// v = ω × x + A x about the centre of the box, m/s, where ω is upright, 1/s, and A diagonal, 1/s.
fn velocities(mesh: &TetMesh, spin: f64, stretching: [f64; 3]) -> Vec<[f64; 3]> {
    let bounds = mesh.bounds();
    let centre: [f64; 3] = std::array::from_fn(|c| 0.5 * (bounds.min[c] + bounds.max[c]));
    let velocity = |position: &[f64; 3]| {
        let x: [f64; 3] = std::array::from_fn(|c| position[c] - centre[c]);
        let [u, v, w]: [f64; 3] = std::array::from_fn(|c| stretching[c] * x[c]);
        [u + spin * x[2], v, w - spin * x[0]]
    };
    mesh.positions.iter().map(velocity).collect()
}

impl Momenta {
    fn of(Undamped { simulation, rest_energy }: &mut Undamped) -> Self {
        let energies = simulation.energies();
        let energy = energies.kinetic + energies.elastic - *rest_energy;
        let mut momenta = Self { energy, linear: [0.0; 3], angular: [0.0; 3], size: 0.0 };
        let states = simulation.positions().iter().zip(simulation.velocities());
        for (&mass, (x, v)) in simulation.body().masses().iter().zip(states) {
            let cross = [x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]];
            for c in 0..3 {
                momenta.linear[c] += mass * v[c];
                momenta.angular[c] += mass * cross[c];
            }
            momenta.size += mass * norm(*v);
        }
        momenta
    }
}

impl Track {
    /// From a body of this height; frames are added by whoever moves it.
    pub(super) fn new(height: f64) -> Self {
        let (frames, momenta) = (Vec::new(), Vec::new());
        Self { frames, height, momenta, steps: 0, newton_iterations: 0, linear_iterations: 0 }
    }

    /// Adds a frame of a free body.
    pub(super) fn note(&mut self, positions: &[[f64; 3]]) {
        self.frames.push(positions.to_vec());
    }

    /// The largest distance of a node between two tracks at the frames that both have, body heights.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let (few, many) = if self.frames.len() < other.frames.len() { (self, other) } else { (other, self) };
        // Of a track with longer steps each frame is one of several.
        let stride = many.frames.len() / few.frames.len().max(1);
        let mut largest = 0.0_f64;
        for (index, frame) in few.frames.iter().enumerate() {
            for (a, b) in frame.iter().zip(&many.frames[stride * (index + 1) - 1]) {
                largest = largest.max(distance(*a, *b));
            }
        }
        largest / self.height
    }

    /// The largest distance of a node between two tracks after the last frame, body heights.
    pub(super) fn final_distance(&self, other: &Self) -> f64 {
        let (Some(one), Some(other)) = (self.frames.last(), other.frames.last()) else { return f64::NAN };
        let distances = one.iter().zip(other).map(|(a, b)| distance(*a, *b));
        distances.fold(0.0, f64::max) / self.height
    }

    /// Of a free body that was followed with the time step of the scene.
    pub(super) fn history(&self, body: Body, way: &Way) -> Option<HistoryRow> {
        /// More would not be seen.
        const AT_MOST: usize = 250;
        let first = *self.momenta.first()?;
        if body == Body::LetGo || way.axis != "h" || way.division != 1.0 {
            return None;
        }
        let instants = self.momenta.iter().enumerate().step_by(self.momenta.len().div_ceil(AT_MOST));
        let instants = instants.map(|(frame, momenta)| HistoryInstant {
            time: frame as f64 * TIME_STEP,
            energy: momenta.energy / first.energy,
            angular_momentum_error: distance(momenta.angular, first.angular) / norm(first.angular),
        });
        Some(HistoryRow { scene: body.name(), setting: way.setting.clone(), instants: instants.collect() })
    }

    /// Relative to the energy before the first step; NaN of a body that is held.
    pub(super) fn largest_energy_error(&self) -> f64 {
        let Some(first) = self.momenta.first() else { return f64::NAN };
        self.momenta.iter().map(|at| (at.energy / first.energy - 1.0).abs()).fold(0.0, f64::max)
    }

    pub(super) fn drift(&self) -> Drift {
        let (Some(first), Some(last)) = (self.momenta.first(), self.momenta.last()) else {
            return Drift { energy: f64::NAN, linear_momentum: f64::NAN, angular_momentum: f64::NAN };
        };
        Drift {
            energy: (last.energy - first.energy) / first.energy,
            linear_momentum: distance(last.linear, first.linear) / first.size,
            angular_momentum: distance(last.angular, first.angular) / norm(first.angular),
        }
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(std::array::from_fn(|c| a[c] - b[c]))
}

fn norm(x: [f64; 3]) -> f64 {
    x.iter().map(|c| c * c).sum::<f64>().sqrt()
}
