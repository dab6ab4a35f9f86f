//! Why a run cannot start or go on.

use std::fmt;
use std::path::PathBuf;

use piola::material::Inadmissible;
use piola_laboratory::chart::ChartError;
use piola_laboratory::fit::FitError;

/// Why a run cannot start or go on.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// No scene of that name.
    UnknownScene {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// No body of that name.
    UnknownBody {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// The scene puts no node anywhere at random.
    NotScrambled {
        /// What was asked for, such as `--seed`.
        option: &'static str,
        /// The scene.
        scene: &'static str,
        /// The scenes that do.
        known: Vec<&'static str>,
    },
    /// No material of that name.
    UnknownMaterial {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// The material has no parameter of that name.
    UnknownParameter {
        /// Name of the material.
        material: &'static str,
        /// The name as given.
        parameter: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// A parameter was given no value; there is no right one for everybody.
    MissingParameters {
        /// Name of the material.
        material: &'static str,
        /// The names without a value.
        missing: Vec<&'static str>,
    },
    /// The material refuses its parameters.
    Inadmissible {
        /// Name of the material.
        material: &'static str,
        /// Its reason.
        reason: Inadmissible,
    },
    /// A number of the setting is out of range.
    OutOfRange {
        /// What it is, such as `dt`.
        quantity: &'static str,
        /// The number as given.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
    /// A pin names neither a box nor a group.
    UnknownPin {
        /// The text as given.
        pin: String,
        /// The groups of the mesh.
        groups: Vec<String>,
    },
    /// A pin holds no node.
    Pin {
        /// Which one.
        pin: String,
        /// Why.
        reason: String,
    },
    /// A mesh or a surface is unusable.
    Geometry {
        /// The file, or the name of what it would be.
        file: String,
        /// What is wrong with it, the file not named.
        reason: String,
    },
    /// The solver refuses what it is given.
    Setup {
        /// Its reason.
        reason: String,
    },
    /// A file cannot be read or says nonsense.
    File {
        /// What is wrong, the file and its line named.
        reason: String,
    },
    /// The bench has no use for what it is given.
    Bench {
        /// Why.
        reason: String,
    },
    /// Files cannot be written there.
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A file that names its scene is given beside a scene or its options.
    ScenesOwn,
    /// The page cannot be served there.
    Port {
        /// The port as given.
        port: u16,
        /// What the system says.
        reason: String,
    },
    /// Threads cannot be started.
    Threads {
        /// What the system says.
        reason: String,
    },
    /// A file cannot be written although its folder could be.
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A body that is not back cannot be looked at.
    Standing {
        /// What the solver says.
        reason: String,
    },
    /// Parameters cannot be fitted to the data.
    Fit {
        /// Name of the material.
        material: String,
        /// Why.
        reason: FitError,
    },
    /// There is no chart.
    Chart {
        /// Why.
        reason: ChartError,
    },
    /// A time step failed.
    Step {
        /// The frame it would have led to.
        frame: usize,
        /// What the solver says.
        reason: String,
    },
}

impl Error {
    /// The exit status of a command that ends with it: 2 where the input is to blame and nothing has begun, 1 where
    /// something failed on the way.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Threads { .. } | Self::Write { .. } | Self::Standing { .. } | Self::Step { .. } => 1,
            _ => 2,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownScene { name, known } => {
                write!(f, "there is no scene `{name}`; choose one of {}", list(known))
            }
            Self::UnknownBody { name, known } => {
                write!(f, "there is no body `{name}`; choose one of {}, or a file with --mesh", list(known))
            }
            Self::NotScrambled { option, scene, known } => {
                write!(
                    f,
                    "the scene `{scene}` has no use for {option}: it displaces nothing at random, as {} does",
                    list(known)
                )
            }
            Self::UnknownMaterial { name, known } => {
                write!(
                    f,
                    "there is no material `{name}`; choose one of {}. `piola materials` describes them",
                    list(known)
                )
            }
            Self::UnknownParameter { material, parameter, known } => {
                write!(f, "{material} has no parameter `{parameter}`; it has {}", list(known))
            }
            Self::MissingParameters { material, missing } => write!(
                f,
                "{material} needs a value for {}; add {}",
                list(missing),
                missing.iter().map(|name| format!("--param {name}=…")).collect::<Vec<_>>().join(" ")
            ),
            Self::Inadmissible { material, reason } => {
                write!(f, "{material}: {reason}")?;
                match reason {
                    Inadmissible::NoExtension { .. } | Inadmissible::DoesNotRestore { .. } => {
                        f.write_str(" (`--inversion refuse`)")
                    }
                    _ => Ok(()),
                }
            }
            Self::OutOfRange { quantity, value, requirement } => {
                write!(f, "{quantity} is {value}; it must be {requirement}")
            }
            Self::UnknownPin { pin, groups } if groups.is_empty() => {
                write!(f, "`{pin}` is no box to pin, and the mesh has no groups; {}", crate::region::NoRegion)
            }
            Self::UnknownPin { pin, groups } => write!(
                f,
                "`{pin}` is neither a group of the mesh (it has {}) nor a box; {}",
                list(groups),
                crate::region::NoRegion
            ),
            Self::Pin { pin, reason } => {
                write!(f, "the pin {pin} holds nothing: {reason}; choose a place with --pin")
            }
            Self::Setup { reason } => f.write_str(reason),
            Self::Geometry { file, reason } => write!(f, "{file}: {reason}"),
            Self::File { reason } | Self::Bench { reason } => f.write_str(reason),
            Self::Folder { path, reason } => {
                write!(
                    f,
                    "cannot write to the folder {}: {reason}; name another one with --out",
                    path.display()
                )
            }
            Self::ScenesOwn => f.write_str(
                "the file names its scene and options itself; leave out all but --load or --replay, --port, --save and --record",
            ),
            Self::Port { port, reason } => {
                write!(f, "cannot serve the page at port {port}: {reason}; name another one with --port, or 0 for any")
            }
            Self::Threads { reason } => write!(f, "cannot start threads: {reason}"),
            Self::Write { path, reason } => write!(f, "cannot write {}: {reason}", path.display()),
            Self::Fit { material, reason } => {
                write!(f, "{material} cannot be fitted: {reason}")?;
                match reason {
                    FitError::Start(_) => f.write_str(" (--param gives others)"),
                    FitError::TooFewPoints { .. } => f.write_str(" (--hold)"),
                    _ => Ok(()),
                }
            }
            Self::Chart { reason } => reason.fmt(f),
            Self::Standing { reason } => write!(f, "where the body rests cannot be said: {reason}"),
            Self::Step { frame, reason } => {
                write!(f, "the step to frame {frame} failed: {reason}; nothing was written")
            }
        }
    }
}

impl std::error::Error for Error {}

fn list(names: &[impl AsRef<str>]) -> String {
    names.iter().map(|name| format!("`{}`", name.as_ref())).collect::<Vec<_>>().join(", ")
}
