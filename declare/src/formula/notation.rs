//! Characters of papers that Rust does not have: `μ/2 (I₁ − 3)` is read as `μ/2 (I1 - 3)`.

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
        let mut characters = formula.chars().enumerate().peekable();
        while let Some((place, character)) = characters.next() {
            let raised = raised(character);
            let is_name = characters.peek().is_some_and(|(_, next)| next.is_alphabetic());
            let written = match (raised, lowered(character)) {
                (Some(digit), _) if is_raised => digit.to_string(),
                (Some(digit), _) => format!("^{digit}"),
                (None, Some(letter)) => letter.to_string(),
                // `\lambda_{1}` of TeX is `lambda_1`.
                (None, None) if character == '\\' && is_name => String::new(),
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
        let notation = Self { tokens: TokenStream::new(), text, origins };
        match notation.text.parse() {
            Ok(tokens) => Ok(Self { tokens, ..notation }),
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
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = RAISED.iter().position(|&raised| raised == character);
    digit.and_then(|digit| char::from_digit(digit as u32, 10)).or((character == '⁻').then_some('-'))
}

/// The character of Rust for one that papers use.
fn lowered(character: char) -> Option<char> {
    const LOWERED: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    let digit = LOWERED.iter().position(|&lowered| lowered == character);
    let digit = digit.and_then(|digit| char::from_digit(digit as u32, 10));
    digit.or(match character {
        '−' | '–' => Some('-'),
        '·' | '×' | '∗' | '⋅' => Some('*'),
        '∕' | '÷' => Some('/'),
        _ => None,
    })
}
