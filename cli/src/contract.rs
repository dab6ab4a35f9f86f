//! `piola contract`: the rules that every material must keep, on an energy without a crate.

use clap::Args;
use piola::Inversion;
use piola::contract::{Notation, Settings, check_without_lanes};
use piola_declare::Energy;
use piola_laboratory::curve::Volume;

use crate::bench::{Material, at_rest};
use crate::error::Error;

/// Prints how near each rule came to its tolerance, or what is broken, and where.
#[derive(Debug, Args)]
pub(crate) struct Contract {
    #[command(flatten)]
    material: Material,

    /// Check the energy that is continued by polynomials below this stretch, too.
    #[arg(long, value_name = "STRETCH", allow_negative_numbers = true)]
    extend: Option<f64>,
}

impl Contract {
    pub(crate) fn run(self) -> Result<String, Error> {
        let spec = self.material.spec(Volume::Free)?;
        let inversions = self.extend.map(|epsilon| Inversion::Extend { epsilon });
        let notation = spec.energy.as_ref().map_or_else(Notation::default, Energy::notation);
        let settings = Settings { notation, ..Settings::default() };
        let mut text = String::new();
        let rest = at_rest(spec.clone().with_inversion(Inversion::Refuse).build()?.moduli, Volume::Free);
        for inversion in std::iter::once(Inversion::Refuse).chain(inversions) {
            let spec = spec.clone().with_inversion(inversion);
            let material = spec.build()?.name;
            // The lanes of the interpreter are the same for every energy; its tests check them.
            let report = check_without_lanes(&spec.interpreted()?, &settings)
                .map_err(|violations| Error::Contract { material: material.to_string(), violations })?;
            text += &match inversion {
                Inversion::Refuse => format!("{material} keeps the contract\n{rest}"),
                Inversion::Extend { epsilon } => format!("continued below {epsilon}, it does as well\n"),
            };
            for finding in &report.findings {
                text += &format!("  {finding}\n");
            }
        }
        Ok(text)
    }
}
