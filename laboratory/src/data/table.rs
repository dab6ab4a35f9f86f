//! The table of a file: lines taken apart, and which of its columns are used for what.

use piola::__private::message::{names, quoted};

use super::heading::{Heading, Quantity, Unit, has_clear_unit, unit};
use super::options::{DataError, ReadOptions};

pub(super) struct Row<'a> {
    pub(super) line: u64,
    pub(super) fields: Vec<&'a str>,
}

impl Row<'_> {
    /// True if this is not a header but a row of the table.
    fn is_data(&self) -> bool {
        self.fields.iter().filter(|field| is_number(field)).count() > 1
    }

    /// True if this may be a row of units below a header.
    fn is_units(&self) -> bool {
        self.fields.iter().any(|field| unit(field).is_some())
            && !self.fields.iter().any(|field| is_number(field))
    }
}

/// Rows with the columns that are used.
pub(super) struct Table<'a> {
    /// The line of the header, or of the first row where there is none.
    pub(super) line: u64,
    pub(super) separator: char,
    /// The place of the test, if a column has it.
    pub(super) mode: Option<usize>,
    pub(super) control: Heading,
    pub(super) stress: Heading,
    /// Headers of columns that are not used.
    pub(super) unused: Vec<String>,
    /// Lines above the header that are not comments.
    pub(super) preamble: usize,
    /// Lines of the header that return, as above another specimen.
    pub(super) repeated: usize,
    pub(super) rows: Vec<Row<'a>>,
}

/// The place of the test, the control and the stress.
type Columns = (Option<usize>, Heading, Heading);

impl<'a> Table<'a> {
    /// The table of a file: below the first line whose columns are those of the options, or else in plain
    /// form. If both columns are chosen by their numbers, it begins with the first number in one of them.
    pub(super) fn of(text: &'a str, options: &ReadOptions) -> Result<Self, DataError> {
        let (separator, mut rows) = rows(text)?;
        let (preamble, begin, (mode, control, stress)) = find(&rows, options)?;
        let Row { line, fields } = &rows[preamble];
        let (line, expected, has_header) = (*line, fields.len(), begin > preamble);
        let is_used = |place| [Some(control.place), Some(stress.place), mode].contains(&Some(place));
        let names = fields.iter().enumerate();
        let unused = names.filter(|(place, name)| has_header && !name.is_empty() && !is_used(*place));
        let unused = unused.map(|(_, name)| (*name).to_owned()).collect();
        let head: Vec<_> = rows.drain(..begin).skip(preamble).map(|row| row.fields).collect();
        let below = rows.len();
        rows.retain(|row| !head.contains(&row.fields));
        let repeated = below - rows.len();
        for row in &mut rows {
            // Such as of a separator at the end of each line.
            while row.fields.len() > expected && row.fields.last() == Some(&"") {
                row.fields.pop();
            }
            let found = row.fields.len();
            if found != expected {
                let mistake = format!(
                    "{found} fields where the header has {expected}; write as many, decimals with a point or columns \
                     separated by semicolons or tabs, and another table to another file"
                );
                return Err(DataError::at(row.line, mistake));
            }
        }
        Ok(Self { line, separator, mode, control, stress, unused, preamble, repeated, rows })
    }
}

/// The separator, and all rows with something in them that are not comments. Lines may end as on any system.
fn rows(text: &str) -> Result<(char, Vec<Row<'_>>), DataError> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let is_comment = |text: &str| ["#", "//", "**"].iter().any(|mark| text.starts_with(mark));
    let lines = (1..).zip(text.split(end)).map(|(line, text)| (line, text.trim_matches([' ', '\r'])));
    let lines: Vec<_> = lines.filter(|(_, text)| !text.trim().is_empty() && !is_comment(text)).collect();
    // The first of these that is in the last line.
    let mark = |(_, last): &(u64, &str)| ['\t', ';', ','].into_iter().find(|mark| last.contains(*mark));
    let separator = lines.last().and_then(mark).unwrap_or(' ');
    let rows = lines.into_iter().map(|(line, text)| Row { line, fields: fields(text, separator) });
    let rows: Vec<_> = rows.filter(|row| row.fields.iter().any(|field| !field.is_empty())).collect();
    if rows.is_empty() {
        let remedy = "write `mode,stretch,nominal_stress_MPa`, then lines such as `uniaxial,1.5,0.37`";
        return Err(DataError::at(1, format!("there is no table; {remedy}")));
    }
    Ok((separator, rows))
}

/// The fields of a line, without spaces and quotes around them. Between quotes nothing separates.
fn fields(line: &str, separator: char) -> Vec<&str> {
    let mut is_quoted = false;
    let fields = line.split(|c: char| {
        is_quoted ^= c == '"';
        !is_quoted && c == separator
    });
    let bare = fields.map(|field| field.trim().trim_matches('"').trim());
    // Between columns that spaces separate there may be several.
    bare.filter(|field| separator != ' ' || !field.is_empty()).collect()
}

/// A finite number with a mark of decimals.
pub(super) fn number(field: &str, decimal: char) -> Option<f64> {
    if !field.chars().all(|c| matches!(c, '0'..='9' | '+' | '-' | '−' | 'e' | 'E') || c == decimal) {
        return None;
    }
    let digits = field.replace(decimal, ".").replace('−', "-");
    digits.parse().ok().filter(|number: &f64| number.is_finite())
}

/// True if a field is a number, with a point or a comma.
fn is_number(field: &str) -> bool {
    number(field, '.').or_else(|| number(field, ',')).is_some()
}

