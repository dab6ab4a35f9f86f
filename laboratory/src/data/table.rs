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

/// True if the comma of a number may be one of thousands, as in `1,234`.
pub(super) fn may_be_thousands(field: &str) -> bool {
    let Some((whole, part)) = field.trim_start_matches(['+', '-', '−']).split_once(',') else {
        return false;
    };
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let has_lengths = matches!(whole.len(), 1..=3) && part.len() == 3;
    has_lengths && !whole.starts_with('0') && are_digits(whole) && are_digits(part)
}

/// A finite number with a mark of decimals.
pub(super) fn number(field: &str, decimal: char) -> Option<f64> {
    if !field.chars().all(|c| matches!(c, '0'..='9' | '+' | '-' | '−' | 'e' | 'E') || c == decimal) {
        return None;
    }
    let digits = field.replace(decimal, ".").replace('−', "-");
    digits.parse().ok().filter(|number: &f64| number.is_finite())
}
