//! Characters and TeX of papers: `\frac{\mu}{2} (I₁ − 3)` is read as `((mu)/(2)) (I1 - 3)`.

use piola_codegen::read::spelling::greek;
use proc_macro2::TokenStream;

use super::spellings::meaning;
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
        // The sign that ends a sentence or a statement is left out.
        let is_end = |character: char| character.is_whitespace() || ";.,".contains(character);
        let characters: Vec<char> = formula.trim_end_matches(is_end).chars().collect();
        let (mut text, mut origins) = (String::new(), Vec::new());
        // The texts that close the braces around, and the character before.
        let (mut braces, mut before, mut origin) = (Vec::new(), ' ', 0);
        while origin < characters.len() {
            let part = read_part(&characters[origin..], before, &text, &mut braces);
            let (length, written) = part.map_err(|message| {
                let place = Place::at(formula, origin);
                Mistakes::new(formula, vec![Mistake { message: message.to_owned(), place }])
            })?;
            let last = origin + length - 1;
            let count = written.chars().count();
            origins.extend((1..=count).map(|k| if k < count { origin } else { last }));
            text += &written;
            (origin, before) = (last + 1, characters[last]);
        }
        origins.push(formula.chars().count());
        match text.parse() {
            Ok(tokens) if braces.is_empty() => Ok(Self { tokens, text, origins }),
            _ => Err(Mistakes::new(formula, vec![unreadable(formula)])),
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

/// Reads the part of a formula that begins here, behind a character and a text: the number of its characters,
/// and what is read instead.
fn read_part(
    rest: &[char],
    before: char,
    text: &str,
    braces: &mut Vec<&'static str>,
) -> Result<(usize, String), &'static str> {
    let character = rest[0];
    let is_digit = |character: char| character.is_ascii_digit();
    let is_operand = |character: char| character.is_alphanumeric() || "_.)]".contains(character);
    let exponent: String = rest.iter().map_while(|&character| raised(character)).collect();
    if !exponent.is_empty() {
        let is_difference = exponent.trim_start_matches('-').contains('-');
        let written = if is_difference { format!("^({exponent})") } else { format!("^{exponent}") };
        return Ok((exponent.chars().count(), written));
    }
    let index = lowered(character);
    if index.is_some() || character == '_' {
        let base = text.trim_end_matches(|c: char| is_digit(c) || "- ".contains(c));
        let is_behind_power = base.ends_with('^') || base.ends_with("**");
        if is_behind_power || raised(before).is_some() || text.ends_with(')') {
            return Err("an index stands before the exponent, as in `I_1^2`");
        }
        return Ok((1, index.unwrap_or(character).to_string()));
    }
    let is_mixed = character == '½' && text.trim_end().ends_with(is_digit);
    if character.is_numeric() && !is_digit(character) && (character != '½' || is_mixed) {
        return Err("write this number as a fraction or with a decimal point, as in `(1/3)` and `2.5`");
    }
    if let Some((length, written)) = symbol(rest) {
        // A fraction, or a root; `\{` is not closed by a brace.
        if length > 2 && rest[length - 1] == '{' {
            braces.push(if written == "((" { ")/(" } else { ")" });
        }
        return Ok((length, written.to_owned()));
    }
    // `2\mu`, `λ²μ` and `λ₁λ₂` are products, and `\lambda_{1}` of TeX is `lambda_1`.
    let is_behind_index = raised(before).is_some() || lowered(before).is_some() && !character.is_ascii();
    let is_name = character == '\\' || character.is_alphanumeric() && is_behind_index;
    let gap = if is_name && text.ends_with(char::is_alphanumeric) { " " } else { "" };
    match character {
        '\\' => named(rest).map(|(length, name)| (length, gap.to_owned() + &name)).ok_or(TEX),
        '{' => {
            let (opening, closing) = if text.ends_with('_') { ("", "") } else { ("(", ")") };
            braces.push(closing);
            Ok((1, opening.to_owned()))
        }
        '}' => match (braces.pop(), rest[1..].iter().position(|c| !c.is_whitespace())) {
            (Some(")/("), Some(gap)) if rest[1 + gap] == '{' => {
                braces.push("))");
                Ok((2 + gap, ")/(".to_owned()))
            }
            (Some(")/("), _) => Err(TEX),
            (closing, _) => Ok((1, closing.unwrap_or("}").to_owned())),
        },
        '.' if rest.get(1).copied().is_some_and(is_digit) && !text.ends_with(is_operand) => {
            Ok((1, "0.".to_owned()))
        }
        _ => Ok((1, format!("{gap}{character}"))),
    }
}

