//! Mistakes: each gives one message, on its tokens, with the remedy. The mistakes that
//! `tests/declarations/mistakes.rs` shows with whole messages are left out here. `table.txt` has the mistakes
//! of single terms and arguments.

mod declaration;
mod domain;
mod energy;
mod sums;

use proc_macro2::TokenStream;

/// The messages of a declaration, each with the tokens that it stands on.
fn mistakes(arguments: &str, item: &str) -> Vec<(String, String)> {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let understood = piola_codegen::analyse(tokens(arguments), tokens(item), None);
    let errors = understood.err().into_iter().flatten();
    errors.map(|error| (error.span().source_text().unwrap_or_default(), error.to_string())).collect()
}

#[track_caller]
fn check(arguments: &str, item: &str, expected: &[(&str, &str)]) {
    let found = mistakes(arguments, item);
    assert_eq!(found.len(), expected.len(), "{item}\n{found:#?}");
    for ((tokens, message), (expected_tokens, expected)) in found.iter().zip(expected) {
        assert!(message.contains(expected), "{item}\nsays: {message}\nnot:  {expected}");
        assert_eq!(tokens, expected_tokens, "{item}\n{message}");
    }
}

/// A good energy that uses every parameter, to which a mistake is added.
const GOOD: &str = "mu * (I1 - 3.0 - 2.0 * J.ln()) + sum(|p| m[p]) * (J - 1.0).powi(2)";

#[track_caller]
fn check_body(body: &str, expected: &[(&str, &str)]) {
    let item =
        format!("fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N]) -> f64 {{ {body} }}");
    check("domain(J > 0.0)", &item, expected);
}

#[track_caller]
fn check_added(term: &str, tokens: &str, expected: &str) {
    check_body(&format!("{GOOD} + {term}"), &[(tokens, expected)]);
}

#[track_caller]
fn check_arguments(arguments: &str, expected: &[(&str, &str)]) {
    let item =
        format!("fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N]) -> f64 {{ {GOOD} }}");
    check(arguments, &item, expected);
}

/// A signature whose energy would be good.
#[track_caller]
fn check_signature(signature: &str, expected: &[(&str, &str)]) {
    check(
        "",
        &format!("{signature} {{ mu * ((a - 1.0).powi(2) + (b - 1.0).powi(2) + (c - 1.0).powi(2)) }}"),
        expected,
    );
}

#[test]
fn each_line_of_the_table_is_one_mistake() {
    let cases = include_str!("table.txt").lines().filter(|line| !line.is_empty() && !line.starts_with("//"));
    for case in cases {
        let parts: Vec<_> = case.rsplitn(3, " => ").collect();
        let [message, tokens, written] = parts[..] else { panic!("no case: {case}") };
        match (written.strip_prefix("+ "), written.strip_prefix("#[").and_then(|it| it.strip_suffix(']'))) {
            (Some(term), _) => check_added(term, tokens, message),
            (_, Some(arguments)) => check_arguments(arguments, &[(tokens, message)]),
            _ => panic!("neither a term nor arguments: {case}"),
        }
    }
}

#[test]
fn a_good_energy_has_none() {
    check_body(GOOD, &[]);
    // A whole power of an expression that vanishes at rest is zero there, not unknown.
    check_body(&format!("{GOOD} + mu * (I1b - 3.0).powi(2) + mu * J.ln().powf(2.0)"), &[]);
    check_arguments(
        "domain(J > 0.0), admissible(m[p] * m[p] > -1.0, mu.powi(2.0) * 3.0.sqrt() >= 0), extend(mu > 0.0)",
        &[],
    );
    check_signature("fn E([a, b, c]: [f64; 3], mu: f64) -> f64", &[]);
}

#[test]
fn all_mistakes_come_at_once() {
    check(
        "domain(J > 0.0), prestresed, admissible(mu, nu > 0.0)",
        "async fn E([l1, l2, l3]: [f64; 3], mu: f64, mu: f64, f: f32) -> f64 {
            let unused = 1.0;
            f * nu * J.lm() + sum(|q| m[p])
        }",
        &[
            ("prestresed", "did you mean `prestressed`?"),
            ("mu", "a condition is a comparison"),
            ("async", "remove this"),
            ("mu", "the name `mu` is taken already"),
            ("f32", "a parameter is a number"),
            ("nu", "unknown name `nu`: did you mean `mu`?"),
            ("lm", "unknown function `lm`: did you mean `.ln()`?"),
            ("m", "unknown name `m`"),
            ("unused", "`unused` is not used"),
            ("nu", "unknown name `nu`: did you mean `mu`?"),
        ],
    );
}

