//! Number literals of a condition on parameters, with the types that Rust requires.
//!
//! A condition is emitted as it is written. In an energy all numbers are real and need no types; in Rust the
//! type of `3.0.sqrt()` is unknown, `mu > 0` compares with an integer, and `mu.powi(2.0)` is an error.

use proc_macro2::{Delimiter, Group, Literal, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Expr, Lit, UnOp};

/// A condition with every literal an `f64`, except that exponents of `powi`, literals with or without a sign,
/// are integers.
pub(crate) fn typed(condition: &Expr) -> TokenStream {
    rewrite(condition.to_token_stream(), real)
}

/// True if an exponent of `powi` is a literal with or without a sign.
pub(crate) fn is_number(exponent: &Expr) -> bool {
    match exponent {
        Expr::Lit(_) => true,
        Expr::Unary(unary) => matches!(unary.op, UnOp::Neg(_)) && is_number(&unary.expr),
        Expr::Paren(inner) => is_number(&inner.expr),
        Expr::Group(inner) => is_number(&inner.expr),
        _ => false,
    }
}

fn rewrite(tokens: TokenStream, number: fn(Literal) -> Literal) -> TokenStream {
    let mut follows_powi = false;
    tokens
        .into_iter()
        .map(|token| {
            let is_exponent = std::mem::replace(
                &mut follows_powi,
                matches!(&token, TokenTree::Ident(name) if name == "powi"),
            );
            match token {
                TokenTree::Group(group) => {
                    let is_exponent = is_exponent && group.delimiter() == Delimiter::Parenthesis;
                    let inner = rewrite(group.stream(), if is_exponent { whole } else { number });
                    let mut rewritten = Group::new(group.delimiter(), inner);
                    rewritten.set_span(group.span());
                    TokenTree::Group(rewritten)
                }
                TokenTree::Literal(literal) => TokenTree::Literal(number(literal)),
                other => other,
            }
        })
        .collect()
}

fn real(literal: Literal) -> Literal {
    replaced(literal, Literal::f64_suffixed)
}

fn whole(literal: Literal) -> Literal {
    replaced(literal, |value| Literal::i32_unsuffixed(value as i32))
}

/// A number in another form.
fn replaced(literal: Literal, form: impl Fn(f64) -> Literal) -> Literal {
    let digits = match Lit::new(literal.clone()) {
        Lit::Float(number) => number.base10_digits().to_owned(),
        Lit::Int(number) => number.base10_digits().to_owned(),
        _ => return literal,
    };
    match digits.parse::<f64>() {
        Ok(value) if value.is_finite() => {
            let mut replaced = form(value);
            replaced.set_span(literal.span());
            replaced
        }
        _ => literal,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_its_type() {
        let condition = syn::parse_quote!(3.0.sqrt() * mu.powi(-(2.0)) > m[p].powf(2) + 1e-3.ln() - (0));
        let expected: Expr =
            syn::parse_quote!(3f64.sqrt() * mu.powi(-(2)) > m[p].powf(2f64) + 0.001f64.ln() - (0f64));
        assert_eq!(typed(&condition).to_string(), expected.to_token_stream().to_string());
    }
}
