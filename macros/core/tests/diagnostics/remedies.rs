//! Remedies: an energy that follows a message has no mistake, and a message offers nothing else.

use super::mistakes;

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
