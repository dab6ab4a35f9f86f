//! Reader of measured points from the text of a file, with questions about numbers that are unlikely to be
//! what their header names, and a note on how the file was understood.

use piola::__private::message::{self, names, quoted};

use super::heading::{Heading, Quantity, Unit};
use super::measured::{Measured, Measurements};
use super::options::{DataError, NO_TEST, ReadOptions};
use super::table::{Row, Table, number};
use crate::curve::Mode;
use crate::rest::{digits, pascals};

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
        let is_keyword = |line: &str| line.starts_with('*') && !line.starts_with("**");
        let is_block = |line: &str| is_keyword(line) && line.to_lowercase().contains("test data");
        if let Some(line) = text.lines().position(is_block) {
            let mistake = "this is an input deck, which names no units; write the rows of one test of one material, temperature \
                           and direction to a file, below a header such as `stress [MPa],strain`";
            return Err(DataError::at(line as u64 + 1, mistake));
        }
        let table = Table::of(text, options)?;
        let at_header = |mistake: String| DataError::at(table.line, mistake);
        let Table { control, stress, .. } = &table;
        if table.mode.is_none() && options.test.is_none() {
            return Err(at_header(NO_TEST.into()));
        }
        if stress.unit.is_none() {
            return Err(at_header(format!(
                "`{}` names no unit of stress; write it there, as in `stress [MPa]`, or give it (`--unit MPa`, \
                 `ReadOptions::unit`)",
                quoted(&stress.text)
            )));
        }
        let decimal = decimal(&table)?;
        let mut points = Vec::new();
        for row in &table.rows {
            let point = table.point(row, decimal, options.test);
            points.push((row.line, point.map_err(|mistake| DataError::at(row.line, mistake))?));
        }
        check(&points, control)?;
        let measurements = Measurements { points: points.into_iter().map(|(_, point)| point).collect() };
        if measurements.points.iter().all(Measured::is_rest) {
            let remedy = "write lines such as `uniaxial,1.5,0.37`";
            return Err(at_header(format!("below this header there is no point but rest; {remedy}")));
        }
        let note = note(&table, decimal, &measurements);
        Ok(Reading { measurements, note })
    }
}

/// The mark of decimals: a comma if a number has one and another mark separates columns.
fn decimal(table: &Table<'_>) -> Result<char, DataError> {
    let places = [table.control.place, table.stress.place];
    let numbers = table.rows.iter().flat_map(|row| places.map(|place| (row.line, row.fields[place])));
    let mut with_comma = numbers.filter(|(_, field)| table.separator != ',' && field.contains(','));
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

/// True if the comma of a number may be one of thousands, as in `1,234`.
fn may_be_thousands(field: &str) -> bool {
    let Some((whole, part)) = field.trim_start_matches(['+', '-', '−']).split_once(',') else {
        return false;
    };
    let are_digits = whole.bytes().chain(part.bytes()).all(|byte| byte.is_ascii_digit());
    are_digits && matches!(whole.len(), 1..=3) && part.len() == 3 && !whole.starts_with('0')
}

impl Table<'_> {
    fn point(&self, row: &Row<'_>, decimal: char, given: Option<Mode>) -> Result<Measured, String> {
        let mode = match self.mode {
            Some(place) => row.fields[place].parse::<Mode>()?,
            None => given.ok_or(NO_TEST)?,
        };
        let value = |column: &Heading| {
            let found = row.fields[column.place];
            let marks = match decimal {
                ',' => ": decimals of this file have a comma, and thousands no mark",
                _ => "",
            };
            let mistake = || {
                let (text, header) = (quoted(found), quoted(&column.text));
                format!("`{text}` under `{header}` is not a number{marks}")
            };
            Ok::<_, String>(column.factor() * number(found, decimal).ok_or_else(mistake)?)
        };
        let of_test = |column: &Heading, value: f64, control: f64| {
            converted(column.quantity, mode, value, control)
                .ok_or_else(|| format!("`{}` is not a quantity of the test {mode}", quoted(&column.text)))
        };
        let (control, stress) = (value(&self.control)?, value(&self.stress)?);
        let control = of_test(&self.control, control, f64::NAN)?;
        // The control first: a stress may be divided by it.
        Measured { mode, control, stress: 0.0 }.check()?;
        let stress = of_test(&self.stress, stress, control)?;
        let point = Measured { mode, control, stress };
        point.check().map(|()| point)
    }
}

/// The control, or at a control the stress, of a test from a quantity that a column holds.
///
/// In the first three tests the area that a true stress acts on is 1/λ of that at rest where the volume is
/// kept: λ^(−½) λ^(−½), λ λ^(−2), 1 · λ^(−1). In simple shear the plates keep their area, and the stress of a
/// volumetric test is a true one already.
fn converted(quantity: Quantity, mode: Mode, value: f64, control: f64) -> Option<f64> {
    match (quantity, mode) {
        (Quantity::TrueStress, Mode::Uniaxial | Mode::Equibiaxial | Mode::PureShear) => Some(value / control),
        (Quantity::Pressure, Mode::Volumetric) => Some(-value),
        (Quantity::Stretch | Quantity::Stress | Quantity::TrueStress, _)
        | (Quantity::Strain | Quantity::Shear, Mode::SimpleShear)
        | (Quantity::Volume, Mode::Volumetric) => Some(value),
        (Quantity::Strain, _) | (Quantity::VolumeStrain, Mode::Volumetric) => Some(1.0 + value),
        (Quantity::TrueStrain, mode) if mode != Mode::SimpleShear => Some(value.exp()),
        _ => None,
    }
}

