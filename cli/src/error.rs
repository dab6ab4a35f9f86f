//! Errors that end the command.

use std::io;
use std::path::PathBuf;

use piola::contract::Violations;
use piola::material::MaterialError;
use piola_bodies::mesh::ReadError;
use piola_laboratory::data::DataError;
use piola_laboratory::fit::FitError;
use piola_scenes::error::Error as SceneError;
use piola_viewer::error::Error as ViewerError;

/// Error that ends the command without success.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene cannot start or continue.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A viewer cannot take or write a file.
    #[error(transparent)]
    Viewer(ViewerError),
    /// A file that names its scene is given together with a scene or its options.
    #[error(
        "the file contains its scene and options; leave out all options except --load, --mesh and --surface of its body, \
         --port and --save"
    )]
    ScenesOwn,
    /// The page cannot be served at the port.
    #[error("cannot serve the page at port {port}: {source}; name another one with --port, or 0 for any")]
    Port {
        /// The port as given.
        port: u16,
        /// Error of the system.
        source: io::Error,
    },
    /// A thread cannot be started.
    #[error("cannot start a thread: {0}")]
    Thread(#[source] io::Error),
    /// Signals cannot be listened to.
    #[error("cannot listen to signals: {0}")]
    Signals(#[source] io::Error),
    /// Standard output cannot be written to.
    #[error("cannot write to standard output: {0}")]
    StandardOutput(#[source] io::Error),
    /// A file that is to be written is also read, or written by two.
    #[error("{} is named by {one} and by {other}, which would overwrite it; name another file", path.display())]
    NamedTwice {
        /// The file, as the second option spells it.
        path: PathBuf,
        /// The option that names it first.
        one: &'static str,
        /// The option that would overwrite it.
        other: &'static str,
    },
    /// The system gives no random number for the page's token.
    #[error("cannot make a token for the page: {0}")]
    Random(#[source] getrandom::Error),
    /// A material breaks rules that all must keep.
    #[error("{material} does not keep the contract of a material:\n{violations}")]
    Contract {
        /// Name of the material.
        material: String,
        /// The rules that it breaks.
        violations: Violations,
    },
    /// A file of measured points cannot be read.
    #[error("{} cannot be read: {source}; give a file, or `treloar`", path.display())]
    UnreadableData {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A file is not a table of measured points.
    #[error("{}:{}: {}", path.display(), source.line, source.fault)]
    Data {
        /// The file.
        path: PathBuf,
        /// Reason.
        source: DataError,
    },
    /// The bench refuses the material, the stretches or the chart.
    #[error(transparent)]
    Bench(Box<dyn std::error::Error + Send + Sync>),
    /// Ranking of all rubbers without data.
    #[error("`piola curve all` compares energies with measured points: add --data FILE, or --data treloar")]
    RankedWithoutData,
    /// Ranking of all rubbers with an option for one material.
    #[error("`piola curve all` cannot use {0}: it fits all parameters to all points, at constant volume")]
    RankedWith(
        /// The option, such as `--param`.
        &'static str,
    ),
    /// Ranking of all rubbers with a test that changes the volume.
    #[error("{files}: `piola curve all` fits solids that keep their volume; leave the volumetric test out")]
    RankedByVolume {
        /// The files.
        files: String,
    },
    /// Wrong number of values of an option: it needs one for all files of measured points, or one for each.
    #[error(
        "{given} values of {option} and {files} of --data: give one for all files, or one for each in their order"
    )]
    Unpaired {
        /// The option.
        option: &'static str,
        /// Number of times that it is given.
        given: usize,
        /// Number of files.
        files: usize,
    },
    /// A file has no points of the requested tests.
    #[error("{}: has points of {} alone, and none of the tests of --mode", path.display(), known.join(", "))]
    NoSuchTest {
        /// The file.
        path: PathBuf,
        /// The tests that it has.
        known: Vec<&'static str>,
    },
    /// An option of measured points is given without them.
    #[error(
        "{0} applies to measured points: add --data FILE, or leave it out; units of parameters are written after them"
    )]
    WithoutData(
        /// The option.
        &'static str,
    ),
    /// Parameters cannot be fitted to the data.
    #[error(
        "{material} cannot be fitted: {source}{}",
        match source {
            FitError::Start(_) => " (--param gives others)",
            FitError::TooFewPoints { .. } => " (--hold)",
            _ => "",
        }
    )]
    Fit {
        /// Name of the material.
        material: String,
        /// Reason.
        source: FitError,
    },
}

