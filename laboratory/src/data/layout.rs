//! Layout of columns and rows in a file: below a header, bare, or in the blocks of an input deck.

use super::fault::{DataError, Fault};
use super::heading::{Heading, Quantity, unit};
use super::section::{Column, Row, Section};
use super::table::{Separator, is_number};
use super::test::Test;
use crate::curve::Mode;

/// The separator and the sections of a file.
pub(super) fn sections(text: &str) -> Result<(Separator, Vec<Section<'_>>), DataError> {
    let mut lines = lines(text);
    let declared = lines.first().and_then(|line| Separator::declared(line.text));
    lines.drain(..usize::from(declared.is_some()));
    let is_deck =
        |line: &Line<'_>| !line.is_comment() && line.text.starts_with('*') && deck_test(line.text).is_some();
    match lines.iter().any(is_deck) {
        true => Ok((Separator::Comma, deck(&lines)?)),
        false => table(&lines, declared),
    }
}

/// A line with something in it.
struct Line<'a> {
    /// Counted from 1.
    number: u64,
    text: &'a str,
}

impl Line<'_> {
    fn is_comment(&self) -> bool {
        self.text.starts_with('#') || self.text.starts_with("//") || self.text.starts_with("**")
    }
}

/// All lines with something in them. Lines may end as on any system.
fn lines(text: &str) -> Vec<Line<'_>> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let lines = (1..)
        .zip(text.split(end))
        .map(|(number, text)| Line { number, text: text.trim_matches([' ', '\r']) });
    lines.filter(|line| !line.text.trim().is_empty()).collect()
}

/// The separator, unless a first line has declared it, and the section of a table.
fn table<'a>(
    lines: &[Line<'a>],
    declared: Option<Separator>,
) -> Result<(Separator, Vec<Section<'a>>), DataError> {
    let plain: Vec<&Line<'a>> = lines.iter().filter(|line| !line.is_comment()).collect();
    let separator = declared.unwrap_or_else(|| Separator::of(plain.iter().map(|line| line.text)));
    let has_numbers =
        |line: &Line<'_>| separator.fields(line.text).iter().filter(|field| is_number(field)).count() > 1;
    let first = plain.iter().position(|line| has_numbers(line));
    let columns = first.map_or(0, |first| separator.fields(plain[first].text).len());

    // A header by its words, wherever it stands.
    let mut found = None;
    for (index, line) in plain.iter().enumerate().filter(|(_, line)| !has_numbers(line)) {
        let below = plain.get(index + 1).map(|line| separator.header(line.text, columns));
        let below = below.filter(|fields| are_units(fields));
        let names = separator.header(line.text, columns);
        let header = Header::of(line.number, &names, below.as_deref().unwrap_or_default());
        if header.has_pair() {
            found = Some((index + 1 + usize::from(below.is_some()), header));
            break;
        }
    }
    let (begin, header) = match (found, first) {
        (Some(found), _) => found,
        (None, Some(first)) => {
            // The line above the numbers: a header that is not understood, or one in a comment.
            let number = plain[first].number;
            let above = lines.iter().take_while(|line| line.number < number).last();
            let header = above.map(|line| {
                let text = line.text.trim_start_matches(|c| "#/%!*' ".contains(c));
                Header::of(line.number, &separator.header(text, columns), &[])
            });
            match header {
                Some(header) if header.has_pair() || above.is_some_and(|line| !line.is_comment()) => {
                    (first, header)
                }
                _ => (first, Header::unnamed(number, &separator.fields(plain[first].text))?),
            }
        }
        (None, None) => {
            let Some(line) = plain.first() else {
                return Err(DataError { line: 1, fault: Fault::NoHeader });
            };
            (1, Header::of(line.number, &separator.fields(line.text), &[]))
        }
    };
    let preamble = plain.iter().take_while(|line| line.number < header.line).count();
    let mut section = header.section(preamble)?;
    let expected = header.headings.len();
    for line in &plain[begin..] {
        let mut fields = separator.fields(line.text);
        while fields.len() > expected && fields.last().is_some_and(|field| field.is_empty()) {
            fields.pop();
        }
        if fields.iter().all(|field| field.is_empty()) {
            continue;
        }
        if fields.len() != expected {
            let fault = Fault::Fields { found: fields.len(), expected };
            return Err(DataError { line: line.number, fault });
        }
        section.rows.push(Row { line: line.number, fields });
    }
    Ok((separator, vec![section]))
}

/// True if the fields of a row are units, some of them known.
fn are_units(fields: &[&str]) -> bool {
    fields.iter().any(|field| unit(field).is_some())
        && fields.iter().all(|field| !is_number(field) && field.parse::<Test>().is_err())
}

/// The headings of a table.
struct Header {
    line: u64,
    text: String,
    headings: Vec<Heading>,
    /// The first heading that has another unit than the row below.
    conflict: Option<Fault>,
}

impl Header {
    /// The headings of these names, with the row of units below them, which may be empty.
    fn of(line: u64, names: &[&str], below: &[&str]) -> Self {
        let (mut headings, mut conflict) = (Vec::new(), None);
        for (place, name) in names.iter().enumerate() {
            let below = below.get(place).copied().unwrap_or_default();
            let heading = Heading::of(name, below);
            if unit(below).is_some_and(|below| heading.unit != Some(below)) {
                let fault = Fault::UnitTwice { header: (*name).into(), below: below.into() };
                conflict.get_or_insert(fault);
            }
            headings.push(heading);
        }
        Self { line, text: names.join(","), headings, conflict }
    }

