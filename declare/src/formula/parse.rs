//! The grammar of formulas, and the tokens of Rust that they become.
//!
//! ```text
//! formula   = ["ψ" "="] sum ["where" condition {"," condition}]
//! condition = sum ("<" | ">" | "<=" | ">=" | "!=") sum
//! sum       = product {("+" | "-") product}
//! product   = sign {("*" | "/" | nothing) sign}
//! sign      = {"+" | "-"} power
//! power     = atom ["^" sign]
//! atom      = number | name | name "[" index "]" | function "(" sum ")" | "sum" "(" index "," sum ")" | "(" sum ")"
//! ```
//!
//! So −x² is −(x²), a/2 b is (a/2) b, and x^y^z is x^(y^z).

use std::iter::Peekable;

use piola_codegen::read::parse::WORDS;
use proc_macro2::{Delimiter, Group, Ident, Literal, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};

use super::{FormulaOptions, is_notation};

/// The names of the stretches in a declaration.
pub(super) const STRETCHES: [&str; 3] = ["l1", "l2", "l3"];

/// Levels of parentheses and exponents: fewer than the compiler bears.
const DEEPEST: usize = 48;

/// A formula as the parts of a declaration.
pub(super) struct Parsed {
    pub(super) name: Ident,
    pub(super) summary: String,
    pub(super) parameters: Vec<Parameter>,
    pub(super) body: TokenStream,
    /// Conditions of the domain.
    pub(super) domain: Vec<TokenStream>,
    /// Conditions on parameters alone.
    pub(super) admissible: Vec<TokenStream>,
}

/// A name that stands for a parameter.
pub(super) struct Parameter {
    name: Ident,
    doc: String,
    is_list: bool,
}

