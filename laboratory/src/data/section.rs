//! Rows with the same columns, and the points that they are.

use piola::__private::message::quoted;

use super::fault::{DataError, Fault};
use super::heading::{Heading, Quantity, Unit};
use super::measured::Measured;
use super::options::ReadOptions;
use super::table::number;
use super::test::Test;
use crate::curve::Mode;

/// A row with numbers.
pub(super) struct Row<'a> {
    pub(super) line: u64,
    pub(super) fields: Vec<&'a str>,
}

/// Rows with the same columns.
pub(super) struct Section<'a> {
    /// The line of the header.
    pub(super) line: u64,
    /// The test of all rows, if one is named above them.
    pub(super) test: Option<Test>,
    pub(super) mode: Option<Column>,
    pub(super) control: Column,
    pub(super) stress: Column,
    /// Headers of columns that are not used.
    pub(super) unused: Vec<String>,
    /// Lines above the header that are not comments.
    pub(super) preamble: usize,
    pub(super) rows: Vec<Row<'a>>,
}

/// A column of numbers.
pub(super) struct Column {
    pub(super) place: usize,
    pub(super) heading: Heading,
}

impl Column {
    /// The factor of the numbers, with the sign of compression.
    fn factor(&self, options: &ReadOptions) -> Result<f64, Fault> {
        let size = match (self.heading.unit, self.heading.quantity.is_stress()) {
            (Some(Unit::Share(size)), false) => size,
            (_, false) => 1.0,
            (Some(Unit::Stress(unit)), _) => unit.pascals(),
            _ => {
                let no_unit = || Fault::NoUnit { found: self.heading.text.clone() };
                options.unit.ok_or_else(no_unit)?.pascals()
            }
        };
        Ok(if self.heading.is_compressive { -size } else { size })
    }

    /// The column with its quantity and unit, in sentences.
    pub(super) fn name(&self, options: &ReadOptions) -> String {
        let Heading { text, quantity, unit, is_compressive, .. } = &self.heading;
        let unit = match (unit, options.unit) {
            (Some(Unit::Stress(unit)), _) => format!(" in {unit}"),
            (Some(Unit::Share(0.01)), _) => " in %".into(),
            (None, Some(unit)) if quantity.is_stress() => format!(" in {unit}"),
            _ => String::new(),
        };
        let sign = if *is_compressive { ", compression positive" } else { "" };
        format!("`{}` as {}{unit}{sign}", quoted(text), quantity.name())
    }
}

impl<'a> Section<'a> {
    /// The fields that must be numbers, with their lines.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (u64, &'a str)> + Clone {
        let places = [self.control.place, self.stress.place];
        self.rows.iter().flat_map(move |row| places.map(|place| (row.line, row.fields[place])))
    }

    /// Leaves out a column that is called one of tests and names none, such as numbers of specimens.
    pub(super) fn leave_out_specimens(&mut self) {
        let names_none =
            |column: &Column| self.rows.iter().all(|row| row.fields[column.place].parse::<Test>().is_err());
        if self.mode.as_ref().is_some_and(names_none) {
            self.unused.extend(self.mode.take().map(|column| column.heading.text));
        }
    }

    /// True if test and unit are known.
    pub(super) fn is_complete(&self, options: &ReadOptions) -> Result<(), Fault> {
        let has_test = self.mode.is_some() || self.test.or(options.test).is_some();
        if has_test { self.stress.factor(options).map(|_| ()) } else { Err(Fault::NoMode) }
    }

    pub(super) fn point(
        &self,
        row: &Row<'_>,
        decimal: char,
        options: &ReadOptions,
    ) -> Result<(Test, Measured), DataError> {
        let at = |fault| DataError { line: row.line, fault };
        let test = match &self.mode {
            Some(column) => row.fields[column.place].parse().map_err(|error| at(Fault::Mode(error)))?,
            None => self.test.or(options.test).ok_or_else(|| at(Fault::NoMode))?,
        };
        let value = |column: &Column| {
            let (found, heading) = (row.fields[column.place], &column.heading);
            let is_percent = found.ends_with('%');
            let number = number(found, decimal).filter(|_| !(is_percent && heading.quantity.is_stress()));
            let number =
                number.ok_or_else(|| Fault::Number { column: heading.text.clone(), found: found.into() })?;
            let factor = column.factor(options)?;
            // A cell with its own unit, `10 %`.
            Ok::<_, Fault>(number * if is_percent { 0.01_f64.copysign(factor) } else { factor })
        };
        let (control, stress) = (value(&self.control).map_err(at)?, value(&self.stress).map_err(at)?);
        let not_of_test =
            |column: &Column| at(Fault::NotOfTest { column: column.heading.text.clone(), mode: test.mode });
        let control = control_of(self.control.heading.quantity, test.mode, control)
            .ok_or_else(|| not_of_test(&self.control))?;
        let measured = Measured { mode: test.mode, control, stress };
        if let Some(fault) = measured.fault() {
            return Err(at(fault.with_remedy(
                match (self.control.heading.quantity, self.control.heading.unit) {
                    (Quantity::Stretch, _) => {
                        "; if it is a strain, write `strain`, or `strain [%]`, above the numbers"
                    }
                    (_, None) => "; if the strain is in percent, write `strain [%]` above the numbers",
                    _ => "",
                },
            )));
        }
        let stress = stress_of(self.stress.heading.quantity, test.mode, control, stress)
            .ok_or_else(|| not_of_test(&self.stress))?;
        let measured = Measured { stress, ..measured };
        measured.fault().map_or(Ok((test, measured)), |fault| Err(at(fault)))
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
