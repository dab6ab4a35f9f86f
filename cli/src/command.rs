//! The command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};
use piola::Inversion;
use piola::step::Integrator;
use piola_scenes::material::MaterialSpec;
use piola_scenes::output::Newton;
use piola_scenes::run::{Existing, Output};
use piola_scenes::scene::{Amplitude, Body, SCENES, Scene, Start};
use piola_scenes::settings::{Files, Settings};

use crate::bench::{Check, Curve, Fit};
use crate::contract::Contract;
use crate::declare::Declare;
use crate::declared::{self, Formula};
use crate::error::Error;
use crate::overlap::refuse_overlaps;
use crate::value::Given;
use crate::view::recording::Recording;
use crate::view::state::State;
use crate::view::{Begin, Options};

/// Elastic bodies that collapse, invert and recover.
///
/// Without arguments, runs the scene `horse` and writes to the folder out/horse.
#[derive(Debug, Parser)]
#[command(version)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene and write its surfaces, a picture and a summary.
    #[command(after_help = scenes())]
    Run(Box<Run>),
    /// Show a scene in a browser, to be pulled with the mouse.
    ///
    /// Serves a page on 127.0.0.1 and prints its address; Ctrl-C ends it. The address has a random token,
    /// without which nobody gets in: give it to those who may pull, and to nobody else.
    #[command(after_help = scenes())]
    View(Box<View>),
    /// List the materials with formula, parameters and typical values of them, domain and small-strain
    /// moduli.
    Materials,
    /// Print test curves of a material, with R² of measured ones; or rank all rubbers by it.
    Curve(Box<Curve>),
    /// Fit the parameters of a material to measured curves.
    Fit(Box<Fit>),
    /// Print a formula as a declaration in Rust, to be pasted into a crate, and its derivatives as formulas.
    Declare(Box<Declare>),
    /// Check the rules that every material must keep, on a declaration in Rust or a formula.
    ///
    /// Finite differences of energy and stress, symmetry, equal stretches, inversion, accuracy in single
    /// precision and on lanes: what `piola::contract!` tests in a crate.
    Contract(Box<Contract>),
    /// Show where a material is stable: Baker–Ericksen, Hill, strong ellipticity.
    ///
    /// Over a box of stretches, and in uniaxial, equibiaxial, pure shear, confined and hydrostatic tests from
    /// rest.
    Check(Box<Check>),
}

/// All quantities are in SI units; y points upwards.
#[derive(Debug, Parser)]
pub(crate) struct Run {
    #[command(flatten)]
    choice: Choice,

    /// Number of time steps [default: the scene's].
    #[arg(long, value_name = "N")]
    frames: Option<usize>,

    /// Folder for frame_NNNN.ply, frames.png, summary.json and state.json [default: out/SCENE].
    ///
    /// A run replaces or removes only files that earlier runs have written, which are listed in
    /// piola-files.txt there, and an earlier run only by a complete one. The folder is refused if it holds
    /// other files with names of results. Ctrl-C ends a run with the frames that it has.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Replace files in the folder that no run has written, where they have the names of results.
    #[arg(long)]
    force: bool,

    /// Go on with the run in the folder, to the last bit as if it had not been interrupted; needs the options
    /// that it was begun with, but for --frames and --threads.
    #[arg(long, conflicts_with = "force")]
    resume: bool,

    /// Write the tetrahedra as well, frame_NNNN.vtu with fields and frames.pvd with times, for ParaView.
    #[arg(long)]
    vtu: bool,
}

/// All quantities are in SI units; y points upwards.
#[derive(Debug, Parser)]
pub(crate) struct View {
    #[command(flatten)]
    choice: Choice,

    /// Port of the page on 127.0.0.1; 0 for any that is free.
    #[arg(long, default_value_t = 8017)]
    port: u16,

    /// File for the state that the page's button saves; a recording that is played back writes none [default:
    /// kept in memory].
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,

    /// Continue a saved state, to the last bit; it names its scene and options itself, but for the files of
    /// another body: give --mesh and --surface again.
    #[arg(long, value_name = "FILE", conflicts_with = "replay")]
    load: Option<PathBuf>,

    /// Record every pull and every change in a file; only an earlier recording is overwritten.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,

    /// Play a recording back, which names its scene and options like a state; the page takes over at its end,
    /// or when its button is pressed.
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
}

/// A scene and overrides of its defaults.
#[derive(Debug, PartialEq, Parser)]
struct Choice {
    /// The scene.
    #[arg(default_value = "horse")]
    scene: String,

    /// Time step in s [default: the scene's, 1/30].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    dt: Option<f64>,

    /// Material, as listed by `piola materials`, or a file of Rust that declares one [default: the scene's].
    /// One that is listed is as stiff as the scene's without --param.
    #[arg(long, value_name = "NAME|FILE.rs")]
    material: Option<String>,

