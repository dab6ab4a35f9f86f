//! The grammar of formulas, and the tokens of Rust that they become.
//!
//! ```text
//! formula   = ["ψ" "="] ["return"] sum ["where" condition {"," condition}]
//! condition = sum ("<" | ">" | "<=" | ">=" | "!=") sum
//! sum       = product {("+" | "-") product}
//! product   = sign {("*" | "/" | nothing) sign}
//! sign      = {"+" | "-"} power
//! power     = atom ["^" sign]
//! atom      = number | {module "."} name | name "[" index "]" | function "(" sum ")" | function name
//!           | power "(" sum "," sum ")" | invariant "(" tensors ")" | "sum" "(" index "," sum ")" | "(" sum ")"
//! ```
//!
//! So −x² is −(x²), a/2 b is (a/2) b, and x^y^z is x^(y^z). The meaning of names is in [`spellings`].

use std::collections::{HashMap, HashSet};

use piola_codegen::read::diagnostics::Diagnostics;
use piola_codegen::read::parse::{WORDS, is_reserved};
use piola_codegen::read::spelling::{greek, nearest, spelled_out};
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};

use super::spellings::{self, Invariant, Meaning};
use super::{FormulaOptions, advice};
use tokens::{Tokens, parenthesised, parenthesised_as, real, span, whole};

mod tokens;

/// The names of the stretches in a declaration.
pub(super) const STRETCHES: [&str; 3] = ["l1", "l2", "l3"];

/// Levels of parentheses and exponents: fewer than the compiler bears.
const DEEPEST: usize = 48;

/// Maximum number of names without values in one message.
const MOST_ASKED: usize = 20;

/// A formula as the parts of a declaration.
pub(super) struct Parsed {
    /// The arguments of the function.
    pub(super) parameters: Vec<TokenStream>,
    pub(super) body: TokenStream,
    /// Conditions of the domain.
    pub(super) domain: Vec<TokenStream>,
    /// Conditions on parameters alone.
    pub(super) admissible: Vec<TokenStream>,
}

