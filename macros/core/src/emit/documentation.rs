//! The documentation of a material: ψ and its derivatives as formulas, its parameters, domain and moduli, and
//! the operations of each result.

use crate::model::Model;
use crate::printer::{Formulas, formula, formulas, formulas_by_invariants};
use crate::read::notation::plain_name;
use crate::read::parse::Declaration;
use crate::schedule::count::{LEGEND, table};

use super::{Texts, condition_text};

/// The documentation of the type, below that of its declaration.
pub fn page(declaration: &Declaration, model: &mut Model, texts: &Texts) -> String {
    let Texts { formula, moduli: [shear, lame], .. } = texts;
    let sections = [
        format!("```text\nψ = {formula}\n```"),
        parameters(declaration),
        typical(declaration),
        format!("**Domain**: {}{}", domain(declaration, texts), outside(declaration)),
        format!("**Small strain**: μ = {shear}, λ = {lame}{}.", brackets(&[shear, lame])),
        digits(declaration, model),
        derivatives(declaration, model),
        operations(declaration, model),
    ];
    let sections: Vec<_> = sections.into_iter().filter(|section| !section.is_empty()).collect();
    format!("\n{}", sections.join("\n\n"))
}

/// The meaning of [n = 1] in formulas of the moduli.
fn brackets(moduli: &[&String]) -> &'static str {
    let has_brackets = moduli.iter().any(|modulus| modulus.contains(" = "));
    if has_brackets { ", where a bracket is 1 if it is true, else 0" } else { "" }
}

fn parameters(declaration: &Declaration) -> String {
    if declaration.parameters.is_empty() {
        return String::new();
    }
    let parameters =
        declaration.parameters.iter().map(|p| format!("\n* `{}`: {}", plain_name(&p.name), p.doc));
    let list: String = parameters.collect();
    let conditions: Vec<_> = declaration.options.admissible.iter().map(condition_text).collect();
    let admissible = if conditions.is_empty() {
        String::new()
    } else {
        format!("\n\nThey satisfy `{}`.", conditions.join(", "))
    };
    format!("**Parameters**:\n{list}{admissible}")
}

fn typical(declaration: &Declaration) -> String {
    declaration.options.typical.as_ref().map_or_else(String::new, |typical| {
        let values = typical.values.iter().map(|(name, values)| format!("{name} = {}", values.text));
        let values: Vec<_> = values.collect();
        format!("**Typical**: `{}`, {}.", values.join(", "), typical.source.value())
    })
}

fn domain(declaration: &Declaration, texts: &Texts) -> String {
    let has_conditions = !declaration.options.domain.is_empty();
    let domain = if has_conditions { format!("`{}`", texts.domain) } else { texts.domain.clone() };
    format!("{}.", [domain.as_str(), &texts.defined].join(" ").trim_end())
}

/// The behaviour outside the domain.
fn outside(declaration: &Declaration) -> String {
    let options = &declaration.options;
    match (&options.extend, &options.refuse) {
        (Some(conditions), _) if conditions.is_empty() => " It can be continued beyond J > 0.".to_owned(),
        (Some(conditions), _) => {
            let conditions: Vec<_> = conditions.iter().map(condition_text).collect();
            format!(" It can be continued beyond J > 0 if `{}`.", conditions.join(", "))
        }
        (None, Some(reason)) => format!(" It cannot be continued beyond that: {}.", reason.value()),
        (None, None) => String::new(),
    }
}