    #[command(flatten)]
    formula: Formula,

    /// Value of a parameter of the material, in SI units or with kPa, MPa or GPa behind it; lists as
    /// NAME=V,V,V. Of another material than the scene's, all or none.
    #[arg(long = "param", value_name = "NAME=V", value_parser = crate::value::parameter)]
    parameters: Vec<Given>,

    /// Beyond the domain of a material: `refuse` takes shorter steps, a number is the stretch below which the
    /// energy is extended by polynomials [default: 0.1 where it can be].
    #[arg(long, value_name = "refuse|STRETCH", value_parser = crate::value::inversion, allow_negative_numbers = true)]
    inversion: Option<Inversion>,

    /// Density in kg/m³ [default: the scene's, 1000].
    #[arg(long, value_name = "RHO", allow_negative_numbers = true)]
    density: Option<f64>,

    /// Gravity in m/s², downwards [default: 0].
    #[arg(long, value_name = "G", allow_negative_numbers = true)]
    gravity: Option<f64>,

    /// Nodes to hold in place of the scene's: a physical group of the mesh, or a box
    /// LOW:HIGH,LOW:HIGH,LOW:HIGH in m, open where a side is left out, such as `:,:0.05,:`; may be repeated.
    #[arg(long = "pin", value_name = "BOX|GROUP", allow_hyphen_values = true)]
    pins: Vec<String>,

    /// Another body that comes with the program: horse, dinosaur or bar [default: the scene's].
    #[arg(long, value_name = "NAME", conflicts_with = "mesh")]
    body: Option<String>,

    /// Seed of the random displacements of a scene that scrambles: equal seeds give equal starts [default:
    /// the scene's, 1].
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// How far such a scene displaces each node along each axis, in mean edge lengths; `box` puts it anywhere
    /// in the body's bounding box [default: the scene's, 0.3].
    #[arg(long, value_name = "A|box", allow_negative_numbers = true)]
    amplitude: Option<Amplitude>,

    /// Another body: tetrahedra in Gmsh MSH 4.1 or 2.2, ASCII, or TetGen's .node and .ele; the scene's places
    /// become shares of its bounding box.
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,

    /// The surface to embed in them, OBJ [default: their boundary].
    #[arg(long, value_name = "FILE", requires = "mesh")]
    surface: Option<PathBuf>,

    /// Method by which steps advance in time: sdirk2 and sdirk3 have two and three stages, each as much work
    /// as a step of implicit Euler, and errors of second and third order.
    #[arg(long, value_name = "METHOD", value_parser = integrators(), default_value = "implicit-euler")]
    integrator: Integrator,

    /// Largest error of the motion that steps of time may make, in body heights per second: each frame is
    /// made in steps as short as that takes. Best with --integrator sdirk2 and --newton full.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    tolerance: Option<f64>,

    /// How far each step is solved: one Newton iteration with line search, or until the residual is small.
    #[arg(long, value_enum, default_value_t = Newton::Single)]
    newton: Newton,

    /// Threads for the solver; 0 for one per core.
    #[arg(long, value_name = "N", default_value_t = 1)]
    threads: usize,
}

impl Run {
    /// Settings of the run, and the files that it leaves.
    pub(crate) fn settings(self) -> Result<(Settings, Output), Error> {
        let mut settings = self.choice.settings()?;
        settings.frames = self.frames.unwrap_or(settings.frames);
        let name = settings.scene.name;
        let folder = self.out.unwrap_or_else(|| PathBuf::from("out").join(name));
        let existing = match (self.force, self.resume) {
            (_, true) => Existing::Resume,
            (true, false) => Existing::Replace,
            (false, false) => Existing::Keep,
        };
        Ok((settings, Output::new(folder).with_vtu(self.vtu).with_existing(existing)))
    }
}

impl View {
    /// Options of the viewer.
    pub(crate) fn options(self) -> Result<Options, Error> {
        self.refuse_overlaps()?;
        let begin = match (&self.load, &self.replay) {
            (None, None) => Begin::Scene(Box::new(self.choice.settings()?)),
            (Some(path), _) => {
                let files = self.choice.only_files()?;
                Begin::State(Box::new(State::read(path)?.with_files(files)))
            }
            (None, Some(path)) => {
                let files = self.choice.only_files()?;
                Begin::Replay(Box::new(Recording::read(path)?.with_files(files)))
            }
        };
        Ok(Options::new(begin).with_port(self.port).with_save(self.save).with_record(self.record))
    }

