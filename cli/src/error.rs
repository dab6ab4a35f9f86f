//! Errors that end the command.

use std::fmt::Display;
use std::io;

use piola::contract::Violations;
use piola::material::MaterialError;
use piola_bodies::mesh::ReadError;
use piola_scenes::error::Error as SceneError;

/// Error that ends the command without success.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    /// A scene cannot start or continue.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The system refuses a thread, a signal handler, a random number or output.
    #[error("cannot {action}: {source}")]
    System {
        /// The action, such as "start a thread".
        action: &'static str,
        /// Error of the system.
        source: io::Error,
    },
    /// A material breaks rules that all must keep.
    #[error("{material} does not keep the contract of a material:\n{violations}")]
    Contract {
        /// Name of the material.
        material: String,
        /// The rules that it breaks.
        violations: Violations,
    },
}

impl Error {
    /// An error of options, or of the laboratory about what they choose.
    pub(crate) fn usage(reason: impl Display) -> Self {
        SceneError::Usage(reason.to_string()).into()
    }

    /// An error of the system in some action.
    pub(crate) fn system(action: &'static str) -> impl Fn(io::Error) -> Self {
        move |source| Self::System { action, source }
    }

    /// True if its message is laid out in lines, as a compiler's is.
    pub(crate) fn has_lines(&self) -> bool {
        matches!(self, Self::Scene(SceneError::Declaration(_)) | Self::Contract { .. })
    }

    /// The exit status of a command that ends with it: 2 if the input is to blame and nothing has begun, 1 if
    /// something failed on the way.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::System { .. }
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
                "the density" => " (--density, or density= of --part)",
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
            SceneError::Step { .. } => "; nothing was written".into(),
            _ => String::new(),
        }
    }
}