#[test]
fn one_mistake_gives_one_message() {
    // Neither unused nor unknown: it is meant, though misspelt or misdeclared.
    check_body(&GOOD.replace("mu *", "mv *"), &[("mv", "did you mean `mu`?")]);
    check_body(&GOOD.replace("mu *", "2mu *"), &[("2mu", "write `2 * mu` for a product")]);
    check_added("sum(|q| m[p])", "p", "the index here is `q`");
    check_added("sum(|q| m[p] * (l1.powf(m[p]) + l2.powf(m[p])))", "p", "the index here is `q`");
    check_body(
        &format!("{GOOD} + sum(|i| m[j] + m[k]) + sum(|i| m[j])"),
        &[("j", "the index here is `i`"), ("k", "the index here is `i`"), ("j", "the index here is `i`")],
    );
    check_added("sum(|p| mu[p])", "mu", "`mu` is not a list: write `mu`");
    check_added("sum(|p| n[p])", "n", "unknown name `n`");
    check_added("{ let (x, y) = 1.0; x * y }", "let (x, y) = 1.0;", "write `let name = expression;`");
    // The index of a sum is misunderstood once, however often it is written.
    check_added(
        "sum(|n| m[n] / (2 * n) * (J.powf(n) + J.powi(n) - 2 * n.ln())) + sum(|n| n * m[n])",
        "n",
        "the index `n` only selects entries",
    );
    // Uses of a mistaken binding are not reported again.
    for (binding, tokens, expected) in [
        ("let n = [1.0, 2.0];", "[1.0, 2.0]", "written out, term by term"),
        ("let n = vec![1.0, 2.0];", "vec![1.0, 2.0]", "an energy is made of numbers"),
        ("let n = nu;", "nu", "did you mean `mu`?"),
        ("let n: [f64; 2] = [1.0, 2.0];", "let n: [f64; 2] = [1.0, 2.0];", "write `let name = expression;`"),
    ] {
        let uses = [
            "n",
            "n[0]",
            "sum(|p| m[p] * n[p])",
            "sum(|p| n[p])",
            "n(J)",
            "mu / (n - 1.0)",
            "(n - 1.0).ln()",
            "J.powi(n) * J.powf(n)",
            "{ let k = 2.0 * n; J.powi(k) + k[p] }",
        ];
        for used in uses {
            check_body(&format!("{binding} {GOOD} + mu * {used}"), &[(tokens, expected)]);
        }
        check_body(&format!("{binding} {GOOD}"), &[(tokens, expected)]);
    }
    for ty in ["f32", "&[f64]", "Vec<f32>", "[f64; 0]", "f46"] {
        let item = format!(
            "fn E([l1, l2, l3]: [f64; 3], m: {ty}) -> f64 {{ sum(|p| m[p]) * (I1 - 3.0) + m * m(l1) }}"
        );
        assert_eq!(mistakes("", &item).len(), 1, "{item}");
    }
}

#[test]
fn names() {
    let single = "single entries of a list cannot be used: declare them as parameters of their own, or write `m[p]`, inside";
    check_added("m[1] * J + m[2] * m[0].ln() + sum(|p| m[p] * m[0]) + m[p]", "m[1]", single);
    check_body(&format!("let unused = 1.0; {GOOD}"), &[("unused", "`unused` is not used")]);
    check_body(&format!("let x = mu; let x = 2.0 * x; x + {GOOD}"), &[("x", "`x` is taken already")]);
    // A condition does not see into the body, nor an energy into a block that has ended.
    let condition = |arguments: &str, body: &str| {
        let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {{ {body} }}");
        check(arguments, &item, &[("x", "`x` is known only in the `{ … }` of its `let`: write out here")]);
    };
    let body = "let x = I1 - 3.0; mu * (x - 2.0 * J.ln())";
    condition("domain(J > 0.0, x < 2.0)", body);
    condition("domain(J > 0.0), admissible(mu > x)", body);
    condition("domain(J > 0.0)", "mu * ({ let x = I1 - 3.0; x } - 2.0 * J.ln() + 0.0 * x)");
}

#[test]
fn helpers() {
    let expected = "write a sum over the three stretches as `sum(|l| …)`, and name parts by `let`, also in a sum: `sum(|p| { let s = …; … })`";
    let closure = "|x: f64| x.powf(mu) + (y[k] - 1.0)";
    check_body(&format!("let f = {closure}; {GOOD} + f(l1) + f(l2) + f(l3)"), &[(closure, expected)]);
    let function = "fn f(x: f64, a: f64) -> f64 { x.powf(a) }";
    check_body(&format!("{function} {GOOD} + sum(|p| f(l1, m[p]) + f(l2, m[p]))"), &[(function, expected)]);
}

#[test]
fn numbers() {
    for suffix in ["i32", "usize", "u8", "f16"] {
        check_added(&format!("1{suffix}"), &format!("1{suffix}"), "remove the suffix");
    }
    let shape = "1e38 * mu * (J.powi(2) - 2.0 * J + 1.0)";
    check(
        "",
        &format!("fn E([a, b, c]: [f64; 3], mu: f64) -> f64 {{ {shape} }}"),
        &[(shape, "in the derivatives")],
    );
}

#[test]
fn lines() {
    check_body(&format!("return {GOOD};"), &[("return", "write it without `return` and `;`")]);
    check_body(&format!("mu; {GOOD}"), &[("mu;", "`let` bindings and one expression at the end")]);
    check_body(&format!("let x: f64 = {GOOD}; x"), &[]);
    check_body(&format!("let mut x = {GOOD}; x"), &[(&format!("let mut x = {GOOD};"), "write `let name")]);
    check("", "fn E([l1, l2, l3]: [f64; 3]) -> f64 {}", &[("{}", "an energy is missing here")]);
    check(
        "",
        "fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { let x = mu; }",
        &[("let x = mu;", "ends with its value")],
    );
}

#[test]
fn half_a_body_is_one_mistake() {
    check("", "fn E([a, b, c]: [f64; 3], mu: f64) -> f64 { mu * }", &[("}", "expected an expression")]);
    check("", "fn E([a, b, c]: [f64; 3], mu) -> f64 { mu }", &[(")", "a declaration is `fn Name(")]);
}
