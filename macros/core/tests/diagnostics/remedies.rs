//! Remedies: an energy that follows a message has no mistake, and a message offers nothing else.

use super::{check, mistakes};

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

/// A condition that fails where elements are flat is not offered where `extend` excludes it.
#[test]
fn what_is_extended_has_room_for_flat_elements() {
    let limited = "fn E([l1, l2, l3]: [f64; 3], mu: f64, m: f64) -> f64 { -mu * (1 - (I1 - 3) / m).ln() }";
    let message = |arguments: &str| {
        mistakes(arguments, limited).into_iter().map(|(_, message)| message).collect::<String>()
    };
    assert!(message("domain(J > 0.0, I1 - 3.0 < m)").contains("or write `I1b` for `I1`"));
    assert!(!message("domain(J > 0.0, I1 - 3.0 < m), extend").contains("I1b"));
}
