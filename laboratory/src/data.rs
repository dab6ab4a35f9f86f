//! Measured test curves, and how well an energy agrees with them.
//!
//! A file of them is a table with a header, separated by commas; lines that begin with `#` are comments:
//!
//! ```text
//! mode,stretch,nominal_stress_MPa
//! uniaxial,1.125,0.134351
//! ```
//!
//! The modes are those of [`Mode`]; under `stretch` stands the control, which is γ for `simple_shear` and J
//! for `volumetric`. The stress is in the unit that its header ends with, `_Pa`, `_kPa` or `_MPa`, and what
//! [`crate::curve`](mod@crate::curve) says of each mode. The columns may come in any order.

use std::fmt;

use csv::{Position, ReaderBuilder, StringRecord, Trim};

use crate::curve::{Mode, Response, ResponseError, Volume, respond};
use crate::specimen::Specimen;

/// Vulcanised rubber with 8 % sulphur in uniaxial tension, equibiaxial tension and pure shear, as a file.
///
/// Treloar, *Stress-strain data for vulcanised rubber under various types of deformation*, Trans. Faraday
/// Soc. 40, 1944; digitised, as its comments say.
pub const TRELOAR_1944: &str = include_str!("../data/treloar1944.csv");

/// A reading of a testing machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The test.
    pub mode: Mode,
    /// The control that the machine had set: λ, γ or J.
    pub control: f64,
    /// The stress, Pa.
    pub stress: f64,
}

impl Measured {
    /// Whether this is the rest state, from which nothing can be learnt.
    #[must_use]
    pub fn is_rest(&self) -> bool {
        self.control == self.mode.rest()
    }
}

/// Readings of one material in one or several tests.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurements {
    /// In the order of the file.
    pub points: Vec<Measured>,
}

impl Measurements {
    /// Reads the text of a file.
    ///
    /// ```
    /// use piola_laboratory::curve::Mode;
    /// use piola_laboratory::data::{Measurements, TRELOAR_1944};
    ///
    /// # fn main() -> Result<(), piola_laboratory::data::DataError> {
    /// let rubber = Measurements::read(TRELOAR_1944)?;
    /// assert_eq!(rubber.of(Mode::PureShear).count(), 14);
    ///
    /// let error = Measurements::read("mode,stretch,nominal_stress_kPa\nuniaxial,two,5\n").unwrap_err();
    /// assert_eq!(error.to_string(), "line 2: `two` under `stretch` is not a number");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`DataError`] of the first malformed line, or if no data point differs from the rest state.
    pub fn read(text: &str) -> Result<Self, DataError> {
        let mut reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(Trim::All)
            .has_headers(false)
            .from_reader(text.as_bytes());
        let line = |position: Option<&Position>| line_of(text, position);
        let mut records = reader.records().map(|record| match record {
            Ok(record) => Ok((line(record.position()), record)),
            Err(error) => Err(unreadable(&error, line(error.position()))),
        });
        let (line, header) = records.next().unwrap_or(Err(DataError { line: 1, fault: Fault::NoHeader }))?;
        let columns = Columns::of(line, &header)?;
        let points = records.map(|record| record.and_then(|(line, record)| columns.point(line, &record)));
        let points: Vec<_> = points.collect::<Result<_, _>>()?;
        match points.iter().all(Measured::is_rest) {
            true => Err(DataError { line, fault: Fault::NoPoints }),
            false => Ok(Self { points }),
        }
    }

    /// The modes in which there are points other than rest, in the order of [`Mode::ALL`].
    pub fn modes(&self) -> impl Iterator<Item = Mode> {
        let is_used = |mode: &Mode| self.of(*mode).any(|point| !point.is_rest());
        Mode::ALL.into_iter().filter(is_used)
    }

    /// The points of a mode.
    pub fn of(&self, mode: Mode) -> impl Iterator<Item = &Measured> {
        self.points.iter().filter(move |point| point.mode == mode)
    }

    /// The response of the specimen at each point.
    pub fn responses(&self, specimen: &dyn Specimen, volume: Volume) -> Vec<Result<Response, ResponseError>> {
        self.points.iter().map(|point| respond(specimen, point.mode, volume, point.control)).collect()
    }

