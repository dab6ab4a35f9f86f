//! The parser: from tokens to a [`Declaration`], the form of the item without the meaning of its body.
//!
//! A declaration is an ordinary Rust function from stretches and parameters to the energy density, so rustfmt
//! and editors treat it as one:
//!
//! ```text
//! #[material(domain(J > 0.0), admissible(mu > 0.0), extend)]
//! pub fn NeoHookean([l1, l2, l3]: [f64; 3], /// Shear modulus, Pa.
//!                   mu: f64) -> f64 { … }
//! ```

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Expr, Ident, Type, Visibility};

use crate::algebra::expr::Length;
use crate::read::diagnostics::Diagnostics;
use crate::read::unit::Unit;
pub(crate) use function::Function;
pub use lengths::Entries;
pub(crate) use nesting::{DEEPEST_FILE, check};
pub use options::Options;
use signature::Reader;
pub use signature::is_reserved;
pub(crate) use signature::{entry, is_f64, is_type, is_u32, is_vector, may_be_function};
pub use typical::{Typical, Values};

mod function;
mod lengths;
mod nesting;
mod options;
mod signature;
mod typical;

/// An energy as declared.
pub struct Declaration {
    /// Documentation and other attributes of the item.
    pub attributes: Vec<Attribute>,
    /// Visibility of the type.
    pub visibility: Visibility,
    /// Name of the type.
    pub name: Ident,
    /// Names of the constant generics, each the length of lists.
    pub generics: Vec<Ident>,
    /// Names of the three stretches.
    pub stretches: [Ident; 3],
    /// Parameters in the order of the declaration.
    pub parameters: Vec<Parameter>,
    /// Lengths of lists.
    pub lengths: Vec<Entries>,
    /// Names whose own declaration is a mistake: their uses in the body are not reported again.
    pub mistaken: Vec<Ident>,
    /// The energy.
    pub body: syn::Block,
    /// The arguments of the attribute.
    pub options: Options,
}

/// A parameter of the energy.
pub struct Parameter {
    /// Its name.
    pub name: Ident,
    /// Its documentation.
    pub doc: String,
    /// The documentation as written.
    pub attributes: Vec<Attribute>,
    /// A number, a list or a function.
    pub kind: Kind,
    /// True if its numbers are whole, `u32`: exponents and nothing else.
    pub is_whole: bool,
}

/// The kind of a parameter.
pub enum Kind {
    /// A number.
    Number,
    /// A list of numbers.
    List(Length),
    /// A function of one variable, of a type that implements `piola::Univariate`.
    Function(Box<Type>),
}

impl Parameter {
    /// The length of a list.
    #[must_use]
    pub fn length(&self) -> Option<Length> {
        match self.kind {
            Kind::List(length) => Some(length),
            Kind::Number | Kind::Function(_) => None,
        }
    }

    /// The Rust type of its numbers.
    pub(crate) fn number_type(&self) -> Type {
        if self.is_whole { syn::parse_quote!(u32) } else { syn::parse_quote!(f64) }
    }

    /// True if the parameter is a function.
    #[must_use]
    pub fn is_function(&self) -> bool {
        matches!(self.kind, Kind::Function(_))
    }

    /// The unit that its documentation states, for a function that of its values. A whole exponent has none,
    /// and its documentation need not state that.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        if self.is_whole { Some(Unit::Dimensionless) } else { Unit::read(&self.doc).ok().flatten() }
    }
}

impl Declaration {
    /// The Rust type of a parameter.
    pub(crate) fn parameter_type(&self, parameter: &Parameter) -> Type {
        let number = parameter.number_type();
        match &parameter.kind {
            Kind::Number => number,
            Kind::List(length) => match &self.lengths[*length] {
                Entries::Known(length) => syn::parse_quote!([#number; #length]),
                Entries::AtRunTime(_) => syn::parse_quote!(::std::vec::Vec<#number>),
            },
            Kind::Function(ty) => (**ty).clone(),
        }
    }

    /// The place of the parameter of this name.
    #[must_use]
    pub fn place(&self, name: &Ident) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == *name)
    }

    /// True if a parameter is a list whose length is known at run time only.
    pub(crate) fn is_vector(&self, parameter: &Parameter) -> bool {
        parameter.length().is_some_and(|length| self.lengths[length].are_known_at_run_time())
    }

    /// True if all parameters are plain real numbers, so that a material can be copied and can keep a value
    /// for each lane instead of each number.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        !self.has_functions()
            && !self.has_whole_exponents()
            && !self.lengths.iter().any(Entries::are_known_at_run_time)
    }

