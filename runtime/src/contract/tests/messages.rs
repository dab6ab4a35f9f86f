//! Messages of broken rules: their facts, and a remedy that helps.

use super::*;

/// The violation of a rule.
#[track_caller]
fn violation(rule: Rule, material: &dyn Subject, settings: &Settings) -> Violation {
    let verdict = judge_rule(rule, material, None, settings).expect("a rule that applies");
    verdict.expect_err("a broken rule")
}

#[test]
fn lost_digits_are_not_told_as_a_mistake() {
    let text = |found: f64, notation: Notation| {
        let settings = Settings { notation, ..Settings::default() };
        let mut judge = Judge::new(Rule::Rest, &NeoHookean, &settings);
        let verdict = judge.compare_or(|| "stress".into(), [1.0; 3], found, 0.0, 1e-13, Some("subtract it"));
        verdict.expect_err("a difference").to_string()
    };
    let (lost, mistaken) = (text(1e-11, Notation::Rust), text(1e-3, Notation::Rust));
    assert!(lost.contains("more likely a loss of digits than a mistake in the formula"), "{lost}");
    assert!(lost.contains("the documentation of a declared type") && !lost.contains("subtract it"), "{lost}");
    assert!(mistaken.ends_with("1.0e-13\n    remedy      subtract it"), "{mistaken}");
    let lost = text(1e-11, Notation::Formula);
    assert!(lost.contains("`piola declare` names") && !lost.contains("range"), "{lost}");
}

#[test]
fn a_violation_has_a_line_for_each_fact() {
    let settings = Settings::default();
    let mut judge = Judge::new(Rule::Quotients, &NeoHookean, &settings);
    let component = || "flip of stretches 1 and 2, which are 1e-9 of their mean apart".into();
    let verdict = judge.compare(component, [1.50000000075, 1.49999999925, 0.5], 0.0, 2.0, 1e-14);
    let text = "\
quotients: flips and twists keep their digits at every gap between stretches, zero included
    component   flip of stretches 1 and 2, which are 1e-9 of their mean apart
    stretches   1.50000000075, 1.49999999925, 0.5
    found       0e0
    expected    2e0
    difference  2.0e0, of which rounding explains 1.0e-14";
    assert_eq!(verdict.map_err(|violation| violation.to_string()), Err(text.to_owned()));
    let same = judge.same(|| "energy".into(), [1.0; 3], 1.0, 2.0).expect_err("other bits").to_string();
    assert!(same.ends_with("\n    difference  1.0e0, where both must have the same bits"), "{same}");
}

/// Remedies for a declaration in Rust, and for a formula, which quote no Rust.
#[test]
fn remedies_are_in_the_notation_of_the_energy() {
    let check = |rule: Rule, material: &dyn Subject, in_rust: &str, in_formula: &str| {
        let text =
            |notation| violation(rule, material, &Settings { notation, ..Settings::default() }).to_string();
        let (rust, formula) = (text(Notation::Rust), text(Notation::Formula));
        assert!(rust.contains(in_rust), "{rust}");
        assert!(formula.contains(in_formula), "{formula}");
        for word in ["range:", "domain(", "admissible", "admits`", "extend(", "refuse(", ".ln()", "1.0 -"] {
            assert!(!formula.contains(word), "{word}: {formula}");
        }
    };
    let steep = exponential(1.0, 40.0);
    let extended = |defect| Defective(ExtendedNeoHookean { epsilon: 0.3 }, defect);
    let pulls_by = |c| Defective(RotatedLinear, Defect::PullsBy(c));
    check(
        Rule::Domain,
        &exponential(1.0, 200.0),
        "the number overflows there: choose smaller parameters, or narrow the stretches of the test",
        "choose smaller parameters, or exclude large stretches by a condition",
    );
    check(
        Rule::Domain,
        &undefined(f64::NAN),
        "or to `admissible(…)` if a parameter divides by zero",
        "or `where b > 0` if a parameter divides by zero",
    );
    check(
        Rule::Domain,
        &extended(Defect::OverflowsInExtension),
        "choose a greater `epsilon` or smaller parameters, or narrow the stretches",
        "choose a greater `epsilon` or smaller parameters, or exclude large stretches",
    );
    let verdict = judge_rule(Rule::Domain, &steep, None, &Settings::default());
    assert!(matches!(verdict, Some(Ok(_))), "{verdict:?}");
    check(Rule::SinglePrecision, &steep, "`f32` ends at 3.4e38", "`where J > 0, I1 < 9`");
    check(
        Rule::Extension,
        &extended(Defect::AttractsCollapse),
        "as in `extend(kappa > 0.0)`",
        "`+ kappa*(J - 1 - ln(J))`",
    );
    let signs = "write that limit in terms that are independent of signs";
    check(Rule::Extension, &extended(Defect::EndsAtInversion), signs, signs);
    let smaller = "falls there, too: choose a smaller `epsilon`";
    check(Rule::Extension, &pulls_by(1.0), smaller, smaller);
    // An energy that never restores is not told to begin later.
    check(
        Rule::Extension,
        &pulls_by(-0.1),
        "falls there, too, and the steeper the flatter: if it is that of an incompressible solid",
        "by a condition such as `where kappa > 0`",
    );
    let stressed = Defective(NeoHookean, Defect::Prestress);
    let text = violation(Rule::Rest, &stressed, &Settings::default()).to_string();
    assert!(text.contains("    remedy      append to the energy a term that cancels this stress"), "{text}");
    assert!(text.contains("`piola::contract!(gel: Gel::new(1e4, 1e6)?, stress_free_at_rest: false)`"));
}

