//! `piola emit`: an energy as source text of another language.

use std::path::PathBuf;

use clap::Args;
use piola::Inversion;
use piola_declare::emit::{Emission, PointFunction, Precision, Target};
use piola_laboratory::curve::Volume;
use piola_scenes::output::write_whole;

use crate::bench::{Material, as_options};
use crate::error::Error;

/// One file without a dependency: a structure of the parameters, a check of them, and the functions of a
/// point. The comment at its top describes contents and compilation.
#[derive(Debug, Args)]
pub(crate) struct Emit {
    #[command(flatten)]
    material: Material,

    /// The language: c (C99 and C++17 alike), cuda (HIP and Warp, too), opencl, wgsl.
    #[arg(long)]
    target: Target,

    /// The number format: f64 or f32 [default: f64, for wgsl f32].
    #[arg(long)]
    precision: Option<Precision>,

    /// First part of all names; no other file of the program may add `_projected` to it
    /// [default: the name of the energy].
    #[arg(long, value_name = "PREFIX")]
    name: Option<String>,

    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',', help = format!(
        "The functions, separated by commas: {} [default: all]",
        PointFunction::ALL.map(PointFunction::name).join(", ")
    ))]
    functions: Vec<PointFunction>,

    /// Continue the energy by polynomials below this stretch.
    #[arg(long, value_name = "STRETCH", allow_negative_numbers = true)]
    extend: Option<f64>,

    /// Write to a file [default: print].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Emit {
    /// The text, or a line about the file that was written and its parameters.
    pub(crate) fn run(self) -> Result<String, Error> {
        let inversion = self.extend.map_or(Inversion::Refuse, |epsilon| Inversion::Extend { epsilon });
        let mut emission = Emission::new(self.target);
        emission.precision = self.precision.unwrap_or(emission.precision);
        emission.prefix = self.name;
        if !self.functions.is_empty() {
            emission.functions = self.functions;
        }
        let spec = self.material.spec(Volume::Free)?.with_inversion(inversion);
        let text = spec.emit(&emission)?;
        let Some(file) = self.output else { return Ok(text) };
        write_whole(&file, text.as_bytes())?;
        Ok(format!("wrote {}, whose example is {}\n", file.display(), as_options(&spec)?))
    }
}
