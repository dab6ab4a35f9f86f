//! The constructor from Young's modulus and Poisson's ratio.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::doc;
use super::writer::free_name;
use crate::algebra::rational::Rational;
use crate::algebra::young_poisson::{Determined, YoungPoisson};
use crate::printer::combination;
use crate::read::parse::Declaration;

/// `from_young_poisson`, with the parameters that are not determined in the order of the declaration.
pub(super) fn from_young_poisson(declaration: &Declaration, determined: &YoungPoisson) -> TokenStream {
    let Declaration { visibility, parameters, .. } = declaration;
    let young = free_name(declaration, &["young", "young_modulus"]);
    let poisson = free_name(declaration, &["poisson", "poisson_ratio"]);
    let others: Vec<_> =
        (0..parameters.len()).filter(|&k| determined.of(k).is_none()).map(|k| &parameters[k]).collect();
    let names: Vec<_> = others.iter().map(|parameter| &parameter.name).collect();
    let types = others.iter().map(|parameter| declaration.parameter_type(parameter));
    let all = parameters.iter().enumerate().map(|(k, parameter)| match determined.of(k) {
        Some(one) => value(one),
        None => parameter.name.to_token_stream(),
    });
    let formulas = determined.0.map(|one| {
        let Determined { parameter, mu, lambda, constant } = one;
        format!("`{}` = {}", parameters[parameter].name, combination(&[("μ", mu), ("λ", lambda)], constant))
    });
    let described = [
        format!("* `{young}`: Young's modulus E > 0, Pa."),
        format!("* `{poisson}`: Poisson's ratio, −1 < ν < 1/2."),
    ];
    let described = described
        .into_iter()
        .chain(others.iter().map(|parameter| format!("* `{}`: {}", parameter.name, parameter.doc)));
    let documentation = doc(&format!(
        "The material with this stiffness at small strain.\n\n{}\n\nWith μ = E/(2 (1 + ν)) and λ = E ν/((1 + ν) (1 − 2 ν)), {} and {}.\n\n\
         # Errors\nIf E or ν is outside its range, or the parameters that follow from them are not admissible.",
        described.collect::<Vec<_>>().join("\n"),
        formulas[0],
        formulas[1],
    ));
    quote! {
        #documentation
        #visibility fn from_young_poisson(
            #young: f64,
            #poisson: f64,
            #(#names: #types),*
        ) -> __p::Result<Self, __p::MaterialError> {
            let moduli = __p::Moduli::from_young_poisson(#young, #poisson)?;
            Self::new(#(#all),*)
        }
    }
}

/// The parameter as an expression in `moduli`.
fn value(determined: &Determined) -> TokenStream {
    let Determined { mu, lambda, constant, .. } = *determined;
    let modulus = |coefficient: Rational, modulus: TokenStream| {
        (!coefficient.is_zero()).then(|| {
            if coefficient == Rational::ONE {
                modulus
            } else {
                let coefficient = number(coefficient);
                quote!(#coefficient * #modulus)
            }
        })
    };
    let constant = (!constant.is_zero()).then(|| number(constant));
    let terms = [modulus(mu, quote!(moduli.mu)), modulus(lambda, quote!(moduli.lambda)), constant];
    let terms = terms.into_iter().flatten();
    quote!(#(#terms)+*)
}

/// A fraction as an `f64`: exact if possible, else rounded once.
fn number(value: Rational) -> TokenStream {
    let magnitude = Literal::f64_unsuffixed(value.to_f64().abs());
    if value.is_negative() { quote!((-#magnitude)) } else { quote!(#magnitude) }
}