    /// How well the specimen agrees with the points, those of rest left out: the coefficient of determination
    ///
    /// ```text
    /// R² = 1 − Σ (P − P̂)² / Σ (P − P̄)²
    /// ```
    ///
    /// of the stresses P with mean P̄, P̂ being those of the specimen. 1 is agreement; below 0 the mean would
    /// be a better guess. A single point, whose mean is itself, has none and gives −∞ or NaN.
    ///
    /// # Errors
    /// [`PointError`] of the first point where the specimen has no stress.
    pub fn agreement(&self, specimen: &dyn Specimen, volume: Volume) -> Result<Agreement, PointError> {
        let responses = self.responses(specimen, volume);
        let mut pairs = Vec::with_capacity(self.points.len());
        for (&point, response) in self.points.iter().zip(responses) {
            let response = response.map_err(|reason| PointError { point, reason })?;
            if !point.is_rest() {
                pairs.push((point, response.stress));
            }
        }
        let of = |mode| {
            let pairs: Vec<_> = pairs.iter().filter(|(point, _)| point.mode == mode).copied().collect();
            determination(&pairs)
        };
        Ok(Agreement {
            modes: self.modes().map(|mode| (mode, of(mode))).collect(),
            total: determination(&pairs),
        })
    }
}

/// R² by mode and of all points together.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// R² of each mode by itself.
    pub modes: Vec<(Mode, f64)>,
    /// R² of the points of all modes.
    pub total: f64,
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (mode, determination) in &self.modes {
            write!(f, "{mode} {determination:.5}, ")?;
        }
        write!(f, "all {:.5}", self.total)
    }
}

/// A measured point at which a specimen has no stress.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{} at {} = {}: {reason}", point.mode, point.mode.letter(), point.control)]
pub struct PointError {
    /// The point.
    pub point: Measured,
    /// Why the specimen has no stress there.
    #[source]
    pub reason: ResponseError,
}

fn determination(pairs: &[(Measured, f64)]) -> f64 {
    let mean = pairs.iter().map(|(point, _)| point.stress).sum::<f64>() / pairs.len() as f64;
    let unexplained: f64 = pairs.iter().map(|(point, stress)| (point.stress - stress).powi(2)).sum();
    let all: f64 = pairs.iter().map(|(point, _)| (point.stress - mean).powi(2)).sum();
    1.0 - unexplained / all
}

/// The places of the columns, and the factor that brings the stresses to Pa.
struct Columns {
    mode: usize,
    control: usize,
    stress: usize,
    unit: f64,
}

impl Columns {
    fn of(line: u64, header: &StringRecord) -> Result<Self, DataError> {
        let at = |fault| DataError { line, fault };
        let find = |name: &'static str, is_it: &dyn Fn(&str) -> bool| {
            let mut found = (0..header.len()).filter(|&column| is_it(&header[column]));
            match (found.next(), found.next()) {
                (Some(column), None) => Ok(column),
                (None, _) => {
                    Err(at(Fault::NoColumn { name, found: header.iter().collect::<Vec<_>>().join(",") }))
                }
                _ => Err(at(Fault::ColumnTwice { name })),
            }
        };
        let mode = find("mode", &|name| name == "mode")?;
        let control = find("stretch", &|name| name == "stretch")?;
        let stress = find("nominal_stress_MPa", &|name| name.starts_with("nominal_stress"))?;
        let unit = match &header[stress]["nominal_stress".len()..] {
            "_Pa" => 1.0,
            "_kPa" => 1e3,
            "_MPa" => 1e6,
            _ => return Err(at(Fault::Unit { found: header[stress].into() })),
        };
        Ok(Self { mode, control, stress, unit })
    }

    fn point(&self, line: u64, record: &StringRecord) -> Result<Measured, DataError> {
        let at = |fault| DataError { line, fault };
        let number = |column: usize, name: &'static str| {
            let text = &record[column];
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            number.ok_or_else(|| at(Fault::Number { column: name, found: text.into() }))
        };
        let mode: Mode = record[self.mode].parse().map_err(|unknown| at(Fault::Mode(unknown)))?;
        let control = number(self.control, "stretch")?;
        let stress = self.unit * number(self.stress, "nominal_stress")?;
        match mode.allows(control) {
            true => Ok(Measured { mode, control, stress }),
            false => Err(at(Fault::Control(ResponseError::Control { mode, control }))),
        }
    }
}

/// A mistake in a file of measurements.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {fault}")]
pub struct DataError {
    /// The line, counted from 1.
    pub line: u64,
    /// The mistake.
    #[source]
    pub fault: Fault,
}