impl Parameter {
    /// The argument of the function.
    pub(super) fn tokens(&self) -> TokenStream {
        let Self { name, doc, is_list } = self;
        let doc = (!doc.is_empty()).then(|| {
            let doc = format!(" {doc}");
            quote!(#[doc = #doc])
        });
        let ty = if *is_list { quote!(Vec<f64>) } else { quote!(f64) };
        quote!(#doc #name: #ty)
    }
}

/// Reads a formula.
///
/// # Errors
/// The first mistake of its form; what its names mean is the business of the compiler.
pub(super) fn parse(tokens: TokenStream, options: &FormulaOptions) -> syn::Result<Parsed> {
    let mut parser = Parser { tokens: Tokens::new(tokens), names: Vec::new(), indices: Vec::new(), depth: 0 };
    parser.left_side();
    let mut body = parser.sum()?;
    let (mut domain, mut admissible) = (Vec::new(), Vec::new());
    if parser.tokens.take_word("where").is_some() {
        loop {
            let (condition, is_of_deformation) = parser.condition()?;
            if is_of_deformation { &mut domain } else { &mut admissible }.push(condition);
            if parser.tokens.take_sign(",").is_none() {
                break;
            }
        }
    }
    parser.tokens.end()?;
    if let Some(bulk) = &options.bulk {
        let bulk = syn::parse_str::<Ident>(bulk).map_err(|_| {
            syn::Error::new(Span::call_site(), format!("`{bulk}` is no name for a bulk modulus"))
        })?;
        parser.use_name(&bulk, false);
        body = quote!(#body + #bulk / 2.0 * (J - 1.0).powi(2));
    }
    // One that the formula does not use is told, and is what another may have been meant for.
    for (name, _) in options.parameters.iter().flatten() {
        if let Ok(name) = syn::parse_str::<Ident>(name) {
            parser.use_name(&name, false);
        }
    }
    let is_declared = |name: &str| match &options.parameters {
        Some(known) => known.iter().any(|(known, _)| known == name) || options.bulk.as_deref() == Some(name),
        None => !is_notation(name),
    };
    let doc = |name: &str| {
        let known = options.parameters.iter().flatten().find(|(known, _)| known == name);
        known.map(|(_, doc)| doc.clone()).unwrap_or_default()
    };
    let parameters = parser.names.into_iter().filter(|(name, _)| is_declared(&name.to_string()));
    Ok(Parsed {
        name: Ident::new("Energy", Span::call_site()),
        summary: "Energy of a formula.".to_owned(),
        parameters: parameters
            .map(|(name, is_list)| Parameter { doc: doc(&name.to_string()), name, is_list })
            .collect(),
        body,
        domain,
        admissible,
    })
}

struct Parser {
    tokens: Tokens,
    /// Names that may be parameters, in the order of their first use, and whether they are lists.
    names: Vec<(Ident, bool)>,
    /// Indices of the sums around.
    indices: Vec<Ident>,
    depth: usize,
}

impl Parser {
    /// Skips `ψ =`.
    fn left_side(&mut self) {
        let mut ahead = self.tokens.0.clone();
        let is_psi = ahead
            .next()
            .is_some_and(|token| ["ψ", "psi", "Psi", "Ψ", "W"].contains(&token.to_string().as_str()));
        let is_equal = ahead
            .next()
            .is_some_and(|token| matches!(token, TokenTree::Punct(sign) if sign.as_char() == '='));
        if is_psi && is_equal {
            self.tokens.0 = ahead;
        }
    }

    fn condition(&mut self) -> syn::Result<(TokenStream, bool)> {
        let left = self.sum()?;
        let comparison =
            ["<=", ">=", "!=", "<", ">"].into_iter().find_map(|sign| self.tokens.take_sign(sign));
        let Some(comparison) = comparison else {
            return Err(self.tokens.mistake("a condition is a comparison, such as `J > 0` or `mu > 0`"));
        };
        let right = self.sum()?;
        let condition = quote!(#left #comparison #right);
        let names = piola_codegen::read::parse::identifiers(condition.clone());
        let is_of_deformation =
            names.iter().any(|name| WORDS.iter().chain(&STRETCHES).any(|word| name == word));
        Ok((condition, is_of_deformation))
    }

    fn sum(&mut self) -> syn::Result<TokenStream> {
        let mut sum = self.product()?;
        while let Some(sign) = self.tokens.take_sign("+").or_else(|| self.tokens.take_sign("-")) {
            let term = self.product()?;
            sum.extend(sign);
            sum.extend(term);
        }
        Ok(sum)
    }

    fn product(&mut self) -> syn::Result<TokenStream> {
        let mut product = self.sign()?;
        loop {
            if let Some(sign) = self.tokens.take_sign("*").or_else(|| self.tokens.take_sign("/")) {
                product.extend(sign);
            } else if self.tokens.begins_factor() {
                product.extend(quote!(*));
            } else {
                return Ok(product);
            }
            product.extend(self.sign()?);
        }
    }

    /// A power, with signs before it.
    fn sign(&mut self) -> syn::Result<TokenStream> {
        let mut minus = None;
        while let Some(sign) = self.tokens.take_sign("+").or_else(|| self.tokens.take_sign("-")) {
            if sign.to_string() == "-" {
                minus = if minus.is_some() { None } else { Some(sign) };
            }
        }
        let power = self.power()?;
        Ok(quote!(#minus #power))
    }

    fn power(&mut self) -> syn::Result<TokenStream> {
        let base = self.atom()?;
        let Some(caret) = self.tokens.take_sign("^").or_else(|| self.tokens.take_sign("**")) else {
            return Ok(base);
        };
        let span = span(&caret);
        self.deeper(span)?;
        let exponent = self.sign()?;
        self.depth -= 1;
        let (method, exponent) = match whole(&exponent) {
            Some(whole) => (Ident::new("powi", span), whole),
            None => (Ident::new("powf", span), exponent),
        };
        // The power ends where its exponent does.
        let last = exponent.clone().into_iter().last().map_or(span, |last| last.span());
        let argument = parenthesised(exponent, last);
        Ok(quote_spanned!(span=> #base.#method #argument))
    }

    /// An operand that methods may be called on.
    fn atom(&mut self) -> syn::Result<TokenStream> {
        match self.tokens.0.next() {
            Some(TokenTree::Literal(literal)) => Ok(real(literal)?.to_token_stream()),
            Some(TokenTree::Group(group)) if group.delimiter() != Delimiter::Brace => {
                let inner = self.inside(&group, Self::sum)?;
                Ok(parenthesised(inner, group.span()).to_token_stream())
            }
            Some(TokenTree::Ident(name)) => self.name(name),
            Some(other) => Err(syn::Error::new(
                other.span(),
                format!("a number, a name or `(` is expected here, not `{other}`"),
            )),
            None => Err(self.tokens.mistake("a formula ends with a number, a name or `)`")),
        }
    }

    fn name(&mut self, name: Ident) -> syn::Result<TokenStream> {
        let text = name.to_string();
        match self.tokens.0.peek().cloned() {
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => {
                self.tokens.0.next();
                return if text == "sum" { self.summation(&name, &group) } else { self.call(&name, &group) };
            }
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => {
                self.tokens.0.next();
                self.use_name(&name, true);
                return Ok(quote!(#name #group));
            }
            _ => {}
        }
        if let Some(stretch) = stretch(&text) {
            return Ok(Ident::new(stretch, name.span()).to_token_stream());
        }
        if ["pi", "π"].contains(&text.as_str()) {
            return Ok(Ident::new("PI", name.span()).to_token_stream());
        }
        let is_known = WORDS.contains(&text.as_str()) || text == "PI" || self.indices.contains(&name);
        if !is_known {
            if syn::parse_str::<Ident>(&text).is_err() {
                let message = format!("`{text}` is a word of Rust: give the parameter another name");
                return Err(syn::Error::new(name.span(), message));
            }
            self.use_name(&name, false);
        }
        Ok(name.to_token_stream())
    }

    /// `ln(x)` as `x.ln()`.
    fn call(&mut self, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        let text = name.to_string();
        let method = match text.as_str() {
            "arctan" => "atan",
            "arsinh" | "arcsinh" => "asinh",
            "log1p" | "ln1p" => "ln_1p",
            "expm1" => "exp_m1",
            "log" => {
                let message = "write `ln(x)` for the natural logarithm, or `log10(x)`";
                return Err(syn::Error::new(name.span(), message));
            }
            "pow" => return Err(syn::Error::new(name.span(), "write a power as `x^n`")),
            text if self.names.iter().any(|(known, _)| known == text)
                || WORDS.contains(&text)
                || stretch(text).is_some() =>
            {
                let message = format!("`{text}` is no function: write `{text} * ( … )` for a product");
                return Err(syn::Error::new(name.span(), message));
            }
            text => text,
        };
        let method = Ident::new(method, name.span());
        let argument = self.inside(group, Self::sum)?;
        let argument = parenthesised(argument, group.span());
        Ok(quote!(#argument.#method()))
    }

    /// `sum(p, mu[p])` as `sum(|p| mu[p])`.
    fn summation(&mut self, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        let (index, term) = self.inside(group, |parser| {
            let index = match parser.tokens.0.next() {
                Some(TokenTree::Ident(index)) => Some(index),
                _ => None,
            };
            let Some(index) = index.filter(|_| parser.tokens.take_sign(",").is_some()) else {
                let message = "a sum over lists is `sum(p, mu[p] * …)`, the index first";
                return Err(syn::Error::new(group.span(), message));
            };
            parser.indices.push(index.clone());
            let term = parser.sum();
            parser.indices.pop();
            Ok((index, term?))
        })?;
        Ok(quote_spanned!(name.span()=> sum(|#index| #term)))
    }

    /// Reads all tokens of a group.
    fn inside<T>(&mut self, group: &Group, read: impl FnOnce(&mut Self) -> syn::Result<T>) -> syn::Result<T> {
        self.deeper(group.span())?;
        let outer = std::mem::replace(&mut self.tokens, Tokens::new(group.stream()));
        self.tokens.1 = group.span_close();
        let result = read(self).and_then(|result| self.tokens.end().map(|()| result));
        self.tokens = outer;
        self.depth -= 1;
        result
    }

    fn deeper(&mut self, span: Span) -> syn::Result<()> {
        self.depth += 1;
        if self.depth > DEEPEST {
            let message = format!("this is nested deeper than any formula: at most {DEEPEST} levels");
            return Err(syn::Error::new(span, message));
        }
        Ok(())
    }

    /// Notes that a name is used, and whether as a list.
    fn use_name(&mut self, name: &Ident, is_list: bool) {
        match self.names.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known |= is_list,
            None => self.names.push((name.clone(), is_list)),
        }
    }
}

/// Tokens that are left, and the place of their end.
struct Tokens(Peekable<proc_macro2::token_stream::IntoIter>, Span);

impl Tokens {
    fn new(tokens: TokenStream) -> Self {
        let last = tokens.clone().into_iter().last();
        Self(tokens.into_iter().peekable(), last.map_or_else(Span::call_site, |last| last.span()))
    }

    /// Takes a sign of one or two characters if it comes next.
    fn take_sign(&mut self, sign: &str) -> Option<TokenStream> {
        let mut ahead = self.0.clone();
        let mut taken = TokenStream::new();
        for character in sign.chars() {
            match ahead.next() {
                Some(TokenTree::Punct(found)) if found.as_char() == character => {
                    taken.extend([TokenTree::Punct(found)]);
                }
                _ => return None,
            }
        }
        // `*` is no beginning of `**`.
        let is_power =
            sign == "*" && matches!(ahead.peek(), Some(TokenTree::Punct(next)) if next.as_char() == '*');
        if is_power {
            return None;
        }
        self.0 = ahead;
        Some(taken)
    }

    fn take_word(&mut self, word: &str) -> Option<()> {
        self.0.next_if(|token| matches!(token, TokenTree::Ident(found) if found == word)).map(|_| ())
    }

    /// Whether a factor comes next, without `*` before it.
    fn begins_factor(&mut self) -> bool {
        match self.0.peek() {
            Some(TokenTree::Ident(word)) => word != "where",
            Some(TokenTree::Literal(_)) => true,
            Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
            _ => false,
        }
    }

    /// A mistake at the next token, or at the end.
    fn mistake(&mut self, message: &str) -> syn::Error {
        let span = self.0.peek().map_or(self.1, TokenTree::span);
        syn::Error::new(span, message)
    }

    fn end(&mut self) -> syn::Result<()> {
        match self.0.peek() {
            None => Ok(()),
            Some(token) => {
                let message = match token.to_string().as_str() {
                    "." => "functions are written before their arguments, as in `ln(J)`".to_owned(),
                    "=" => "an equation has nothing to do here: write the energy alone".to_owned(),
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

fn parenthesised(tokens: TokenStream, span: Span) -> Group {
    let mut group = Group::new(Delimiter::Parenthesis, tokens);
    group.set_span(span);
    group
}

fn span(tokens: &TokenStream) -> Span {
    tokens.clone().into_iter().next().map_or_else(Span::call_site, |token| token.span())
}

/// A number with a decimal point, as Rust wants it.
fn real(literal: Literal) -> syn::Result<Literal> {
    let refuse = || syn::Error::new(literal.span(), format!("`{literal}` is no number of a formula"));
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
fn whole(exponent: &TokenStream) -> Option<TokenStream> {
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

/// The stretch that a name stands for.
fn stretch(name: &str) -> Option<&'static str> {
    let number =
        ["l", "λ", "λ_", "lambda_", "lambda"].into_iter().find_map(|letter| name.strip_prefix(letter))?;
    match number {
        "1" => Some(STRETCHES[0]),
        "2" => Some(STRETCHES[1]),
        "3" => Some(STRETCHES[2]),
        _ => None,
    }
}
