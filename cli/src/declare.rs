//! `piola declare`: a formula as a declaration in Rust, and its derivatives as formulas.

use clap::Args;
use piola_declare::{Energy, FormulaOptions};
use piola_scenes::error::Error as SceneError;

use crate::error::Error;

/// The declaration can be pasted into a crate that depends on `piola`, or written to a file and given to
/// `--material`.
#[derive(Debug, Args)]
pub(crate) struct Declare {
    /// The energy, such as `mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2`; conditions may follow, as in `…
    /// where J > 0`.
    #[arg(allow_hyphen_values = true)]
    formula: String,

    /// Subtract s ln J from it, s being its stress at rest, so that the rest state is free of stress.
    #[arg(long)]
    free_rest: bool,

    /// Add kappa/2 (J - 1)^2 to it, which resists changes of volume.
    #[arg(long)]
    kappa: bool,
}

impl Declare {
    /// The declaration and what follows from it.
    pub(crate) fn run(self) -> Result<String, Error> {
        let options = FormulaOptions {
            free_rest: self.free_rest,
            bulk: self.kappa.then(|| "kappa".into()),
            value: Some("--param NAME=VALUE"),
            free_rest_option: Some("--free-rest"),
            ..FormulaOptions::default()
        };
        let energy = Energy::from_formula_with(&self.formula, &options).map_err(SceneError::Declaration)?;
        // The documentation is a comment, so that all of the output is Rust.
        let lines = energy.documentation().trim().lines();
        let comment: Vec<_> = lines.map(|line| format!("// {line}").trim_end().to_owned()).collect();
        Ok(format!("{}\n{}", energy.source(), comment.join("\n")))
    }
}
