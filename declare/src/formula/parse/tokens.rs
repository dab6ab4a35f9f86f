//! Tokens of a formula, one after the other.

use proc_macro2::{Delimiter, Group, Ident, Literal, Span, TokenStream, TokenTree};
use quote::quote;

/// Tokens, those that are left, and the place of their end.
pub(super) struct Tokens {
    all: Vec<TokenTree>,
    next: usize,
    end: Span,
}

impl Tokens {
    pub(super) fn new(tokens: TokenStream) -> Self {
        let all: Vec<_> = tokens.into_iter().collect();
        let end = all.last().map_or_else(Span::call_site, TokenTree::span);
        Self { all, next: 0, end }
    }

    /// The tokens within the parentheses of a group.
    pub(super) fn inside(group: &Group) -> Self {
        Self { end: group.span_close(), ..Self::new(group.stream()) }
    }

    /// Skips tokens.
    pub(super) fn skip(&mut self, count: usize) {
        self.next += count;
    }

    /// The token `by` positions after the next one.
    pub(super) fn ahead(&self, by: usize) -> Option<&TokenTree> {
        self.all.get(self.next + by)
    }

    pub(super) fn peek(&self) -> Option<&TokenTree> {
        self.ahead(0)
    }

    /// Takes the next token.
    pub(super) fn advance(&mut self) -> Option<TokenTree> {
        let token = self.peek().cloned();
        self.next += usize::from(token.is_some());
        token
    }

    pub(super) fn is_sign(&self, by: usize, character: char) -> bool {
        matches!(self.ahead(by), Some(TokenTree::Punct(found)) if found.as_char() == character)
    }

    /// Takes a sign of one or two characters if it comes next.
    pub(super) fn take_sign(&mut self, sign: &str) -> Option<TokenStream> {
        let comes = sign.chars().enumerate().all(|(k, character)| self.is_sign(k, character));
        // `*` is not the beginning of `**`.
        if !comes || sign == "*" && self.is_sign(1, '*') {
            return None;
        }
        let taken = self.all[self.next..][..sign.len()].iter().cloned().collect();
        self.next += sign.len();
        Some(taken)
    }

    /// Takes one of two signs if it comes next, also with the point before it of operations on each entry.
    pub(super) fn take_either(&mut self, signs: [&str; 2]) -> Option<TokenStream> {
        let point = usize::from(self.is_sign(0, '.'));
        self.next += point;
        let taken = signs.into_iter().find_map(|sign| self.take_sign(sign));
        if taken.is_none() {
            self.next -= point;
        }
        taken
    }

    /// Takes the name behind `.` or `::`.
    pub(super) fn take_member(&mut self) -> Option<Ident> {
        let behind = match (self.is_sign(0, '.'), self.is_sign(0, ':') && self.is_sign(1, ':')) {
            (true, _) => 1,
            (_, true) => 2,
            _ => return None,
        };
        let Some(TokenTree::Ident(member)) = self.ahead(behind).cloned() else { return None };
        self.next += behind + 1;
        Some(member)
    }

    pub(super) fn take_word(&mut self, word: &str) -> bool {
        let comes = matches!(self.peek(), Some(TokenTree::Ident(found)) if found == word);
        self.next += usize::from(comes);
        comes
    }

    /// True if a factor comes next, without `*` before it.
    pub(super) fn begins_factor(&self) -> bool {
        match self.peek() {
            Some(TokenTree::Ident(word)) => word != "where",
            Some(TokenTree::Literal(_)) => true,
            Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
            _ => false,
        }
    }

    /// True if an exponent comes next.
    pub(super) fn begins_exponent(&self) -> bool {
        self.is_sign(0, '^') || self.is_sign(0, '*') && self.is_sign(1, '*')
    }

    /// A mistake at the next token, or at the end.
    pub(super) fn mistake(&self, message: &str) -> syn::Error {
        syn::Error::new(self.peek().map_or(self.end, TokenTree::span), message)
    }

    pub(super) fn end(&self) -> syn::Result<()> {
        match self.peek() {
            None => Ok(()),
            Some(token) => {
                let message = match token.to_string().as_str() {
                    "." => "functions are written before their arguments, as in `ln(J)`".to_owned(),
                    "=" => "an equation is not expected here: write the energy alone".to_owned(),
                    "," => "parts of a formula are joined by `+ - * / ^`; a decimal point is `.`".to_owned(),
                    other => format!(
                        "`{other}` is not expected here: parts of a formula are joined by `+ - * / ^`"
                    ),
                };
                Err(syn::Error::new(token.span(), message))
            }
        }
    }
}

pub(super) fn parenthesised(tokens: TokenStream, span: Span) -> Group {
    parenthesised_as(Delimiter::Parenthesis, tokens, span)
}

pub(super) fn parenthesised_as(delimiter: Delimiter, tokens: TokenStream, span: Span) -> Group {
    let mut group = Group::new(delimiter, tokens);
    group.set_span(span);
    group
}

pub(super) fn span(tokens: &TokenStream) -> Span {
    tokens.clone().into_iter().next().map_or_else(Span::call_site, |token| token.span())
}

/// A number with a decimal point, as Rust requires.
pub(super) fn real(literal: Literal) -> syn::Result<Literal> {
    /// More characters than any number needs, for numbers are read digit by digit.
    const LONGEST: usize = 100;
    let refuse = || syn::Error::new(literal.span(), format!("`{literal}` is not a number: use `2*x`, `1e6`"));
    if literal.to_string().len() > LONGEST {
        let message = format!("a number has at most {LONGEST} digits here");
        return Err(syn::Error::new(literal.span(), message));
    }
    let digits = match syn::Lit::new(literal.clone()) {
        syn::Lit::Int(number) if number.suffix().is_empty() => number.base10_digits().to_owned() + ".0",
        syn::Lit::Float(number) if number.suffix().is_empty() => number.base10_digits().to_owned(),
        _ => return Err(refuse()),
    };
    let mut number: Literal = digits.parse().map_err(|_| refuse())?;
    number.set_span(literal.span());
    Ok(number)
}

/// An exponent that is a whole number of at most two digits, with or without a sign and parentheses.
pub(super) fn whole(exponent: &TokenStream) -> Option<TokenStream> {
    let mut tokens: Vec<TokenTree> = exponent.clone().into_iter().collect();
    if let [TokenTree::Group(group)] = &tokens[..] {
        tokens = group.stream().into_iter().collect();
    }
    let (minus, literal) = match &tokens[..] {
        [TokenTree::Literal(literal)] => (None, literal),
        [TokenTree::Punct(minus), TokenTree::Literal(literal)] if minus.as_char() == '-' => {
            (Some(minus), literal)
        }
        _ => return None,
    };
    let value: f64 = literal.to_string().parse().ok()?;
    if value.fract() != 0.0 || value > 64.0 {
        return None;
    }
    let mut whole = Literal::i64_unsuffixed(value as i64);
    whole.set_span(literal.span());
    Some(quote!(#minus #whole))
}
