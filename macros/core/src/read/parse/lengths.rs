//! Lengths of lists, and the lists that share one.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};
use syn::{Expr, ExprLit, Ident, Lit};

use super::{Declaration, Kind, Options, Parameter, indexed_lists};
use crate::algebra::expr::Length;

/// The number of entries of lists.
pub enum Entries {
    /// An integer literal or a constant generic: the lists are arrays.
    Known(Expr),
    /// Known at run time: the lists are vectors, the one of this name the first of them.
    AtRunTime(Ident),
}

impl Entries {
    /// True if it is known at run time only.
    #[must_use]
    pub fn are_known_at_run_time(&self) -> bool {
        matches!(self, Self::AtRunTime(_))
    }

    /// The number, if the declaration states it.
    #[must_use]
    pub fn stated(&self) -> Option<usize> {
        match self {
            Self::Known(Expr::Lit(ExprLit { lit: Lit::Int(length), .. })) => length.base10_parse().ok(),
            _ => None,
        }
    }

    /// The number as an expression in methods of the material.
    pub(crate) fn of_self(&self) -> TokenStream {
        self.of(&format_ident!("self"))
    }

    /// The number as an expression, for a material of this name.
    #[must_use]
    pub fn of(&self, material: &Ident) -> TokenStream {
        match self {
            Self::Known(length) => length.to_token_stream(),
            Self::AtRunTime(first) => quote!(#material.#first.len()),
        }
    }

    /// The number in the usual notation: `3`, `N`, or `N_mu` if `N` alone could be another length.
    #[must_use]
    pub fn text(&self, declaration: &Declaration) -> String {
        let first = match self {
            Self::Known(length) => return length.to_token_stream().to_string(),
            Self::AtRunTime(first) => first,
        };
        let is_other = |other: &Self| matches!(other, Self::AtRunTime(other) if other != first);
        let is_ambiguous =
            declaration.generics.iter().any(|name| name == "N") || declaration.lengths.iter().any(is_other);
        if is_ambiguous { format!("N_{first}") } else { "N".to_owned() }
    }
}

/// Gives vectors that are read in one sum, or in one condition on entries, one length.
pub(super) fn unite(
    parameters: &mut [Parameter],
    lengths: &mut Vec<Entries>,
    body: &impl ToTokens,
    options: &Options,
) {
    let mut together = Vec::new();
    sums(body.to_token_stream(), &mut together);
    options.domain.iter().for_each(|condition| sums(condition.to_token_stream(), &mut together));
    let on_entries = options.admissible.iter().chain(options.extend.iter().flatten());
    together.extend(on_entries.map(|condition| indexed_lists(condition.to_token_stream())));
    for lists in together {
        let vectors =
            parameters.iter().filter(|parameter| lists.iter().any(|(list, _)| *list == parameter.name));
        let members = vectors.filter_map(Parameter::length);
        let members: Vec<Length> = members.filter(|&k| lengths[k].are_known_at_run_time()).collect();
        let Some(&first) = members.iter().min() else { continue };
        rename(parameters, |length| if members.contains(&length) { first } else { length });
    }
    let is_used: Vec<_> = (0..lengths.len())
        .map(|k| parameters.iter().any(|parameter| parameter.length() == Some(k)))
        .collect();
    rename(parameters, |length| is_used[..length].iter().filter(|&&used| used).count());
    let mut is_used = is_used.into_iter();
    lengths.retain(|_| is_used.next().unwrap_or(true));
}

fn rename(parameters: &mut [Parameter], name: impl Fn(Length) -> Length) {
    for parameter in parameters {
        if let Kind::List(length) = &mut parameter.kind {
            *length = name(*length);
        }
    }
}

/// The lists of each `sum(…)` among tokens.
fn sums(tokens: TokenStream, found: &mut Vec<Vec<(Ident, Ident)>>) {
    let mut is_sum = false;
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                if is_sum && group.delimiter() == Delimiter::Parenthesis {
                    found.push(indexed_lists(group.stream()));
                }
                sums(group.stream(), found);
                is_sum = false;
            }
            TokenTree::Ident(word) => is_sum = word == "sum",
            _ => is_sum = false,
        }
    }
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;
    use crate::read::diagnostics::Diagnostics;
    use crate::read::parse::parse_declaration;

    #[test]
    fn vectors_that_are_read_together_have_one_length() {
        let item = quote! {
            fn E<const N: usize>(
                [x, y, z]: [f64; 3], a: Vec<f64>, b: [f64; N], c: Vec<f64>, d: Vec<f64>, e: Vec<f64>, f: Vec<f64>,
            ) -> f64 {
                let s = sum(|p| a[p]) * sum(|q| { let k = c[q]; k * sum(|l| l.powf(d[q])) });
                s + sum(|p| b[p]) * sum(|p| e[p] + f[p])
            }
        };
        let mut diagnostics = Diagnostics::default();
        let arguments = quote!(admissible(c[p] > 0.0, a[p] < f[p]));
        let declaration = parse_declaration(arguments, item, &mut diagnostics);
        let declaration = diagnostics.finish(declaration).unwrap_or_else(|e| panic!("{e}"));
        let lengths: Vec<_> = declaration.parameters.iter().filter_map(Parameter::length).collect();
        assert_eq!(lengths, [0, 1, 2, 2, 0, 0]);
        let texts: Vec<_> = declaration.lengths.iter().map(|length| length.text(&declaration)).collect();
        assert_eq!(texts, ["N_a", "N", "N_c"]);
    }
}
