//! The depth of tokens, measured without descending into them: parser and resolver do descend.
//!
//! A level is anything that the syntax nests: a pair of parentheses, one sign before another, one call behind
//! another, a value behind a `|` or a `=`. Terms and factors are none: a sum may be as long as it likes.

use proc_macro2::{Delimiter, Group, Punct, Span, TokenStream, TokenTree};

use crate::read::notation::Notation;

/// Maximum depth of a declaration. Each level takes up to 20 kB of stack if a macro is compiled without
/// optimisation, and an editor may expand it in a thread of 2 MiB.
pub(super) const DEEPEST: usize = 64;

/// Maximum depth of a file, for its parser. Its contents are checked later, with their own limit.
pub(crate) const DEEPEST_FILE: usize = 8 * DEEPEST;

/// Maximum number of terms of a sum, or factors of a product, in a declaration that is read at run time:
/// syntax nests a term in all that follow it.
const LONGEST: usize = 1000;

/// The tokens of a group that are left, and their depth.
struct Level {
    rest: proc_macro2::token_stream::IntoIter,
    /// Levels around the group.
    around: usize,
    /// Signs before the next operand, and calls behind the last one.
    about_operand: usize,
    /// Values one behind the other, up to the next `,` or `;`.
    behind: usize,
    /// Terms before the next operand, and factors.
    joined: [usize; 2],
    is_behind_operand: bool,
}

impl Level {
    fn new(tokens: TokenStream, around: usize) -> Self {
        Self {
            rest: tokens.into_iter(),
            around,
            about_operand: 0,
            behind: 0,
            joined: [0; 2],
            is_behind_operand: false,
        }
    }

    fn depth(&self) -> usize {
        self.around + self.about_operand + self.behind
    }

    fn sign(&mut self, sign: &Punct) {
        let [terms, factors] = self.joined;
        self.joined = match sign.as_char() {
            ',' | ';' => [0; 2],
            '+' | '-' if self.is_behind_operand => [terms + 1, 0],
            '*' | '/' if self.is_behind_operand => [terms, factors + 1],
            _ => self.joined,
        };
        match sign.as_char() {
            ',' | ';' => (self.about_operand, self.behind) = (0, 0),
            '|' | '=' => (self.about_operand, self.behind) = (0, self.behind + 1),
            // What follows is another call of the same operand.
            '.' if self.is_behind_operand => {}
            _ if self.is_behind_operand => self.about_operand = 0,
            _ => self.about_operand += 1,
        }
        self.is_behind_operand = sign.as_char() == '.' && self.is_behind_operand;
    }

    fn operand(&mut self) {
        self.about_operand += usize::from(self.is_behind_operand);
        self.is_behind_operand = true;
    }

    /// The level inside of a group. Behind `{ … }` a statement may begin without a `;`.
    fn enter(&mut self, group: &Group) -> Self {
        self.operand();
        Self::new(group.stream(), self.depth() + 1)
    }
}

/// Checks that tokens are not nested deeper than the given depth.
///
/// # Errors
/// A mistake at the token that is too deep.
pub(crate) fn check(deepest: usize, tokens: &TokenStream, notation: Notation) -> syn::Result<()> {
    let mut levels = vec![Level::new(tokens.clone(), 0)];
    while let Some(level) = levels.last_mut() {
        let Some(token) = level.rest.next() else {
            levels.pop();
            continue;
        };
        let inside = match &token {
            TokenTree::Punct(sign) => {
                level.sign(sign);
                None
            }
            TokenTree::Group(group) => Some(level.enter(group)),
            TokenTree::Ident(_) | TokenTree::Literal(_) => {
                level.operand();
                None
            }
        };
        if notation != Notation::Attribute && level.joined.into_iter().any(|parts| parts > LONGEST) {
            let message = format!("a sum has at most {LONGEST} terms here, and a product as many factors");
            return Err(syn::Error::new(first(&token), message));
        }
        let depth = inside.as_ref().unwrap_or(level).depth();
        if depth > deepest {
            let remedy = notation.either("name parts of it by `let`", "write it with fewer parentheses");
            let message = format!("this is nested more than {deepest} deep: {remedy}");
            return Err(syn::Error::new(first(&token), message));
        }
        levels.extend(inside);
    }
    Ok(())
}

fn first(token: &TokenTree) -> Span {
    match token {
        TokenTree::Group(group) if group.delimiter() != Delimiter::None => group.span_open(),
        token => token.span(),
    }
}
