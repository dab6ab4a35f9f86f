//! Mistakes: each gives one message, on its tokens, that says what to write.

mod energy;

use std::fs;
use std::path::Path;

use piola_codegen::algebra::interpret::evaluate;
use proc_macro2::TokenStream;

/// The messages of a declaration, each with the tokens that it stands on.
fn mistakes(arguments: &str, item: &str) -> Vec<(String, String)> {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let understood = piola_codegen::analyse(tokens(arguments), tokens(item));
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
    check_added("K", "K", "known are `l1`, `l2`, `l3`, `mu`, `m`, `J`, `I1`, `I2`, `I1b`, `I2b`");
    check_added("m", "m", "write `sum(|p| … m[p] …)`");
    let single = "single entries of a list cannot be used: declare them as parameters of their own, or write `m[p]`, inside";
    check_added("m[0]", "m[0]", single);
    check_added("m[1] * J + m[2] * m[0].ln() + sum(|p| m[p] * m[0]) + m[p]", "m[1]", single);
    check_added("sum(|p| m[p + 1])", "m[p + 1]", "an entry is written `m[p]`, inside `sum(|p| …)`");
    check_arguments(
        "domain(J > 0.0), admissible(m[0] > 0.0)",
        &[("m[0]", "or write `m[p]`, which holds for each")],
    );
    check_added("m[p]", "m[p]", "entries are only read inside a sum: `sum(|p| m[p])`");
    check_added("l1[p]", "l1", "`l1` is not a list");
    check_added("N", "N", "`N` is the length of lists");
    check_added(
        "sum(|p| m[p] * p)",
        "p",
        "selects entries, as in `m[p]`, and is not a number: write the terms out",
    );
    check_added("I3", "I3", "write `J.powi(2)`");
    check_added("I1_bar", "I1_bar", "write `I1b`");
    check_added("Ib2", "Ib2", "write `I2b`");
    check_added("e.powf(-mu * (I1 - 3.0))", "e", "write `x.exp()` for eˣ");
    check_added(
        "E",
        "E",
        "C has eigenvalues `l1.powi(2)` and so on, the Green strain E `(l1.powi(2) - 1.0) / 2.0`",
    );
    check_added("f64::EPSILON", "f64::EPSILON", "write constants as numbers");
    check_added("I4", "I4", "it belongs to fibres, and an energy is isotropic");
    check_added("pi", "pi", "write `PI`");
    check_added("f64::INFINITY", "f64::INFINITY", "the numbers of an energy are finite");
    check_body(&format!("let unused = 1.0; {GOOD}"), &[("unused", "`unused` is not used")]);
    check_body(&format!("let mu = 1.0; {GOOD}"), &[("mu", "`mu` is taken already")]);
    check_body(&format!("let x = mu; let x = 2.0 * x; x + {GOOD}"), &[("x", "`x` is taken already")]);
    check_body("mu * (I1 - 3.0 - 2.0 * J.ln())", &[("m", "`m` does not occur")]);
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
fn calls_and_operators() {
    check_added("J.log()", "log", "takes one argument, the base; the natural logarithm is `.ln()`");
    check_added("J.pow(2)", "pow", "write `.powi(2)`");
    check_added("J.zeta()", "zeta", "there are `.powi(2)`, `.powf(alpha)`");
    check_added("J.acos()", "acos", "implements `piola::Univariate`");
    check_added("J.tan()", "tan", "write `x.sin() / x.cos()`");
    check_added("J.thanh()", "thanh", "did you mean `.tanh()`?");
    check_added("tanh(J)", "tanh", "write `x.tanh()`");
    check_added("J.tanh(2.0)", "tanh", "`tanh` takes no argument");
    check_added("J.log(1.0)", "1.0", "no base 1");
    check_added("(0.0).log10()", "(0.0).log10()", "a number that is not positive");
    check_added("tr(J)", "tr", "write the sum of the eigenvalues");
    check_added("J.abs()", "abs", "`abs` has a kink");
    check_added("J.ln(2.0)", "ln", "`ln` takes no argument");
    check_added("J.powi()", "powi", "one argument, the exponent");
    check_added("J.powi(0.5)", "0.5", "`powi` takes a whole number: for this one write `.powf(0.5)`");
    check_added("J.powi(2 * mu)", "2 * mu", "for this one write `.powf(2 * mu)`");
    check_added("sum(|p| J.powi(m[p]))", "m[p]", "for this one write `.powf(m[p])`");
    check_added("J.powi(1000)", "1000", "at most 64");
    check_added("J.powi(99999999999999999999)", "99999999999999999999", "at most 64");
    check_added("J.powf(l1)", "l1", "not of stretches");
    check_added("ln(J)", "ln", "write `x.ln()`");
    check_added("f64::powf(J, 2.0)", "f64::powf", "write `x.powf(alpha)`");
    check_added("mu(J)", "mu(J)", "`mu` is not a function: write `mu * (…)`");
    check_added("max(l1, 0.0)", "max", "`max` has a kink");
    check_added("sum(m)", "sum(m)", "a sum is written `sum(|p| mu[p] * …)`");
    check_added("sum(|i| mu)", "i", "runs over no list: write `m[i]` in it");
    check_added("J ^ 2", "^", "x.powi(2)");
    check_added("J ** 2", "*", "a power is written `x.powi(2)`");
    check_added("J % 2.0", "%", "only `+ - * /`");
    check_added("!J", "!", "only `-`");
    check_added("(J > 1.0)", ">", "an energy has no comparisons");
    check_added("if mu > 0.0 { 1.0 } else { 2.0 }", "if", "no branches");
    check_added("match 1 { _ => J }", "match", "no branches");
    check_added("if mu > 0.0 { nu } else { 2.0 }", "if", "no branches");
    check_added("(J as f64)", "f64", "remove the cast");
    check_added("[J, mu]", "[J, mu]", "lists are parameters, as `mu: [f64; N]`");
    check_added("mu * [J - 1.0]", "[J - 1.0]", "parentheses are round in an energy");
    check_body(&format!("return {GOOD};"), &[("return", "write it without `return` and `;`")]);
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
fn parts_are_named_inside_sums() {
    let energies = |sum: &str| {
        let energy = "mu * (I1 - 3.0 - 2.0 * J.ln())";
        let item = format!(
            "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N]) -> f64 {{ {energy} + {sum} }}"
        );
        let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
        let (_, model) = piola_codegen::analyse(tokens("domain(J > 0.0)"), tokens(&item)).expect(sum);
        let point = &model.samples[0];
        [model.energy, model.plain.energy].map(|id| evaluate(&model.graph, id, point).value)
    };
    let written_out = "sum(|p| (l1.powf(m[p]) + l2.powf(m[p]) + l3.powf(m[p]) - 3 - m[p] * J.ln()).exp())";
    let named = "sum(|p| {
        let s = l1.powf(m[p]) + l2.powf(m[p]) + l3.powf(m[p]) - 3;
        let q = s - m[p] * J.ln();
        q.exp()
    })";
    assert_eq!(energies(named), energies(written_out));
}

