//! Signatures, and parameters of functions.

use super::{check, check_signature, mistakes};

#[test]
fn signatures() {
    const FIRST: &str = "the first argument names the three stretches: `[l1, l2, l3]: [f64; 3]`";
    check("", "struct E;", &[("struct", "`#[material]` applies to a function")]);
    check("", "fn E() -> f64 { 1.0 }", &[("E", FIRST)]);
    check("", "fn E([a, b, c]: [f32; 3]) -> f64 { a }", &[("[a, b, c]: [f32; 3]", FIRST)]);
    check("", "fn E(&self) -> f64 { 1.0 }", &[("&self", FIRST)]);
    check("", "fn E([a, b, b]: [f64; 3]) -> f64 { a }", &[("b", "`b` is taken already")]);
    check_signature("fn E([a, b, c]: [f64; 3], mu: f64) -> f32", &[("f32", "write `-> f64`")]);
    check_signature("const fn E([a, b, c]: [f64; 3], mu: f64) -> f64", &[("const", "remove this")]);
    check_signature(
        "extern \"C\" fn E([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("extern \"C\"", "remove this")],
    );
    check_signature(
        "fn E<const N: usize>([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("N", "`N` is not the length of a list")],
    );
    let parameter = |parameter: &str, tokens: &str, expected: &str| {
        let item =
            format!("fn E([a, b, c]: [f64; 3], {parameter}) -> f64 {{ mu * (I1 - 3.0 - 2.0 * J + 2.0) }}");
        let found = mistakes("", &item);
        assert_eq!(found.first().map(|(found, _)| &**found), Some(tokens), "{found:#?}");
        assert!(found[0].1.contains(expected), "{found:#?}");
    };
    parameter("mu: (f64, f64)", "(f64, f64)", "a parameter is a number `mu: f64`");
    parameter("mut mu: f64", "mut mu", "a parameter is a number `mu: f64`");
    parameter("mu: Vec<f32>", "f32", "the entries of a list are `f64`");
    parameter("mu: Vec", "Vec", "the entries of a list are `f64`");
    parameter("mu: Vec<f64>", "mu", "`mu` is a list: write `sum(|p| … mu[p] …)`");
    parameter("mu: [f32; 3]", "f32", "the entries of a list are `f64`");
    parameter("mu: [f64; 0]", "0", "the length of a list is a number such as `3`");
    parameter("a: f64", "a", "`a` is taken already");
    parameter(
        "mu: piola::Spline",
        "mu",
        "`mu` is declared as a function: write `mu(l1)`, or declare `mu: f64`",
    );
}

#[test]
fn whole_exponents_are_exponents_alone() {
    let good = "m * ((a - 1.0).powi(2) + (b - 1.0).powi(2) + (c - 1.0).powi(2))";
    let says = |arguments: &str, term: &str, tokens: &str, expected: &str| {
        let item = format!(
            "fn E([a, b, c]: [f64; 3], m: f64, n: u32, d: [f64; 2], k: [u32; 2]) -> f64 {{ {good} + {term} }}"
        );
        check(arguments, &item, &[(tokens, expected)]);
    };
    let used = "sum(|p| d[p] * (I1 - 3.0).powi(k[p])) * (J - 1.0).powi(n)";
    says("prestressed, admissible(n > 1)", used, "n", "at most 64: remove this condition");
    says("prestressed, admissible(k[p] > 1)", used, "k", "at most 64: remove this condition");
    let with = |term: &str| format!("{used} + {term}");
    says("prestressed", &with("n * m"), "n", "`n` is a whole exponent and nothing else: write `x.powi(n)`");
    says("prestressed", &with("J.powf(n)"), "n", "write `x.powi(n)`");
    says("prestressed", &with("sum(|p| k[p] * d[p])"), "k", "write `x.powi(k[p])`");
    says("prestressed", &with("sum(|p| d[p] * J.powf(k[p]))"), "k", "write `x.powi(k[p])`");
    says("prestressed", &with("J.powi(k)"), "k", "`k` is a list");
    says("prestressed", &with("J.powi(m)"), "m", "write `.powf(m)`, or declare `m: u32`");
    says(
        "prestressed",
        &with("sum(|p| J.powi(d[p]))"),
        "d[p]",
        "write `.powf(d[p])`, or declare `d: [u32; N]`",
    );
    says(
        "prestressed",
        &with("sum(|p| d[p] * J.powi(2 * k[p]))"),
        "2 * k[p]",
        "let the list `k` hold the values of `2 * k[p]` themselves, or declare `k` with `f64` and write `.powf(2 * k[p])`",
    );
    says("prestressed", &with("J.powi((n - 1))"), "(n - 1)", "let `n` be the value of `n - 1` itself");
    says(
        "prestressed",
        &with("sum(|q| J.powi(-k[q]))"),
        "-k[q]",
        "write `.recip().powi(k[q])`, or declare `k`",
    );
    says("prestressed", &with("J.powi(k[p])"), "k[p]", "entries are only read inside a sum");
    let typical =
        |n: &str| format!("prestressed, typical(\"rubber\", m = 1, n = {n}, d = [1, 2], k = [0, 3])");
    says(&typical("1.5"), used, "n", "exponents `n` are whole numbers from 0 to 64");
    says(&typical("65"), used, "n", "whole numbers from 0 to 64");
    // What is raised has no unit.
    let item = "fn E([a, b, c]: [f64; 3], /** Modulus, Pa. */ m: f64, n: u32) -> f64 { (m * J).powi(n) }";
    check("prestressed", item, &[("(m * J).powi(n)", "Pa")]);
}