    /// Refuses to write over files that are read. A state may be saved to the file that it was loaded from.
    fn refuse_overlaps(&self) -> Result<(), Error> {
        let Choice { mesh, surface, .. } = &self.choice;
        // TetGen's files are two, either of which may be named.
        let is_tetgen = |mesh: &&PathBuf| mesh.extension().is_some_and(|end| end == "node" || end == "ele");
        let tetgen = mesh.as_ref().filter(is_tetgen);
        let beside = |extension| tetgen.map(|mesh| mesh.with_extension(extension));
        let named = |option, file: &Option<PathBuf>| file.clone().map(|file| (option, file));
        let inputs = [
            named("--mesh", mesh),
            named("--mesh", &beside("node")),
            named("--mesh", &beside("ele")),
            named("--surface", surface),
            named("--replay", &self.replay),
        ];
        let (save, record) = (named("--save", &self.save), named("--record", &self.record));
        refuse_overlaps(named("--load", &self.load), record.clone())?;
        refuse_overlaps(inputs.into_iter().flatten(), [save, record].into_iter().flatten())
    }
}

impl Choice {
    /// The files of another body.
    fn files(&self) -> Option<Files> {
        self.mesh.clone().map(|mesh| Files { mesh, surface: self.surface.clone() })
    }

    /// The files of another body, where nothing else may be chosen.
    fn only_files(self) -> Result<Option<Files>, Error> {
        let files = self.files();
        let rest = Self { mesh: None, surface: None, ..self };
        if rest == Self::parse_from(["piola"]) { Ok(files) } else { Err(Error::ScenesOwn) }
    }

    /// The scene with the overrides.
    fn settings(self) -> Result<Settings, Error> {
        let files = self.files();
        let scene = Scene::find(&self.scene)?;
        let mut settings = Settings::new(scene);
        if let Some(material) = self.formula.spec(&self.parameters)? {
            settings.material = material;
        } else if let Some(name) = self.material.filter(|name| !settings.material.is(name)) {
            settings.material = match declared::in_file(&name)? {
                Some(material) => material,
                None => MaterialSpec::matching(&name, settings.material.build()?.moduli),
            };
        }
        settings.material = declared::with_values(settings.material, self.parameters);
        if let Some(inversion) = self.inversion {
            settings.material = settings.material.with_inversion(inversion);
        }
        if let Some(name) = self.body {
            settings.body = Body::find(&name)?;
        }
        settings.start = start(scene, self.seed, self.amplitude)?;
        settings.density = self.density.unwrap_or(settings.density);
        settings.gravity = self.gravity.unwrap_or(settings.gravity);
        settings.dt = self.dt.unwrap_or(settings.dt);
        Ok(settings
            .with_files(files)
            .with_pins(self.pins)
            .with_integrator(self.integrator)
            .with_tolerance(self.tolerance)
            .with_newton(self.newton)
            .with_threads(self.threads))
    }
}

fn integrators() -> impl TypedValueParser<Value = Integrator> {
    PossibleValuesParser::new(["implicit-euler", "sdirk2", "sdirk3"]).map(|name| match name.as_str() {
        "sdirk2" => Integrator::Sdirk2,
        "sdirk3" => Integrator::Sdirk3,
        _ => Integrator::ImplicitEuler,
    })
}

/// The scene's start, with another seed or amplitude if it is a random one.
fn start(scene: &'static Scene, seed: Option<u64>, amplitude: Option<Amplitude>) -> Result<Start, Error> {
    let is_random = |scene: &&&Scene| matches!(scene.start, Start::Scrambled { .. });
    match (scene.start, seed, amplitude) {
        (Start::Scrambled { seed, amplitude }, other_seed, other_amplitude) => Ok(Start::Scrambled {
            seed: other_seed.unwrap_or(seed),
            amplitude: other_amplitude.unwrap_or(amplitude),
        }),
        (start, None, None) => Ok(start),
        (_, seed, _) => Err(Error::NotScrambled {
            option: if seed.is_some() { "--seed" } else { "--amplitude" },
            scene: scene.name,
            known: SCENES.iter().filter(is_random).map(|scene| scene.name).collect(),
        }),
    }
}

fn scenes() -> String {
    let mut text = String::from("Scenes:\n");
    for scene in SCENES {
        text += &format!("  {:24} {}\n", scene.name, scene.about);
    }
    text
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;
    use crate::value::parameter;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn lists_and_numbers_are_parameters() {
        let read = |text| parameter(text).map(|given| (given.name, given.values));
        assert_eq!(read("mu=1e5"), Ok(("mu".into(), vec![1e5])));
        assert_eq!(read("alpha = 1.3, 5,-2"), Ok(("alpha".into(), vec![1.3, 5.0, -2.0])));
        assert_eq!(read("mu=0.25 MPa"), Ok(("mu".into(), vec![0.25e6])));
        assert_eq!(read("mu=1,2kPa"), Ok(("mu".into(), vec![1e3, 2e3])));
        assert!(parameter("mu").is_err_and(|error| error.contains("NAME=VALUE")));
        assert!(parameter("mu=soft").is_err_and(|error| error.contains("`soft`")));
    }
}
