//! Mistakes: each gives one message, at its token, that says what to write.

use proc_macro2::TokenStream;
use quote::quote;

/// The messages of a declaration, with the text of the token each stands on.
fn mistakes(arguments: TokenStream, body: &str) -> Vec<String> {
    let item =
        format!("fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N]) -> f64 {{ {body} }}");
    let item: TokenStream = item.parse().expect("tokens");
    of_item(arguments, item)
}

fn of_item(arguments: TokenStream, item: TokenStream) -> Vec<String> {
    let result = piola_codegen::parse::parse(arguments, item)
        .and_then(|d| piola_codegen::model::model(&d).map(|_| ()));
    result.err().map(|all| all.into_iter().map(|error| error.to_string()).collect()).unwrap_or_default()
}

/// A good energy that uses every parameter, to which a mistake is added.
const GOOD: &str = "mu * (I1 - 3.0 - 2.0 * J.ln()) + sum(|p| m[p]) * (J - 1.0).powi(2)";

#[track_caller]
fn check(body: &str, expected: &[&str]) {
    let found = mistakes(quote!(domain(J > 0.0)), body);
    assert_eq!(found.len(), expected.len(), "{body}\n{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.contains(expected), "{body}\nsays: {found}\nnot:  {expected}");
    }
}

#[track_caller]
fn check_added(term: &str, expected: &str) {
    check(&format!("{GOOD} + {term}"), &[expected]);
}

#[test]
fn a_good_energy_has_none() {
    check(GOOD, &[]);
}

#[test]
fn all_mistakes_come_at_once() {
    check(
        &format!("{GOOD} + nu * J.lm() + sum(|q| m[p])"),
        &[
            "unknown name `nu`: did you mean `mu`?",
            "unknown function `lm`: did you mean `.ln(…)`?",
            "index of this sum is `q`",
            "runs over no list",
        ],
    );
}

#[test]
fn names_and_calls() {
    check_added("J.log()", "write `.ln()`");
    check_added("J.pow(2)", "write `.powi(2)`");
    check_added("J.powi(0.5)", "`powi` takes a whole number");
    check_added("J.powi()", "one argument, the exponent");
    check_added("J.powi(1000)", "at most 64");
    check_added("J.powf(l1)", "not of stretches");
    check_added("m", "write `sum(|p| … m[p] …)`");
    check_added("m[0]", "write `m");
    check_added("J ^ 2", "x.powi(2)");
    check_added("sum(|p| m[p] * sum(|q| m[q]))", "sums cannot stand inside sums");
    check_added("max(l1, 0.0)", "the only functions called by name are `sum");
    check_added("J / 0.0", "division by zero");
    check_added("1.0f32", "remove the suffix");
    check_added("1e999", "not finite");
    check_added("if mu > 0.0 { 1.0 } else { 2.0 }", "no branches");
    check(&format!("let unused = 1.0; {GOOD}"), &["`unused` is not used"]);
    check(&format!("let mu = 1.0; {GOOD}"), &["`mu` is taken already"]);
    check("mu * (I1 - 3.0 - 2.0 * J.ln())", &["`m` does not occur"]);
    check("let x = mu;", &["the last line of an energy is its value", "is not used", "`m` does not occur"]);
}

#[test]
fn physics() {
    check_added("mu * l1 * l2", "exchanged, but the term `μ λ₁ λ₂` does");
    check_added("mu * (l1 + l2 + l3)", "the rest state carries the stress ψ1(1, 1, 1) = μ:");
    let free = |options| mistakes(options, GOOD);
    assert!(free(quote!(domain(J > 2.0)))[0].contains("excludes the rest state"));
    assert!(free(quote!(extend))[0].contains("declare one of these"));
    assert!(free(quote!(domain(J != 0.0), extend, refuse("no")))[0].contains("either `extend` or `refuse`"));
    assert!(free(quote!(refuse(no)))[0].contains("say in a string why"));
    assert!(free(quote!(domain(J > 0.0), domein(mu > 0.0)))[0].contains("unknown argument `domein`"));
    assert!(free(quote!(admissible(mu)))[0].contains("a condition is a comparison"));
}

#[test]
fn form() {
    let check = |item: TokenStream, expected: &str| {
        let found = of_item(quote!(), item);
        assert!(found.iter().any(|message| message.contains(expected)), "{found:#?} lacks {expected}");
    };
    check(
        quote!(
            struct E;
        ),
        "stands on a function",
    );
    check(
        quote!(
            fn E() -> f64 {
                1.0
            }
        ),
        "the first argument is `[l1, l2, l3]: [f64; 3]`",
    );
    check(
        quote!(
            fn E([a, b]: [f64; 2]) -> f64 {
                1.0
            }
        ),
        "the first argument names the stretches",
    );
    check(
        quote!(
            fn E([a, b, b]: [f64; 3]) -> f64 {
                1.0
            }
        ),
        "`b` is taken already",
    );
    check(
        quote!(
            fn E([a, b, c]: [f64; 3], J: f64) -> f64 {
                J
            }
        ),
        "`J` has a meaning of its own",
    );
    check(
        quote!(
            fn E([a, b, c]: [f64; 3], mu: f32) -> f64 {
                mu
            }
        ),
        "a parameter is a number",
    );
    check(
        quote!(
            fn E([a, b, c]: [f64; 3], mu: f64, mu: f64) -> f64 {
                mu
            }
        ),
        "`mu` is taken already",
    );
    check(
        quote!(
            fn E<T>([a, b, c]: [f64; 3]) -> f64 {
                a
            }
        ),
        "only lengths of lists can be generic",
    );
    check(
        quote!(
            fn E([a, b, c]: [f64; 3]) {
                a
            }
        ),
        "write `-> f64`",
    );
    check(
        quote!(
            async fn E([a, b, c]: [f64; 3]) -> f64 {
                a
            }
        ),
        "remove this",
    );
}
