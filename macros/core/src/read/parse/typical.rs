//! The argument `typical("natural rubber", mu = 4e5, alpha = [1.3, 5.0])`: parameters of some real material.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{Expr, ExprLit, Ident, Lit, LitStr, Token, UnOp};

use super::{Kind, Parameter};
use crate::read::diagnostics::Diagnostics;
use crate::read::spelling::list;

const FORM: &str = "typical parameters are written `typical(\"natural rubber\", mu = 4e5, alpha = [1.3, 5.0])`, the material \
     first";

/// Parameters of some real material.
pub struct Typical {
    /// The argument's name, for mistakes.
    word: Ident,
    /// Name of the material and source of the values.
    pub source: LitStr,
    /// The values as written; once checked, in the order of the parameters.
    pub values: Vec<(Ident, Values)>,
}

/// The values of one parameter.
#[derive(Clone, Debug)]
pub struct Values {
    /// One value, or the entries of a list.
    pub numbers: Vec<f64>,
    is_list: bool,
    /// The text as written, such as `[1.3, -2.0]`.
    pub text: String,
}

impl Typical {
    /// Reads the argument; the names of the parameters are not known yet.
    pub(super) fn read(word: &Ident, tokens: &TokenStream, diagnostics: &mut Diagnostics) -> Option<Self> {
        let parser = |input: syn::parse::ParseStream<'_>| {
            let source = input.parse()?;
            let rest = match input.parse::<Option<Token![,]>>()? {
                Some(_) => Punctuated::<Expr, Token![,]>::parse_terminated(input)?,
                None => Punctuated::new(),
            };
            Ok((source, rest))
        };
        let parsed = parser.parse2(tokens.clone());
        let parsed = parsed.map_err(|error| syn::Error::new(error.span(), format!("{error}; {FORM}")));
        let (source, assignments) = diagnostics.take(parsed)?;
        let mut values = Vec::new();
        for assignment in assignments {
            match read_values(&assignment) {
                Ok(pair) => values.push(pair),
                Err(error) => diagnostics.error(error, FORM),
            }
        }
        Some(Self { word: word.clone(), source, values })
    }

    /// Brings the values into the order of the parameters, each of which must have its own.
    pub(super) fn check(&mut self, parameters: &[Parameter], diagnostics: &mut Diagnostics) {
        let mut given = std::mem::take(&mut self.values);
        let mut missing = Vec::new();
        for parameter in parameters {
            let Some(k) = given.iter().position(|(name, _)| *name == parameter.name) else {
                missing.push(parameter.name.to_string());
                continue;
            };
            let (name, values) = given.remove(k);
            if values.is_list == matches!(parameter.kind, Kind::Number) {
                let form = if values.is_list {
                    "one number, as in `mu = 4e5`"
                } else {
                    "a list, as in `mu = [4e5]`"
                };
                diagnostics.error(&name, format!("the typical value of `{name}` is {form}"));
            }
            let is_exponent = |value: &f64| value.fract() == 0.0 && (0.0..=64.0).contains(value);
            if parameter.is_whole && !values.numbers.iter().all(is_exponent) {
                diagnostics.error(&name, format!("exponents `{name}` are whole numbers from 0 to 64"));
            }
            self.values.push((name, values));
        }
        for (name, _) in given {
            let names: Vec<_> = parameters.iter().map(|parameter| parameter.name.to_string()).collect();
            diagnostics.error(
                &name,
                format!(
                    "`{name}` is not a parameter, or is given twice: the parameters are {}",
                    list(&names)
                ),
            );
        }
        if !missing.is_empty() {
            diagnostics
                .error(&self.word, format!("a typical value is missing: add one for {}", list(&missing)));
        }
    }
}

fn read_values(assignment: &Expr) -> Result<(Ident, Values), TokenStream> {
    let error = || assignment.to_token_stream();
    let Expr::Assign(assignment) = assignment else { return Err(error()) };
    let Expr::Path(path) = &*assignment.left else { return Err(error()) };
    let name = path.path.get_ident().ok_or_else(error)?;
    let entry = |entry: &Expr| number(entry).ok_or_else(|| entry.to_token_stream());
    let (numbers, is_list) = match &*assignment.right {
        Expr::Array(array) => (array.elems.iter().map(entry).collect::<Result<Vec<_>, _>>()?, true),
        value => (vec![entry(value)?], false),
    };
    let texts: Vec<_> = numbers.iter().map(|(_, text)| text.as_str()).collect();
    let text = if is_list { format!("[{}]", texts.join(", ")) } else { texts.concat() };
    let numbers = numbers.into_iter().map(|(value, _)| value).collect();
    Ok((name.clone(), Values { numbers, is_list, text }))
}

/// A finite number and its text.
fn number(expression: &Expr) -> Option<(f64, String)> {
    match expression {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            number(&unary.expr).map(|(value, text)| (-value, format!("-{text}")))
        }
        Expr::Lit(ExprLit { lit: lit @ (Lit::Float(_) | Lit::Int(_)), .. }) => {
            let text = lit.to_token_stream().to_string();
            let value = text.replace('_', "").parse().ok().filter(|value: &f64| value.is_finite());
            value.map(|value| (value, text))
        }
        _ => None,
    }
}