#[test]
fn sums_inside_sums() {
    let both = "sums over lists cannot stand inside each other: write two sums and multiply them";
    check_added("sum(|p| m[p] * sum(|q| m[q]))", "sum(|q| m[q])", both);
    check_added("sum(|p| sum(|q| l[q].powf(m[p]) * (m[q])))", "sum(|q| l[q].powf(m[p]) * (m[q]))", both);
    let out = |power: &str| format!("names one of them: write `sum(|l| l.{power})`");
    for inner in
        ["sum(|k| l[k].powf(m[p]))", "sum(|k| lambda[k].powf(m[p]) - 1)", "sum(|k| mu * l1[k].powf(m[p]))"]
    {
        check_added(&format!("sum(|p| m[p] * (({inner} - 3).exp() - 1))"), inner, &out("powf(m[p])"));
    }
    check_added("sum(|p| m[p] * sum(|k| l[k].powi(4)))", "sum(|k| l[k].powi(4))", &out("powi(2)"));
    let inner = "sum(|k| m[p] * x[k].powf(a[p]))";
    let item = format!("fn E([x, y, z]: [f64; 3], m: [f64; 2], a: [f64; 2]) -> f64 {{ sum(|p| {inner}) }}");
    check("", &item, &[(inner, "names one of them: write `sum(|l| l.powf(a[p]))`")]);
}

