//! Command line: options of piola-mpi, mixed with options of PETSc.

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use piola::point::Filter;
use piola_bodies::step::{Filtering, LinearSolver, NewtonSettings};
use piola_scenes::options::{SceneOptions, StepOptions, scenes};
use piola_scenes::settings::Settings;
use serde::Serialize;

use crate::error::Error;

/// Elastic bodies on many machines: scenes of piola with the solvers of PETSc, over MPI.
///
/// Run it as `mpirun -n N piola-mpi …`. Options of PETSc, with one dash, may be at any place: -ksp_type cg
/// -pc_type gamg.
#[derive(Debug, Parser)]
#[command(version, name = "piola-mpi")]
pub struct Cli {
    /// Subcommand.
    #[command(subcommand)]
    pub command: Command,
}

/// Subcommand, with its options.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Let a cube of 1 m, held at one face, sag under its own weight; the mesh is generated in parallel.
    /// Prints numbers of iterations and times.
    Box(BoxOptions),
    /// Compute the equilibrium of a body under gravity.
    #[command(after_help = scenes())]
    Statics(Box<BodyOptions>),
    /// Run a scene, or a mesh, in time steps.
    #[command(after_help = scenes())]
    Run(Box<RunOptions>),
}

/// Options of the subcommand `box`.
#[derive(Debug, Parser)]
pub struct BoxOptions {
    /// Minimum number of tetrahedra; the cube has n³ cells of six tetrahedra each.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    pub elements: u64,

    /// Folder for a checkpoint of the result [default: no checkpoint].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    #[command(flatten)]
    #[expect(missing_docs, reason = "clap would print it")]
    pub solver: SolverOptions,
}

/// Options of the subcommand `statics`, and of every body that is not a box.
#[derive(Debug, Parser)]
pub struct BodyOptions {
    #[command(flatten)]
    scene: SceneOptions,

    /// Displacement of nodes: BOX|GROUP=X,Y,Z@T moves them steadily by X, Y, Z in m until the time T in s,
    /// and then holds them; in statics the whole displacement is applied at once. May be repeated.
    #[arg(long = "move", value_name = "BOX|GROUP=X,Y,Z@T", value_parser = motion, allow_hyphen_values = true)]
    moves: Vec<Move>,

    /// Folder for the results [default: out/SCENE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Replace results in the folder.
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    #[expect(missing_docs, reason = "clap would print it")]
    pub solver: SolverOptions,
}

/// Options of the subcommand `run`.
#[derive(Debug, Parser)]
pub struct RunOptions {
    #[command(flatten)]
    #[expect(missing_docs, reason = "clap would print it")]
    pub body: BodyOptions,

    #[command(flatten)]
    pub(crate) steps: StepOptions,

    /// Number of time steps [default: the scene's].
    #[arg(long, value_name = "N")]
    frames: Option<usize>,

    /// Continue from the checkpoint in the folder, on any number of ranks; needs the options of its first
    /// run, except --frames and the options of the solver.
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,

    /// Write the tetrahedra of each frame for ParaView: frame_NNNN.pvtu with a piece of each rank, and
    /// frames.pvd with the times.
    #[arg(long)]
    pub vtu: bool,

    /// Number of steps between two checkpoints; with 0, only the end is written.
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub checkpoint_every: usize,
}

/// Options of the solvers in a step.
#[derive(Clone, Debug, Parser)]
pub struct SolverOptions {
    /// Tolerance of Newton's method, relative to the first residual.
    #[arg(long, value_name = "T", default_value_t = 1e-6)]
    newton_tolerance: f64,

    /// Maximum number of Newton iterations in a step.
    #[arg(long, value_name = "N", default_value_t = 50)]
    newton_iterations: usize,

    /// Tolerance of the first linear systems, relative to their right sides; the last ones have the tolerance
    /// that the tolerance of Newton's method requires [default: 0.01, or 1e-8 with --newton single].
    #[arg(long, value_name = "T")]
    linear_tolerance: Option<f64>,

    /// Projection of the tangents: on-demand (if the matrix is not positive definite otherwise), clamp or
    /// absolute (always), or none [default: on-demand, or clamp with --newton single].
    #[arg(long, value_name = "WHEN", value_parser = filtering)]
    filter: Option<Filtering>,

    /// Number of threads of each rank; PETSc itself uses one.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
}

/// Prescribed motion of some nodes, which are pinned for it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Move {
    /// Nodes that move: a box, or the name of a group.
    pub(crate) nodes: String,
    /// Displacement at the end of the motion, m.
    pub(crate) displacement: [f64; 3],
    /// End of the steady motion, s; the nodes are held afterwards.
    pub(crate) reached: f64,
}

/// Settings of a run: a scene, and prescribed motions.
#[derive(Debug)]
pub(crate) struct Task {
    /// The scene with its overrides.
    pub(crate) settings: Settings,
    /// Motions of nodes.
    pub(crate) moves: Vec<Move>,
}

impl RunOptions {
    /// Settings of the run.
    pub(crate) fn task(&self) -> Result<Task, Error> {
        let mut task = self.body.task()?;
        let frames = self.frames.unwrap_or(task.settings.frames);
        task.settings = self.steps.apply(task.settings);
        task.settings.frames = frames;
        task.settings.check()?;
        Ok(task)
    }
}

