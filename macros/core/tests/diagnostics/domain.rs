//! Where an energy and its continuation have a value.

use super::{GOOD, check, check_added, check_body, mistakes};

/// Near rest, rounding gives an expression that vanishes there either sign.
#[test]
fn what_vanishes_at_rest_has_whole_powers() {
    for (factor, written, power) in [
        ("mu", "(I1 - 3.0).sqrt()", "(I1 - 3.0).sqrt()"),
        ("mu", "(J - 1.0).cbrt()", "(J - 1.0).cbrt()"),
        ("mu", "(mu * (I1 - 3.0)).powf(2.0 * mu)", "(mu * (I1 - 3.0)).powf(2.0 * mu)"),
        ("sum(|p| m[p])", "(2.0 * J.ln()).powf(mu)", "(2.0 * J.ln()).powf(mu)"),
    ] {
        let term = format!("{factor} * {written}");
        check_added(&term, written, &format!("the base of `{power}` vanishes at rest"));
    }
    let of_entries = "(2.0 * J.ln()).powf(m[p])";
    check_added(
        &format!("sum(|p| m[p] * {of_entries})"),
        of_entries,
        "the base of `(2.0 * J.ln()).powf(m[p])` vanishes at rest",
    );
    check_body(&format!("{GOOD} + mu * (1.0 + mu * (I1b - 3.0)).powf(mu)"), &[]);
    check_added(
        "mu * (I1 - 3.0).powf(1.5)",
        "(I1 - 3.0).powf(1.5)",
        "write `I1b` for `I1`, since `I1b - 3.0` is never negative",
    );
}

/// I1b − 3 is never negative, and its real powers above 1 are smooth.
#[test]
fn powers_of_what_is_never_negative() {
    check_body(&format!("{GOOD} + mu * (I1b - 3.0).powf(1.5)"), &[]);
    check_body(&format!("{GOOD} + mu * (2.0 * (I1b - 3.0) + I2b - 3.0).powf(1.01)"), &[]);
    let rough = "the stiffness of this is infinite at rest";
    for power in ["(I1b - 3.0).sqrt()", "(I2b - 3.0).powf(0.9)", "(I1b - 3.0).powf(mu)"] {
        check_added(&format!("mu * {power}"), power, rough);
    }
    // The terms of first order cancel, and the root alone would not do.
    let smooth = "let t = ((I1b - 3.0) / mu).sqrt(); -mu * ((1.0 - t).ln() + t)";
    check(
        "domain(J > 0.0, I1b - 3.0 < mu)",
        &format!("fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {{ {smooth} + mu * (J - 1.0).powi(2) }}"),
        &[],
    );
    let energy = "mu * (I1b - 3.0) + k * (I1b - 3.0).powf(n)";
    let item = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, k: f64, n: f64) -> f64 {{ {energy} }}");
    check("domain(J > 0.0)", &item, &[("(I1b - 3.0).powf(n)", "declare `admissible(n > 1.0)`")]);
    check("domain(J > 0.0), admissible(n > 1.0), fit", &item, &[]);
    check("domain(J > 0.0), admissible(n > 1.0), extend", &item, &[("extend", "which is not continued")]);
}

/// All exponents without a bound are named at once, each once, and none that has one.
#[test]
fn exponents_of_what_vanishes_at_rest_are_above_one() {
    let mistakes = |admissible: &str, energy: &str| {
        let item = format!(
            "fn E<const N: usize>([l1, l2, l3]: [f64; 3], k: f64, a: f64, b: f64, c: [f64; N], n: [f64; N]) -> f64 {{ \
             k * a * b * sum(|p| c[p] * n[p]) * (J - 1.0).powi(2) + {energy} }}"
        );
        mistakes(&format!("domain(J > 0.0), prestressed, admissible({admissible})"), &item)
    };
    let check = |energy: &str, tokens: &str, admissible: &str, condition: &str| {
        let [(found, message)] = &mistakes(admissible, energy)[..] else { panic!("{energy}") };
        let conditions: Vec<_> = [admissible, condition].into_iter().filter(|it| !it.is_empty()).collect();
        let declared = conditions.join(", ");
        assert!(message.ends_with(&format!(": declare `admissible({declared})`")), "{message}");
        assert_eq!(found, tokens);
        assert_eq!(mistakes(&declared, energy), [], "{energy}");
    };
    let two = "k * (I1b - 3.0).powf(a) + k * (I1b - 3.0).powf(b) - 2.0 * k * (I2b - 3.0).powf(a)";
    check(two, "(I1b - 3.0).powf(a)", "", "a > 1.0, b > 1.0");
    check(two, "(I1b - 3.0).powf(b)", "a > 1.0", "b > 1.0");
    check(two, "(I1b - 3.0).powf(a)", "b >= 1.5", "a > 1.0");
    let next = "k / (a + 1.0) * (I1b - 3.0).powf(a + 1.0)";
    check(next, "(I1b - 3.0).powf(a + 1.0)", "", "a > 0.0");
    for condition in ["a > 0.0", "0.0 < a", "a + 1.0 > 1.0", "k > 0.0, b < 0.0, a > 0.1"] {
        assert_eq!(mistakes(condition, next), [], "{condition}");
    }
    let fused = "{ let x = I2b - 3.0; k * x * x.powf(2.0 - a / 3.0) }";
    check(fused, "k * x * x.powf(2.0 - a / 3.0)", "", "a < 6.0");
    check("k * (I1b - 3.0).powf(a + b + 0.5)", "(I1b - 3.0).powf(a + b + 0.5)", "", "a + b > 1.0 / 2.0");
    let of_entries = "(I1b - 3.0).powf(n[p] + 1.0)";
    check(&format!("sum(|p| c[p] * {of_entries})"), of_entries, "k > 0.0", "n[p] > 0.0");
    // A base may be negative for what is not admissible.
    assert_eq!(mistakes("a > 0.5", "k * ((I1b - 3.0) / b).powf(2.0 * a)"), []);
}