/// Stretches come in order, so that a condition on the second one is on neither the largest nor the smallest.
#[test]
fn domains_are_symmetric() {
    check_arguments(
        "domain(J > 0.0, l2 < 3.0)",
        &[("l2 < 3.0", "write this condition for the largest, `l1`")],
    );
    for domain in
        ["J > 0.0, l1 < 3.0", "J > 0.0, l1 < 3.0, l2 < 3.0, l3 < 3.0", "J > 0.0, l1 + l2 + l3 < 9.0"]
    {
        check_arguments(&format!("domain({domain})"), &[]);
    }
}

/// The closure of a sum over stretches has names of its own, each read at least once.
#[test]
fn sums_over_stretches() {
    let whole = "mu * (sum(|l| l.powi(2) - 1.0) - 2.0 * J.ln()) + sum(|p| m[p]) * (J - 1.0).powi(2)";
    check_body(whole, &[]);
    check_body(&format!("{GOOD} + mu * sum(|a, b| (a * b - 1.0).powi(2))"), &[]);
    check_body(
        &format!("{GOOD} + sum(|l| {{ let s = l / J.cbrt(); sum(|p| (s.powf(m[p]) - 1.0) * m[p]) }})"),
        &[],
    );
    check_added("sum(|l1| l1.powi(2))", "l1", "the name `l1` is taken already");
    check_added("sum(|a, a| (a - 1.0).powi(2))", "a", "the name `a` is taken already");
    check_added("sum(|a, b| (a - 1.0).powi(2))", "b", "`b` is not used: remove it");
    check_added("sum(|l| (l - nu).powi(2))", "nu", "did you mean `mu`?");
    check_added(
        "sum(|a, b, c| a * b * c)",
        "sum(|a, b, c| a * b * c)",
        "`sum(|a, b| (a * b).powi(2))` over their pairs",
    );
    check_added("sum(|l| { let s = l; l.powi(2) })", "s", "`s` is not used");
}

/// Papers write tr C⁻¹, which is I2/J², not I1; each is one mistake.
#[test]
fn tensors() {
    for c in ["C", "b", "B", "C.inverse().inverse()"] {
        check_added(&format!("tr({c})"), "tr", "write `I1` for the trace of C");
        check_added(&format!("{c}.trace()"), "trace", "write `I1` for the trace of C");
        check_added(&format!("det({c})"), "det", "write `J.powi(2)` for the determinant of C");
    }
    for inverse in [
        "C.inverse()",
        "C.inv()",
        "C.powi(-1)",
        "(C).powf(-1.0)",
        "C.recip()",
        "inverse(C)",
        "Cinv",
        "C_inv",
        "invC",
        "b_inv",
    ] {
        check_added(&format!("tr({inverse})"), "tr", "write `I2 / J.powi(2)` for the trace of C⁻¹");
        check_added(&format!("{inverse}.trace()"), "trace", "write `I2 / J.powi(2)` for the trace of C⁻¹");
    }
    for other in ["E", "U", "C.powi(2)", "C.sqrt()", "C * C", "(E - 1.0)", "C.inverse().powi(2)", "C.foo()"] {
        check_added(&format!("tr({other})"), "tr", "write the sum of the eigenvalues, of C `l1.powi(2)`");
        check_added(&format!("({other}).trace()"), "trace", "write the sum of the eigenvalues");
    }
    check_added("F.determinant()", "determinant", "write `J` for the determinant of F");
    check_added("C.inverse()", "C", "C has eigenvalues");
    check_added("C.transpose().double_dot(C)", "C", "C has eigenvalues");
    check_added("Cinv", "Cinv", "C has eigenvalues");
    // Names of the declaration are not tensors.
    check_body(&format!("let b = mu; {GOOD} + tr(b)"), &[("tr", "write the sum of the eigenvalues")]);
}

