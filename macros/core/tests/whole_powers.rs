//! Powers whose whole exponents are parameters, against the same energies with the exponents written out.

use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{Estimate, Point, evaluate};
use piola_codegen::analyse;
use piola_codegen::model::Model;
use piola_codegen::printer::formula;
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

/// Exponents of the terms, the coefficients being 1, 2, 3.
const EXPONENTS: [[u32; 2]; 3] = [[1, 0], [0, 2], [3, 1]];

/// Stretches apart, pairwise equal, at rest, nearly at rest, and flat.
const STRETCHES: [[f64; 3]; 7] = [
    [1.7, 1.2, 0.6],
    [1.3, 1.3, 0.8],
    [1.1, 0.9, 0.9],
    [1.0, 1.0, 1.0],
    [1.0 + 1e-7, 1.0, 1.0 - 2e-7],
    [1.5, 0.8, 1e-5],
    [2.0, 1e-6, 1e-6],
];

fn model(arguments: &TokenStream, energy: TokenStream, parameters: TokenStream) -> Model {
    let item = quote!(fn E([l1, l2, l3]: [f64; 3], #parameters) -> f64 { #energy });
    let found = analyse(arguments.clone(), item, None);
    found
        .unwrap_or_else(|error| panic!("{:?}", error.into_iter().map(|e| e.to_string()).collect::<Vec<_>>()))
        .1
}

/// All that is emitted of an energy inside its domain.
fn results(model: &Model) -> Vec<Id> {
    let mut all = vec![model.plain.energy];
    all.extend(model.plain.blocks());
    all.extend(model.at_strains);
    all.extend(model.moduli);
    all.extend(
        model.extended.iter().flat_map(|extended| [vec![extended.energy], extended.blocks()].concat()),
    );
    all
}

/// A term with the exponents i and j.
type Term = fn(TokenStream, TokenStream) -> TokenStream;

/// Compares Σ c term(i, j) + other with its three terms written out.
#[track_caller]
fn check(arguments: TokenStream, term: Term, other: TokenStream) {
    let of_entries = term(quote!(i[p]), quote!(j[p]));
    let lists = quote!(c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, k: f64);
    let lists = model(&arguments, quote!(sum(|p| c[p] * #of_entries) + #other), lists);
    let terms = EXPONENTS.iter().zip(["c0", "c1", "c2"]).map(|(exponents, c)| {
        let [i, j] = exponents.map(|n| Literal::u32_unsuffixed(n).into_token_stream());
        let (c, term) = (format_ident!("{c}"), term(i, j));
        quote!(#c * #term)
    });
    let written = model(&arguments, quote!(#(#terms)+* + #other), quote!(c0: f64, c1: f64, c2: f64, k: f64));
    assert_eq!(lists.plain.has_pole, written.plain.has_pole);
    assert_eq!(lists.invariants.is_some(), written.invariants.is_some());
    for stretches in STRETCHES {
        let epsilon = 1e-3;
        let of_entry = |n: usize| EXPONENTS.map(|exponents| f64::from(exponents[n])).to_vec();
        let parameters = vec![vec![1.0, 2.0, 3.0], of_entry(0), of_entry(1), vec![0.7]].into();
        let with_lists = Point { stretches, parameters, lengths: vec![3], epsilon };
        let parameters = [1.0, 2.0, 3.0, 0.7].map(|value| vec![value]).to_vec().into();
        let with_terms = Point { stretches, parameters, lengths: vec![], epsilon };
        let pairs = results(&lists).into_iter().zip(results(&written));
        for (n, (found, expected)) in pairs.enumerate() {
            let found = evaluate(&lists.graph, found, &with_lists);
            let Estimate { value, magnitude } = evaluate(&written.graph, expected, &with_terms);
            // Both are evaluated in a few dozen operations.
            let tolerance = 64.0 * f64::EPSILON * (magnitude + found.magnitude);
            let error = (found.value - value).abs();
            assert!(error <= tolerance, "result {n} at {stretches:?}: {} for {value}", found.value);
        }
    }
}

#[test]
fn series_in_the_invariants() {
    let series = |i, j| quote!((I1b - 3.0).powi(#i) * (I2b - 3.0).powi(#j));
    check(quote!(domain(J > 0.0), extend), series, quote!(k * (J - 1.0).powi(2)));
    let series = |i, j| quote!((I1 - 3.0).powi(#i) * (J - 1.0).powi(#j));
    check(quote!(prestressed), series, quote!(k * I2));
}

#[test]
fn series_in_the_stretches() {
    let of_each = |i, j| quote!(sum(|l| (l - 1.0).powi(#i) * (l * l - 1.0).powi(#j)));
    check(quote!(prestressed), of_each, quote!(k * I2));
    check(quote!(prestressed, domain(J > 0.0)), of_each, quote!(k * I2));
    let of_sum = |i, j| quote!((l1 + l2 + l3 - 3.0).powi(#i) * (l1 * l2 * l3.powi(3) * l2.powi(2) * l1.powi(2)).powi(#j));
    check(quote!(prestressed, domain(J > 0.0)), of_sum, quote!(k * I2));
}

/// x^n is odd for some n and even for others: the draws have both.
#[test]
fn the_parity_of_a_power_is_that_of_no_draw() {
    let energy = quote!(sum(|p| c[p] * sum(|l| l.powi(2 * 1) * l.powi(n[p]))) + k * I1);
    let lists = quote!(c: Vec<f64>, n: Vec<u32>, k: f64);
    assert!(model(&quote!(prestressed), energy, lists).plain.has_pole);
    let energy = quote!(c * sum(|l| l.powi(2).powi(n)) + k * I1);
    assert!(!model(&quote!(prestressed), energy, quote!(c: f64, n: u32, k: f64)).plain.has_pole);
}

#[test]
fn formulas_have_the_exponents() {
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, n: u32) -> f64 {
            sum(|p| c[p] * (I1b - 3.0).powi(i[p])) + (J - 1.0).powi(n)
        }
    };
    let (declaration, mut model) =
        analyse(quote!(domain(J > 0.0), prestressed), item, None).expect("an energy");
    let mut print = |id| formula(&mut model.graph, &declaration, id);
    assert_eq!(print(model.energy), "Σₚ cₚ (I1 J^(−2/3) − 3)^iₚ + (J − 1)^n");
    assert_eq!(print(model.moduli[0]), "2 Σₚ cₚ [iₚ = 1] − 1/2 [n = 1]");
}
