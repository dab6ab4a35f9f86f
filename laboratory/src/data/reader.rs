//! Reader of measured points from the text of a file, with a note on how the file was understood.

use piola::__private::message::{names, quoted};

use super::columns::{Row, Table, Used};
use super::fault::{DataError, Fault};
use super::heading::{Heading, Quantity, Unit};
use super::measured::{Measured, Measurements};
use super::options::{ReadOptions, Test};
use super::plausible;
use super::table::{may_be_thousands, number};
use crate::curve::Mode;
use crate::rest::digits;

/// Measurements, and how a file was understood.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reading {
    /// The points.
    pub measurements: Measurements,
    /// Note on the columns that were used, with their meaning, and those that were left out.
    pub note: String,
}

impl Measurements {
    /// Reads the text of a file that names its tests and units.
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
        Self::read_with(text, &ReadOptions::default()).map(|reading| reading.measurements)
    }

    /// Reads the text of a file, with columns, a test and a unit if it names none.
    ///
    /// # Errors
    /// [`DataError`] of the first malformed line, if the columns or their numbers are ambiguous, or if no
    /// data point differs from the rest state.
    pub fn read_with(text: &str, options: &ReadOptions) -> Result<Reading, DataError> {
        let text = text.trim_start_matches('\u{feff}');
        if text.contains('\0') {
            let mistake = "this is UTF-16, or not text but an archive, as spreadsheets are; save the sheet as CSV in UTF-8";
            return Err(DataError::at(1, mistake));
        }
        let table = Table::of(text, options)?;
        let at_header = |mistake: String| DataError::at(table.line, mistake);
        if table.used.mode.is_none() && options.test.is_none() {
            return Err(DataError { line: table.line, fault: Fault::NoMode });
        }
        let factor = |column| factor(column).map_err(at_header);
        let factors = [factor(&table.used.control)?, factor(&table.used.stress)?];
        let decimal = table.decimal()?;
        let (mut points, mut rows) = (Vec::new(), Vec::new());
        for row in &table.rows {
            let point = table.used.point(row, decimal, factors, options);
            let (test, point) = point.map_err(|fault| DataError { line: row.line, fault })?;
            points.push(point);
            rows.push((row.line, test));
        }
        plausible::check(&points, &rows, &table.used.control)?;
        if points.iter().all(Measured::is_rest) {
            let remedy = "write lines such as `uniaxial,1.5,0.37`";
            return Err(at_header(format!("below this header there is no point but rest; {remedy}")));
        }
        let measurements = Measurements { points };
        let note = note(&table, decimal, &measurements);
        Ok(Reading { measurements, note })
    }
}

impl Table<'_> {
    /// The mark of decimals: a comma if a number has one and another mark separates columns.
    fn decimal(&self) -> Result<char, DataError> {
        let places = [self.used.control.place, self.used.stress.place];
        let numbers = self.rows.iter().flat_map(|row| places.map(|place| (row.line, row.fields[place])));
        let mut with_comma = numbers.filter(|(_, field)| self.separator != ',' && field.contains(','));
        let Some((line, found)) = with_comma.next() else { return Ok('.') };
        if !may_be_thousands(found) || !with_comma.all(|(_, field)| may_be_thousands(field)) {
            return Ok(',');
        }
        let mistake = format!(
            "`{}` may be {} or {}, like every number with a comma here; write decimals with a point, and thousands \
             without a mark",
            quoted(found),
            quoted(&found.replace(',', "")),
            quoted(&found.replace(',', "."))
        );
        Err(DataError::at(line, mistake))
    }
}

/// The size of a unit of a column, with the sign of compression.
fn factor(column: &Heading) -> Result<f64, String> {
    let size = match column.unit {
        Some(Unit::Share(size)) => size,
        Some(Unit::Stress(unit)) => unit.pascals(),
        None if column.quantity.is_stress() => {
            return Err(format!(
                "`{}` names no unit of stress; write it there, as in `stress [MPa]`, or give it (`--unit MPa`, \
                 `ReadOptions::unit`)",
                quoted(&column.text)
            ));
        }
        None => 1.0,
    };
    Ok(if column.is_compressive { -size } else { size })
}

