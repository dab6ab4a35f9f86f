//! Options for measured points: files, and the columns, tests and units that they do not name.

use std::path::{Path, PathBuf};

use clap::Args;
use piola_laboratory::curve::Mode;
use piola_laboratory::data::{Measurements, NO_TEST, ReadOptions, StressUnit, TRELOAR_1944};

use crate::error::Error;

/// Contents of files, below the help of each command that reads measurements.
pub(super) const HELP: &str = "\
Files of measured points:
  separators  tabs, semicolons, commas or spaces; decimals with a point, or with a comma if columns are not
              separated by commas
  columns     `stretch`, `strain` (nominal), `true strain`, `shear strain`, `volume ratio`, `volume strain`;
              `stress` (nominal), `true stress`, `pressure`; `mode`. Others are chosen by --strain and --stress.
              True stress σ becomes nominal stress P = σ/λ, as for an incompressible solid
  units       after the name or in a row below, as in `strain [%]`, `stress (MPa)`: Pa, kPa, MPa, GPa, psi,
              ksi, bar, atm, kgf/cm2, kgf/mm2, dyn/cm2, N/mm2
  tests       uniaxial (UT, tension), equibiaxial (ET, EB, BT, biaxial), pure_shear (PS, planar),
              simple_shear (SS), volumetric (hydrostatic), in a column `mode` or by --mode
  curves      one of each test; --cycle chooses one of the cycles or specimens in a file, and several
              materials, temperatures and directions are files of their own
The output names what was read and what was left out of each file.";

/// Measured points, with columns, tests and units that their files do not name.
#[derive(Debug, Args)]
pub(crate) struct Data {
    /// Measured points: a file, or `treloar`; may be repeated, as for a file of each test.
    #[arg(long = "data", value_name = "FILE|treloar")]
    pub(super) files: Vec<PathBuf>,

    /// Tests, separated by commas or repeated: uniaxial, equibiaxial, pure_shear, simple_shear, volumetric.
    /// From files that name their tests only these are used. For others it is the test: one for all files, or
    /// one for each --data in their order [default: those of the data, or else the first three].
    #[arg(long = "mode", value_name = "MODE,MODE", value_delimiter = ',')]
    pub(super) tests: Vec<Mode>,

    /// Unit of stresses whose header names none, such as MPa: one for all files, or one for each --data.
    #[arg(long = "unit", value_name = "UNIT")]
    units: Vec<StressUnit>,

    /// Column of the strain, by name or number, and what it holds if its header does not say it, as in
    /// `Dehnung`, `1=stretch`, `Dehnung=strain [%]`: one for all files, or one for each --data.
    #[arg(long = "strain", value_name = "COLUMN")]
    strains: Vec<String>,

    /// Column of the stress, as in `Spannung`, `2`, `2=true stress [MPa]`.
    #[arg(long = "stress", value_name = "COLUMN")]
    stresses: Vec<String>,

    /// Cycle, or specimen, of a file with several whose loading is used: one for all files, or one for each.
    #[arg(long = "cycle", value_name = "first|N", value_parser = cycle)]
    cycles: Vec<usize>,
}

fn cycle(text: &str) -> Result<usize, String> {
    let number = if text == "first" { Some(1) } else { text.parse().ok() };
    number.ok_or_else(|| "it must be `first`, or the number of a cycle, counted from 1".to_owned())
}

impl Data {
    /// The files in sentences.
    pub(super) fn names(&self) -> String {
        self.files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join(", ")
    }

    /// The points of all files, and a line for each file on how it was understood.
    pub(super) fn read(&self) -> Result<(Measurements, String), Error> {
        let files = self.files.len();
        for (option, given) in [
            ("--unit", self.units.len()),
            ("--strain", self.strains.len()),
            ("--stress", self.stresses.len()),
            ("--cycle", self.cycles.len()),
        ] {
            if files == 0 && given > 0 {
                return Err(Error::usage(format!(
                    "{option} applies to measured points: add --data FILE, or leave it out; units of parameters are written \
                     after them"
                )));
            }
            if given > 1 && given != files {
                return Err(unpaired(option, given, files));
            }
        }
        let (mut all, mut notes) = (Measurements::default(), String::new());
        for (index, file) in self.files.iter().enumerate() {
            let (measured, note) = self.file(index, file)?;
            all.points.extend(measured.points);
            notes += &format!("  read     {}: {note}\n", file.display());
        }
        // Those of a chosen cycle are as they are: it may begin with a strain that has remained.
        if self.cycles.is_empty() {
            let refused = |mistake| Error::usage(format!("{}: {mistake}", self.names()));
            all.check_curves().map_err(refused)?;
        }
        Ok((all, notes))
    }

    /// The points of a file, and how it was understood.
    fn file(&self, index: usize, file: &Path) -> Result<(Measurements, String), Error> {
        let path = file.display();
        let unreadable =
            |error| Error::usage(format!("{path} cannot be read: {error}; give a file, or `treloar`"));
        let bytes = match is_treloar(file) {
            true => TRELOAR_1944.into(),
            false => std::fs::read(file).map_err(unreadable)?,
        };
        let column = |choices: &[String]| self.of_file(choices, index).filter(|_| !is_treloar(file));
        let options = ReadOptions {
            test: self.of_file(&self.tests, index),
            unit: self.of_file(&self.units, index),
            strain: column(&self.strains),
            stress: column(&self.stresses),
        };
        let (files, given) = (self.files.len(), self.tests.len());
        // Older machines write Latin-1, also in units: N/mm², µm/m.
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| error.into_bytes().into_iter().map(char::from).collect());
        let reading = Measurements::read_with(&text, &options).map_err(|error| match error.mistake {
            mistake if mistake == NO_TEST && given > 0 => unpaired("--mode", given, files),
            mistake => Error::usage(format!("{path}:{}: {mistake}", error.line)),
        })?;
        let (mut points, mut note) = (reading.measurements.clone(), reading.note);
        if !self.tests.is_empty() {
            points.points.retain(|point| self.tests.contains(&point.mode));
            if points.modes().next().is_none() {
                let known: Vec<_> = reading.measurements.modes().map(|mode| mode.name()).collect();
                let known = known.join(", ");
                return Err(Error::usage(format!(
                    "{path}: has points of {known} alone, and none of the tests of --mode"
                )));
            }
        }
        if let Some(cycle) = self.of_file(&self.cycles, index) {
            points = points.cycle(cycle).map_err(|mistake| Error::usage(format!("{path}: {mistake}")))?;
        }
        let (all, used) = (reading.measurements.points.len(), points.points.len());
        if used < all {
            note += &format!("; {used} of {all} points used, by --mode or --cycle");
        }
        Ok((points, note))
    }

    /// The value of an option for a file: the only one, or that of its place.
    fn of_file<T: Clone>(&self, values: &[T], index: usize) -> Option<T> {
        match values {
            [one] => Some(one.clone()),
            values if values.len() == self.files.len() => Some(values[index].clone()),
            _ => None,
        }
    }
}

/// The error of an option that is given neither once for all files nor once for each.
fn unpaired(option: &str, given: usize, files: usize) -> Error {
    Error::usage(format!(
        "{given} values of {option} and {files} of --data: give one for all files, or one for each in their order"
    ))
}

/// True if the measured points are those that the program includes.
fn is_treloar(file: &Path) -> bool {
    file.as_os_str().eq_ignore_ascii_case("treloar")
}
