//! Lines of a table, taken apart: what separates columns, and how numbers are written.

/// The separator of columns: the first of tab, semicolon, comma and space that is in a line of numbers.
pub(super) fn separator(line: &str) -> char {
    ['\t', ';', ','].into_iter().find(|mark| line.contains(*mark)).unwrap_or(' ')
}

/// The fields of a line, without spaces and quotes around them. Between quotes nothing separates.
pub(super) fn fields(line: &str, separator: char) -> Vec<&str> {
    let mut is_quoted = false;
    let fields = line.split(|c: char| {
        is_quoted ^= c == '"';
        !is_quoted && c == separator
    });
    // Between columns that spaces separate there may be several.
    fields.map(bare).filter(|field| separator != ' ' || !field.is_empty()).collect()
}

fn bare(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').map_or(field, |rest| rest.strip_suffix('"').unwrap_or(rest)).trim()
}

/// True if a field is a number, with a point or a comma.
pub(super) fn is_number(field: &str) -> bool {
    number(field, '.').or_else(|| number(field, ',')).is_some()
}

/// A finite number with a mark of decimals.
pub(super) fn number(field: &str, decimal: char) -> Option<f64> {
    if !field.chars().all(|c| matches!(c, '0'..='9' | '+' | '-' | '−' | 'e' | 'E') || c == decimal) {
        return None;
    }
    let digits = field.replace(decimal, ".").replace('−', "-");
    digits.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The mark of decimals of all numbers, or the first one that makes it ambiguous: with a second mark, with
/// another one than those before, or with a comma that may be one of thousands as all others may.
pub(super) fn decimal<'a>(
    fields: impl Iterator<Item = (u64, &'a str)> + Clone,
) -> Result<char, (u64, &'a str)> {
    let begins = |c: char| c.is_ascii_digit() || "+-−.,".contains(c);
    let marked = fields.filter(|(_, field)| field.starts_with(begins) && field.contains(['.', ',']));
    let Some((_, first)) = marked.clone().next() else { return Ok('.') };
    let decimal = if first.contains('.') { '.' } else { ',' };
    let is_other = |(_, field): &(u64, &str)| {
        let mut marks = field.chars().filter(|c| matches!(c, '.' | ','));
        marks.next() != Some(decimal) || marks.next().is_some()
    };
    let may_be_thousands = |field: &str| {
        let (whole, part) = field.trim_start_matches(['-', '+', '−']).split_once(',').unwrap_or_default();
        !whole.is_empty() && !whole.starts_with('0') && part.len() == 3
    };
    let is_unclear = decimal == ',' && marked.clone().all(|(_, field)| may_be_thousands(field));
    match marked.clone().find(is_other).or_else(|| marked.clone().next().filter(|_| is_unclear)) {
        Some(unclear) => Err(unclear),
        None => Ok(decimal),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_one_mark_of_decimals() {
        assert_eq!(number("1,5e-3", ','), Some(1.5e-3));
        assert_eq!(number("−2.5", '.'), Some(-2.5));
        for text in ["", "inf", "NaN", "1,5", "1.234,5", "0x10", "e", "1e999", "5%"] {
            assert_eq!(number(text, '.'), None, "{text}");
        }
        let mark = |fields: &[&'static str]| decimal((1..).zip(fields.iter().copied()));
        assert_eq!(mark(&["1", "2,5", "1,125"]), Ok(','));
        assert_eq!(mark(&["0,125"]), Ok(','));
        assert_eq!(mark(&["1", "2"]), Ok('.'));
        assert_eq!(mark(&["1.250", "2.500"]), Ok('.'));
        assert_eq!(mark(&["2,5", "0.1"]), Err((2, "0.1")));
        assert_eq!(mark(&["1.234,5"]), Err((1, "1.234,5")));
        assert_eq!(mark(&["1", "1,234", "12,345"]), Err((2, "1,234")));
    }
}