/// A mistake in a line of a file of measurements.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The file is empty.
    #[error("there is no table; {HEADER}, then lines such as `uniaxial,1.5,0.37`")]
    NoHeader,
    /// A column is missing.
    #[error("the header `{found}` has no column `{name}`; {HEADER}")]
    NoColumn {
        /// Its name.
        name: &'static str,
        /// The header as given.
        found: String,
    },
    /// A column is there more than once.
    #[error("the header has two columns for `{name}`; keep one")]
    ColumnTwice {
        /// Its name.
        name: &'static str,
    },
    /// The header of the stress names no known unit.
    #[error("`{found}` names no known unit; {HEADER}")]
    Unit {
        /// The header as given.
        found: String,
    },
    /// There is no such test.
    #[error(transparent)]
    Mode(
        /// The name as given.
        crate::curve::ModeError,
    ),
    /// Something else stands where a finite number is needed.
    #[error("`{found}` under `{column}` is not a number")]
    Number {
        /// The header of its column.
        column: &'static str,
        /// The text there.
        found: String,
    },
    /// No specimen can be brought to that stretch, shear or volume.
    #[error(transparent)]
    Control(
        /// The reason.
        ResponseError,
    ),
    /// There is no point apart from the rest state.
    #[error("below this header there is no point but rest; write lines such as `uniaxial,1.5,0.37`")]
    NoPoints,
    /// The line is not one of such a table.
    #[error("{reason}")]
    Malformed {
        /// The message of the reader.
        reason: String,
    },
}

const HEADER: &str = "write `mode,stretch,nominal_stress_MPa` (or `_kPa`, `_Pa`) above the points";

/// The line of a record; its position is before the comments and empty lines above it.
fn line_of(text: &str, position: Option<&Position>) -> u64 {
    let (byte, line) = position.map_or((0, 1), |position| (position.byte(), position.line()));
    let rest = text.get(byte as usize..).unwrap_or_default();
    let is_passed_over = |line: &&str| line.is_empty() || line.starts_with('#');
    line + rest.lines().take_while(is_passed_over).count() as u64
}

fn unreadable(error: &csv::Error, line: u64) -> DataError {
    let reason = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} fields where the header has {expected_len}; write as many")
        }
        _ => error.to_string(),
    };
    DataError { line, fault: Fault::Malformed { reason } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, line: u64, words: &[&str]) {
        let error = Measurements::read(text).expect_err("nonsense");
        assert_eq!(error.line, line, "{error}");
        for word in words {
            assert!(error.to_string().contains(word), "`{word}` is not in: {error}");
        }
    }

    const HEADER: &str = "mode,stretch,nominal_stress_kPa\n";

    #[test]
    fn mistakes_are_named_with_their_line() {
        check("", 1, &["mode,stretch,nominal_stress_MPa"]);
        check("# nothing\n", 1, &["no table"]);
        check("# by hand\nmode,strain,nominal_stress_Pa\n", 2, &["`stretch`", "strain"]);
        check("mode,stretch,nominal_stress_psi\n", 1, &["psi", "_kPa"]);
        check("mode,stretch,stretch,nominal_stress_Pa\n", 1, &["two", "`stretch`"]);
        check(HEADER, 1, &["uniaxial,1.5,0.37"]);
        check(&format!("{HEADER}uniaxial,1,0\n"), 1, &["no point but rest"]);
        check(&format!("{HEADER}# twist\ntorsion,1,0\n"), 3, &["`torsion`", "`pure_shear`"]);
        check(&format!("{HEADER}uniaxial,1,0\n\nuniaxial,2\n"), 4, &["2 fields", "3"]);
        check(&format!("{HEADER}uniaxial,1.1,1e999\n"), 2, &["1e999", "`nominal_stress`"]);
        check(&format!("{HEADER}uniaxial,-1.1,1\n"), 2, &["-1.1", "positive"]);
    }

    #[test]
    fn columns_may_come_in_any_order_with_more_beside_them() -> Result<(), DataError> {
        let text =
            "nominal_stress_kPa, sample, mode, stretch\n-3, A, Simple Shear, -0.5\n2, B, planar, 1.5\n";
        let read = Measurements::read(text)?;
        let first = Measured { mode: Mode::SimpleShear, control: -0.5, stress: -3e3 };
        assert_eq!(read.points[0], first);
        assert_eq!(read.modes().collect::<Vec<_>>(), [Mode::PureShear, Mode::SimpleShear]);
        Ok(())
    }
}
