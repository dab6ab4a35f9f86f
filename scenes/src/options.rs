//! Options of a command line that choose a scene and override its defaults, for every program that plays one.

mod energy;
mod value;

pub use energy::Formula;
pub use value::{Given, inversion, parameter};

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use piola::Inversion;
use piola_bodies::step::Integrator;

use crate::error::{Error, list};
use crate::output::Newton;
use crate::scene::{Amplitude, Body, SCENES, Scene, Start};
use crate::settings::{Files, Settings};
use crate::unit::Unit;

/// A scene and overrides of its defaults.
#[derive(Clone, Debug, PartialEq, Args)]
#[non_exhaustive]
pub struct SceneOptions {
    /// The scene.
    #[arg(default_value = "horse")]
    pub scene: String,

    /// Material, as listed by `piola materials`, or a file of Rust that declares one [default: the scene's].
    /// A listed one other than the scene's has the small-strain moduli of the scene's without --param, if it
    /// can, and needs all of its parameters with it.
    #[arg(long, value_name = "NAME|FILE.rs")]
    pub material: Option<String>,

    #[command(flatten)]
    #[expect(missing_docs, reason = "clap would print it")]
    pub formula: Formula,

    /// Behaviour beyond the domain of a material: `refuse` takes shorter steps, a number is the stretch below
    /// which the energy is extended by polynomials [default: 0.1 if it can be extended].
    #[arg(long, value_name = "refuse|STRETCH", value_parser = inversion, allow_negative_numbers = true)]
    pub inversion: Option<Inversion>,

    /// Density in kg/m³ [default: the scene's, 1000].
    #[arg(long, value_name = "RHO", allow_negative_numbers = true)]
    pub density: Option<f64>,

    /// Another material for a group of tetrahedra: GROUP=NAME, or GROUP=NAME;PARAM=V;…;density=RHO. NAME may
    /// be a file of Rust. Without parameters, it has the small-strain moduli of --material. May be
    /// repeated.
    #[arg(long = "part", value_name = "GROUP=NAME|FILE.rs;…")]
    pub parts: Vec<String>,

    /// Gravity in m/s², downwards, which is along -y [default: 0].
    #[arg(long, value_name = "G", allow_negative_numbers = true)]
    pub gravity: Option<f64>,

    /// Nodes to hold instead of the scene's: a physical group of the mesh, or a box
    /// LOW:HIGH,LOW:HIGH,LOW:HIGH in m, open where a side is left out, such as `:,:0.05,:`; may be repeated.
    #[arg(long = "pin", value_name = "BOX|GROUP", allow_hyphen_values = true)]
    pub pins: Vec<String>,

    /// Another body that comes with the program: horse, dinosaur or bar [default: the scene's].
    #[arg(long, value_name = "NAME", conflicts_with = "mesh")]
    pub body: Option<String>,

    /// Seed of the random displacements of a scene that scrambles: equal seeds give equal starts [default:
    /// the scene's, 1].
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// Largest displacement of a node along each axis in such a scene, in mean edge lengths; `box` puts it
    /// anywhere in the body's bounding box [default: the scene's, 0.3].
    #[arg(long, value_name = "A|box", allow_negative_numbers = true)]
    pub amplitude: Option<Amplitude>,

    /// Another body: tetrahedra in Gmsh MSH 4.1 or 2.2, ASCII, or TetGen's .node and .ele; the scene's places
    /// become shares of its bounding box.
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,

    /// Unit of the coordinates in the files of --mesh and --surface; places of other options are in m
    /// [default: m].
    #[arg(long, value_enum, requires = "mesh")]
    pub unit: Option<Unit>,

    /// Leave out the volume elements of --mesh that are not linear tetrahedra; a mesh with such elements is
    /// refused otherwise.
    #[arg(long, requires = "mesh")]
    pub only_tetrahedra: bool,
}

