//! `piola fit`: parameters of a material from measured curves.

use std::path::PathBuf;

use clap::Args;
use piola::Inversion;
use piola_laboratory::chart;
use piola_laboratory::curve::{Mode, Volume, sweep};
use piola_laboratory::fit::{FitSettings, fit_parameters};

use super::data::{Data, HELP};
use super::{FINE, Material, as_options, at_rest, draw, spaced, titled};
use crate::error::Error;

/// Prints the parameters in a form to be pasted, R² of each test, and why other parameters might do as well.
///
/// Minimises differences relative to the measured stress, so that points without stress, such as rest, do not
/// count, unless --floor or --absolute gives others; R² is that of all points, rest included, as in a
/// spreadsheet.
#[derive(Debug, Args)]
#[command(after_help = HELP, mut_arg("files", |data| data.required(true)))]
pub(crate) struct Fit {
    #[command(flatten)]
    material: Material,

    #[command(flatten)]
    data: Data,

    /// Keep a parameter, all entries of a list, or one as NAME_1; may be repeated.
    #[arg(long = "hold", value_name = "NAME")]
    held: Vec<String>,

    /// Least stress by which a difference is divided, as a share of the greatest one, such as 0.05: it limits
    /// the weight of readings near zero stress, which noise and offsets decide.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    floor: f64,

    /// Minimise absolute differences, so that large stresses decide, and R² of all points is greatest.
    #[arg(long, conflicts_with = "floor")]
    absolute: bool,

    /// Keep the volume constant, regardless of the bulk modulus: the default unless the data have a
    /// volumetric test.
    #[arg(long)]
    incompressible: bool,

    /// Let the sides move as the energy demands.
    #[arg(long, conflicts_with = "incompressible")]
    compressible: bool,

    /// Number of descents from random parameters, in addition to the one from those given. Each call draws
    /// the same.
    #[arg(long, value_name = "N", default_value_t = 20)]
    starts: usize,

    /// Draw the fitted curves with the points.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl Fit {
    pub(crate) fn run(self) -> Result<String, Error> {
        let (data, notes) = self.data.read()?;
        let is_volumetric = data.modes().any(|mode| mode == Mode::Volumetric);
        let volume = match self.compressible || is_volumetric && !self.incompressible {
            true => Volume::Free,
            false => Volume::Kept,
        };
        let spec = self.material.spec(volume)?.with_inversion(Inversion::Refuse);
        let material = spec.build()?.name;
        let candidate = spec.candidate()?;
        let (kind, floor) = if self.absolute { ("absolute", 1.0) } else { ("relative", self.floor) };
        let (held, restarts) = (self.held, self.starts);
        let settings = FitSettings { volume, floor, held, restarts, ..FitSettings::default() };
        let fit = fit_parameters(&candidate, &data, &settings)
            .map_err(|error| Error::usage(format!("{material} cannot be fitted: {error}")))?;
        let fitted = spec.with_fitted(&fit.values)?;
        let options = as_options(&fitted)?;

        let title = titled(&material, volume);
        let mut text =
            format!("{title}, fitted to {} by {kind} differences, floor {floor}\n", self.data.names());
        text += &notes;
        text += &format!("  {options}\n");
        text += &at_rest(fitted.build()?.moduli, volume);
        text += &fit.to_string();
        if let Some(file) = &self.svg {
            let fitted = fitted.interpreted()?;
            let curve = |mode| {
                let [from, to] = data.range(mode);
                let points = sweep(&fitted, mode, volume, &spaced(from, to, FINE));
                chart::Curve { mode, points }
            };
            let curves: Vec<_> = data.modes().map(curve).collect();
            draw(file, &title, &options, &curves, Some((&data, &fit.agreement)))?;
        }
        Ok(text)
    }
}