impl From<ViewerError> for Error {
    fn from(error: ViewerError) -> Self {
        match error {
            ViewerError::Scene(error) => Self::Scene(error),
            error => Self::Viewer(error),
        }
    }
}

impl Error {
    /// An error of the bench.
    pub(crate) fn bench(source: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Bench(Box::new(source))
    }

    /// True if its message is laid out in lines, as a compiler's is.
    pub(crate) fn has_lines(&self) -> bool {
        matches!(self, Self::Scene(SceneError::Declaration(_)) | Self::Contract { .. })
    }

    /// The exit status of a command that ends with it: 2 if the input is to blame and nothing has begun, 1 if
    /// something failed on the way.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Thread(_)
            | Self::Random(_)
            | Self::Signals(_)
            | Self::StandardOutput(_)
            | Self::Contract { .. }
            | Self::Scene(
                SceneError::Threads(_)
                | SceneError::Write { .. }
                | SceneError::Interrupted
                | SceneError::Equilibrium(_)
                | SceneError::Step { .. },
            ) => 1,
            _ => 2,
        }
    }

    /// A hint at what to change on the command line, to be put behind the message.
    pub(crate) fn remedy(&self) -> String {
        let Self::Scene(error) = self else { return String::new() };
        match error {
            SceneError::Unknown { kind: "body", .. } => ", or a file with --mesh".into(),
            SceneError::Unknown { kind: "material", .. } => ". `piola materials` describes them".into(),
            SceneError::MissingParameters { missing, .. } => {
                let options: Vec<_> = missing.iter().map(|name| format!("--param {name}=…")).collect();
                format!("; add {}", options.join(" "))
            }
            SceneError::Inadmissible {
                source: MaterialError::NoExtension { .. } | MaterialError::DoesNotRestore { .. },
                ..
            } => " (`--inversion refuse`)".into(),
            SceneError::OutOfRange { quantity, .. } => match *quantity {
                "the time step" => " (--dt)",
                "the density" => " (--density)",
                "the gravity" => " (--gravity)",
                "the number of frames" => " (--frames)",
                "the amplitude" => " (--amplitude)",
                "the number of threads" => " (--threads)",
                "the number of pins" => " (--pin)",
                "the stretch where the extension begins" => " (--inversion)",
                "Young's modulus of the material" => " (--param)",
                "the diagonal of the body" => " (--unit)",
                _ => "",
            }
            .into(),
            SceneError::Read(ReadError::OtherElements { .. }) => {
                ", or leave the others out with --only-tetrahedra".into()
            }
            SceneError::OtherBody { .. } => {
                "; give the mesh that it was saved with by --mesh (and --surface), or none for a body of the \
                 program"
                    .into()
            }
            SceneError::Pin { .. } => "; choose a place with --pin".into(),
            SceneError::Folder { source, .. } if source.kind() == io::ErrorKind::AlreadyExists => {
                "; name a new one with --out, or continue the run in it with --resume".into()
            }
            SceneError::Folder { .. } => "; name another one with --out".into(),
            SceneError::NothingToResume { .. } => {
                "; leave out --resume, or name another one with --out".into()
            }
            SceneError::Resume { .. } => {
                "; give the options that it was begun with, or leave out --resume to begin anew".into()
            }
            SceneError::StartOutsideDomain { refusal: None, .. } => {
                "; leave out --inversion refuse, or choose a scene that starts elsewhere".into()
            }
            SceneError::StartOutsideDomain { others, .. } => {
                format!(
                    "; choose a scene that starts elsewhere, such as `stretch`, or another --material: {}",
                    others.join(", ")
                )
            }
            SceneError::Step { .. } => "; nothing was written".into(),
            _ => String::new(),
        }
    }
}
