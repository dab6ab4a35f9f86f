//! `piola check`: where a material is stable.

use std::path::PathBuf;

use clap::Args;
use piola::Inversion;
use piola_laboratory::AtRest;
use piola_laboratory::chart;
use piola_laboratory::curve::Volume;
use piola_laboratory::stability::{SurveySettings, survey};
use piola_scenes::options::inversion;
use piola_scenes::output::write_whole;

use super::{Material, as_options};
use crate::error::Error;

/// Over a box of stretches, and in uniaxial, equibiaxial, pure shear, confined and hydrostatic tests from
/// rest.
#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    material: Material,

    /// Behaviour beyond the domain of a material: `refuse` leaves stretches out, a number is the stretch
    /// below which the energy is extended by polynomials.
    #[arg(long, value_name = "refuse|STRETCH", value_parser = inversion, default_value = "refuse")]
    #[arg(allow_negative_numbers = true)]
    inversion: Inversion,

    /// Least stretch of the box and of the tests.
    #[arg(long, value_name = "A", default_value_t = 0.3, allow_negative_numbers = true)]
    from: f64,

    /// Greatest stretch of the box and of the tests.
    #[arg(long, value_name = "B", default_value_t = 3.0, allow_negative_numbers = true)]
    to: f64,

    /// Stretches along each axis of the box.
    #[arg(long, value_name = "N", default_value_t = 41)]
    resolution: usize,

    /// Draw a map over the stretches in a sheet and in plane strain.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Check {
    pub(crate) fn run(self) -> Result<String, Error> {
        let material = self.material.spec(Volume::Free)?.with_inversion(self.inversion);
        let stretches = SurveySettings { from: self.from, to: self.to, resolution: self.resolution };
        let description = material.description()?;
        let title = format!("{} {}", description.name, as_options(&material)?.replace("--param ", ""));
        let specimen = material.interpreted()?;
        let report = survey(&specimen, &stretches).map_err(Error::usage)?;
        if let Some(path) = self.svg {
            write_whole(&path, chart::map(&specimen, &stretches, &title).map_err(Error::usage)?.as_bytes())?;
        }
        let warning = AtRest { moduli: report.moduli, volume: Volume::Free }.warning();
        let warning = warning.map(|warning| format!("warning: {warning}\n")).unwrap_or_default();
        Ok(format!("{title}\n  ψ = {}\n{warning}\n{report}", description.formula))
    }
}
