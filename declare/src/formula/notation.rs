//! Characters of papers that Rust does not have: `μ/2 (I₁ − 3)` is read as `μ/2 (I1 - 3)`.

use std::ops::Range;

use proc_macro2::TokenStream;

use crate::mistakes::{Mistake, Mistakes, Place};
use crate::rust::check_size;

/// A formula in the characters of Rust.
pub(super) struct Notation {
    pub(super) tokens: TokenStream,
    /// The text of the tokens.
    text: String,
    /// Position in the formula of each character of the text.
    origins: Vec<usize>,
}

impl Notation {
    /// Reads a formula.
    ///
    /// # Errors
    /// [`Mistakes`] if its characters do not form tokens.
    pub(super) fn read(formula: &str) -> Result<Self, Mistakes> {
        check_size(formula)?;
        let (mut text, mut origins) = (String::new(), Vec::new());
        let (mut is_raised, mut is_index) = (false, false);
        let mut characters = with_bars(formula).into_iter().peekable();
        while let Some((place, character)) = characters.next() {
            let raised = raised(character);
            let is_name = characters.peek().is_some_and(|(_, next)| next.is_alphabetic());
            let written = match (raised, lowered(character)) {
                (Some(digit), _) if is_raised => digit.to_string(),
                (Some(digit), _) => format!("^{digit}"),
                (None, Some(letter)) => letter.to_string(),
                // `\lambda_{1}` of TeX is `lambda_1`, and `2\mu` a product.
                (None, None) if character == '\\' && is_name => {
                    if text.ends_with(char::is_alphanumeric) { " " } else { "" }.to_owned()
                }
                (None, None) if character == '{' && text.ends_with('_') => {
                    is_index = true;
                    String::new()
                }
                (None, None) if character == '}' && std::mem::take(&mut is_index) => String::new(),
                (None, None) => character.to_string(),
            };
            is_raised = raised.is_some();
            origins.extend(written.chars().map(|_| place));
            text += &written;
        }
        origins.push(formula.chars().count());
        match text.parse() {
            Ok(tokens) => Ok(Self { tokens, text, origins }),
            Err(_) => Err(Mistakes::new(formula, vec![unreadable(formula)])),
        }
    }

    /// The mistakes of the compiler at their places in the formula.
    pub(super) fn mistakes(&self, formula: &str, error: syn::Error) -> Mistakes {
        let Mistakes { list, .. } = Mistakes::from_syn(&self.text, error);
        let at_origin = |Mistake { message, place }: Mistake| Mistake {
            message,
            place: place.and_then(|place| self.origin(formula, place)),
        };
        let mut list: Vec<_> = list.into_iter().map(at_origin).collect();
        list.dedup();
        Mistakes::new(formula, list)
    }

    fn origin(&self, formula: &str, Place { line, column, length }: Place) -> Option<Place> {
        // A line ends at its line feed, as for the compiler, and a carriage return before that is part of it.
        let before: usize = self.text.split('\n').take(line - 1).map(|line| line.chars().count() + 1).sum();
        let [first, last] = [column - 1, column + length - 2].map(|k| self.origins.get(before + k));
        let (first, last) = (*first?, *last?);
        let place = Place::at(formula, first)?;
        let rest = formula.split('\n').nth(place.line - 1)?.chars().count() + 1 - place.column;
        Some(Place { length: (last - first + 1).clamp(1, rest.max(1)), ..place })
    }
}

/// The characters of a formula with their positions. A bar of TeX becomes part of the name below it:
/// `\bar{I}_1` is `\Ibar_1`.
fn with_bars(formula: &str) -> Vec<(usize, char)> {
    let characters: Vec<char> = formula.chars().collect();
    let mut written = Vec::with_capacity(characters.len());
    let mut next = 0;
    while next < characters.len() {
        match bar(&characters, next) {
            Some((name, end)) => {
                written.push((next, '\\'));
                written.extend(characters[name].iter().map(|&letter| (next, letter)));
                written.extend("bar".chars().map(|letter| (end - 1, letter)));
                next = end;
            }
            None => {
                written.push((next, characters[next]));
                next += 1;
            }
        }
    }
    written
}

/// The name below a bar of TeX that begins here, and the end of the bar.
fn bar(text: &[char], start: usize) -> Option<(Range<usize>, usize)> {
    const BARS: [&str; 2] = ["\\bar", "\\overline"];
    let begins = |bar: &&&str| bar.chars().eq(text[start..].iter().copied().take(bar.len()));
    let behind = |from: usize, is_part: fn(char) -> bool| {
        from + text[from..].iter().take_while(|&&character| is_part(character)).count()
    };
    let command = start + BARS.iter().find(begins)?.len();
    let argument = behind(command, char::is_whitespace);
    let is_braced = *text.get(argument)? == '{';
    let backslash = argument + usize::from(is_braced);
    let first = backslash + usize::from(*text.get(backslash)? == '\\');
    let last = behind(first, |character| character.is_alphanumeric() || character == '_');
    // Without braces or a backslash, the bar is above one letter, which is apart from the command.
    let is_letter = first == argument;
    let last = if is_letter { last.min(first + 1) } else { last };
    let end = last + usize::from(is_braced);
    let is_name =
        last > first && (!is_letter || argument > command) && (!is_braced || text.get(last) == Some(&'}'));
    is_name.then_some((first..last, end))
}

/// Error for characters that do not form tokens: an unmatched parenthesis, or characters without a meaning in
/// formulas.
fn unreadable(formula: &str) -> Mistake {
    let mut open: Vec<(char, usize)> = Vec::new();
    for (k, character) in formula.chars().enumerate() {
        match character {
            '(' => open.push((')', k)),
            '[' => open.push((']', k)),
            ')' | ']' if open.last().is_some_and(|&(closing, _)| closing == character) => _ = open.pop(),
            ')' | ']' => {
                let message = format!("this `{character}` closes nothing: remove it, or open it before");
                return Mistake { message, place: Place::at(formula, k) };
            }
            _ => {}
        }
    }
    if let Some(&(closing, k)) = open.first() {
        let opening = if closing == ')' { '(' } else { '[' };
        let message = format!("this `{opening}` is not closed: write `{closing}` where it ends");
        return Mistake { message, place: Place::at(formula, k) };
    }
    let is_known = |c: char| c.is_alphanumeric() || c.is_whitespace() || "_+-*/^()[].,<>=!".contains(c);
    let strange = formula.chars().position(|c| !is_known(c) && raised(c).is_none() && lowered(c).is_none());
    Mistake {
        message: "this cannot be part of a formula: names are made of letters, digits and `_`, numbers are written as `1.5e6`, and \
                  parts are joined by `+ - * / ^`"
            .to_owned(),
        place: strange.and_then(|k| Place::at(formula, k)),
    }
}

/// A digit or sign in an exponent.
fn raised(character: char) -> Option<char> {
    counterpart(character, "⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
}

/// The character of Rust for one that papers use.
fn lowered(character: char) -> Option<char> {
    counterpart(character, "₀₁₂₃₄₅₆₇₈₉−–·×∗⋅∕÷", "0123456789--****//")
}

/// The character of the second text at the place that this one has in the first.
fn counterpart(character: char, first: &str, second: &str) -> Option<char> {
    first.chars().zip(second.chars()).find(|&(one, _)| one == character).map(|(_, other)| other)
}
