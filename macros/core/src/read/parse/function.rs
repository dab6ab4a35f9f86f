//! The outer form of a declaration: a function whose body is only tokens yet.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Signature, Visibility};

use super::nesting::{DEEPEST, check};
use crate::read::notation::Notation;

/// A function with its body as tokens: while it is being typed, the body may be half an expression.
pub(crate) struct Function {
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) visibility: Visibility,
    pub(crate) signature: Signature,
    pub(crate) body: TokenStream,
}

impl Function {
    /// Reads the function below an attribute.
    pub(crate) fn read(item: TokenStream) -> syn::Result<Self> {
        check(DEEPEST, &without_body(&item), Notation::Attribute)?;
        let is_function =
            item.clone().into_iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "fn"));
        syn::parse2(item).map_err(|error| {
            let message = if is_function {
                format!("{error}; a declaration is `fn Name([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {{ … }}`")
            } else {
                "`#[material]` applies to a function from the stretches to the energy density".to_owned()
            };
            syn::Error::new(error.span(), message)
        })
    }
}

fn without_body(item: &TokenStream) -> TokenStream {
    let is_body =
        |token: &TokenTree| matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
    item.clone().into_iter().filter(|token| !is_body(token)).collect()
}

impl Parse for Function {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        Ok(Self {
            attributes: input.call(Attribute::parse_outer)?,
            visibility: input.parse()?,
            signature: input.parse()?,
            body: input.parse()?,
        })
    }
}