impl SolverOptions {
    /// Settings of Newton's method, with one iteration or as many as needed.
    pub(crate) fn settings(&self, is_single: bool) -> Result<NewtonSettings, Error> {
        let linear = self.linear_tolerance.unwrap_or(if is_single { 1e-8 } else { 1e-2 });
        for (option, value) in [("--newton-tolerance", self.newton_tolerance), ("--linear-tolerance", linear)]
        {
            if !(0.0..1.0).contains(&value) {
                return Err(Error::usage(format!("{option} {value}: it must be at least 0 and below 1")));
            }
        }
        if self.newton_iterations == 0 || !(1..=1024).contains(&self.threads) {
            let reason = "--newton-iterations must be at least 1, and --threads from 1 to 1024";
            return Err(Error::usage(reason));
        }
        let usual = if is_single { Filtering::Always(Filter::Clamp) } else { Filtering::OnDemand };
        Ok(NewtonSettings {
            filtering: self.filter.unwrap_or(usual),
            max_iterations: if is_single { 1 } else { self.newton_iterations },
            tolerance: self.newton_tolerance,
            linear: LinearSolver::ConjugateGradients { tolerance: linear, max_iterations: 20_000 },
            ..Default::default()
        })
    }
}

impl BodyOptions {
    /// Settings of statics.
    pub(crate) fn task(&self) -> Result<Task, Error> {
        let settings = self.scene.clone().settings(None)?;
        settings.check()?;
        Ok(Task { settings, moves: self.moves.clone() })
    }
}

/// Reads `BOX|GROUP=X,Y,Z@T`.
fn motion(text: &str) -> Result<Move, String> {
    let how = "write BOX=X,Y,Z@T, or GROUP=X,Y,Z@T, with T > 0";
    let (nodes, rest) = text.rsplit_once('=').ok_or(how)?;
    let (displacement, reached) = rest.split_once('@').ok_or(how)?;
    let number = |value: &str| value.trim().parse::<f64>().map_err(|_| format!("`{value}` is not a number"));
    let displacement: Vec<f64> = displacement.split(',').map(number).collect::<Result<_, _>>()?;
    let displacement: [f64; 3] = displacement.try_into().map_err(|_| how)?;
    let reached: f64 = reached.parse().map_err(|_| how)?;
    if reached > 0.0 && reached.is_finite() && displacement.iter().all(|x| x.is_finite()) {
        Ok(Move { nodes: nodes.to_owned(), displacement, reached })
    } else {
        Err(how.to_owned())
    }
}

/// Reads the name of a filter.
fn filtering(text: &str) -> Result<Filtering, String> {
    match text {
        "on-demand" => Ok(Filtering::OnDemand),
        "clamp" => Ok(Filtering::Always(Filter::Clamp)),
        "absolute" => Ok(Filtering::Always(Filter::Absolute)),
        "none" => Ok(Filtering::Always(Filter::None)),
        _ => Err("write on-demand, clamp, absolute or none".to_owned()),
    }
}

/// Options of PETSc: names without their dash, with their values.
pub type PetscOptions = Vec<(String, Option<String>)>;

/// Separates the options of PETSc from a command line: one dash and a word, and the next argument as value
/// unless it is an option too.
pub fn split(arguments: impl IntoIterator<Item = String>) -> (Vec<String>, PetscOptions) {
    let is_petsc = |text: &str| {
        let mut letters = text.chars();
        let is_dashed =
            letters.next() == Some('-') && letters.next().is_some_and(|c| c.is_ascii_alphabetic());
        is_dashed && !matches!(text, "-h" | "-V")
    };
    let (mut own, mut petsc): (Vec<String>, PetscOptions) = (Vec::new(), Vec::new());
    let mut awaits_value = false;
    for argument in arguments {
        if is_petsc(&argument) {
            petsc.push((argument[1..].to_owned(), None));
            awaits_value = true;
        } else if awaits_value && !argument.starts_with("--") {
            if let Some((_, value)) = petsc.last_mut() {
                *value = Some(argument);
            }
            awaits_value = false;
        } else {
            own.push(argument);
            awaits_value = false;
        }
    }
    (own, petsc)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn options_of_petsc_are_separated() {
        let words = "piola-mpi run -ksp_type cg horse -ksp_view --gravity -9.81 -x -1 -h";
        let (own, petsc) = split(words.split(' ').map(str::to_owned));
        assert_eq!(own, ["piola-mpi", "run", "horse", "--gravity", "-9.81", "-h"]);
        let expected = [("ksp_type", Some("cg")), ("ksp_view", None), ("x", Some("-1"))];
        assert_eq!(petsc, expected.map(|(name, value)| (name.to_owned(), value.map(str::to_owned))));
    }

    #[test]
    fn motions_are_read() {
        let expected = Move { nodes: ":,0.9:,:".to_owned(), displacement: [0.0, -0.1, 0.0], reached: 2.0 };
        assert_eq!(motion(":,0.9:,:=0,-0.1,0@2"), Ok(expected));
        for wrong in ["top=1,2@3", "top=1,2,3@0", "1,2,3@1", "top=1,2,3"] {
            assert!(motion(wrong).is_err(), "{wrong}");
        }
    }
}