impl Used {
    fn point(
        &self,
        row: &Row<'_>,
        decimal: char,
        factors: [f64; 2],
        options: &ReadOptions,
    ) -> Result<(Test, Measured), Fault> {
        let test = match self.mode {
            Some(place) => row.fields[place].parse::<Test>().map_err(Fault::Other)?,
            None => options.test.ok_or(Fault::NoMode)?,
        };
        let value = |column: &Heading, factor: f64| {
            let found = row.fields[column.place];
            let marks = match decimal {
                ',' => ": decimals of this file have a comma, and thousands no mark",
                _ => "",
            };
            let mistake = || {
                let (text, header) = (quoted(found), quoted(&column.text));
                Fault::Other(format!("`{text}` under `{header}` is not a number{marks}"))
            };
            Ok::<_, Fault>(factor * number(found, decimal).ok_or_else(mistake)?)
        };
        let not_of_test = |column: &Heading| {
            let (header, mode) = (quoted(&column.text), test.mode);
            Fault::Other(format!("`{header}` is not a quantity of the test {mode}"))
        };
        let (control, stress) = (value(&self.control, factors[0])?, value(&self.stress, factors[1])?);
        let control = control_of(self.control.quantity, test.mode, control);
        let control = control.ok_or_else(|| not_of_test(&self.control))?;
        // The control first: a stress may be divided by it.
        if let Some(fault) = (Measured { mode: test.mode, control, stress: 0.0 }).fault() {
            return Err(Fault::Other(fault));
        }
        let stress = stress_of(self.stress.quantity, test.mode, control, stress);
        let stress = stress.ok_or_else(|| not_of_test(&self.stress))?;
        let measured = Measured { mode: test.mode, control, stress };
        measured.fault().map_or(Ok((test, measured)), |fault| Err(Fault::Other(fault)))
    }
}

/// The control of a test from a quantity that a column holds.
fn control_of(quantity: Quantity, mode: Mode, value: f64) -> Option<f64> {
    match (quantity, mode) {
        (Quantity::Stretch, _)
        | (Quantity::Strain | Quantity::Shear, Mode::SimpleShear)
        | (Quantity::Volume, Mode::Volumetric) => Some(value),
        (Quantity::TrueStrain, Mode::SimpleShear) => None,
        (Quantity::Strain, _) | (Quantity::VolumeStrain, Mode::Volumetric) => Some(1.0 + value),
        (Quantity::TrueStrain, _) => Some(value.exp()),
        _ => None,
    }
}

/// The stress of a test from a quantity that a column holds.
///
/// In the first three tests the area that a true stress acts on is 1/λ of that at rest where the volume is
/// kept: λ^(−½) λ^(−½), λ λ^(−2), 1 · λ^(−1). In simple shear the plates keep their area, and the stress of a
/// volumetric test is a true one already.
fn stress_of(quantity: Quantity, mode: Mode, control: f64, value: f64) -> Option<f64> {
    match (quantity, mode) {
        (Quantity::TrueStress, Mode::Uniaxial | Mode::Equibiaxial | Mode::PureShear) => Some(value / control),
        (Quantity::Stress | Quantity::TrueStress, _) => Some(value),
        (Quantity::Pressure, Mode::Volumetric) => Some(-value),
        _ => None,
    }
}

/// The column with its quantity and unit, in sentences.
fn described(column: &Heading) -> String {
    let unit = match column.unit {
        Some(Unit::Stress(unit)) => format!(" in {unit}"),
        Some(Unit::Share(0.01)) => " in %".into(),
        _ => String::new(),
    };
    let sign = if column.is_compressive { ", compression positive" } else { "" };
    format!("`{}` as {}{unit}{sign}", quoted(&column.text), column.quantity.name())
}

fn note(table: &Table<'_>, decimal: char, data: &Measurements) -> String {
    let Used { control, stress, .. } = &table.used;
    let mut parts = vec![format!("{}, {}", described(control), described(stress))];
    if stress.quantity == Quantity::TrueStress {
        parts.push("nominal stress from true stress as of an incompressible solid".into());
    }
    let of_mode = |mode: Mode| {
        let controls = || data.of(mode).map(|point| point.control);
        let (count, letter) = (controls().count(), mode.letter());
        let [least, most] = [controls().reduce(f64::min)?, controls().reduce(f64::max)?].map(digits);
        let points = if count == 1 { "point" } else { "points" };
        Some(format!("{count} {points} of {mode}, {letter} from {least} to {most}"))
    };
    parts.extend(Mode::ALL.into_iter().filter_map(of_mode));
    if decimal == ',' {
        parts.push("decimal commas".into());
    }
    if !table.unused.is_empty() {
        parts.push(format!("left out: {}", names(&table.unused)));
    }
    match table.preamble {
        0 => {}
        1 => parts.push("a line above the header left out".into()),
        lines => parts.push(format!("{lines} lines above the header left out")),
    }
    parts.join("; ")
}