    /// True if some parameter is a whole exponent or a list of whole exponents.
    pub(crate) fn has_whole_exponents(&self) -> bool {
        self.parameters.iter().any(|parameter| parameter.is_whole)
    }

    /// True if some parameter is a function, about which nothing is known here.
    #[must_use]
    pub fn has_functions(&self) -> bool {
        self.parameters.iter().any(Parameter::is_function)
    }

    /// True if the documentation of a parameter states a unit.
    pub(crate) fn has_units(&self) -> bool {
        self.parameters.iter().any(|parameter| matches!(Unit::read(&parameter.doc), Ok(Some(_))))
    }
}

/// Names with a meaning in every energy.
pub const WORDS: [&str; 5] = ["J", "I1", "I2", "I1b", "I2b"];

/// Reads the attribute's arguments and its item, and adds mistakes to the diagnostics: the rest of the
/// declaration may have further ones in its meaning.
pub fn parse_declaration(
    arguments: TokenStream,
    item: TokenStream,
    diagnostics: &mut Diagnostics,
) -> Option<Declaration> {
    let mut options = Options::read(arguments, diagnostics);
    let Function { attributes, visibility, signature, body } = diagnostics.take(Function::read(item))?;
    let Reader { generics, stretches, mut parameters, mut lengths, mistaken, .. } =
        Reader::read(&signature, diagnostics);
    if let Some(typical) = options.typical.as_mut().filter(|_| mistaken.is_empty()) {
        typical.check(&parameters, diagnostics);
    }
    let is_shallow = check(nesting::DEEPEST, &body, diagnostics.notation());
    let body: syn::Block = diagnostics.take(is_shallow.and_then(|()| syn::parse2(body)))?;
    lengths::unite(&mut parameters, &mut lengths, &body, &options);
    Some(Declaration {
        attributes,
        visibility,
        name: signature.ident,
        generics,
        stretches: stretches?,
        parameters,
        lengths,
        mistaken,
        body,
        options,
    })
}

/// All names among tokens.
#[must_use]
pub fn identifiers(tokens: TokenStream) -> Vec<Ident> {
    let names = tokens.into_iter().map(|token| match token {
        TokenTree::Ident(name) => vec![name],
        TokenTree::Group(group) => identifiers(group.stream()),
        _ => Vec::new(),
    });
    names.flatten().collect()
}

/// True if one of the names is among tokens.
pub(crate) fn mentions(tokens: impl ToTokens, names: &[&str]) -> bool {
    identifiers(tokens.into_token_stream()).iter().any(|found| names.iter().any(|name| found == name))
}

/// The first list of a condition with the index that stands for all entries, as in `mu[p] > 0.0`.
pub(crate) fn indexed_list(condition: &Expr) -> Option<(Ident, Ident)> {
    indexed_lists(condition.to_token_stream()).into_iter().next()
}

/// All names with an index that is a name, as in `mu[p]`, in order.
pub(crate) fn indexed_lists(tokens: TokenStream) -> Vec<(Ident, Ident)> {
    let mut found = Vec::new();
    let mut list = None;
    for token in tokens {
        match token {
            TokenTree::Ident(name) => list = Some(name),
            TokenTree::Group(group) => {
                let is_index = group.delimiter() == Delimiter::Bracket;
                let index = syn::parse2(group.stream()).ok().filter(|_| is_index);
                match list.take().zip(index) {
                    Some(pair) => found.push(pair),
                    None => found.extend(indexed_lists(group.stream())),
                }
            }
            _ => list = None,
        }
    }
    found
}

/// The text of documentation comments, lines joined by spaces, paragraphs by newlines.
#[must_use]
pub fn documentation(attributes: &[Attribute]) -> String {
    let mut text = String::new();
    for attribute in attributes {
        if let syn::Meta::NameValue(doc) = &attribute.meta
            && doc.path.is_ident("doc")
            && let Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(line), .. }) = &doc.value
        {
            let line = line.value();
            match line.trim() {
                "" => text.push('\n'),
                line => {
                    if !text.is_empty() && !text.ends_with('\n') {
                        text.push(' ');
                    }
                    text.push_str(line);
                }
            }
        }
    }
    text
}
