//! Lines of a table, taken apart: what separates columns, and how numbers are written.

/// A separator of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Tab,
    Semicolon,
    Comma,
    Spaces,
}

impl Separator {
    const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Spaces];

    /// The separator with which most lines have two numbers, and fewest fields are torn numbers.
    pub(super) fn of<'a>(lines: impl Iterator<Item = &'a str> + Clone) -> Self {
        let score = |separator: &Self| {
            let (mut good, mut torn) = (0_usize, 0_usize);
            for line in lines.clone().take(SAMPLE) {
                let fields = separator.fields(line);
                good += usize::from(fields.iter().filter(|field| is_number(field)).count() > 1);
                torn += fields.iter().filter(|field| is_torn(field)).count();
            }
            (good, usize::MAX - torn)
        };
        let best = Self::ALL.into_iter().rev().max_by_key(score).filter(|best| score(best).0 > 0);
        // Without a line of two numbers, what most lines have.
        let count = |separator: &Self| {
            lines.clone().take(SAMPLE).filter(|line| separator.fields(line).len() > 1).count()
        };
        let most = || Self::ALL.into_iter().rev().max_by_key(count).filter(|most| count(most) > 0);
        best.or_else(most).unwrap_or(Self::Comma)
    }

    /// The separator that a first line such as `sep=;` declares for spreadsheets.
    pub(super) fn declared(line: &str) -> Option<Self> {
        match &*line.trim_matches('"').to_ascii_lowercase() {
            "sep=;" => Some(Self::Semicolon),
            "sep=," => Some(Self::Comma),
            "sep=\t" => Some(Self::Tab),
            _ => None,
        }
    }

    /// The fields of a line, without spaces and quotes around them. Between quotes nothing separates.
    pub(super) fn fields(self, line: &str) -> Vec<&str> {
        let line = if self == Self::Spaces { line.trim() } else { line };
        let mut is_quoted = false;
        let fields = line.split(|c: char| {
            is_quoted ^= c == '"';
            !is_quoted
                && match self {
                    Self::Tab => c == '\t',
                    Self::Semicolon => c == ';',
                    Self::Comma => c == ',',
                    Self::Spaces => c.is_whitespace(),
                }
        });
        let fields = fields.map(bare);
        if self == Self::Spaces {
            fields.filter(|field| !field.is_empty()).collect()
        } else {
            fields.collect()
        }
    }

    /// The fields of a header above `columns` columns: where spaces separate, names with single spaces in
    /// them stand two spaces or more apart.
    pub(super) fn header(self, line: &str, columns: usize) -> Vec<&str> {
        let fields = self.fields(line);
        if self != Self::Spaces || fields.len() == columns {
            return fields;
        }
        let names: Vec<_> = line.split("  ").map(bare).filter(|name| !name.is_empty()).collect();
        if names.len() == columns { names } else { fields }
    }

    /// The name in sentences.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Tab => "tabs",
            Self::Semicolon => "semicolons",
            Self::Comma => "commas",
            Self::Spaces => "spaces",
        }
    }
}

/// Lines by which a separator is judged.
const SAMPLE: usize = 1000;

fn bare(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').map_or(field, |rest| rest.strip_suffix('"').unwrap_or(rest)).trim()
}

/// True if a field looks like a number, with any marks of decimals and thousands.
pub(super) fn is_number(field: &str) -> bool {
    let digits = field.trim_end_matches('%').trim_end();
    digits.contains(|c: char| c.is_ascii_digit())
        && digits.chars().all(|c| is_digit(c) || matches!(c, '.' | ','))
}

/// True if a character belongs to a number, not counting marks; Fortran writes exponents with `D`.
fn is_digit(c: char) -> bool {
    matches!(c, '0'..='9' | '+' | '-' | '−' | 'e' | 'E' | 'd' | 'D')
}

/// True if a field begins like a number but is not one.
fn is_torn(field: &str) -> bool {
    field.starts_with(|c: char| c.is_ascii_digit()) && !is_number(field)
}

/// A finite number with a mark of decimals, with or without a sign for percent behind it.
pub(super) fn number(field: &str, decimal: char) -> Option<f64> {
    let digits = field.trim_end_matches('%').trim_end();
    if !digits.chars().all(|c| is_digit(c) || c == decimal) {
        return None;
    }
    let digits = digits.replace(decimal, ".").replace('−', "-").replace(['d', 'D'], "e");
    digits.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The mark of decimals of all fields with numbers, or the first field that has another than those before it,
/// with its line.
pub(super) fn decimal<'a>(fields: impl Iterator<Item = (u64, &'a str)>) -> Result<char, (u64, &'a str)> {
    let begins = |c: char| c.is_ascii_digit() || "+-−.,".contains(c);
    let mut found = None;
    for (line, field) in fields.filter(|(_, field)| field.starts_with(begins)) {
        let mut marks = field.chars().filter(|c| matches!(c, '.' | ','));
        let Some(mark) = marks.next() else { continue };
        if marks.next().is_some() || *found.get_or_insert(mark) != mark {
            return Err((line, field));
        }
    }
    Ok(found.unwrap_or('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_are_those_of_the_numbers() {
        for (text, separator) in [
            ("uniaxial,1,0\nuniaxial,2,0.5", Separator::Comma),
            ("1.02, 0.13\n1.1, 0.3", Separator::Comma),
            ("1,02; 0,13\n1,1; 0,3", Separator::Semicolon),
            ("1,02\t0,13", Separator::Tab),
            ("1,02 0,13", Separator::Spaces),
            ("\"1,02\",\"0,13\"", Separator::Comma),
            ("Name;Versuch, 3. Probe;\nDehnung;Spannung\n0,1;2", Separator::Semicolon),
            ("2024-01-05 10:00:01,1.2,3.4", Separator::Comma),
            ("  1.02   0.13  ", Separator::Spaces),
            ("mode;stretch", Separator::Semicolon),
            ("", Separator::Comma),
        ] {
            assert_eq!(Separator::of(text.lines()), separator, "{text}");
        }
    }

    #[test]
    fn numbers_have_one_mark_of_decimals() {
        assert_eq!(number("1,5e-3", ','), Some(1.5e-3));
        assert_eq!(number("−2.5", '.'), Some(-2.5));
        assert_eq!(number("1.0D+02", '.'), Some(100.0));
        assert_eq!(number("12.5 %", '.'), Some(12.5));
        for text in ["", "inf", "NaN", "1,5", "1.234,5", "0x10", "e", "1e999", "%"] {
            assert_eq!(number(text, '.'), None, "{text}");
        }
        let mark = |fields: &[&'static str]| decimal((1..).zip(fields.iter().copied()));
        assert_eq!(mark(&["1", "2,5", "0,1"]), Ok(','));
        assert_eq!(mark(&["1", "2"]), Ok('.'));
        assert_eq!(mark(&["2,5", "0.1"]), Err((2, "0.1")));
        assert_eq!(mark(&["1.234,5"]), Err((1, "1.234,5")));
    }
}