#[test]
fn numbers() {
    check_added("1.0f32", "1.0f32", "remove the suffix");
    for suffix in ["i32", "usize", "u8", "f16"] {
        check_added(&format!("1{suffix}"), &format!("1{suffix}"), "remove the suffix");
    }
    check_added("1e999", "1e999", "not finite");
    check_added("true", "true", "a literal in an energy is a number");
    check_added("J / 0.0", "0.0", "division by zero");
    check_added("(J - J).recip()", "(J - J)", "division by zero");
    check_added("(J - J).powi(-2)", "-2", "division by zero");
    check_added("(0.0).ln()", "(0.0).ln()", "a number that is not positive");
    check_added("(3.0 * J).powi(64).powi(2)", "(3.0 * J).powi(64).powi(2)", "leaves 128 bits");
    let shape = "1e38 * mu * (J.powi(2) - 2.0 * J + 1.0)";
    check(
        "",
        &format!("fn E([a, b, c]: [f64; 3], mu: f64) -> f64 {{ {shape} }}"),
        &[(shape, "in the derivatives")],
    );
    check_added("1e30 * 1e30 + 1.0", "1e30 * 1e30", "leaves 128 bits");
}

/// Papers write products without a sign.
#[test]
fn numbers_before_names() {
    check_added("mu * (2mu - 1.0)", "2mu", "`2mu` is not a number: write `2 * mu` for a product");
    check_added("J.powf(2.5mu)", "2.5mu", "write `2.5 * mu` for a product");
    check_added("J.powi(2u1)", "2u1", "write `2 * u1` for a product");
    check_body(&GOOD.replace("mu *", "2mu *"), &[("2mu", "write `2 * mu` for a product")]);
    check_arguments("domain(J > 0.0, I1 < 3mu)", &[("3mu", "write `3 * mu` for a product")]);
    check_arguments("domain(J > 0.0), admissible(2mu > 1.0)", &[("2mu", "write `2 * mu` for a product")]);
    check_added("2(mu * (1.0 - 1.0))", "2", "`2` is not a function: write `2 * (…)` for a product");
    check_added("(mu)(mu - mu)", "(mu)", "this is not a function: write `*` behind it for a product");
}

