//! Settings of a run, and their checks.

use std::path::PathBuf;

use piola::Inversion;
use piola_bodies::step::Integrator;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::{Error, in_range};
use crate::material::{MaterialPart, MaterialSpec};
use crate::output::Newton;
use crate::scene::{Amplitude, Body, Scene, Start};
use crate::unit::Unit;

/// Maximum number of threads: more would take longer to start than any scene to run.
const MAX_THREADS: f64 = 1024.0;
/// Maximum number of pins: each is searched for among all nodes.
const MAX_PINS: f64 = 1000.0;

/// Settings of a run: a scene and overrides of its defaults.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The scene.
    #[serde(with = "Scene")]
    pub scene: &'static Scene,
    /// The body, unless `files` describe another.
    #[serde(with = "Body")]
    pub body: Body,
    /// Files of another body; their names appear only in errors of reading.
    #[serde(skip)]
    pub files: Option<Files>,
    /// Unit of the coordinates in the files.
    #[serde(default)]
    pub unit: Unit,
    /// Leaves out the volume elements of the files that are not linear tetrahedra; such a mesh is refused
    /// without it.
    #[serde(default)]
    pub only_tetrahedra: bool,
    /// Positions of the nodes before the first step.
    pub start: Start,
    /// The material of the tetrahedra that are in none of `parts`.
    #[serde(rename = "energy")]
    pub material: MaterialSpec,
    /// Mass per rest volume, kg/m³, of these tetrahedra.
    pub density: f64,
    /// Groups of tetrahedra with a material and a density of their own.
    #[serde(default)]
    pub parts: Vec<MaterialPart>,
    /// Acceleration downwards, along −y, m/s².
    pub gravity: f64,
    /// Time step, s.
    pub dt: f64,
    /// Number of time steps.
    pub frames: usize,
    /// Boxes or names of groups to pin, instead of those of the scene.
    pub pins: Vec<String>,
    /// Method by which steps advance in time.
    #[serde(default)]
    pub integrator: Integrator,
    /// Largest error of the motion from time steps, body heights per second: each frame is made in steps as
    /// short as that requires, or in one step without it.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Accuracy to which each step is solved.
    pub newton: Newton,
    /// Threads for the solver; 0 for one per core.
    pub threads: usize,
}

/// Files of a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// Tetrahedra: TetGen if the name ends in `.node` or `.ele`, else Gmsh MSH 4.1 or 2.2 in ASCII.
    pub mesh: PathBuf,
    /// The surface to embed in them, OBJ; `None` for their own boundary.
    pub surface: Option<PathBuf>,
}

impl Settings {
    /// The scene as it is described, on one thread and without gravity.
    #[must_use]
    pub fn new(scene: &'static Scene) -> Self {
        Self {
            scene,
            body: scene.body,
            files: None,
            unit: Unit::default(),
            only_tetrahedra: false,
            start: scene.start,
            material: (scene.material)(),
            density: scene.density,
            parts: Vec::new(),
            gravity: 0.0,
            dt: scene.dt,
            frames: scene.frames,
            pins: Vec::new(),
            integrator: Integrator::ImplicitEuler,
            tolerance: None,
            newton: Newton::Single,
            threads: 1,
        }
    }

    /// All parts of the body: the first has the tetrahedra that are in none of `parts`.
    #[must_use]
    pub fn all_parts(&self) -> Vec<MaterialPart> {
        let rest = MaterialPart { group: None, material: self.material.clone(), density: self.density };
        [vec![rest], self.parts.clone()].concat()
    }

    /// Checks that all values are in range, so that a simulation is meaningful and ends.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the first value that is not in range.
    pub fn check(&self) -> Result<(), Error> {
        let amplitude = match self.start {
            Start::Scrambled { amplitude: Amplitude::Edges(value), .. } => value,
            _ => 0.0,
        };
        for MaterialPart { material, density, .. } in self.all_parts() {
            let epsilon = match material.inversion {
                Some(Inversion::Extend { epsilon }) => epsilon,
                _ => 0.5,
            };
            let requirement = "from 1e-6 to 1, or `refuse`";
            in_range("the stretch where the extension begins", epsilon, 1e-6..=1.0, requirement)?;
            in_range("the density", density, 1e-9..=1e15, "from 1e-9 to 1e15 kg/m³")?;
        }
        let tolerance = self.tolerance.unwrap_or(1.0);
        for (quantity, value, range, requirement) in [
            ("the time step", self.dt, 1e-12..=1e6, "from 1e-12 to 1e6 s"),
            ("the gravity", self.gravity, -1e9..=1e9, "from -1e9 to 1e9 m/s²"),
            ("the tolerance", tolerance, 1e-9..=1e3, "from 1e-9 to 1000 body heights per second"),
            ("the number of frames", self.frames as f64, 1.0..=1e6, "from 1 to 1000000"),
            ("the amplitude", amplitude, 0.0..=1e3, "from 0 to 1000 mean edge lengths"),
            ("the number of threads", self.threads as f64, 0.0..=MAX_THREADS, "at most 1024"),
            ("the number of pins", self.pins.len() as f64, 0.0..=MAX_PINS, "at most 1000"),
        ] {
            in_range(quantity, value, range, requirement)?;
        }
        Ok(())
    }
}

/// The first setting in which two runs differ, in words, from their settings as JSON objects.
#[must_use]
pub fn difference(before: &Value, now: &Value) -> Option<String> {
    let name = now.as_object()?.keys().find(|name| before[*name] != now[*name])?;
    Some(format!("its setting `{name}` was {}, and is {} now", before[name], now[name]))
}
