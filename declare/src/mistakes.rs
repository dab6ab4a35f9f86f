//! Mistakes of a text, each with the place that is to be changed.

use std::fmt;

use proc_macro2::Span;

/// A mistake in the text of an energy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The reason, and what to write instead.
    pub message: String,
    /// Position of the mistake; `None` if it is about the text as a whole.
    pub place: Option<Place>,
}

/// A part of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line of the first character, from 1.
    pub line: usize,
    /// Column of the first character in its line, in characters, from 1.
    pub column: usize,
    /// Number of characters on that line, at least 1.
    pub length: usize,
}

/// All mistakes of a text. Displayed in the style of a compiler, each with the line that it is in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistakes {
    /// Name of the text: a file, or `energy`.
    pub name: String,
    /// The text.
    pub text: String,
    /// The mistakes, in the order in which they were found.
    pub list: Vec<Mistake>,
}

/// Maximum number of mistakes that are shown for a text.
const MOST: usize = 100;

impl Mistakes {
    /// One mistake about a text as a whole.
    pub(crate) fn of_all(text: &str, message: String) -> Self {
        Self::new(text, vec![Mistake { message, place: None }])
    }

    pub(crate) fn new(text: &str, list: Vec<Mistake>) -> Self {
        Self { name: "energy".to_owned(), text: text.to_owned(), list }
    }

    /// The mistakes of the compiler, whose spans are places of the text.
    pub(crate) fn from_syn(text: &str, error: syn::Error) -> Self {
        let mistake =
            |error: syn::Error| Mistake { message: error.to_string(), place: Place::of(text, error.span()) };
        let mut errors = error.into_iter();
        let mut list: Vec<_> = errors.by_ref().take(MOST).map(mistake).collect();
        let left = errors.count();
        if left > 0 {
            list.push(Mistake { message: format!("{left} more mistakes are not shown"), place: None });
        }
        Self::new(text, list)
    }

    fn write(&self, Mistake { message, place }: &Mistake, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Quotations from the text contain no control characters.
        f.write_str(&message.replace(|c: char| c.is_control() && c != '\n', "�"))?;
        let Some(Place { line, column, length }) = *place else { return Ok(()) };
        let source = self.text.lines().nth(line - 1).unwrap_or_default();
        let margin = " ".repeat(line.to_string().len());
        // As wide as the characters are shown; a tab is shown as four spaces.
        let shown = |text: &str| text.replace('\t', "    ").replace(char::is_control, "�");
        let part = |from: usize, count: usize| source.chars().skip(from).take(count).collect::<String>();
        let width = |text: &str| unicode_width::UnicodeWidthStr::width(shown(text).as_str());
        let before = " ".repeat(width(&part(0, column - 1)));
        let carets = "^".repeat(width(&part(column - 1, length)).max(1));
        write!(
            f,
            "\n{margin}--> {}:{line}:{column}\n{margin} |\n{line} | {}\n{margin} | {before}{carets}",
            self.name,
            shown(source)
        )
    }
}

impl Place {
    /// The place of one character, counted from 0.
    pub(crate) fn at(text: &str, character: usize) -> Option<Self> {
        let mut begin = 0;
        for (line, content) in text.split('\n').enumerate() {
            let end = begin + content.chars().count();
            if character <= end {
                return Some(Self { line: line + 1, column: character - begin + 1, length: 1 });
            }
            begin = end + 1;
        }
        None
    }

    /// The place of tokens; `None` for those that stand nowhere in the text.
    fn of(text: &str, span: Span) -> Option<Self> {
        let (start, end) = (span.start(), span.end());
        // An empty place elsewhere is that of text that makes no tokens.
        if span.byte_range() == (0..0) {
            return None;
        }
        let line = text.lines().nth(start.line.checked_sub(1)?)?;
        let rest = line.chars().count().saturating_sub(start.column).max(1);
        let length = if end.line == start.line { end.column.saturating_sub(start.column) } else { rest };
        Some(Self { line: start.line, column: start.column + 1, length: length.clamp(1, rest) })
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, mistake) in self.list.iter().enumerate() {
            if k > 0 {
                f.write_str("\n\n")?;
            }
            self.write(mistake, f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Mistakes {}
