//! The command line.

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use piola_scenes::options::{SceneOptions, StepOptions, scenes};
use piola_scenes::output::new_folder;
use piola_scenes::run::Output;
use piola_scenes::settings::{Files, Settings};
use piola_viewer::session::Session;
use piola_viewer::state::State;

use crate::bench::{Check, Curve, Fit};
use crate::contract::Contract;
use crate::declare::Declare;
use crate::emit::Emit;
use crate::error::Error;

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
    /// which is needed for access: give it only to those who may pull.
    #[command(after_help = scenes())]
    View(Box<View>),
    /// List the materials with formula, parameters and typical values of them, domain and small-strain
    /// moduli.
    Materials {
        /// Only this material
        name: Option<String>,
    },
    /// Print test curves of a material, with R² of measured ones; or rank all rubbers by it.
    Curve(Box<Curve>),
    /// Fit the parameters of a material to measured curves.
    Fit(Box<Fit>),
    /// Print a formula as a declaration in Rust, to be pasted into a crate, and its derivatives as formulas.
    Declare(Box<Declare>),
    /// Print an energy as C, CUDA, OpenCL or WGSL: stress, tangent and projection at a point, forces and
    /// stiffness of a tetrahedron, in one file without a dependency.
    Emit(Box<Emit>),
    /// Check the rules that every material must keep, on a declaration in Rust or a formula.
    ///
    /// Finite differences of energy and stress, symmetry, equal stretches, inversion, accuracy in single
    /// precision: the tests of `piola::contract!` in a crate.
    Contract(Box<Contract>),
    /// Show where a material is stable: Baker–Ericksen, Hill, strong ellipticity.
    ///
    /// Checks a box of stretches, and uniaxial, equibiaxial, pure shear, confined and hydrostatic tests from
    /// rest.
    Check(Box<Check>),
}

/// Options of `piola run`.
#[derive(Debug, Parser)]
pub(crate) struct Run {
    #[command(flatten)]
    choice: Choice,

    /// Number of time steps [default: the scene's].
    #[arg(long, value_name = "N")]
    frames: Option<usize>,

    /// New folder for frame_NNNN.ply, frames.png, summary.json and state.json [default: out/SCENE, or the
    /// first of out/SCENE-2, out/SCENE-3, … that does not exist].
    ///
    /// Ctrl-C ends a run with the frames that it has.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Continue the run in the folder of --out, to the last bit as if it had not been interrupted; needs the
    /// same options, except for --frames and --threads.
    #[arg(long, requires = "out")]
    resume: bool,

    /// Write the tetrahedra as well, frame_NNNN.vtu with fields and frames.pvd with times, for ParaView.
    #[arg(long)]
    vtu: bool,
}

/// Options of `piola view`.
#[derive(Debug, Parser)]
pub(crate) struct View {
    #[command(flatten)]
    choice: Choice,

    /// Port of the page on 127.0.0.1; 0 for any that is free.
    #[arg(long, default_value_t = 8017)]
    port: u16,

    /// File for the state that the page's button saves [default: kept in memory].
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,

    /// Continue a saved state, to the last bit; it contains its scene and options, except for the files of
    /// another body: give --mesh and --surface again.
    #[arg(long, value_name = "FILE")]
    load: Option<PathBuf>,
}

/// A scene and overrides of its defaults.
#[derive(Debug, PartialEq, Parser)]
struct Choice {
    #[command(flatten)]
    scene: SceneOptions,

    /// The surface to embed in them, OBJ [default: their boundary].
    #[arg(long, value_name = "FILE", requires = "mesh")]
    surface: Option<PathBuf>,

    #[command(flatten)]
    steps: StepOptions,

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
        let folder = self.out.unwrap_or_else(|| new_folder(&PathBuf::from("out").join(name)));
        Ok((settings, Output { folder, vtu: self.vtu, resume: self.resume }))
    }
}

impl View {
    /// The session, the port of its page, and the file for its states.
    pub(crate) fn session(self) -> Result<(Session, u16, Option<PathBuf>), Error> {
        let session = match &self.load {
            None => Session::new(self.choice.settings()?)?,
            Some(path) => {
                let files = self.choice.only_files()?;
                Session::resume(State::read(path)?.with_files(files))?
            }
        };
        Ok((session, self.port, self.save))
    }
}

impl Choice {
    /// The files of another body, where nothing else may be chosen.
    fn only_files(mut self) -> Result<Option<Files>, Error> {
        let (mesh, surface) = (self.scene.mesh.take(), self.surface.take());
        let files = mesh.map(|mesh| Files { mesh, surface });
        let has_other_options = self != Self::parse_from(["piola"]);
        match has_other_options {
            true => Err(Error::usage(
                "the file contains its scene and options; leave out all options except --load, --mesh and --surface of its \
                 body, --port and --save",
            )),
            false => Ok(files),
        }
    }

    fn settings(self) -> Result<Settings, Error> {
        let settings = self.scene.settings(self.surface)?;
        Ok(Settings { threads: self.threads, ..self.steps.apply(settings) })
    }
}