/// The index of the header, or of the first row if there is none, that of the first row, and the columns.
fn find(rows: &[Row<'_>], options: &ReadOptions) -> Result<(usize, usize, Columns), DataError> {
    let number = |choice: &Option<String>| chosen(choice.as_deref()?).0.parse::<usize>().ok();
    if let Some((strain, stress)) = number(&options.strain).zip(number(&options.stress)) {
        let field = |row: &Row<'_>, number: usize| {
            row.fields.get(number.wrapping_sub(1)).is_some_and(|field| is_number(field))
        };
        let first = rows.iter().position(|row| field(row, strain) || field(row, stress));
        let first = first.unwrap_or(rows.len() - 1);
        let nameless = vec![""; rows[first].fields.len()];
        let used = columns(&nameless, None, options).map_err(|problem| refused(&rows[first], problem))?;
        return Ok((first, first, used));
    }
    for (index, row) in rows.iter().enumerate().filter(|(_, row)| !row.is_data()) {
        let units = rows.get(index + 1).filter(|row| row.is_units());
        let Ok(used) = columns(&row.fields, units, options) else { continue };
        let is_row = |above: &Row<'_>| above.is_data() && above.fields.len() == row.fields.len();
        if rows[..index].iter().any(is_row) {
            break;
        }
        return Ok((index, index + 1 + usize::from(units.is_some()), used));
    }
    // The line above the numbers, or what else may be a header.
    let first = rows.iter().position(Row::is_data).unwrap_or(rows.len());
    let names = rows[..first].iter().rfind(|row| !row.is_units()).unwrap_or(&rows[0]);
    let problem = columns(&names.fields, None, options).err().filter(|_| !names.is_data());
    Err(refused(names, problem.unwrap_or_else(|| "there is no header above the numbers".into())))
}

/// The mistake of a header, or of the first row where there is none, with the columns by their numbers.
fn refused(row: &Row<'_>, problem: String) -> DataError {
    let columns = names((1..).zip(&row.fields).map(|(number, name)| format!("{number} `{name}`")));
    let mistake = format!(
        "{problem}; the columns are {columns}. Write a header such as `stretch,nominal_stress_MPa`, or give the columns by \
         name or number and what they hold: `--strain \"1=strain [%]\" --stress \"2=stress [MPa]\"` \
         (`ReadOptions::strain`). Divide forces by the cross-section and elongations by the length at rest. \
         Of tests with two stretches (general biaxial tests) only those that are one of the modes can be used"
    );
    DataError::at(row.line, mistake)
}

/// The columns with these names and, where a name has no unit, those of the row below, or the reason why
/// there are none.
fn columns(names: &[&str], units: Option<&Row<'_>>, options: &ReadOptions) -> Result<Columns, String> {
    let below = |place: usize| unit(units?.fields.get(place)?);
    let headings = names.iter().enumerate().map(|(place, name)| Heading::of(place, name, below(place)));
    let headings: Vec<_> = headings.collect();
    let mode = headings.iter().position(|heading| heading.quantity == Quantity::Mode);
    let control = column(&headings, options.strain.as_deref(), false)?;
    let mut stress = column(&headings, options.stress.as_deref(), true)?;
    stress.unit = stress.unit.or(options.unit.map(Unit::Stress));
    let header = stress.text.to_lowercase();
    if control.quantity == Quantity::TrueStrain
        && stress.quantity == Quantity::Stress
        && options.stress.is_none()
        && !["nominal", "engineering"].iter().any(|kind| header.contains(kind))
    {
        return Err(format!(
            "`{}` next to a true strain may be a `true stress` or a `nominal stress`",
            quoted(&stress.text)
        ));
    }
    Ok((mode, control, stress))
}

/// The column of a choice, or the only one whose header is a stress, or else a strain, in plain form.
fn column(headings: &[Heading], choice: Option<&str>, is_stress: bool) -> Result<Heading, String> {
    let kind = if is_stress { "a stress" } else { "a stretch or a strain" };
    let suits = |heading: &&Heading| match heading.quantity {
        Quantity::Mode | Quantity::Other => false,
        quantity => quantity.is_stress() == is_stress,
    };
    let Some(choice) = choice else {
        return match headings.iter().filter(suits).collect::<Vec<_>>()[..] {
            [] => Err(format!("no header is {kind} in plain form")),
            [one] => Ok(one.clone()),
            [one, other, ..] => {
                Err(format!("`{}` and `{}` are both {kind}", quoted(&one.text), quoted(&other.text)))
            }
        };
    };
    let (name, holds) = chosen(choice);
    let is_named = |heading: &Heading| heading.text.trim().eq_ignore_ascii_case(name);
    let by_number = || name.parse::<usize>().ok()?.checked_sub(1);
    let place = headings.iter().position(is_named).or_else(by_number);
    let own = place.and_then(|place| headings.get(place));
    let own = own.ok_or_else(|| format!("there is no column `{}`", quoted(name)))?;
    let mut column = holds.map_or_else(|| own.clone(), |holds| Heading::of(own.place, holds, None));
    if !suits(&&column) {
        if holds.is_some() {
            return Err(format!("`{}` is not {kind} in plain form", quoted(&column.text)));
        }
        column.quantity = if is_stress { Quantity::Stress } else { Quantity::Strain };
    }
    column.unit = column.unit.or(own.unit);
    column.text.clone_from(&own.text);
    if !has_clear_unit(&own.text, column.unit, is_stress) {
        return Err(format!("`{}` has no known unit of {kind}", quoted(&own.text)));
    }
    Ok(column)
}

/// The header or the number of a chosen column, and the header that replaces its own.
fn chosen(choice: &str) -> (&str, Option<&str>) {
    match choice.rsplit_once('=') {
        Some((column, own)) => (column.trim(), Some(own.trim())),
        None => (choice.trim(), None),
    }
}
