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
//!
//! Stretches and volumes are from 10⁻⁶ to 10⁶, shears up to 10⁶, stresses 0 or from 10⁻¹⁰⁰ to 10¹⁰⁰ Pa in
//! size: far beyond what is measured, and well inside of what can be squared and divided.

use std::fmt;

use csv::{Position, ReaderBuilder, StringRecord, Trim};
use piola::__private::message::{number, quoted};

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

    /// The mistake in a reading out of the range that the [module](self) states.
    pub(crate) fn fault(&self) -> Option<Fault> {
        let Self { mode, control, stress } = *self;
        let (size, least) = match mode {
            Mode::SimpleShear => (control.abs(), 0.0),
            _ => (control, CONTROLS.0),
        };
        if !mode.allows(control) {
            Some(Fault::Control(ResponseError::Control { mode, control }))
        } else if !(least..=CONTROLS.1).contains(&size) {
            Some(Fault::ControlRange { mode, control })
        } else if stress != 0.0 && !(STRESSES.0..=STRESSES.1).contains(&stress.abs()) {
            Some(Fault::StressRange { stress })
        } else {
            None
        }
    }
}

/// Sizes of controls and of stresses, Pa, that measurements may have.
const CONTROLS: (f64, f64) = (1e-6, 1e6);
const STRESSES: (f64, f64) = (1e-100, 1e100);

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
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
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
    /// be a better guess. Stresses that are all equal, such as a single one, have none.
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
    /// R² of each mode by itself; `None` where its stresses do not vary.
    pub modes: Vec<(Mode, Option<f64>)>,
    /// R² of the points of all modes; `None` where their stresses do not vary.
    pub total: Option<f64>,
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |determination: &Option<f64>| match determination {
            Some(determination) => short(*determination),
            None => "undefined (equal stresses)".to_owned(),
        };
        for (mode, determination) in &self.modes {
            write!(f, "{mode} {}, ", shown(determination))?;
        }
        write!(f, "all {}", shown(&self.total))
    }
}

/// R² with five digits behind the point, and one that is far below 0 with an exponent.
pub(crate) fn short(determination: f64) -> String {
    if determination > -1e6 { format!("{determination:.5}") } else { format!("{determination:.1e}") }
}

/// A measured point at which a specimen has no stress.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{} at {} = {}: {reason}", point.mode, point.mode.letter(), number(point.control))]
pub struct PointError {
    /// The point.
    pub point: Measured,
    /// Why the specimen has no stress there.
    #[source]
    pub reason: ResponseError,
}

fn determination(pairs: &[(Measured, f64)]) -> Option<f64> {
    let (first, _) = pairs.first()?;
    if pairs.iter().all(|(point, _)| point.stress == first.stress) {
        return None;
    }
    let mean = pairs.iter().map(|(point, _)| point.stress).sum::<f64>() / pairs.len() as f64;
    let unexplained: f64 = pairs.iter().map(|(point, stress)| (point.stress - stress).powi(2)).sum();
    let all: f64 = pairs.iter().map(|(point, _)| (point.stress - mean).powi(2)).sum();
    Some(1.0 - unexplained / all).filter(|determination| determination.is_finite())
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
        let measured = Measured { mode, control, stress };
        measured.fault().map_or(Ok(measured), |fault| Err(at(fault)))
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
    #[error("the header `{}` has no column `{name}`; {HEADER}", quoted(found))]
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
    #[error("`{}` names no known unit; {HEADER}", quoted(found))]
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
    #[error("`{}` under `{column}` is not a number", quoted(found))]
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
    /// A stretch, a shear or a volume is beyond all bounds.
    #[error(
        "{} is {}; it must be at most {:e}{}", mode.quantity(), number(*control), CONTROLS.1,
        if *mode == Mode::SimpleShear { "" } else { " and at least 1e-6" }
    )]
    ControlRange {
        /// The test.
        mode: Mode,
        /// The control as given.
        control: f64,
    },
    /// A stress is beyond all bounds.
    #[error(
        "the stress is {} Pa; it must be at most {:e} Pa, and at least {:e} Pa if it is not 0: does the header name the right unit?",
        number(*stress), STRESSES.1, STRESSES.0
    )]
    StressRange {
        /// The stress, Pa.
        stress: f64,
    },
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
    fn numbers_beyond_all_bounds_are_named_with_their_line() {
        // 1e303 MPa is infinite in Pa, 1e-320 MPa a subnormal number.
        let megapascals = "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.5\n";
        check(&format!("{megapascals}uniaxial,3,1e303\n"), 3, &["stress is inf Pa", "at most 1e100 Pa"]);
        check(&format!("{megapascals}uniaxial,3,-1e200\n"), 3, &["stress is -1e206 Pa", "right unit"]);
        check(&format!("{megapascals}uniaxial,3,1e-320\n"), 3, &["at least 1e-100 Pa"]);
        for (mode, control) in [("uniaxial", "1e-7"), ("volumetric", "1e7"), ("simple_shear", "-1e300")] {
            check(
                &format!("{megapascals}{mode},{control},1\n"),
                3,
                &[&format!("is {control};"), "at most 1e6"],
            );
        }
        let edge = format!("{megapascals}uniaxial,1e6,1e94\nsimple_shear,-1e6,0\nequibiaxial,1e-6,-1e-105\n");
        assert_eq!(Measurements::read(&edge).map(|read| read.points.len()), Ok(4));
    }

    /// The mark is no part of the first header, nor of a comment before it.
    #[test]
    fn a_byte_order_mark_is_skipped() {
        let text = format!("# by hand\n{HEADER}uniaxial,2,1\n");
        assert_eq!(Measurements::read(&format!("\u{feff}{text}")), Measurements::read(&text));
        check(&format!("\u{feff}{text}uniaxial,x,1\n"), 4, &["`x`"]);
    }

    #[test]
    fn messages_quote_nothing_that_a_terminal_obeys() {
        let hostile = format!("\u{1b}[2J\u{202e}{}", "x".repeat(1_000_000));
        for text in [
            format!("{hostile}\n"),
            format!("mode,stretch,nominal_stress{hostile}\n"),
            format!("{HEADER}{hostile},1,2\n"),
            format!("{HEADER}uniaxial,{hostile},2\n"),
            format!("{HEADER}uniaxial,2,{hostile}\n"),
            format!("{HEADER}\"{hostile}\n"),
        ] {
            let error = Measurements::read(&text).expect_err("nonsense").to_string();
            assert!(error.chars().all(|c| !c.is_control() && c != '\u{202e}'), "{error:?}");
            assert!(error.len() < 300, "{error}");
        }
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