#[test]
fn lines() {
    check_body(&format!("{GOOD};"), &[(";", "remove this `;`")]);
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
fn arguments() {
    check_arguments("domain(J > 0.0, J > 2.0)", &[("J > 2.0", "excludes the rest state")]);
    check_arguments("domain(J > 0.0, l1 != 2.0)", &[("l1 != 2.0", "only a volume can be left out")]);
    check_arguments("domein(J > 0.0), extend", &[("domein", "did you mean `domain(J > 0.0)`?")]);
    check_arguments("extend", &[("extend", "beyond `domain(J > 0.0)`: declare that or remove `extend`")]);
    check_arguments("domain(J > 0.0), fit(mu)", &[("fit", "`fit` is written `fit`")]);
    check_arguments("domain(J > 0.0), fitt", &[("fitt", "did you mean `fit`?")]);
    check_arguments("domain(J > 0.0), fit, fit", &[("fit", "`fit` is given twice")]);
    check_arguments("domain(J > 0.0), serd", &[("serd", "did you mean `serde`?")]);
    check_arguments("domain(J != 0.0), extend, refuse(\"no\")", &[("refuse", "either `extend` or `refuse`")]);
    check_arguments("domain(J > 0.0), refuse(no)", &[("no", "say in a string why")]);
    check_arguments("domain(J > 0.0), domein(mu > 0.0)", &[("domein", "did you mean `domain(J > 0.0)`?")]);
    check_arguments(
        "domain(J > 0.0), unit(\"Pa\")",
        &[("unit", "there are `domain(J > 0.0)`, `admissible(mu > 0.0)`")],
    );
    check_arguments(
        "domain(J > 0.0), prestressed = true",
        &[("prestressed", "`prestressed` is written `prestressed`")],
    );
    check_arguments("domain(J > 0.0), domain(l1 > 0.0)", &[("domain", "is given twice")]);
    check_arguments("domain(J > 0.0), a::b", &[("a::b", "an argument is one word")]);
    check_arguments("domain(J > 0.0 && l1 > 0.0)", &[("&&", "separated by commas")]);
    let parameters = |condition: &str, tokens: &str, expected: &str| {
        check_arguments(&format!("domain(J > 0.0), admissible({condition})"), &[(tokens, expected)]);
    };
    parameters("mu", "mu", "a condition is a comparison");
    parameters("l1 > 0.0", "l1", "stand in `domain(…)`");
    parameters("mu * J > 0.0", "J", "stand in `domain(…)`");
    parameters("mu.powi(1 + 1) > 0.0", "1 + 1", "`powi` takes one number");
    parameters("mu.powi(0.5) > 0.0", "0.5", "`powi` takes a whole number");
    parameters("mu.abs() > 0.0", "abs", "has a kink");
    parameters("m > 0.0", "m", "write `m[p]`");
    parameters("sum(|p| m[p]) > 0.0", "sum(|p| m[p])", "it holds for each entry");
    parameters("m[p] > m[q]", "q", "the index here is `p`");
    parameters("nu > 0.0", "nu", "did you mean `mu`?");
}

#[test]
fn signatures() {
    const FIRST: &str = "the first argument names the three stretches: `[l1, l2, l3]: [f64; 3]`";
    check("", "struct E;", &[("struct", "`#[material]` stands on a function")]);
    check("", "fn E() -> f64 { 1.0 }", &[("E", FIRST)]);
    check("", "fn E([a, b]: [f64; 2]) -> f64 { a }", &[("[a, b]: [f64; 2]", FIRST)]);
    check("", "fn E([a, b, c]: [f32; 3]) -> f64 { a }", &[("[a, b, c]: [f32; 3]", FIRST)]);
    check("", "fn E(&self) -> f64 { 1.0 }", &[("&self", FIRST)]);
    check("", "fn E([a, b, b]: [f64; 3]) -> f64 { a }", &[("b", "`b` is taken already")]);
    check_signature("fn E([a, b, c]: [f64; 3], mu: f64)", &[("E", "write `-> f64`")]);
    check_signature("fn E([a, b, c]: [f64; 3], mu: f64) -> f32", &[("f32", "write `-> f64`")]);
    check_signature("const fn E([a, b, c]: [f64; 3], mu: f64) -> f64", &[("const", "remove this")]);
    check_signature(
        "extern \"C\" fn E([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("extern \"C\"", "remove this")],
    );
    check_signature(
        "fn E<T>([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("T", "only lengths of lists can be generic")],
    );
    check_signature(
        "fn E<'a>([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("'a", "only lengths of lists can be generic")],
    );
    check_signature(
        "fn E<const N: usize>([a, b, c]: [f64; 3], mu: f64) -> f64",
        &[("N", "`N` is the length of no list")],
    );
    let parameter = |parameter: &str, tokens: &str, expected: &str| {
        let item =
            format!("fn E([a, b, c]: [f64; 3], {parameter}) -> f64 {{ mu * (I1 - 3.0 - 2.0 * J + 2.0) }}");
        let found = mistakes("", &item);
        assert_eq!(found.first().map(|(found, _)| &**found), Some(tokens), "{found:#?}");
        assert!(found[0].1.contains(expected), "{found:#?}");
    };
    parameter("mu: f32", "f32", "a parameter is a number `mu: f64`");
    parameter("mu: (f64, f64)", "(f64, f64)", "a parameter is a number `mu: f64`");
    parameter("mut mu: f64", "mut mu", "a parameter is a number `mu: f64`");
    parameter("mu: &[f64]", "&[f64]", "write `Vec<f64>`, or `[f64; N]` with `const N: usize`");
    parameter("mu: Vec<f32>", "f32", "the entries of a list are `f64`");
    parameter("mu: Vec", "Vec", "the entries of a list are `f64`");
    parameter("mu: Vec<f64>", "mu", "`mu` is a list: write `sum(|p| … mu[p] …)`");
    parameter("mu: [f32; 3]", "f32", "the entries of a list are `f64`");
    parameter("mu: [f64; M]", "M", "or `N` with `const N: usize`");
    parameter("mu: [f64; 0]", "0", "the length of a list is a number such as `3`");
    parameter("J: f64", "J", "`J` has a meaning of its own");
    parameter("energy: f64", "energy", "`energy` has a meaning of its own");
    parameter("a: f64", "a", "`a` is taken already");
    parameter("mu: f64, mu: f64", "mu", "`mu` is taken already");
    parameter(
        "mu: piola::Spline",
        "mu",
        "`mu` is declared as a function: write `mu(l1)`, or declare `mu: f64`",
    );
}