#[test]
fn an_overflow_is_told_once() {
    let violations = check(&exponential(1.0, 200.0), &Settings::default());
    let violations = violations.expect_err("an overflow");
    let text = violations.to_string();
    assert!(violations.0.len() > 6 && text.lines().count() == 7, "{text}");
    assert!(text.starts_with("domain: ") && text.contains("the number overflows there"), "{text}");
    let last = text.lines().last().expect("a line");
    assert!(last.starts_with("not judged, because the energy is not finite: isotropy, "), "{last}");
    // Mistakes of the rest state are not its consequences.
    let settings = Settings::default();
    let mut judge = Judge::new(Rule::Rest, &NeoHookean, &settings);
    let stressed = judge.compare(|| gradient_name(0), [1.0; 3], 1.0, 0.0, 1e-14).expect_err("a stress");
    let both = Violations([vec![stressed], violations.0].concat()).to_string();
    assert!(both.starts_with("rest: ") && both.ends_with(&text), "{both}");
}

/// Each rule advises to extend from a greater stretch, for NaN and for differences of large numbers.
#[test]
fn an_overflow_in_an_extension_has_one_remedy() {
    let steep = Defective(ExtendedNeoHookean { epsilon: 0.3 }, Defect::OverflowsInExtension);
    let settings = Settings::default();
    let mut judge = Judge::new(Rule::Isotropy, &steep, &settings);
    for found in [f64::NAN, f64::INFINITY, 4e240] {
        let verdict = judge.compare(|| "stress".into(), [1.5, 1.2, -1.0], found, 4.5e240, 1e239);
        let text = verdict.expect_err("a difference").to_string();
        assert!(text.contains("    remedy      the energy overflows where its extension begun"), "{text}");
    }
}

#[test]
fn why_nothing_was_compared_is_told() {
    let settings = Settings { points: 0, ..Settings::default() };
    let materials: [(Rule, &dyn Subject); 3] = [
        (Rule::Isotropy, &NeoHookean),
        (Rule::Extension, &ExtendedNeoHookean { epsilon: 0.3 }),
        (Rule::Invariants, &by_invariants(-0.5, 0.875, Curvature::Separate)),
    ];
    for (rule, material) in materials {
        let violation = violation(rule, material, &settings);
        let text = "the material admits none of the points at which this is judged: choose other parameters or a wider \
                    domain, or another `range` or more `points` of the settings";
        assert_eq!(violation.to_string(), format!("{rule}: {}\n    {text}", rule.promise()));
    }
}

/// A (exp(a (I1b − 3)) − 1), which overflows as J falls, and a little resistance to changes of volume.
#[crate::material(domain(J > 0.0))]
fn Exponential([l1, l2, l3]: [f64; 3], size: f64, rate: f64) -> f64 {
    size * ((rate * (I1b - 3.0)).exp() - 1.0) + (J - 1.0).powi(2)
}

fn exponential(size: f64, rate: f64) -> Exponential {
    Exponential::new(size, rate).expect("positive moduli")
}

#[test]
fn an_energy_that_overflows_is_defined() {
    let soft = exponential(1.95e5, 0.018);
    let flat = [1.0, 1.0, 8e-9];
    assert!(soft.admits(flat) && soft.energy(flat) == f64::INFINITY);
    let verdict = check(&soft, &Settings::default());
    assert!(verdict.is_ok(), "{verdict:?}");
}

fn undefined(energy: f64) -> Defective<SaintVenantKirchhoff> {
    Defective(SaintVenantKirchhoff, Defect::EnergyOfShortStretches(energy))
}

#[test]
fn an_energy_without_a_value_is_told_of_by_the_rule_domain() {
    let text = |rule, energy| violation(rule, &undefined(energy), &Settings::default()).to_string();
    let domain = text(Rule::Domain, f64::NAN);
    for line in [
        "    component   energy\n",
        "    found       NaN\n    expected    a finite number\n    remedy      the domain admits these stretches, but",
        "write `I1b` for `I1`",
    ] {
        assert!(domain.contains(line), "{domain}");
    }
    assert!(text(Rule::Domain, f64::NEG_INFINITY).contains("    found       -inf\n"));
    let other = text(Rule::Isotropy, f64::NAN);
    let line = "    found       NaN, where NaN is expected: not a finite number, here or near by, but an overflow, or a root, \
                real power or logarithm of something negative; see the rule `domain`";
    assert_eq!(other.lines().last(), Some(line), "{other}");
}
