//! What a run is asked for, and whether that makes sense.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::energy::Energy;
use crate::error::Error;
use crate::output::Newton;
use crate::scene::{self, Amplitude, Body, Scene, Start};

/// More would take longer to start than any scene to run.
const MAX_THREADS: usize = 1024;

/// What a run is asked for: a scene, and what is to be different from it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// What happens.
    #[serde(with = "scene::by_name")]
    pub scene: &'static Scene,
    /// The body, where no files take its place.
    pub body: Body,
    /// Files of another body.
    pub files: Option<Files>,
    /// What it looks like before the first step.
    pub start: Start,
    /// What the body is made of.
    pub energy: Energy,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
    /// Acceleration downwards, m/s².
    pub gravity: f64,
    /// Time step, s.
    pub dt: f64,
    /// How many steps of it.
    pub frames: usize,
    /// Boxes or names of groups to pin, in place of the scene's.
    pub pins: Vec<String>,
    /// How far each step is solved.
    pub newton: Newton,
    /// Threads for the solver; 0 for one per core.
    pub threads: usize,
}

/// Files of a body.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Files {
    /// Tetrahedra: Gmsh MSH 4.1 or 2.2 in ASCII, or TetGen where it ends in `.node` or `.ele`.
    pub mesh: PathBuf,
    /// The surface to embed in them, OBJ; where None, their own boundary.
    pub surface: Option<PathBuf>,
}

impl Settings {
    /// The scene as it is described, on one thread.
    #[must_use]
    pub fn of(scene: &'static Scene) -> Self {
        Self {
            scene,
            body: scene.body,
            files: None,
            start: scene.start,
            energy: (scene.energy)(),
            density: scene.density,
            gravity: 0.0,
            dt: scene.dt,
            frames: scene.frames,
            pins: Vec::new(),
            newton: Newton::Single,
            threads: 1,
        }
    }

    /// Refuses numbers that no run could use.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the first of them.
    pub fn check(&self) -> Result<(), Error> {
        let positive = |quantity, value: f64| match value.is_finite() && value > 0.0 {
            true => Ok(()),
            false => Err(Error::OutOfRange { quantity, value, requirement: "positive and finite" }),
        };
        positive("the time step --dt", self.dt)?;
        positive("the density --density", self.density)?;
        if !self.gravity.is_finite() {
            let (quantity, value) = ("the acceleration --gravity", self.gravity);
            return Err(Error::OutOfRange { quantity, value, requirement: "finite" });
        }
        if self.frames == 0 {
            let (quantity, value) = ("the number of --frames", 0.0);
            return Err(Error::OutOfRange { quantity, value, requirement: "at least 1" });
        }
        if let Start::Scrambled { amplitude: Amplitude::Edges(value), .. } = self.start
            && !(value >= 0.0 && value.is_finite())
        {
            let quantity = "the --amplitude";
            return Err(Error::OutOfRange { quantity, value, requirement: "finite and not negative" });
        }
        if self.threads > MAX_THREADS {
            let (quantity, value) = ("the number of --threads", self.threads as f64);
            return Err(Error::OutOfRange { quantity, value, requirement: "at most 1024" });
        }
        Ok(())
    }
}
