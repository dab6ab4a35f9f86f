//! Mistakes of the energy itself, whose words are understood: stress at rest, asymmetry, units.

use super::{check, check_added, check_body, mistakes};

#[test]
fn physics() {
    let body =
        "let skew = mu * (l1 + 2.0 * l2 + l3); sum(|p| m[p]) * (I1 - 3.0 - 2.0 * J.ln()) + (skew - mu)";
    check_body(body, &[("mu * (l1 + 2.0 * l2 + l3)", "does not change when `l1` and `l2` are exchanged")]);
    for (attribute, term, message) in [
        (
            "",
            "I1 - 3.0 - 2.0 * J.ln()",
            "no value where J < 0, in inverted material: declare `domain(J > 0.0)`",
        ),
        (
            "",
            "I1b - 3.0",
            "no value where J = 0, in flat material: declare `domain(J > 0.0)`, or `domain(J != 0.0)` if the energy should treat \
             inverted elements (J < 0) like upright ones",
        ),
        (
            "",
            "I1 - 3.0 + J.powi(-2)",
            "no value where J = 0, in flat material: declare `domain(J > 0.0)`, or",
        ),
        ("domain(J != 0.0)", "I1 - 3.0 - 2.0 * J.ln()", "no value where J < 0, in inverted material"),
    ] {
        let item = format!("fn E([a, b, c]: [f64; 3], mu: f64) -> f64 {{ mu * ({term}) }}");
        check(attribute, &item, &[(&format!("mu * ({term})"), message)]);
    }
    check("prestressed", "fn E([a, b, c]: [f64; 3], mu: f64) -> f64 { mu * I1 }", &[]);
    check_added("mu / (I1b - 3.0)", "mu / (I1b - 3.0)", "is not finite at rest");
}

#[test]
fn stress_at_rest_is_gathered() {
    let says = |generics: &str, parameters: &str, energy: &str, stress: &str| {
        let item = format!("fn E{generics}([l1, l2, l3]: [f64; 3], {parameters}) -> f64 {{ {energy} }}");
        let found = mistakes("domain(J > 0.0)", &item);
        let [(_, message)] = &found[..] else { panic!("{energy}: {found:#?}") };
        assert!(message.contains(&format!("leaves the stress `{stress}` at rest")), "{message}");
    };
    let generics = "<const N: usize, const M: usize>";
    let lists = "A: [f64; N], n: [f64; N], B: [f64; M], m: [f64; M]";
    let strain =
        |power: &str| format!("(l1.powf({power}) + l2.powf({power}) + l3.powf({power}) - 3) / {power}");
    let (first, second) = (strain("n[p]"), strain("m[q]"));
    let energy = format!("sum(|p| A[p] * {first}) + sum(|q| B[q] * {second})");
    says(generics, lists, &energy, "sum(|p| A[p]) + sum(|p| B[p])");
    let energy =
        "sum(|p| A[p] * (I1 / 3).powf(n[p]) / n[p]) * 3 / 2 + sum(|q| B[q] * (I2 / 3).powf(m[q]) / m[q])";
    says(generics, lists, energy, "sum(|p| A[p]) + 4.0 * sum(|p| B[p]) / 3.0");
    let energy = "A * (I1.powf(n) + (I2 / J).powf(n) + I1 * 3.0.powf(n))";
    says("", "A: f64, n: f64", energy, "2.0 * A * 3.0.powf(n) + A * n * 3.0.powf(n)");
}

/// An incompressible solid lacks a term; in an energy with J, a term is mistyped.
#[test]
fn stress_at_rest_of_a_compressible_solid_is_a_mistype() {
    let says_so = |attribute: &str, energy: &str| {
        let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, n: f64) -> f64 {{ mu * n * ({energy}) }}");
        let [(_, message)] = &mistakes(attribute, &item)[..] else { panic!("{energy}") };
        message.ends_with(
            "to the attribute (if the paper's solid is compressible, a factor or a power is mistyped)",
        )
    };
    assert!(says_so("domain(J > 0.0)", "I1.powf(n) + (I2 / J).powf(n)"));
    assert!(says_so("domain(J > 0.0)", "l1 + l2 + l3"));
    assert!(says_so("", "I1 - 3.0 + J"));
    assert!(!says_so("", "I1 - 3.0"));
    assert!(!says_so("", "l1.powi(4) + l2.powi(4) + l3.powi(4) - 3.0"));
}