#[test]
fn what_vanishes_elsewhere_is_a_limit() {
    let energy = |term: &str| {
        format!(
            "fn E([l1, l2, l3]: [f64; 3], mu: f64, b: f64) -> f64 {{ mu * b * (J - 1.0).powi(2) + {term} }}"
        )
    };
    for (term, limit) in [
        ("mu / (1 - b * I1b / 3)", "1.0 - b * I1b / 3.0 > 0.0"),
        ("-mu * b * (1 - (I1b - 3) / b).ln()", "1.0 - (I1b - 3.0) / b > 0.0"),
        ("mu * (I1b - 4 - b).recip()", "I1b - b - 4.0 < 0.0"),
        ("mu * (I1b - 3) + mu * (1 - b * (J - 1).powi(2)).sqrt()", "1.0 - b * (J - 1.0).powi(2) > 0.0"),
        ("mu * (4 + b - I2b).powf(b)", "b + 4.0 - I2b > 0.0"),
    ] {
        let [(_, message)] = &mistakes("domain(J > 0.0)", &energy(term))[..] else { panic!("{term}") };
        let domain = format!("domain(J > 0.0, {limit})");
        assert!(message.contains(&format!("declare `{domain}`")), "{term}: {message}");
        check(&domain, &energy(term), &[]);
    }
    // Conditions come at once, except for those that follow from the others; what is meant is underlined.
    let two = "{ let x = 1 - b * (I1b - 3); -mu * x.ln() - mu * mu * (1 - b * (I2b - 3).powi(2)).ln() + mu / x - mu }";
    let limits = "1.0 - b * (I1b - 3.0) > 0.0, 1.0 - b * (I2b - 3.0).powi(2) > 0.0";
    let [(tokens, message)] = &mistakes("domain(J > 0.0)", &energy(two))[..] else { panic!("{two}") };
    let expected = format!(
        "`1.0 - b * (I1b - 3.0)`, `1.0 - b * (I2b - 3.0).powi(2)` vanish inside the domain, and there the energy has no \
         value: declare `domain(J > 0.0, {limits})`"
    );
    assert!(message.starts_with(&expected), "{message}");
    assert_eq!(tokens, "x.ln()");
    check(&format!("domain(J > 0.0, {limits})"), &energy(two), &[]);
    let stressed = "-mu * (1 - b * (I1 - 3)).ln() - mu * (1 - b * (I2 - 3).powi(2)).ln() + mu * J";
    let [(_, message)] = &mistakes("", &energy(stressed))[..] else { panic!("{stressed}") };
    let domain = "`domain(J > 0.0, 1.0 - b * (I1 - 3.0) > 0.0, 1.0 - b * (I2 - 3.0).powi(2) > 0.0)`";
    assert!(message.contains(&format!("* J.ln()` with {domain}; or")), "{message}");
    let root = "mu * (I1b - 3.0) - mu * (1.0 - (b * (I1b - 3.0)).powf(1.5)).ln()";
    let logarithm = "(1.0 - (b * (I1b - 3.0)).powf(1.5)).ln()";
    check("domain(J > 0.0), admissible(b > 0.0)", &energy(root), &[(logarithm, "inside the domain")]);
    // The admissible parameters decide.
    let logarithm = "(1 + b * (I1b - 3)).ln()";
    let term = format!("mu * {logarithm}");
    check("domain(J > 0.0)", &energy(&term), &[]);
    check("domain(J > 0.0), admissible(b < 0.0)", &energy(&term), &[(logarithm, "inside the domain")]);
    // I1 leaves the bound when volume is lost; I1b stays above it.
    for term in
        ["mu * (I1 - 3 + b).powf(b)", "mu * (b + b * (I1 - 2).ln())", "mu * (I1 - 3 + b.powi(2)).sqrt()"]
    {
        let [(_, message)] = &mistakes("domain(J > 0.0), prestressed", &energy(term))[..] else {
            panic!("{term}")
        };
        assert!(
            message.contains(": write `I1b` for `I1`, which is at least 3 wherever J > 0"),
            "{term}: {message}"
        );
        let [(_, message)] = &mistakes("", &energy(term))[..] else { panic!("{term}") };
        let way = ": write `I1b` for `I1` with `domain(J > 0.0)`, which leaves none and has a value wherever J > 0; or";
        assert!(message.contains(way), "{term}: {message}");
        check("domain(J > 0.0)", &energy(&term.replace("I1", "I1b")), &[]);
    }
    // An upper limit is none of these, though the sign of its distance from 3 be unknown.
    let locking = "mu * (1 - (-b * (I1 - 3) / (m - 3)).exp()) - mu * (m - 3) * (1 - (I1 - 3) / (m - 3)).ln() + b * (J - 1).powi(2)";
    let locking = format!("fn E([l1, l2, l3]: [f64; 3], mu: f64, b: f64, m: f64) -> f64 {{ {locking} }}");
    let [(_, message)] = &mistakes("", &locking)[..] else { panic!("{locking}") };
    assert!(
        message.contains("* J.ln()` with `domain(J > 0.0, 1.0 - (I1 - 3.0) / (m - 3.0) > 0.0)`"),
        "{message}"
    );
    // The denominator vanishes, and the whole term has no value.
    check(
        "",
        "fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * (I1 - 3.0 * J) + mu / (2.0 - J) }",
        &[("mu / (2.0 - J)", "declare `domain(2.0 - J > 0.0)`")],
    );
}

