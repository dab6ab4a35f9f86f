//! Sums over the stretches and over lists, and names inside them.

use piola_codegen::algebra::interpret::evaluate;
use proc_macro2::TokenStream;

use super::{GOOD, check, check_added, check_arguments, check_body};

#[test]
fn parts_are_named_inside_sums() {
    let energies = |sum: &str| {
        let energy = "mu * (I1 - 3.0 - 2.0 * J.ln())";
        let item = format!(
            "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N]) -> f64 {{ {energy} + {sum} }}"
        );
        let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
        let (_, model) = piola_codegen::analyse(tokens("domain(J > 0.0)"), tokens(&item), None).expect(sum);
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

/// Stretches come in order, so that a condition on the second one constrains neither the largest nor the
/// smallest.
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
    // Names of the declaration are not tensors.
    check_body(&format!("let b = mu; {GOOD} + tr(b)"), &[("tr", "write the sum of the eigenvalues")]);
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