#[test]
fn the_stress_at_rest_is_taken_away_by_what_is_printed() {
    let check = |energy: &str, isochoric: Option<&str>| {
        let declared = |energy: &str| {
            let item = format!(
                "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, b: f64, m: [f64; N], a: [f64; N]) -> f64 {{ \
                 b * (J - 1.0).powi(2) + mu * sum(|p| m[p] * a[p]) * (I1b - 3.0) + {energy} }}"
            );
            mistakes("domain(J > 0.0)", &item)
        };
        let found = declared(energy);
        let [(_, message)] = &found[..] else { panic!("{energy}: {found:#?}") };
        let (_, rest) = message.split_once("append `").expect(message);
        let (term, rest) = rest.split_once('`').expect(message);
        let balanced = format!("{energy} {term}");
        assert_eq!(declared(&balanced), [], "{balanced}");
        let said = rest.strip_prefix("; or write ").and_then(|rest| rest.split_once(", which leaves none"));
        assert_eq!(said.map(|(said, _)| said), isochoric, "{message}");
    };
    check("mu * (I1 - 3) + b * (I2 - 3)", Some("`I1b`, `I2b` for `I1`, `I2`"));
    check("-mu * (I1 - 3) / 2 - b * I1", Some("`I1b` for `I1`"));
    check("mu * (I1 - 3) + b * J", None);
    check("mu * (b.sqrt() * I1 / 3).powf(mu) + (b * J).exp()", None);
    check("sum(|k| m[k] / a[k] * (l1.powf(a[k]) + l2.powf(a[k]) + l3.powf(a[k]) - 3))", None);
    check("mu * (I1 + 2 / b / (1 + b * I1 / 3)) / 6 + (mu / (b * J) + b).ln()", None);
}

/// A term in `J - 1.0` is offered only if it needs no other domain.
#[test]
fn what_is_printed_has_a_value_wherever_it_is_said_to() {
    let check = |arguments: &str, energy: &str, place: Option<&str>| {
        let declared = |arguments: &str, term: &str| {
            let item = format!(
                "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, m: [f64; N], a: [f64; N]) -> f64 {{ \
                 {energy} + sum(|p| m[p] * a[p]) * mu * (J - 1).powi(2) {term} }}"
            );
            mistakes(arguments, &item)
        };
        let found = declared(arguments, "");
        let [(_, message)] = &found[..] else { panic!("{energy}: {found:#?}") };
        let (_, rest) = message.split_once("append `").expect(message);
        let (logarithm, rest) = rest.split_once("` with `domain(J > 0.0)`").expect(message);
        assert_eq!(declared("domain(J > 0.0)", logarithm), [], "{energy} {logarithm}");
        let linear = logarithm.replace("J.ln()", "(J - 1.0)");
        let offered = place.map(|place| format!(", or `{linear}` with {place}; or "));
        assert!(rest.starts_with(offered.as_deref().unwrap_or("; or ")), "{message}");
        assert_eq!(declared(arguments, &linear).is_empty(), place.is_some(), "{energy} {linear}");
    };
    let of_powers = "l1.powf(a[p]) + l2.powf(a[p]) + l3.powf(a[p]) - 3";
    check("", &format!("sum(|p| m[p] * ({of_powers}))"), None);
    check("", &format!("sum(|p| m[p] * ((a[p] * ({of_powers})).exp() - 1))"), None);
    check("", "mu * (I1 + J.ln() / 2)", None);
    check("", "mu * (I1 + J.powi(-2) / 2)", None);
    check("", "mu * I1.powf(mu)", None);
    check("", "mu * I1", Some("any domain"));
    check("", "mu * (mu * (I1 - 3)).exp()", Some("any domain"));
    check("", "mu * (1 + I1).powf(mu)", Some("any domain"));
    check("domain(J != 0.0)", "mu * I1.powf(mu) + mu * J.sqrt()", None);
    check("domain(J != 0.0)", "mu * (I1 + J.powi(-2) / 2)", Some("the declared one"));
}

