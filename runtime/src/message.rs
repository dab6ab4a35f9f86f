//! Formatting of numbers and foreign text in messages: short, and harmless to a terminal.
//!
//! Errors of all crates quote their inputs through these functions.

/// Characters of a quotation beyond which it is cut.
const LONGEST: usize = 40;
/// Names of a list beyond which it is cut.
const MOST_NAMES: usize = 20;

/// Number in the usual form: very large and very small ones with an exponent, so that 10³⁰⁸ does not take a
/// line of zeros.
///
/// ```
/// # use piola::__private::message::number;
/// assert_eq!([0.25, 1e308, -1e-9].map(number), ["0.25", "1e308", "-1e-9"]);
/// ```
#[must_use]
pub fn number(x: f64) -> String {
    let size = x.abs();
    let is_short = (1e-4..1e7).contains(&size) || size == 0.0 || !size.is_finite();
    if is_short { x.to_string() } else { format!("{x:e}") }
}

/// Word of a file, or a name: escaped as by [`printable`], and cut if it is long.
///
/// ```
/// # use piola::__private::message::quoted;
/// assert_eq!(quoted("left\u{1b}[2J side"), "left\\u{1b}[2J side");
/// assert_eq!(quoted(&"x".repeat(1000)), format!("{}…", "x".repeat(40)));
/// ```
#[must_use]
pub fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", printable(&text[..end])),
        None => printable(text),
    }
}

/// Text with all characters that a terminal interprets, or does not show, in the form `\u{1b}`: control
/// characters, and those that hide or turn others.
#[must_use]
pub fn printable(text: &str) -> String {
    let mut printable = String::with_capacity(text.len());
    for c in text.chars() {
        match c.is_control() || is_invisible(c) {
            true => printable.extend(c.escape_default()),
            false => printable.push(c),
        }
    }
    printable
}

/// List of names, each [`quoted`]; a long list is cut after the first ones, with the number of the others.
///
/// ```
/// # use piola::__private::message::names;
/// assert_eq!(names(["left", "right"]), "left, right");
/// assert!(names(["x"; 100]).ends_with("x, x and 80 more"));
/// ```
#[must_use]
pub fn names<S: AsRef<str>>(names: impl IntoIterator<Item = S>) -> String {
    let mut names = names.into_iter();
    let shown: Vec<String> = names.by_ref().take(MOST_NAMES).map(|name| quoted(name.as_ref())).collect();
    let shown = shown.join(", ");
    match names.count() {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// True if a character has no width, or changes the direction of those after it.
fn is_invisible(c: char) -> bool {
    matches!(c,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e0fff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(x: f64, expected: &str) {
        assert_eq!(number(x), expected);
    }

    #[test]
    fn numbers_are_short() {
        check(0.0, "0");
        check(-1.0, "-1");
        check(0.499, "0.499");
        check(1e-4, "0.0001");
        check(9.9e-5, "9.9e-5");
        check(9_999_999.0, "9999999");
        check(1e7, "1e7");
        check(f64::MAX, "1.7976931348623157e308");
        check(5e-324, "5e-324");
        check(f64::NEG_INFINITY, "-inf");
        check(f64::NAN, "NaN");
    }

    #[test]
    fn what_a_terminal_would_obey_is_escaped_and_what_people_write_is_not() {
        let text = "\u{1b}]0;owned\u{7}\r\n\u{9b}2J \u{202e}abc\u{feff}\u{200b}";
        let escaped = printable(text);
        assert!(escaped.chars().all(|c| c.is_ascii() && !c.is_control()), "{escaped}");
        let plain = "Füße, 右, हिन्दी, 'left' \\ \"side\"";
        assert_eq!(printable(plain), plain);
    }
}