/// Stretches that are unlikely for rubber: numbers that are all beyond the first, or some beyond the second,
/// are strains in percent unless their header has a unit.
const FAR: (f64, f64) = (8.0, 20.0);
/// Strains that are noise or slack: this value, or a tenth of the greatest if that is less.
const SMALL: f64 = 0.02;

/// Refuses points of a table, with the line of each, that are unlikely to be what their header names: strains
/// under `stretch`, percent without a word, signs of compression.
fn check(points: &[(u64, Measured)], column: &Heading) -> Result<(), DataError> {
    for mode in Mode::ALL {
        let points = || points.iter().filter(move |(_, point)| point.mode == mode);
        let strain = |point: &Measured| point.control - mode.rest();
        let range = points().map(|(_, point)| strain(point).abs()).fold(0.0, f64::max);
        let peak = points().map(|(_, point)| point.stress.abs()).fold(0.0, f64::max);
        let is_pulled = points().all(|(_, point)| point.stress > -0.01 * peak);
        let mut strained = points().filter(|(_, point)| strain(point).abs() > SMALL);
        let controls = || strained.clone().map(|(_, point)| point.control);
        let (least, most) = (controls().fold(f64::INFINITY, f64::min), controls().fold(0.0, f64::max));
        if column.unit.is_none()
            && mode != Mode::Volumetric
            && (least > FAR.0 || most > FAR.1)
            && let Some((line, _)) = strained.next()
        {
            let (letter, least, most) = (mode.letter(), message::number(least), message::number(most));
            let unit = if column.quantity == Quantity::Stretch { "stretch [-]" } else { "strain [-]" };
            let mistake = format!(
                "`{}` of {mode} makes {letter} from {least} to {most}: are the numbers percent? Then write `strain [%]`; if \
                 they are as large as that, `{unit}`",
                quoted(&column.text)
            );
            return Err(DataError::at(*line, mistake));
        }
        for &(line, point) in points() {
            let Measured { control, stress, .. } = point;
            let strain = strain(&point);
            // Unloaded rubber has some stress of the other sign. Where no stress is one of compression,
            // a little tells strains under `stretch`.
            let noise = if strain < 0.0 && is_pulled { 0.01 } else { 0.1 };
            if strain.abs() <= SMALL.min(0.1 * range) || stress.abs() <= noise * peak {
                continue;
            }
            let question = if column.is_compressive && strain > 0.0 {
                ", but the test is a compression"
            } else if (strain > 0.0) != (stress > 0.0) {
                ", of another sign than its strain; is the number a strain, or a compression?"
            } else {
                continue;
            };
            let (letter, control, stress) =
                (mode.letter(), message::number(control), message::number(stress));
            let mistake = format!(
                "{mode} {letter} = {control} has a stress of {stress} Pa{question}: a strain is written under `strain` or \
                 `strain [%]`, a compression with negative strain and stress or under `compressive strain` and \
                 `compressive stress`"
            );
            return Err(DataError::at(line, mistake));
        }
    }
    Ok(())
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
    let Table { control, stress, .. } = table;
    let mut parts = vec![format!("{}, {}", described(control), described(stress))];
    let of_mode = |mode: Mode| {
        let controls = || data.of(mode).map(|point| point.control);
        let stresses = || data.of(mode).map(|point| point.stress);
        let [least, most] = [controls().reduce(f64::min)?, controls().reduce(f64::max)?].map(digits);
        let [low, high] = [stresses().reduce(f64::min)?, stresses().reduce(f64::max)?].map(pascals);
        let (count, letter, turns) = (data.of(mode).count(), mode.letter(), data.reversals(mode).len());
        let points = if count == 1 { "point" } else { "points" };
        Some(format!(
            "{count} {points} of {mode}, {letter} from {least} to {most}, stress from {low} to {high}, reversals: {turns}"
        ))
    };
    parts.extend(Mode::ALL.into_iter().filter_map(of_mode));
    let left_out = |lines: usize, of: &str| (lines > 0).then(|| format!("lines left out {of}: {lines}"));
    let is_true = stress.quantity == Quantity::TrueStress;
    let others = [
        is_true.then(|| "nominal stress from true stress as of an incompressible solid".into()),
        (decimal == ',').then(|| "decimal commas".into()),
        (!table.unused.is_empty()).then(|| format!("left out: {}", names(&table.unused))),
        left_out(table.preamble, "above the header"),
        left_out(table.repeated, "as headers that return"),
    ];
    parts.extend(others.into_iter().flatten());
    parts.join("; ")
}