/// The domain of a function is unknown, and its own business; that of the other parts is not.
#[test]
fn parts_beside_functions_have_a_value() {
    let check = |arguments: &str, term: &str, expected: &[(&str, &str)]| {
        let item = format!(
            "fn E([l1, l2, l3]: [f64; 3], mu: f64, g: f64, f: piola::Spline) -> f64 {{ \
             mu * (I1 - 3.0) + f(I1 - 3.0) + g * (J - 1.0).powi(2) + {term} }}"
        );
        check(arguments, &item, expected);
    };
    let limited = "((I2 - 3.0 + g) / g).ln()";
    let isochoric = "write `I1b`, `I2b` for `I1`, `I2`, which are at least 3 wherever J > 0";
    check("domain(J > 0.0), admissible(g > 0.0)", &format!("mu * {limited}"), &[(limited, isochoric)]);
    let limited = "(1.0 - g * (I1b - 3.0)).ln()";
    for term in [format!("mu * {limited}"), format!("f({limited})"), format!("mu * f(J) * {limited}.powi(2)")]
    {
        let limit = "declare `domain(J > 0.0, 1.0 - g * (I1b - 3.0) > 0.0)`";
        check("domain(J > 0.0)", &term, &[(limited, limit)]);
    }
    for (term, part, message) in [
        ("mu * J.ln()", "mu * J.ln()", "has no value where J < 0"),
        ("mu * f(J) * J.sqrt()", "mu * f(J) * J.sqrt()", "has no value where J < 0"),
        ("mu * f(J) / I1", "mu * f(J) / I1", "has no value where λ1 = λ2 = λ3 = 0"),
        ("f(mu * I2.ln())", "I2.ln()", "`I2.ln()` has no value where λ2 = λ3 = 0"),
    ] {
        check("", term, &[(part, message)]);
    }
    for fine in ["mu / f(I1)", "f(mu * I1.sqrt()) * g", "mu * f(J) * (1.0 + I1).powf(-mu)"] {
        check("", fine, &[]);
    }
}