/// The name of a letter or function of TeX, or one in a font, or below a bar, which becomes part of it:
/// `\bar{I}_1` is `Ibar_1`.
fn named(text: &[char]) -> Option<(usize, String)> {
    const BARS: [&str; 2] = ["\\bar", "\\overline"];
    const FONTS: [&str; 5] = ["\\mathrm", "\\mathbf", "\\boldsymbol", "\\operatorname", "\\text"];
    let begins = |bar: &&str| bar.chars().eq(text.iter().copied().take(bar.len()));
    let behind = |from: usize, is_part: fn(char) -> bool| {
        from + text[from..].iter().take_while(|&&character| is_part(character)).count()
    };
    let Some(bar) = BARS.into_iter().chain(FONTS).find(begins) else {
        let end = behind(1, char::is_alphabetic);
        let name: String = text[1..end].iter().collect();
        let is_greek = greek(name.to_lowercase().trim_start_matches("var")).is_some();
        // `\sqrt` with braces has been read, and `\sqrt[3]{x}` is another root.
        let is_read = is_greek || name != "sqrt" && meaning(&name).is_some();
        return is_read.then_some((end, name));
    };
    let argument = behind(bar.len(), char::is_whitespace);
    let is_braced = *text.get(argument)? == '{';
    let backslash = argument + usize::from(is_braced);
    let first = backslash + usize::from(*text.get(backslash)? == '\\');
    let last = behind(first, |character| character.is_alphanumeric() || character == '_');
    // Without braces or a backslash, the bar is above one letter, which is apart from the command.
    let is_letter = first == argument;
    let last = if is_letter { last.min(first + 1) } else { last };
    let end = last + usize::from(is_braced);
    let is_name =
        last > first && (!is_letter || argument > bar.len()) && (!is_braced || text.get(last) == Some(&'}'));
    let added = if BARS.contains(&bar) { "bar" } else { "" };
    is_name.then(|| (end, text[first..last].iter().collect::<String>() + added))
}

/// Error for characters that do not form tokens: an unmatched parenthesis, or characters without a meaning in
/// formulas.
fn unreadable(formula: &str) -> Mistake {
    let mut open: Vec<(char, usize)> = Vec::new();
    for (k, character) in formula.chars().enumerate() {
        if let Some(closing) = counterpart(character, "([{", ")]}") {
            open.push((closing, k));
        } else if ")]}".contains(character) && open.pop().is_none_or(|(closing, _)| closing != character) {
            let message = format!("this `{character}` closes nothing: remove it, or open it before");
            return Mistake { message, place: Place::at(formula, k) };
        }
    }
    if let Some(&(closing, k)) = open.first() {
        let opening = formula.chars().nth(k).unwrap_or('(');
        let message = format!("this `{opening}` is not closed: write `{closing}` where it ends");
        return Mistake { message, place: Place::at(formula, k) };
    }
    let is_known = |c: char| c.is_alphanumeric() || c.is_whitespace() || "_+-*/^()[]{}.,<>=!".contains(c);
    let is_read = |c: char| raised(c).or(lowered(c)).is_some() || symbol(&[c]).is_some();
    let strange = formula.chars().position(|c| !is_known(c) && !is_read(c));
    Mistake {
        message: "this cannot be part of a formula: names are made of letters, digits and `_`, numbers are written as `1.5e6`, and \
                  parts are joined by `+ - * / ^`"
            .to_owned(),
        place: strange.and_then(|k| Place::at(formula, k)),
    }
}

/// A digit, sign or letter in an exponent.
fn raised(character: char) -> Option<char> {
    counterpart(character, "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀⁿᵐᵃᵅᵝ", "0123456789-Tnmaαβ")
}

/// A digit in an index.
fn lowered(character: char) -> Option<char> {
    counterpart(character, "₀₁₂₃₄₅₆₇₈₉", "0123456789")
}

/// The message about TeX that is not read.
const TEX: &str = "of TeX, names, `\\frac{a}{b}` and `\\sqrt{x}` are read with all braces: use plain letters";

/// Signs of papers and commands of TeX, and what is read instead.
const SYMBOLS: [(&str, &str); 15] = [
    ("· × ∗ ⋅ ∙ \\cdot \\times \\ast", "*"),
    ("∕ ⁄ ÷ \\div", "/"),
    ("− –", "-"),
    ("≤ \\le \\leq", "<="),
    ("≥ \\ge \\geq", ">="),
    ("≠ \\ne \\neq", "!="),
    ("½", "(1/2)"),
    ("√", " sqrt "),
    ("\\sqrt{", " sqrt("),
    ("\\frac{ \\dfrac{ \\tfrac{", "(("),
    ("∑ \\sum", " Σ "),
    ("\\{ \\left[ \\bigl[ \\Bigl[ \\big[ \\Big[", "("),
    ("\\} \\right] \\bigr] \\Bigr] \\big] \\Big]", ")"),
    ("\\left \\right \\bigl \\bigr \\Bigl \\Bigr \\big \\Big", " "),
    ("$ \\, \\: \\; \\! \\quad \\displaystyle", " "),
];

/// The symbol that begins here: its length, and what is read instead.
fn symbol(text: &[char]) -> Option<(usize, &'static str)> {
    let length = |symbol: &str| {
        let length = symbol.chars().count();
        let is_longer = || text.get(length).is_some_and(|next| next.is_alphabetic());
        let begins = symbol.chars().eq(text.iter().copied().take(length));
        (begins && !(symbol.ends_with(char::is_alphabetic) && is_longer())).then_some(length)
    };
    SYMBOLS.iter().find_map(|&(symbols, read)| Some((symbols.split(' ').find_map(length)?, read)))
}

/// The character of the second text at the place that this one has in the first.
fn counterpart(character: char, first: &str, second: &str) -> Option<char> {
    first.chars().zip(second.chars()).find(|&(one, _)| one == character).map(|(_, other)| other)
}