impl SceneOptions {
    /// The scene with the overrides; with a surface to embed in the tetrahedra of `--mesh`, instead of their
    /// boundary.
    ///
    /// # Errors
    /// [`Error`] of a name, a formula or a file of the material. Values are not checked: see
    /// [`Settings::check`].
    pub fn settings(self, surface: Option<PathBuf>) -> Result<Settings, Error> {
        let scene = Scene::find(&self.scene)?;
        let mut settings = Settings::new(scene);
        let name = self.material.as_deref();
        settings.material = self.formula.material(name, |name| energy::as_stiff(name, &settings.material))?;
        if let Some(inversion) = self.inversion {
            settings.material = settings.material.with_inversion(inversion);
        }
        if let Some(name) = self.body {
            settings.body = Body::find(&name)?;
        }
        settings.start = start(scene, self.seed, self.amplitude)?;
        settings.density = self.density.unwrap_or(settings.density);
        let part = |text: &String| energy::part(text, &settings.material, settings.density);
        settings.parts = self.parts.iter().map(part).collect::<Result<_, _>>()?;
        settings.gravity = self.gravity.unwrap_or(settings.gravity);
        settings.pins = self.pins;
        settings.files = self.mesh.map(|mesh| Files { mesh, surface });
        settings.unit = self.unit.unwrap_or_default();
        settings.only_tetrahedra = self.only_tetrahedra;
        Ok(settings)
    }
}

/// The scene's start, with another seed or amplitude if it is random.
fn start(scene: &'static Scene, seed: Option<u64>, amplitude: Option<Amplitude>) -> Result<Start, Error> {
    let is_random = |scene: &&&Scene| matches!(scene.start, Start::Scrambled { .. });
    match (scene.start, seed, amplitude) {
        (Start::Scrambled { seed, amplitude }, other_seed, other_amplitude) => Ok(Start::Scrambled {
            seed: other_seed.unwrap_or(seed),
            amplitude: other_amplitude.unwrap_or(amplitude),
        }),
        (start, None, None) => Ok(start),
        (_, seed, _) => {
            let option = if seed.is_some() { "--seed" } else { "--amplitude" };
            let known: Vec<_> = SCENES.iter().filter(is_random).map(|scene| scene.name).collect();
            Err(Error::Usage(format!(
                "the scene `{}` does not use {option}: only {} displace nodes at random",
                scene.name,
                list(&known)
            )))
        }
    }
}

/// Overrides of the steps of a scene.
#[derive(Clone, Debug, PartialEq, Args)]
#[non_exhaustive]
pub struct StepOptions {
    /// Time step in s [default: the scene's, 1/30].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub dt: Option<f64>,

    /// Method by which steps advance in time: sdirk2 and sdirk3 have two and three stages, each as much work
    /// as a step of implicit Euler, and errors of second and third order.
    #[arg(long, value_name = "METHOD", value_parser = integrators(), default_value = "implicit-euler")]
    pub integrator: Integrator,

    /// Largest error of the motion from time steps, in body heights per second: each frame is made in steps
    /// as short as that requires. Best with --integrator sdirk2 and --newton full.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,

    /// Accuracy of each step: one Newton iteration with line search, or iterations until the residual is
    /// small.
    #[arg(long, value_enum, default_value_t = Newton::Single)]
    pub newton: Newton,
}

impl StepOptions {
    /// Settings with these overrides.
    #[must_use]
    pub fn apply(&self, settings: Settings) -> Settings {
        let &Self { integrator, tolerance, newton, dt } = self;
        let dt = dt.unwrap_or(settings.dt);
        Settings { dt, integrator, tolerance, newton, ..settings }
    }
}

fn integrators() -> impl TypedValueParser<Value = Integrator> {
    PossibleValuesParser::new(["implicit-euler", "sdirk2", "sdirk3"]).map(|name| match name.as_str() {
        "sdirk2" => Integrator::Sdirk2,
        "sdirk3" => Integrator::Sdirk3,
        _ => Integrator::ImplicitEuler,
    })
}

/// Units, the axis that points upwards, and a list of the scenes with their descriptions, to be shown behind
/// the options.
#[must_use]
pub fn scenes() -> String {
    let mut text = String::from("All quantities are in SI units; y points upwards.\n\nScenes:\n");
    for scene in SCENES {
        text += &format!("  {:24} {}\n", scene.name, scene.about);
    }
    text
}
