//! `piola curve all`: every rubber of the catalogue compared with measured curves.

use piola::Inversion;
use piola_laboratory::curve::Mode;
use piola_laboratory::fit::FitSettings;
use piola_laboratory::ranking::{Contender, rank};
use piola_materials::DECLARATIONS;
use piola_scenes::error::Error as SceneError;
use piola_scenes::material::MaterialSpec;

use super::data::Data;
use crate::error::Error;

/// The word given instead of a material.
pub(super) const ALL: &str = "all";

pub(super) const HELP: &str = "\
The ranking of `piola curve all --data FILE`:
  energy     those of `piola materials` whose typical parameters are of rubber, from which each fit begins,
             at constant volume and such that R² is greatest
  n          number of fitted parameters, without those that have no effect at constant volume
  R²         1 − Σ (P − P̂)²/Σ (P − P̄)² of all points together, rest among them as in a spreadsheet, P̄ being
             the mean of the measured stresses P; then that of the points of each test, with the mean of these
  R²/n       R² of all points divided by n, to compare energies with similar R²
  stability  Baker–Ericksen (BE), Hill and strong ellipticity (SE), for all changes of shape at constant
             volume from rest to the ends of the data: kept, or lost at the test and stretch nearest to rest";

/// Fits every rubber and ranks them in a table.
pub(super) fn run(data: &Data) -> Result<String, Error> {
    let (files, (data, notes)) = (data.names(), data.read()?);
    if data.points.is_empty() {
        return Err(Error::usage(
            "`piola curve all` compares energies with measured points: add --data FILE, or --data treloar",
        ));
    }
    if data.modes().any(|mode| mode == Mode::Volumetric) {
        return Err(Error::usage(format!(
            "{files}: `piola curve all` fits solids that keep their volume; leave the volumetric test out"
        )));
    }
    let contender = |name: &str| -> Result<Contender, SceneError> {
        let spec = MaterialSpec::typical(name)?.with_inversion(Inversion::Refuse);
        Ok(Contender { name: name.into(), candidate: spec.candidate()? })
    };
    let rubbers = DECLARATIONS.iter().filter(|declaration| declaration.is_rubber);
    let contenders = rubbers.map(|rubber| contender(rubber.name)).collect::<Result<Vec<_>, _>>()?;
    let settings = FitSettings { floor: 1.0, ..FitSettings::default() };
    let ranking = rank(&contenders, &data, &settings);
    Ok(format!("rubbers, incompressible, fitted to {files}\n{notes}\n{ranking}"))
}