/// I2 vanishes on lines, I1 at points, and there negative powers have no value.
#[test]
fn what_collapses_to_a_line_or_a_point_has_a_value() {
    let energy = |term: &str| {
        format!(
            "fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: f64, b: f64, m: [f64; N]) -> f64 {{ \
             mu * b * (I1 - 3 - 2 * (J - 1)) + sum(|p| m[p]) * (J - 1).powi(2) + {term} }}"
        )
    };
    for (term, power, place, condition) in [
        (
            "mu * (I2 / 3).powf(1 + b)",
            "(I2 / 3).powf(1 + b)",
            "λ2 = λ3 = 0, in elements collapsed to a line",
            "b + 1.0",
        ),
        (
            "mu * (I1 / 3).powf(b)",
            "(I1 / 3).powf(b)",
            "λ1 = λ2 = λ3 = 0, in elements collapsed to a point",
            "b",
        ),
        (
            "mu * J.powi(2).powf(2 - b)",
            "J.powi(2).powf(2 - b)",
            "λ3 = 0, in elements collapsed to a sheet",
            "2.0 - b",
        ),
        ("sum(|q| m[q] * I1.powf(m[q] / 2))", "I1.powf(m[q] / 2)", "λ1 = λ2 = λ3 = 0", "m[p] / 2.0"),
    ] {
        let [(tokens, message)] = &mistakes("prestressed, admissible(mu > 0.0)", &energy(term))[..] else {
            panic!("{term}")
        };
        assert!(term.contains(tokens.as_str()) && tokens.contains(power), "{tokens}");
        let says = |part: &str| assert!(message.contains(part), "{message}");
        says(&format!("has no value where its exponent is negative and {place}"));
        let admissible = format!("admissible(mu > 0.0, {condition} > 0.0)");
        says(&format!("declare `{admissible}`, or `domain(J > 0.0)`"));
        check(&format!("prestressed, {admissible}"), &energy(term), &[]);
        check("prestressed, domain(J > 0.0)", &energy(term), &[]);
    }
    check("prestressed", &energy("mu * I2.ln()"), &[("I2.ln()", "`I2.ln()` has no value where λ2 = λ3 = 0")]);
    let of_sums = "mu * I1.powf(sum(|q| m[q]))";
    let message =
        "negative and λ1 = λ2 = λ3 = 0, in elements collapsed to a point: declare `domain(J > 0.0)`";
    check("prestressed", &energy(of_sums), &[("I1.powf(sum(|q| m[q]))", message)]);
    check("prestressed", &energy("mu / I1"), &[("mu / I1", "has no value where λ1 = λ2 = λ3 = 0")]);
    for fine in ["mu * I2.sqrt()", "mu * (1 + I1).powf(b)", "mu * (1 + I1).ln()", "mu * (b * b * I2).exp()"] {
        check("prestressed", &energy(fine), &[]);
    }
}

/// `extend` continues an energy from J = 0 and therefore excludes conditions that fail at J = 0.
#[test]
fn what_is_extended_has_room_for_flat_elements() {
    let energy =
        "fn E([l1, l2, l3]: [f64; 3], mu: f64, m: f64) -> f64 { mu * (I1b - 3) + m * (J - 1).powi(2) }";
    for (condition, instead) in [
        ("I1b - 3.0 < m", "remove `extend`, or bound a quantity that stays moderate there"),
        ("I1 > 2.0", "remove `extend`, or this condition, and write `I1b` for `I1` in the energy"),
        ("J > 0.5", "remove `extend`, or this condition"),
    ] {
        let domain = format!("domain(J > 0.0, {condition})");
        check(&domain, energy, &[]);
        check(&format!("{domain}, extend"), energy, &[(condition, instead)]);
    }
    check("domain(J > 0.0, I1 - 3.0 < m), extend", energy, &[]);
    // Nor is such a condition where one leads that takes the advice of another message.
    let limited = "fn E([l1, l2, l3]: [f64; 3], mu: f64, m: f64) -> f64 { -mu * (1 - (I1 - 3) / m).ln() }";
    let message = |arguments: &str| {
        mistakes(arguments, limited).into_iter().map(|(_, message)| message).collect::<String>()
    };
    assert!(message("domain(J > 0.0, I1 - 3.0 < m)").contains("or write `I1b` for `I1`"));
    assert!(!message("domain(J > 0.0, I1 - 3.0 < m), extend").contains("I1b"));
}

/// A sine is positive on every second branch: its condition is that its argument stays on the first.
#[test]
fn a_sine_is_kept_from_its_first_zero() {
    let energy = "fn E([l1, l2, l3]: [f64; 3], mu: f64, k: f64) -> f64 { mu * (k * sum(|l| l.powi(2)) / I1 * I1b / 3.0).sin().recip() + mu * (J - 1).powi(2) }";
    let found = mistakes("domain(J > 0.0), admissible(k > 0.0, k < 3.0), prestressed", energy);
    let text = format!("{found:?}");
    assert!(text.contains(" < PI)`"), "{text}");
}

/// Continued powers of stretches turn negative, which a logarithm of them has no value for.
#[test]
fn a_continuation_has_a_value() {
    let energy = "fn E([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu * (I1 - sum(|l| l.powf(4.0 / 3.0).ln_1p()) - 2 * J.ln()) + mu * sum(|l| (l.powf(4.0 / 3.0) + 0.01 * l.cbrt()).ln()) }";
    check("domain(J > 0.0), prestressed", energy, &[]);
    check("domain(J > 0.0), prestressed, extend", energy, &[("extend", "remove `extend`")]);
}