/// Reads a formula.
///
/// # Errors
/// The first mistake of its form, or all names that have no value and need one; the compiler resolves the
/// other names.
pub(super) fn parse(tokens: TokenStream, options: &FormulaOptions) -> syn::Result<Parsed> {
    let bulk = options.bulk.as_ref().map(|bulk| {
        syn::parse_str::<Ident>(bulk).map_err(|_| {
            syn::Error::new(Span::call_site(), format!("`{bulk}` is not a name for a bulk modulus"))
        })
    });
    let bulk = bulk.transpose()?;
    let names = options.parameters.iter().flatten().map(|(name, _)| name);
    let given: HashSet<String> = names.chain(&options.bulk).cloned().collect();
    let spelled_out = given.iter().filter_map(|name| Some((spelled_out(name), syn::parse_str(name).ok()?)));
    let mut parser = Parser {
        tokens: Tokens::new(tokens),
        spelled_out: spelled_out.collect(),
        given,
        names: Vec::new(),
        places: HashMap::new(),
        indices: Vec::new(),
        has_traces: false,
        depth: 0,
    };
    parser.left_side();
    let mut body = parser.sum()?;
    let (mut domain, mut admissible) = (Vec::new(), Vec::new());
    if parser.tokens.take_word("where") {
        loop {
            let (condition, is_of_deformation) = parser.condition()?;
            if is_of_deformation { &mut domain } else { &mut admissible }.push(condition);
            if parser.tokens.take_sign(",").is_none() {
                break;
            }
        }
    }
    parser.tokens.end()?;
    if let Some(bulk) = bulk {
        let bulk = parser.parameter(&at(bulk, Span::call_site()), false)?;
        body = quote!(#body + #bulk / 2.0 * (J - 1.0).powi(2));
    }
    if let (Some(all), false) = (&options.parameters, options.further) {
        parser.ask(options)?;
        // One that the formula does not use is reported.
        for name in all.iter().filter_map(|(name, _)| syn::parse_str::<Ident>(name).ok()) {
            // It stands nowhere in the formula.
            parser.parameter(&at(name, Span::call_site()), false)?;
        }
    }
    let docs: HashMap<&str, &str> =
        options.parameters.iter().flatten().map(|(name, doc)| (name.as_str(), doc.as_str())).collect();
    let is_declared = |name: &str| parser.given.contains(name) || advice(name).is_none();
    let parameters = parser.names.iter().filter(|(_, _, name)| is_declared(name));
    let parameters = parameters.map(|(name, is_list, plain)| {
        let doc = docs.get(plain.as_str()).filter(|doc| !doc.is_empty()).map(|doc| {
            let doc = format!(" {doc}");
            quote!(#[doc = #doc])
        });
        let ty = if *is_list { quote!(Vec<f64>) } else { quote!(f64) };
        quote!(#doc #name: #ty)
    });
    Ok(Parsed {
        parameters: parameters.collect(),
        body,
        domain,
        admissible: admissible.into_iter().map(with_path_of_pi).collect(),
    })
}

struct Parser {
    tokens: Tokens,
    /// Names that are parameters, regardless of any other meaning.
    given: HashSet<String>,
    /// These names by their spelling without Greek letters.
    spelled_out: HashMap<String, Ident>,
    /// Names that may be parameters, in the order of their first use: in the declaration, whether they are
    /// lists, and as they are written.
    names: Vec<(Ident, bool, String)>,
    /// The places of the names in that list.
    places: HashMap<String, usize>,
    /// Indices of the sums around.
    indices: Vec<Ident>,
    /// True if a function of tensors has been read.
    has_traces: bool,
    depth: usize,
}

impl Parser {
    /// Skips `ψ =`, `W(I1, I2) =` or `W[I1_, I2_] :=`, and `return`.
    fn left_side(&mut self) {
        let is_name = matches!(self.tokens.peek(), Some(TokenTree::Ident(_)));
        let has_arguments = matches!(self.tokens.ahead(1), Some(TokenTree::Group(_)));
        let colon = 1 + usize::from(has_arguments);
        let equal = colon + usize::from(self.tokens.is_sign(colon, ':'));
        if is_name && self.tokens.is_sign(equal, '=') && !self.tokens.is_sign(equal + 1, '=') {
            self.tokens.skip(equal + 1);
        }
        self.tokens.take_word("return");
    }

    fn condition(&mut self) -> syn::Result<(TokenStream, bool)> {
        self.has_traces = false;
        let left = self.sum()?;
        let comparison =
            ["<=", ">=", "!=", "<", ">"].into_iter().find_map(|sign| self.tokens.take_sign(sign));
        let Some(comparison) = comparison else {
            return Err(self.tokens.mistake("a condition is a comparison, such as `J > 0` or `mu > 0`"));
        };
        let right = self.sum()?;
        let condition = quote!(#left #comparison #right);
        let names = piola_codegen::read::parse::identifiers(condition.clone());
        let is_of_deformation = self.has_traces
            || names.iter().any(|name| WORDS.iter().chain(&STRETCHES).any(|word| name == word));
        Ok((condition, is_of_deformation))
    }

    /// A sum with its products, token by token: their signs bind in Rust as they do in formulas.
    fn sum(&mut self) -> syn::Result<TokenStream> {
        let mut sum = self.sign()?;
        loop {
            match self.tokens.take_either(["*", "/"]).or_else(|| self.plus_or_minus()) {
                Some(sign) => sum.extend(sign),
                None if self.tokens.begins_factor() => sum.extend(quote!(*)),
                None => return Ok(sum),
            }
            sum.extend(self.sign()?);
        }
    }

    fn plus_or_minus(&mut self) -> Option<TokenStream> {
        ["+", "-"].into_iter().find_map(|sign| self.tokens.take_sign(sign))
    }

    /// A power, with signs before it.
    fn sign(&mut self) -> syn::Result<TokenStream> {
        let mut minus = None;
        while let Some(sign) = self.plus_or_minus() {
            if sign.to_string() == "-" {
                minus = if minus.is_some() { None } else { Some(sign) };
            }
        }
        let power = self.power()?;
        Ok(quote!(#minus #power))
    }

    fn power(&mut self) -> syn::Result<TokenStream> {
        let base = self.atom()?;
        let Some(caret) = self.tokens.take_either(["^", "**"]) else { return Ok(base) };
        let span = span(&caret);
        self.deeper(span)?;
        let exponent = self.sign()?;
        self.depth -= 1;
        Ok(raised(&base, exponent, span))
    }

    /// An operand that methods may be called on.
    fn atom(&mut self) -> syn::Result<TokenStream> {
        match self.tokens.advance() {
            Some(TokenTree::Literal(literal)) => Ok(real(literal)?.to_token_stream()),
            Some(TokenTree::Group(group)) => {
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

    /// A name, with its argument if it is that of a function.
    fn name(&mut self, mut name: Ident) -> syn::Result<TokenStream> {
        while !self.given.contains(&name.to_string())
            && spellings::MODULES.contains(&name.to_string().as_str())
            && let Some(function) = self.tokens.take_member()
        {
            name = function;
        }
        let name = self.as_given(name);
        let text = name.to_string();
        let is_given = self.given.contains(&text) || self.indices.contains(&name);
        if !is_given && text.starts_with('Σ') {
            let message = "write a sum over lists as `sum(p, mu[p]*…)`, over the stretches as `sum(l, l^2)`, and others term by term";
            return Err(syn::Error::new(name.span(), message));
        }
        // `Log[J]` of Mathematica is not an entry of a list.
        let is_meant = |name: &str| !is_given && spellings::meaning(name).is_some();
        let is_argument = |index: String| {
            (is_meant(&text) || is_meant(&index)) && self.indices.iter().all(|other| *other != index)
        };
        match self.tokens.peek().cloned() {
            Some(TokenTree::Group(group))
                if group.delimiter() == Delimiter::Parenthesis || is_argument(group.stream().to_string()) =>
            {
                self.tokens.advance();
                return match text.as_str() {
                    _ if is_given => Err(no_function(&name)),
                    "sum" => self.summation(&name, &group),
                    _ => self.call(&name, &group),
                };
            }
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => {
                self.tokens.advance();
                let list = self.parameter(&name, true)?;
                return Ok(quote!(#list #group));
            }
            _ => {}
        }
        if is_given {
            return Ok(match self.indices.contains(&name) {
                true => name.to_token_stream(),
                false => self.parameter(&name, false)?.to_token_stream(),
            });
        }
        match spellings::meaning(&text) {
            Some(Meaning::Name(rust)) => rust_at(rust, name.span()),
            Some(Meaning::Function(_) | Meaning::OfTensors(_)) => self.open_call(&name),
            Some(Meaning::Power) | None => Ok(self.parameter(&name, false)?.to_token_stream()),
        }
    }

    /// A name without a value or another meaning as the one that has a value and differs in the spelling of
    /// Greek letters alone: `kappa` for `κ`.
    fn as_given(&self, name: Ident) -> Ident {
        let text = name.to_string();
        let has_meaning = self.given.contains(&text)
            || self.indices.contains(&name)
            || matches!(spellings::meaning(&text), Some(Meaning::Name(_)));
        match self.spelled_out.get(&spelled_out(&text)) {
            Some(given) if !has_meaning => at(given.clone(), name.span()),
            _ => name,
        }
    }

    /// `ln J`, with one name for its argument.
    fn open_call(&mut self, name: &Ident) -> syn::Result<TokenStream> {
        let write = |form: String| Err(syn::Error::new(name.span(), form));
        let Some(TokenTree::Ident(argument)) = self.tokens.peek().cloned() else {
            return write(format!("`{name}` is a function: write `{name}( … )`"));
        };
        self.tokens.advance();
        if self.tokens.begins_exponent() {
            return write(format!(
                "write `{name}({argument})^n` or `{name}({argument}^n)`, whichever is meant"
            ));
        }
        let span = argument.span();
        self.call(name, &parenthesised(TokenTree::Ident(argument).into(), span))
    }

    /// `ln(x)` as `x.ln()`.
    fn call(&mut self, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        let text = name.to_string();
        let method = match spellings::meaning(&text) {
            Some(Meaning::OfTensors(invariant)) => return self.invariant(invariant, name, group),
            Some(Meaning::Power) => return self.power_of(name, group),
            Some(Meaning::Name(_)) => return Err(no_function(name)),
            _ if self.places.contains_key(&text) => return Err(no_function(name)),
            Some(Meaning::Function(method)) => method,
            None if greek(&spelled_out(&text)).is_some() => return Err(no_function(name)),
            None => text.as_str(),
        };
        let method = Ident::new(method, name.span());
        let argument = self.inside(group, Self::sum)?;
        // A mistake in the call is underlined from its name to the end.
        let argument = parenthesised(argument, whole_call(name, group));
        let end = group.span_close();
        Ok(quote_spanned!(end=> #argument.#method()))
    }

    /// `pow(x, n)` as `x.powf(n)`.
    fn power_of(&mut self, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        let (base, exponent) = self.inside(group, |parser| {
            let base = parser.sum()?;
            if parser.tokens.take_sign(",").is_none() {
                return Err(syn::Error::new(name.span(), format!("a power is `{name}(x, n)`, or `x^n`")));
            }
            Ok((base, parser.sum()?))
        })?;
        let base = parenthesised(base, whole_call(name, group)).to_token_stream();
        Ok(raised(&base, exponent, group.span_close()))
    }

    /// `tr(C)` as `I1`.
    fn invariant(&mut self, invariant: Invariant, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        /// Longer than any arguments, and nested no deeper than text may be.
        const LONGEST: usize = 100;
        let text = match group.span().byte_range().len() {
            0..=LONGEST => group.stream().to_string().replace(char::is_whitespace, ""),
            _ => String::new(),
        };
        let rust =
            spellings::of_tensors(invariant, &text, |name| self.given.contains(name)).map_err(|advice| {
                syn::Error::new(name.span(), format!("`{name}` of this is not known: {advice}"))
            })?;
        self.has_traces = true;
        rust_at(&rust, whole_call(name, group))
    }

    /// `sum(p, mu[p])` as `sum(|p| mu[p])`.
    fn summation(&mut self, name: &Ident, group: &Group) -> syn::Result<TokenStream> {
        let (index, term) = self.inside(group, |parser| {
            let index = match parser.tokens.advance() {
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
        let summand = parenthesised(quote_spanned!(name.span()=> |#index| #term), group.span());
        Ok(quote!(#name #summand))
    }

    /// Reads all tokens of a group.
    fn inside<T>(&mut self, group: &Group, read: impl FnOnce(&mut Self) -> syn::Result<T>) -> syn::Result<T> {
        self.deeper(group.span())?;
        let outer = std::mem::replace(&mut self.tokens, Tokens::inside(group));
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

    /// The name of a parameter in the declaration. One that means something else there is marked by `r#`.
    fn parameter(&mut self, name: &Ident, is_list: bool) -> syn::Result<Ident> {
        let text = name.to_string();
        if let Some(&place) = self.places.get(&text) {
            let (known, was_list, _) = &mut self.names[place];
            *was_list |= is_list;
            return Ok(at(known.clone(), name.span()));
        }
        let is_keyword = syn::parse_str::<Ident>(&text).is_err();
        let declared = match text.as_str() {
            "_" | "self" | "Self" | "super" | "crate" => {
                let message = format!("`{text}` cannot be the name of a parameter: give it another name");
                return Err(syn::Error::new(name.span(), message));
            }
            _ if is_keyword || is_reserved(name) || STRETCHES.contains(&text.as_str()) => {
                Ident::new_raw(&text, name.span())
            }
            _ => name.clone(),
        };
        self.places.insert(text.clone(), self.names.len());
        self.names.push((declared.clone(), is_list, text));
        Ok(declared)
    }

    /// Reports all names without a value.
    fn ask(&self, options: &FormulaOptions) -> syn::Result<()> {
        let missing = self.names.iter().filter(|(_, _, text)| !self.given.contains(text));
        let mut mistakes = Diagnostics::default();
        for (name, _, text) in missing.take(MOST_ASKED) {
            let near = nearest(text, self.given.iter().map(String::as_str));
            let form = options.value.map(|form| form.replace("NAME", text));
            let value = form.map_or("give it one".to_owned(), |form| format!("give it one by `{form}`"));
            let hint = match (near, advice(text)) {
                (Some(near), _) => format!("did you mean `{near}`?"),
                (None, Some(advice)) => {
                    format!("{value}, or, if it has its usual meaning in papers, {advice}")
                }
                (None, None) => value,
            };
            mistakes.error(name, format!("`{text}` has no value: {hint}"));
        }
        mistakes.finish(Some(()))
    }
}

/// Error for a name before a parenthesis that is not a function.
fn no_function(name: &Ident) -> syn::Error {
    syn::Error::new(name.span(), format!("`{name}` is not a function: write `{name} * ( … )` for a product"))
}

/// The place of a call, from its name to its end.
fn whole_call(name: &Ident, group: &Group) -> Span {
    name.span().join(group.span()).unwrap_or(name.span())
}

/// A name at another place.
fn at(mut name: Ident, span: Span) -> Ident {
    name.set_span(span);
    name
}

/// The tokens of a text in Rust, all at one place.
fn rust_at(rust: &str, span: Span) -> syn::Result<TokenStream> {
    let tokens: TokenStream = rust.parse().map_err(|_| syn::Error::new(span, "this is not a formula"))?;
    Ok(mapped(tokens, &|mut token| {
        token.set_span(span);
        token.into()
    }))
}

/// Tokens with others instead of each, also within groups.
fn mapped(tokens: TokenStream, map: &dyn Fn(TokenTree) -> TokenStream) -> TokenStream {
    let each = |token: TokenTree| match token {
        TokenTree::Group(group) => {
            let inside = mapped(group.stream(), map);
            map(parenthesised_as(group.delimiter(), inside, group.span()).into())
        }
        token => map(token),
    };
    tokens.into_iter().flat_map(each).collect()
}

/// A power, whose sign is at this place.
fn raised(base: &TokenStream, exponent: TokenStream, span: Span) -> TokenStream {
    let (method, exponent) = match whole(&exponent) {
        Some(whole) => (Ident::new("powi", span), whole),
        None => (Ident::new("powf", span), exponent),
    };
    // The power ends where its exponent does.
    let last = exponent.clone().into_iter().last().map_or(span, |last| last.span());
    let argument = parenthesised(exponent, last);
    quote_spanned!(span=> #base.#method #argument)
}

/// A condition on parameters, emitted as it is except that π gets its path.
fn with_path_of_pi(condition: TokenStream) -> TokenStream {
    mapped(condition, &|token| match token {
        TokenTree::Ident(name) if name == "PI" => quote!(std::f64::consts::PI),
        token => token.into(),
    })
}