#[test]
fn a_refused_generic_is_one_mistake() {
    let item = "fn E<T>([a, b, c]: [T; 3], mu: T, m: [T; 2]) -> T {
        sum(|p| m[p]) * mu * ((a - 1.0).powi(2) + (b - 1.0).powi(2) + (c - 1.0).powi(2))
    }";
    check("", item, &[("T", "only lengths of lists can be generic")]);
}

#[test]
fn lists_of_a_sum_are_equally_long() {
    let item = "fn E([a, b, c]: [f64; 3], m: [f64; 2], n: [f64; 3]) -> f64 {
        sum(|p| m[p] * n[p] * n[p]) * ((a - 1.0).powi(2) + (b - 1.0).powi(2) + (c - 1.0).powi(2))
    }";
    check("", item, &[("n", "`n` has another length than the lists before it")]);
    let mixed = item.replace("[f64; 3]) ->", "Vec<f64>) ->");
    check("", &mixed, &[("n", "`n` has another length than the lists before it")]);
    check("", &mixed.replace("[f64; 2]", "Vec<f64>"), &[]);
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

#[test]
fn half_a_body_is_one_mistake() {
    check("", "fn E([a, b, c]: [f64; 3], mu: f64) -> f64 { mu * }", &[("}", "expected an expression")]);
    check("", "fn E([a, b, c]: [f64; 3], mu) -> f64 { mu }", &[(")", "a declaration is `fn Name(")]);
}

/// The messages of the cases of `piola-macros`, whatever way the compiler underlines tokens.
#[test]
fn the_compiler_shows_these_messages() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/ui");
    let mut compared = 0;
    for file in fs::read_dir(&folder).expect("the cases") {
        let path = file.expect("a case").path();
        // A thousand parentheses overflow the stack of a test before they are a declaration:
        // tests/nesting.rs.
        let is_too_deep = path.ends_with("nested_too_deep.rs");
        if is_too_deep || path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let source = fs::read_to_string(&path).expect("a case");
        let declarations = piola_codegen::declarations(&source).expect("a Rust source");
        if declarations.is_empty() {
            let declares_nothing =
                ["no_function.rs", "dyn_material.rs"].iter().any(|name| path.ends_with(name));
            assert!(declares_nothing, "{} declares nothing", path.display());
            continue;
        }
        let said: Vec<String> = declarations
            .into_iter()
            .flat_map(|(arguments, item)| piola_codegen::analyse(arguments, item).err())
            .flatten()
            .map(|error| error.to_string())
            .collect();
        let shown = fs::read_to_string(path.with_extension("stderr")).expect("what the compiler shows");
        let shown: Vec<_> = shown.lines().filter_map(|line| line.strip_prefix("error: ")).collect();
        assert_eq!(shown, said, "{}", path.display());
        compared += 1;
    }
    assert!(compared > 35, "{compared} cases");
}
