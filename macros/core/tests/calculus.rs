//! Properties of derivatives that are read off their operations: poles of twists, shared powers. The tests of
//! `piola-tests` judge the values, for the whole catalogue.

use catalogue::{Declared, catalogue};
use piola_codegen::algebra::interpret::{Point, evaluate};
use piola_codegen::analyse;
use piola_codegen::model::Model;
use piola_codegen::schedule::{Op, Program};
use proc_macro2::TokenStream;
use quote::quote;

#[path = "shared/catalogue.rs"]
mod catalogue;

fn compile(name: &str, arguments: &TokenStream, item: &TokenStream) -> Model {
    let analysed = analyse(arguments.clone(), item.clone());
    analysed.map_or_else(|error| panic!("{name}: {error}"), |(_, model)| model)
}

/// The energies of the catalogue, with the names of their files.
fn models() -> Vec<(String, Model)> {
    let model = |name: &str, (arguments, item): Declared| (name.to_owned(), compile(name, &arguments, &item));
    let files = catalogue().into_iter();
    files.flat_map(|(name, all)| all.into_iter().map(move |one| model(&name, one))).collect()
}

/// Number of operations of a kind.
fn count(program: &Program, is_meant: fn(Op) -> bool) -> usize {
    program.operations().filter(|&(_, op)| is_meant(op)).count()
}

/// Where one stretch is far below the other, the plain quotient is exact. ψ1 is a product of a factor that
/// vanishes with its stretch and of one that grows without bound.
#[test]
fn factors_of_opposite_trends_do_not_cancel_on_flat_elements() {
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu * (sum(|l| l.ln().tanh() + l.powi(2)) - 3.0)
        }
    };
    let model = compile("opposite trends", &quote!(domain(J > 0.0), prestressed), &item);
    for flat in [1e-2, 1e-4, 1e-8, 1e-10] {
        let point = Point { stretches: [1.3, 1.1, flat], ..model.samples[0].clone() };
        let value = |id| evaluate(&model.graph, id, &point).value;
        let [g1, _, g3] = model.plain.gradient.map(value);
        let (found, plain) = (value(model.plain.flip[1]), (g1 - g3) / (1.3 - flat));
        assert!((found - plain).abs() <= 1e-12 * plain.abs(), "{found:e} for {plain:e} at {flat:e}");
    }
}

#[test]
fn twists_have_poles_exactly_where_the_stress_jumps() {
    let plain = |item: &str, arguments: TokenStream| {
        let item = format!("fn E([x, y, z]: [f64; 3], a: f64) -> f64 {{ {item} }}");
        compile(&item, &arguments, &item.parse().expect("tokens")).plain.has_pole
    };
    assert!(plain("a * ((x - 1.0).powi(2) + (y - 1.0).powi(2) + (z - 1.0).powi(2))", quote!()));
    // Functions of single stretches that are neither symmetric nor odd, and their products.
    let products = "x.powf(a) * y.ln() * z.ln() + y.powf(a) * z.ln() * x.ln() + z.powf(a) * x.ln() * y.ln()";
    assert!(!plain(&format!("a * (I1 - 3.0) + {products}"), quote!(domain(J > 0.0), prestressed)));
    for (name, model) in models() {
        let jumps = ["fixed_corotated", "rotated_linear"].contains(&name.as_str());
        assert!(model.plain.has_pole || !jumps, "{name}");
        let even = ["fung", "gent", "hencky", "mooney_rivlin", "neo_hookean", "ogden", "st_venant_kirchhoff"];
        assert!(!model.plain.has_pole || !even.contains(&name.as_str()), "{name}");
        // Extended in its stretches, no energy is even any more.
        assert!(model.extended.is_none_or(|extended| extended.has_pole), "{name}, extended");
    }
}

/// Far outside its domain an exponential overflows, which does not reveal its parity: the pole must stay.
#[test]
fn overflow_is_no_parity() {
    let arguments = quote!(domain(J > 0.0), extend, prestressed);
    let item = quote! {
        fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
            mu * (l1.powi(-12) + l2.powi(-12) + l3.powi(-12)).exp()
        }
    };
    let model = compile("exponential of powers", &arguments, &item);
    assert!(model.extended.is_some_and(|extended| extended.has_pole));
}

/// A root of high degree would multiply its rounding error: 1.305678 is 652839/500000.
#[test]
fn literal_exponents_are_real_powers_unless_they_are_simple_fractions() {
    let item = quote! {
        fn E([x, y, z]: [f64; 3], a: f64) -> f64 {
            a * (x.powf(1.305678) + y.powf(1.305678) + z.powf(1.305678)) + a * (x.powf(1.5) + y.powf(1.5) + z.powf(1.5))
        }
    };
    let mut model = compile("literal exponents", &quote!(domain(J > 0.0), prestressed), &item);
    let program = model.program(&model.plain.blocks());
    assert_eq!(count(&program, |op| matches!(op, Op::Power(..))), 3);
    assert_eq!(count(&program, |op| matches!(op, Op::PowerQuotient { .. })), 3);
    assert_eq!(count(&program, |op| matches!(op, Op::Sqrt(_))), 3);
}

/// Multiplying out all of it would take 4⁴ · 4⁴ terms.
#[test]
fn products_of_sums_compile_in_no_time() {
    let item = quote! {
        fn E([x, y, z]: [f64; 3], a: f64) -> f64 {
            let s = x + y + z;
            a * (s + J).powi(4) * (s + I1).powi(4) * (s + I2).powi(4) * (s + 1.0).powi(4)
        }
    };
    let start = std::time::Instant::now();
    compile("product of sums", &quote!(prestressed), &item);
    assert!(start.elapsed().as_secs() < 5);
}

/// 2²⁴ terms when written out; a hundred nodes in the graph.
#[test]
fn formulas_are_cut_off() {
    let mut body = String::from("let v0 = I1 / 3.0 - 1.0;");
    for k in 0..24 {
        body += &format!("let v{0} = 0.5 * (v{1} + v{1} * (1.0 - v{1}));", k + 1, k);
    }
    let body: TokenStream =
        format!("{{ {body} mu * (v24.powi(2) + I1 * I1 / 3.0 - I2) }}").parse().expect("tokens");
    let item = quote!(fn E([x, y, z]: [f64; 3], mu: f64) -> f64 #body);
    let (declaration, mut model) = analyse(quote!(), item).expect("an energy");
    let text = piola_codegen::printer::formula(&mut model.graph, &declaration, model.energy);
    assert!(text.contains('…') && text.len() < 20_000, "{} bytes", text.len());
}