/// A stress that is longer than some lines is not quoted to be appended: isochoric stretches leave none.
#[test]
fn long_stresses_are_avoided_instead_of_balanced() {
    let chain = "let x = l / n.sqrt(); x * (3.0 - x.powi(2)) / (1.0 - x.powi(2)) * (x / x.sinh()).ln()";
    let energy = format!("mu * n * sum(|l| {{ {chain} }})");
    let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, n: f64) -> f64 {{ {energy} }}");
    let found = mistakes("domain(J > 0.0, l1.powi(2) < n), admissible(n > 1.0)", &item);
    let [(tokens, message)] = &found[..] else { panic!("{found:#?}") };
    assert_eq!(tokens, &energy);
    assert!(
        message.contains("write `l1 / J.cbrt()` for `l1`, and so on for `l2` and `l3`, which leaves none")
    );
    assert!(message.len() < 300, "{message}");
    // The remedy is what it says.
    let isochoric = energy.replace("l / n.sqrt()", "l / J.cbrt() / n.sqrt()");
    let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, n: f64) -> f64 {{ {isochoric} }}");
    check(
        "domain(J > 0.0, l1.powi(2) < n * J.powf(2.0 / 3.0)), admissible(n > 1.0), prestressed",
        &item,
        &[],
    );
}

/// Of whole exponents that are parameters, powers at rest cannot be written, and no part of them is offered.
#[test]
fn what_cannot_be_written_is_not_offered() {
    let check = |term: &str, remedy: &str| {
        let item = format!(
            "fn E<const N: usize>([l1, l2, l3]: [f64; 3], c: [f64; N], i: [u32; N], j: [u32; N]) -> f64 {{ \
             sum(|p| c[p] * (I1 - 3.0).powi(i[p]) * (I2 - 3.0).powi(j[p])) + {term} }}"
        );
        let [(_, message)] = &mistakes("domain(J > 0.0)", &item)[..] else { panic!("{term}") };
        let start = format!("this leaves stress at rest: {remedy}; or add `prestressed` to the attribute");
        assert!(message.starts_with(&start) && !message.contains('…'), "{message}");
    };
    check("sum(|p| c[p]) * (J - 1.0).powi(2)", "write `I1b`, `I2b` for `I1`, `I2`, which leaves none");
    check("sum(|p| c[p]) * J", "remove it by a term in `J.ln()`");
}

#[test]
fn the_asymmetric_term_is_named_where_it_is_short() {
    check_added("mu * l1 * l2", "mu * l1 * l2", "but `mu * l1 * l2` does: write");
    let long = "mu * (l1 - 1.0).powi(2) * (l2 - 1.0).powi(2) * (J - 2.0).exp()";
    check_added(long, long, "but this does: write");
    let whole = "mu * l1 + sum(|p| m[p]) * l2";
    check_body(whole, &[(whole, "but this does: write")]);
}

/// Mistakes of different terms, or of one term and of a missing one.
#[test]
fn independent_mistakes_come_at_once() {
    let energy = |body: &str| {
        format!(
            "fn E([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64, m: f64) -> f64 {{ m * (J - 1).powi(2) + {body} }}"
        )
    };
    let stressed = "leaves the stress `2.0 * mu` at rest";
    let inverted = "no value where J < 0, in inverted material: declare `domain(J > 0.0)`";
    let logarithm = "kappa * J.ln().powi(2)";
    check(
        "",
        &energy(&format!("mu * (I1 - 3) + {logarithm}")),
        &[("mu * (I1 - 3)", stressed), (logarithm, inverted)],
    );
    check(
        "domain(J > 0.0)",
        &energy("kappa * J.ln().powf(2.5) + mu * I1"),
        &[("J.ln().powf(2.5)", "vanishes at rest and is negative nearby"), ("mu * I1", stressed)],
    );
    check(
        "",
        &energy("kappa / (I1b - 3) + mu * J.ln()"),
        &[("kappa / (I1b - 3)", "is not finite at rest"), ("mu * J.ln()", inverted)],
    );
    check(
        "",
        "fn E([l1, l2, l3]: [f64; 3], kappa: f64) -> f64 { kappa * J.ln().powi(2) }",
        &[(logarithm, inverted), (logarithm, "the shear modulus of this energy is zero at rest")],
    );
    // The domain that one message asks for includes that of the other.
    let limited = "mu * (1 - (I1 - 3) / m).ln()";
    let both = "domain(J > 0.0, 1.0 - (I1 - 3.0) / m > 0.0)";
    let energy = energy(&format!("{limited} + {logarithm}"));
    check(
        "prestressed",
        &energy,
        &[(logarithm, inverted), ("(1 - (I1 - 3) / m).ln()", &format!("declare `{both}`"))],
    );
    check(&format!("prestressed, {both}"), &energy, &[]);
}