    /// Columns without names: a stretch and a stress, with a test before them or without.
    fn unnamed(line: u64, first: &[&str]) -> Result<Self, DataError> {
        let names: &[&str] = match first {
            [_, _] => &["stretch", "stress"],
            [test, _, _] if test.parse::<Test>().is_ok() => &["mode", "stretch", "stress"],
            _ => return Err(DataError { line, fault: Fault::Columns { columns: first.len() } }),
        };
        let mut header = Self::of(line, names, &[]);
        for (place, heading) in header.headings.iter_mut().enumerate() {
            heading.text = format!("column {}", place + 1);
        }
        Ok(header)
    }

    fn has_pair(&self) -> bool {
        let has = |is: fn(Quantity) -> bool| self.headings.iter().any(|heading| is(heading.quantity));
        has(Quantity::is_control) && has(Quantity::is_stress)
    }

    /// The columns to be used: of several quantities the first in the order of [`Quantity`].
    fn section<'a>(&self, preamble: usize) -> Result<Section<'a>, DataError> {
        let at = |fault| DataError { line: self.line, fault };
        if let Some(fault) = &self.conflict {
            return Err(at(fault.clone()));
        }
        let choose = |is: fn(Quantity) -> bool, missing| {
            let fits = self.headings.iter().filter(|heading| is(heading.quantity));
            let Some(quantity) = fits.map(|heading| heading.quantity).min() else {
                return Ok(Err(missing));
            };
            let mut places =
                (0..self.headings.len()).filter(|&place| self.headings[place].quantity == quantity);
            match (places.next(), places.next()) {
                (Some(one), Some(other)) => {
                    let found = [one, other].map(|place| self.headings[place].text.clone());
                    Err(at(Fault::ColumnTwice { quantity: quantity.name(), found }))
                }
                (place, _) => Ok(place.ok_or(missing)),
            }
        };
        let whole = |place: usize| Column { place, heading: self.headings[place].clone() };
        let mode = choose(|quantity| quantity == Quantity::Mode, "test")?.ok().map(whole);
        let column = |chosen: Result<usize, &'static str>| match chosen {
            Ok(place) => Ok(whole(place)),
            Err(quantity) => {
                Err(at(match self.headings.iter().find(|heading| heading.quantity == Quantity::Sized) {
                    Some(heading) => Fault::NoSize { found: heading.text.clone() },
                    None => Fault::NoColumn { quantity, found: self.text.clone() },
                }))
            }
        };
        let control = column(choose(Quantity::is_control, "stretch or strain")?)?;
        let stress = column(choose(Quantity::is_stress, "stress")?)?;
        if let Some(found) = control.heading.unknown.as_ref().filter(|_| control.heading.quantity.is_strain())
        {
            let header = control.heading.text.clone();
            return Err(at(Fault::StrainUnit { header, found: found.clone() }));
        }
        let is_true = control.heading.quantity == Quantity::TrueStrain;
        if is_true && stress.heading.quantity == Quantity::Stress && !stress.heading.is_specific {
            return Err(at(Fault::WhichStress { found: stress.heading.text }));
        }
        let used = [mode.as_ref().unwrap_or(&control), &control, &stress].map(|column| column.place);
        let unused = self.headings.iter().enumerate().filter(|(place, _)| !used.contains(place));
        let unused =
            unused.map(|(_, heading)| heading.text.clone()).filter(|text| !text.is_empty()).collect();
        Ok(Section { line: self.line, test: None, mode, control, stress, unused, preamble, rows: Vec::new() })
    }
}

/// The test of a line of an input deck such as `*UNIAXIAL TEST DATA`.
fn deck_test(line: &str) -> Option<&str> {
    let keyword = line.trim_start_matches('*').split(',').next()?.trim();
    let (test, end) = keyword.split_at_checked(keyword.len().checked_sub("TEST DATA".len())?)?;
    end.eq_ignore_ascii_case("TEST DATA").then_some(test.trim())
}

/// The blocks of test data in an input deck of a finite-element program: nominal stress, then nominal strain;
/// of a volumetric test pressure, then J.
fn deck<'a>(lines: &[Line<'a>]) -> Result<Vec<Section<'a>>, DataError> {
    let mut sections: Vec<Section<'a>> = Vec::new();
    let mut is_inside = false;
    for line in lines.iter().filter(|line| !line.is_comment()) {
        let at = |fault| DataError { line: line.number, fault };
        if line.text.starts_with('*') {
            let name = deck_test(line.text);
            is_inside = name.is_some();
            if let Some(name) = name {
                let test: Test = name.parse().map_err(|error| at(Fault::Mode(error)))?;
                let names = match test.mode {
                    Mode::Volumetric => ["pressure", "volume ratio"],
                    Mode::SimpleShear => ["shear stress", "shear strain"],
                    _ => ["nominal stress", "nominal strain"],
                };
                let mut section = Header::of(line.number, &names, &[]).section(0)?;
                section.test = Some(test);
                sections.push(section);
            }
        } else if let Some(section) = sections.last_mut().filter(|_| is_inside) {
            let fields = Separator::Comma.fields(line.text);
            if fields.len() < 2 {
                return Err(at(Fault::Fields { found: fields.len(), expected: 2 }));
            }
            if fields[2..].iter().any(|field| !field.is_empty()) && section.unused.is_empty() {
                section.unused.push("columns after the second".into());
            }
            section.rows.push(Row { line: line.number, fields });
        }
    }
    Ok(sections)
}
