//! Reader of measured points from the text of a file, with a note on how the file was understood.

use std::fmt;

use piola::__private::message::names;

use super::fault::{DataError, Fault};
use super::heading::Quantity;
use super::layout;
use super::measured::{Measured, Measurements};
use super::options::ReadOptions;
use super::plausible;
use super::section::Section;
use super::table::{Separator, decimal};
use crate::curve::Mode;

/// Measurements, and how a file was understood.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reading {
    /// The points.
    pub measurements: Measurements,
    /// Note on the columns that were used, with their meaning, and those that were left out.
    note: String,
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.note)
    }
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

    /// Reads the text of a file, with a test and a unit if it names none.
    ///
    /// # Errors
    /// [`DataError`] of the first malformed line, if the columns or their numbers are ambiguous, or if no
    /// data point differs from the rest state.
    pub fn read_with(text: &str, options: &ReadOptions) -> Result<Reading, DataError> {
        let text = text.trim_start_matches('\u{feff}');
        if text.starts_with("PK\u{3}\u{4}") {
            return Err(DataError { line: 1, fault: Fault::Archive });
        }
        let (separator, mut sections) = layout::sections(text)?;
        if options.test.is_some() {
            sections.iter_mut().for_each(Section::leave_out_specimens);
        }
        let cells = sections.iter().flat_map(Section::numbers);
        let unclear =
            |(line, found): (u64, &str)| DataError { line, fault: Fault::Decimals { found: found.into() } };
        let decimal = decimal(cells.clone()).map_err(unclear)?;
        if let Some(found) = thousands(separator, decimal, cells) {
            return Err(unclear(found));
        }

        let (mut points, mut rows) = (Vec::new(), Vec::new());
        for section in &sections {
            section.is_complete(options).map_err(|fault| DataError { line: section.line, fault })?;
            let first = points.len();
            for row in &section.rows {
                let (test, point) = section.point(row, decimal, options)?;
                points.push(point);
                rows.push((row.line, test));
            }
            plausible::check(&points[first..], &rows[first..], &section.control.heading)?;
        }
        if points.iter().all(Measured::is_rest) {
            let line = sections.last().map_or(1, |section| section.line);
            return Err(DataError { line, fault: Fault::NoPoints });
        }
        let measurements = Measurements { points };
        let note = note(&sections, separator, decimal, options, &measurements);
        Ok(Reading { measurements, note })
    }
}

/// A number that may have commas for thousands: quoted ones in a file that is separated by commas, if none of
/// them has another number of digits behind the comma than three.
fn thousands<'a>(
    separator: Separator,
    decimal: char,
    cells: impl Iterator<Item = (u64, &'a str)>,
) -> Option<(u64, &'a str)> {
    if (separator, decimal) != (Separator::Comma, ',') {
        return None;
    }
    let mut cells = cells.filter(|(_, cell)| cell.contains(','));
    let is_whole = |cell: &str| {
        let (before, after) = cell.trim_start_matches(['-', '+']).split_once(',').unwrap_or(("", ""));
        !before.starts_with('0') && after.len() == 3
    };
    let first = cells.next().filter(|(_, cell)| is_whole(cell))?;
    cells.all(|(_, cell)| is_whole(cell)).then_some(first)
}

/// Describes how the file was understood.
fn note(
    sections: &[Section<'_>],
    separator: Separator,
    decimal: char,
    options: &ReadOptions,
    data: &Measurements,
) -> String {
    let mut columns: Vec<String> = Vec::new();
    for column in sections.iter().flat_map(|section| [&section.control, &section.stress]) {
        let name = column.name(options);
        if !columns.contains(&name) {
            columns.push(name);
        }
    }
    let mut parts = vec![columns.join(", ")];
    let is_true = |section: &Section<'_>| section.stress.heading.quantity == Quantity::TrueStress;
    if sections.iter().any(is_true) {
        parts.push("nominal stress from true stress as of an incompressible solid".into());
    }
    let counts = Mode::ALL.map(|mode| match data.of(mode).count() {
        0 => None,
        1 => Some(format!("1 point of {mode}")),
        count => Some(format!("{count} points of {mode}")),
    });
    parts.push(counts.into_iter().flatten().collect::<Vec<_>>().join(", "));
    if separator != Separator::Comma || decimal != '.' {
        let decimals = if decimal == ',' { " and decimal commas" } else { "" };
        parts.push(format!("separated by {}{decimals}", separator.name()));
    }
    let unused: Vec<_> = sections.iter().flat_map(|section| &section.unused).collect();
    if !unused.is_empty() {
        parts.push(format!("left out: {}", names(unused)));
    }
    match sections.first().map_or(0, |section| section.preamble) {
        0 => {}
        1 => parts.push("a line above the header left out".into()),
        lines => parts.push(format!("{lines} lines above the header left out")),
    }
    parts.join("; ")
}