/// A term that breaks several rules is reported once, under any of its names.
#[test]
fn one_term_is_one_mistake() {
    let check = |arguments: &str, body: &str, tokens: &str, message: &str| {
        let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, b: f64) -> f64 {{ {body} }}");
        check(arguments, &item, &[(tokens, message)]);
    };
    let volume = "b * mu * (J - 1).powi(2)";
    check(
        "domain(J > 0.0)",
        &format!("let root = (I1 - 3 + b).powf(b); mu * root + {volume}"),
        "mu * root",
        "leaves the stress",
    );
    check("", &format!("mu * (I1 + J.ln()) + {volume}"), "mu * (I1 + J.ln())", "with `domain(J > 0.0)`");
    check(
        "",
        &format!("mu * ((l1 - 1).powi(2) + (l2 - 1).powi(2) + (l3 - 1).powi(2)) - mu * J.ln() + {volume}"),
        "mu * J.ln()",
        "append `+ mu * (J - 1.0)` with `domain(J > 0.0)`, or remove the term in `J.ln()`",
    );
    check(
        "",
        &format!("mu * (J - 1).cbrt() + {volume}"),
        "(J - 1).cbrt()",
        "vanishes at rest and is negative nearby",
    );
}

/// An energy of a modulus μ in Pa, an exponent n without unit, and x without any stated.
#[track_caller]
fn check_units(body: &str, expected: &[(&str, &str)]) {
    let item = format!(
        "fn E([l1, l2, l3]: [f64; 3], /** Modulus, Pa. */ mu: f64, /** Exponent, dimensionless. */ n: f64, x: f64) -> f64 {{ \
         {body} }}"
    );
    check("domain(J > 0.0), prestressed", &item, expected);
}

#[test]
fn units_make_an_energy_density() {
    check_units("mu / n * ((I1b - 2.0).powf(n) - 1.0) + x * J.ln() + (mu * x).sqrt()", &[]);
    check_units("(mu * mu * n * I1 * I2).sqrt() + x * J", &[]);
    check_units(
        "mu * (I1 - 3.0) + n * (J - 1.0).powi(2) + x * J",
        &[("mu * (I1 - 3.0) + n * (J - 1.0).powi(2)", "is added to")],
    );
    check_units("mu * (I1 + mu) + n + x", &[("I1 + mu", "`mu`, in Pa, is added to")]);
    check_units("mu * (I1 * mu).ln() + n * x", &[("(I1 * mu).ln()", "without unit can")]);
    check_units("mu * I1.powf(mu) + n * x", &[("I1.powf(mu)", "`mu`, in Pa,")]);
    check_units(
        "mu * mu * I1.powf(n) + 0.0 * x",
        &[("mu * mu * I1.powf(n) + 0.0 * x", "this energy is in Pa^2, but an energy density is in Pa")],
    );
}

#[test]
fn units_are_those_of_the_values() {
    let item =
        "fn E([l1, l2, l3]: [f64; 3], /** Modulus, MPa. */ mu: f64, /** Bulk modulus, Pa. */ k: f64) -> f64 {
        mu * (I1b - 3.0) + k * (J - 1.0).powi(2)
    }";
    let message = "values of parameters are in SI units, not in `MPa`: write `Pa`, `1/Pa` or";
    check("domain(J > 0.0)", item, &[("/** Modulus, MPa. */", message)]);
}

#[test]
fn typical_parameters_are_those_of_the_declaration() {
    let of = |typical: &str, expected: &[(&str, &str)]| {
        let item = "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, a: [f64; N]) -> f64 {
            (mu + sum(|p| a[p])) * (I1 - 3.0 - 2.0 * J.ln())
        }";
        check(&format!("domain(J > 0.0), {typical}"), item, expected);
    };
    of("typical(\"rubber\", mu = 4e5, a = [1.0, -2.0])", &[]);
    of("typical(\"rubber\", mu = 4e5)", &[("typical", "add one for `a`")]);
    of("typical(\"rubber\", mu = [4e5], a = [1.0])", &[("mu", "one number")]);
    of("typical(\"rubber\", mu = 4e5, a = 1.0)", &[("a", "a list")]);
    of("typical(\"rubber\", mu = 4e5, a = [1.0], nu = 0.5)", &[("nu", "is not a parameter")]);
    of(
        "typical(\"rubber\", mu = x, a = [1.0])",
        &[("x", "typical parameters are written"), ("typical", "`mu`")],
    );
    of("typical(mu = 4e5)", &[("mu", "the material first")]);
    of("typical", &[("typical", "is written `typical(\"natural rubber\", mu = 4e5)`")]);
}