/// The sums that lose digits, except those that are equal to others by isotropy.
fn digits(declaration: &Declaration, model: &mut Model) -> String {
    let mut sums: Vec<(Vec<String>, String)> = Vec::new();
    for sum in model.lossy.clone() {
        let permutations = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let mut alike = permutations.map(|order| {
            let stretches = order.map(|k| model.graph.stretch(k));
            let exchanged = model.graph.substitute(sum, stretches);
            formula(&mut model.graph, declaration, exchanged)
        });
        let text = alike[0].clone();
        alike.sort_unstable();
        if !sums.iter().any(|(known, _)| *known == alike) {
            sums.push((alike.to_vec(), format!("`{text}`")));
        }
    }
    if sums.is_empty() {
        return String::new();
    }
    let sums: Vec<_> = sums.into_iter().map(|(_, text)| text).collect();
    format!(
        "**Digits**: on elements that are flat, or lines, or huge, the terms of {} cancel, and stress and tangent lose digits. \
         Written as products, or as sums of terms of one sign, such expressions keep them.",
        sums.join(", and of ")
    )
}

/// The derivatives and quotients that are not equal to others by isotropy, and those by the invariants.
fn derivatives(declaration: &Declaration, model: &mut Model) -> String {
    let plain = &model.plain;
    let by_stretches = [
        ("ψ₁", plain.gradient[0]),
        ("ψ₁₁", plain.hessian[0]),
        ("ψ₁₂", plain.hessian[3]),
        ("D⁻₁₂", plain.flip[0]),
        ("D⁺₁₂", plain.twist[0]),
    ];
    let (names, roots): (Vec<_>, Vec<_>) = by_stretches.into_iter().unzip();
    let by_stretches = formulas(&mut model.graph, declaration, &roots);
    let parts =
        if by_stretches.parts.is_empty() { "" } else { "; parts that occur more than once have names" };
    let mut text = format!(
        "**Derivatives** inside the domain, with D⁻₁₂ = (ψ₁ − ψ₂)/(λ₁ − λ₂) and D⁺₁₂ = (ψ₁ + ψ₂)/(λ₁ + λ₂), where f\\[x, y\\] \
         is (f(x) − f(y))/(x − y); the others follow by exchange of stretches{parts}:\n\n{}",
        block(&names, &by_stretches)
    );
    if let Some(invariants) = &model.invariants {
        let names = ["∂ψ/∂I1", "∂ψ/∂I2", "∂ψ/∂J"];
        let by_invariants = formulas_by_invariants(&model.graph, declaration, &invariants.gradient);
        text += "\n\n**By the invariants**, which give the stress without the stretches:\n\n";
        text += &block(&names, &by_invariants);
    }
    text
}

/// Formulas, their shared parts first.
fn block(names: &[&str], Formulas { parts, formulas }: &Formulas) -> String {
    let parts = parts.iter().map(|(name, text)| format!("{name} = {text}\n"));
    let formulas = names.iter().zip(formulas).map(|(name, text)| format!("{name} = {text}\n"));
    format!("```text\n{}```", parts.chain(formulas).collect::<String>())
}

fn operations(declaration: &Declaration, model: &mut Model) -> String {
    let table = table(declaration, &model.counts());
    format!("**Operations**, of each result by itself:\n\n{table}\n{LEGEND}.")
}

#[cfg(test)]
mod tests {
    use quote::quote;

    #[test]
    fn sums_that_lose_digits_are_named_once() {
        let item = quote! {
            /// Rubber.
            fn E([l1, l2, l3]: [f64; 3], mu: f64, k: f64, mu_2: f64) -> f64 {
                let logarithms = sum(|l| ((l.powi(2) + mu_2.powi(2)).sqrt() - mu_2).ln());
                mu * logarithms + k * (J - 1.0).powi(2) + mu * I1
            }
        };
        let arguments = quote!(domain(J > 0.0), admissible(mu > 0.0, k > 0.0, mu_2 > 0.0), prestressed);
        let (declaration, mut model) = crate::analyse(arguments, item).unwrap();
        assert_eq!(model.lossy.len(), 3);
        let digits = super::digits(&declaration, &mut model);
        assert!(digits.starts_with("**Digits**") && digits.matches('`').count() == 2, "{digits}");
        assert!(digits.contains("− μ_2`"), "{digits}");
    }
}
