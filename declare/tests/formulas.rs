//! Formulas in the notation of papers, and the mistakes in them.

use piola::material::Unit;
use piola::{Inversion, Material};
use piola_declare::{Energy, FormulaOptions, Mistake, Mistakes};

/// Checks that two texts declare the same energy of one parameter after the other.
#[track_caller]
fn check_equal(formula: &str, rust: &str) {
    let energy = Energy::from_formula(formula).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let other = Energy::from_rust(rust).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(energy.description().formula, other.description().formula);
    let values = vec![&[2.5][..]; energy.description().parameters.len()];
    let [one, other] =
        [energy, other].map(|energy| energy.material(&values, Inversion::Refuse).expect("stable at rest"));
    for at in [[1.0f64, 1.0, 1.0], [1.3, 1.1, 0.7], [2.0, 2.0, 0.1]] {
        assert_eq!(one.energy(at).to_bits(), other.energy(at).to_bits());
        assert_eq!(one.blocks(at), other.blocks(at));
    }
}

#[test]
fn a_formula_is_the_declaration_that_it_stands_for() {
    check_equal(
        "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2",
        "#[material(domain(J > 0.0))]
         fn E([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
             mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
         }",
    );
    check_equal(
        "m*((l1^a + l2^a + l3^a - 3)/a - ln(J)) + k*(J - 1)^2",
        "#[material(domain(J > 0.0))]
         fn E([l1, l2, l3]: [f64; 3], m: f64, a: f64, k: f64) -> f64 {
             m * ((l1.powf(a) + l2.powf(a) + l3.powf(a) - 3.0) / a - J.ln()) + k * (J - 1.0).powi(2)
         }",
    );
}

#[test]
fn precedence_is_that_of_papers() {
    let value = |formula: &str| -> f64 {
        let text = format!("mu*(I1b - 3) + (J - 1)^2*({formula})");
        let energy = Energy::from_formula(&text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let material = energy
            .material(&[&[1.0]], Inversion::Refuse)
            .unwrap_or_else(|error| panic!("{formula}: {error}"));
        // J = 8, so that (J − 1)² is 49, and I1b is 3 at equal stretches.
        material.energy([2.0, 2.0, 2.0]) / 49.0
    };
    for (formula, expected) in [
        ("2*3^2", 18.0),
        ("20 - 3^2", 11.0),
        ("2^3^2", 512.0),
        ("(2^3)^2", 64.0),
        ("12/2 3", 18.0),
        ("12/(2*3)", 2.0),
        ("4^(1/2)", 2.0),
        ("4^-1", 0.25),
        ("2^(-1)", 0.5),
        ("10 - 2 - 3", 5.0),
        ("--2", 2.0),
        ("sqrt(16)/2", 2.0),
        ("1e1", 10.0),
        ("2(3)", 6.0),
    ] {
        assert!((value(formula) - expected).abs() < 1e-12 * expected, "{formula}: {}", value(formula));
    }
}

#[test]
fn domains_are_found_or_stated() {
    let domain = |formula: &str| {
        let energy = Energy::from_formula(formula).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        (energy.description().domain.to_string(), energy.description().extends)
    };
    assert_eq!(domain("mu/2*(I1 - 2*J - 1)").0, "every deformation");
    assert_eq!(domain("mu/2*(I1 - 3 - 2*ln(J))"), ("J > 0".to_owned(), true));
    let (gent, _) = domain("-mu*Jm/2*ln(1 - (I1b - 3)/Jm) + K/2*(J - 1)^2 where J > 0, I1b < 3 + Jm, Jm > 0");
    assert_eq!(gent, "J > 0, I1b < 3 + Jm");
}

#[test]
fn the_rest_state_is_freed_of_stress_on_request() {
    let printed = "C10*(I1 - 3) + C01*(I2 - 3)";
    let mistakes = Energy::from_formula(printed).unwrap_err();
    assert!(mistakes.to_string().contains("stress"), "{mistakes}");
    let options = FormulaOptions { free_rest: true, bulk: Some("K".into()), ..FormulaOptions::default() };
    let energy = Energy::from_formula_with(printed, &options).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let rubber = energy.material(&[&[2e5], &[1e4], &[1e7]], Inversion::Refuse).expect("stable");
    assert_eq!(rubber.gradient([1.0; 3]), [0.0; 3]);
    // What it prints is read back as the same energy.
    let again = Energy::from_text(energy.source()).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(again.description().formula, energy.description().formula);
    assert_eq!(Energy::from_text(energy.text()), Ok(again));
}

#[test]
fn lists_are_summed() {
    let energy = Energy::from_formula(
        "sum(p, mu[p]/alpha[p]*(l1^alpha[p] + l2^alpha[p] + l3^alpha[p] - 3)) - sum(p, mu[p])*ln(J) + k/2*(J - 1)^2",
    )
    .unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let rubber =
        energy.material(&[&[6.3e5, -1e4], &[1.3, -2.0], &[2e7]], Inversion::Refuse).expect("Ogden's");
    assert_eq!(rubber.gradient([1.0; 3]), [0.0; 3]);
}

/// The mistakes of a formula: the underlined characters, and a part of the message.
#[track_caller]
fn check_mistake(formula: &str, options: &FormulaOptions, underlined: &str, message: &str) {
    let mistakes = match Energy::from_formula_with(formula, options) {
        Ok(_) => panic!("{formula} is understood"),
        Err(mistakes) => mistakes,
    };
    let Mistake { message: found, place } = &mistakes.list[0];
    let place = place.unwrap_or_else(|| panic!("{found}: nowhere"));
    let line = formula.lines().nth(place.line - 1).expect("a line of the formula");
    let marked: String = line.chars().skip(place.column - 1).take(place.length).collect();
    assert_eq!(marked, underlined, "{found}");
    assert!(found.contains(message), "{found}");
}

/// Mistakes that `formulas.txt` shows are left out here.
#[test]
fn mistakes_are_told_at_their_places() {
    let any = FormulaOptions::default();
    check_mistake("mu/2*(I1b - 3)\n  + K*(J - 1)^2\n  + l1", &any, "l1", "are exchanged");
    check_mistake("mu/2*(I1b - 3)\r\n  + K*(J - 1)^2\r\n  + l1", &any, "l1", "are exchanged");
    check_mistake("mu/2*(I1 - 3) + lambd\r\na*ln(J) + lambd\r\n[]/2", &any, "]", "expected an expression");
    let parameters = Some(vec![("mu".to_owned(), "Modulus, Pa.".to_owned())]);
    let known = FormulaOptions { parameters, ..any };
    check_mistake("muu/2*(I1b - 3) + mu*(J - 1)^2", &known, "muu", "did you mean `mu`?");
    check_mistake("mu/2*(I1b - 3)*mu + mu*(J - 1)^2", &known, "mu/2*(I1b - 3)*mu + mu*(J - 1)^2", "in Pa");
}

/// The file `formulas.txt`: pairs of formulas that are one energy, and mistakes with their underlined
/// characters and a part of the message, below `==` and the names that have values.
#[test]
fn each_line_of_the_table_is_true() {
    let mut options = FormulaOptions::default();
    let is_read = |line: &&str| !line.is_empty() && !line.starts_with("//");
    for line in include_str!("formulas.txt").lines().filter(is_read) {
        if let Some(names) = line.strip_prefix("== ") {
            options = given(&names.split(", ").collect::<Vec<_>>());
        } else if let [formula, underlined, message] = line.split(" => ").collect::<Vec<_>>()[..] {
            check_mistake(formula, &options, underlined, message);
        } else {
            let (formula, other) = line.split_once(" is ").expect("two formulas, or a mistake");
            check_same(formula, other);
        }
    }
}

/// Checks that two formulas are one energy.
#[track_caller]
fn check_same(formula: &str, other: &str) {
    let energies = [formula, other].map(|text| {
        let options = FormulaOptions { free_rest: true, ..FormulaOptions::default() };
        Energy::from_formula_with(text, &options).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    });
    let [one, other] = energies.each_ref().map(|energy| energy.description());
    assert_eq!((&one.formula, &one.parameters), (&other.formula, &other.parameters), "{formula}");
    for at in [[1.3, 1.1, 0.7], [2.0, 2.0, 0.1]] {
        let [one, other]: [f64; 2] = energies.each_ref().map(|energy| {
            let values = vec![&[2.5][..]; energy.description().parameters.len()];
            energy.material(&values, Inversion::Refuse).expect("stable at rest").energy(at)
        });
        assert!((one - other).abs() <= 1e-13 * other.abs(), "{formula}: {one}, not {other}");
    }
}

/// Options for parameters with these names, on the command line.
fn given(names: &[&str]) -> FormulaOptions {
    let named = names.iter().map(|&name| (name.to_owned(), String::new()));
    FormulaOptions {
        parameters: Some(named.collect()),
        value: Some("--param NAME=VALUE"),
        free_rest_option: Some("--free-rest"),
        ..FormulaOptions::default()
    }
}

#[test]
fn a_name_with_a_value_is_a_parameter() {
    for name in [
        "b", "C", "E", "B", "S", "U", "F", "e", "I_1", "lambda_1", "I1", "J", "l1", "I3", "log", "pi", "tr",
        "np", "type", "fn", "in", "new", "energy", "values", "Some", "trC", "sum", "each",
    ] {
        let text = format!(
            "mu/2*(lam1^2 + lam2^2 + lam3^2 - 3 - 2*ln(detF)) + {name}*(detF - 1)^2 where {name} > 0"
        );
        let energy = Energy::from_formula_with(&text, &given(&["mu", name]))
            .unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let names: Vec<_> =
            energy.description().parameters.iter().map(|parameter| &*parameter.name).collect();
        assert_eq!(names, ["mu", name]);
        assert_eq!(*energy.description().admissible, [format!("{name} > 0")]);
        let material = energy.material(&[&[1.0], &[2.0]], Inversion::Refuse).expect("stable at rest");
        let (found, expected) = (material.energy([2.0, 1.0, 1.0]), 0.5 * (3.0 - 2.0 * 2f64.ln()) + 2.0);
        assert!((found - expected).abs() < 1e-14, "{name}: {found}, not {expected}");
        // The text that an energy is kept as is read back as the same.
        let again = Energy::from_text(energy.text()).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert_eq!(again.description().parameters, energy.description().parameters, "{}", energy.text());
        let error = energy.material(&[&[1.0], &[-2.0]], Inversion::Refuse).unwrap_err().to_string();
        assert!(error.contains(&format!("`{name} > 0`")) && !error.contains("r#"), "{error}");
    }
    let more = FormulaOptions { further: true, ..given(&["C"]) };
    let energy = Energy::from_formula_with("mu*(I1b - 3) + C*(J - 1)^2", &more).expect("two parameters");
    assert_eq!(energy.description().parameters.len(), 2);
    assert_eq!(Energy::from_text_with("mu*(I1b - 3) + C*(J - 1)^2", &more), Ok(energy));
}

/// Units that some parameters state imply those of others.
#[test]
fn units_of_parameters_are_inferred() {
    let units = |documented: &[(&str, &str)]| {
        let named = documented.iter().map(|&(name, doc)| (name.to_owned(), doc.to_owned()));
        let options = FormulaOptions { parameters: Some(named.collect()), ..FormulaOptions::default() };
        let formula = "a/b*(exp(b*(I1b - 3)) - 1) + c*d*(I2b - 3) + (J - 1)^2/D";
        let energy = Energy::from_formula_with(formula, &options).unwrap_or_else(|error| panic!("{error}"));
        energy.description().parameters.iter().map(|parameter| parameter.unit).collect::<Vec<_>>()
    };
    let (pascal, number, inverse) = (Some(Unit::Pascal), Some(Unit::Dimensionless), Some(Unit::PerPascal));
    let stated = |a, d| units(&[("a", a), ("b", ""), ("c", ""), ("d", d), ("D", "")]);
    assert_eq!(stated("", ""), [None; 5]);
    assert_eq!(stated("Modulus, Pa.", ""), [pascal, number, None, None, inverse]);
    assert_eq!(stated("", "Modulus, Pa."), [pascal, number, number, pascal, inverse]);
}

#[test]
fn greek_letters_are_their_names() {
    let names = |formula: &str, values: &[&str]| -> Vec<String> {
        let options = FormulaOptions { bulk: Some("kappa".into()), ..given(values) };
        let energy =
            Energy::from_formula_with(formula, &options).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        energy.description().parameters.iter().map(|parameter| parameter.name.to_string()).collect()
    };
    for (formula, values) in [
        ("μ*(I1b - 3) + Λ_1*(J - 1)^2 + κ*(J - 1)^4", ["mu", "Lambda_1"]),
        ("mu*(I1b - 3) + Lambda_1*(J - 1)^2", ["μ", "Λ_1"]),
        // The sign of micrometres, the small letter of TeX's `\\epsilon`.
        ("µ*(I1b - 3) + ϵ*(J - 1)^2", ["μ", "epsilon"]),
    ] {
        assert_eq!(names(formula, &values), [values[0], values[1], "kappa"], "{formula}");
    }
    // Two values make two parameters, and a name with another meaning keeps it.
    assert_eq!(names("mu*(I1b - 3) + μ*(J - 1)^2", &["mu", "μ"]), ["mu", "μ", "kappa"]);
    let unused = Energy::from_formula_with("mu*(λ1 + λ2 + λ3 - 3 - ln(J))", &given(&["mu", "lambda1"]));
    assert!(unused.is_err_and(|mistakes| mistakes.to_string().contains("`lambda1`")));
}

#[test]
fn names_without_values_are_told_before_all_else() {
    let two = Energy::from_formula_with("a*(I1 - 3) + b*(J - 1)^2 + a", &given(&[])).unwrap_err();
    assert_eq!(two.list.len(), 2, "{two}");
}

#[test]
fn messages_are_in_the_notation_of_formulas() {
    let (value, free_rest_option) = (Some("NAME=VALUE"), Some("free_rest=True"));
    let python = FormulaOptions { value, free_rest_option, ..given(&["mu"]) };
    check_mistake("mu/2*(I1 - 3)", &python, "mu/2*(I1 - 3)", "append `- mu*ln(J)`; or write `I1b` for `I1`");
    check_mistake("mu/2*(I1 - 3)", &python, "mu/2*(I1 - 3)", "or give the option `free_rest=True`");
    let in_pascals = ["mu", "a"].map(|name| (name.to_owned(), "Modulus, Pa.".to_owned()));
    let units = FormulaOptions { parameters: Some(in_pascals.to_vec()), ..FormulaOptions::default() };
    let mistakes = Energy::from_formula_with("mu*(I1b - 3) + a^2*(J - 1)^2", &units).unwrap_err().to_string();
    assert!(mistakes.contains("in Pa^2, but") && !mistakes.contains(",,"), "{mistakes}");
    // No message about a formula has the Rust that it is translated into.
    for text in [
        "mu/2*(I1 - 3)*J^2",
        "mu*ln(I1 - 3)",
        "mu*(I1 - 3)^a",
        "mu*sqrt(J - 1)",
        "mu/(J - 2)",
        "mu*I2",
        "mu*ln(1 - J)",
        "mu*l1^a",
        "mu*(I1b - 3)^0.5",
        "mu*exp(I1)",
        "mu*(I1^2)^(a/3)",
        "sum(p, m[p]*l1^a[p])",
        "mu*cos(I1b)",
        "mu*ln(I1 - 2) where I1 < 2",
        "mu*(I1b - 3) where l2 < 3",
        "mu*(I1b - 3) + 1/0",
        "mu*(I1b-3)^100*1e999",
    ] {
        let Err(mistakes) = Energy::from_formula(text) else { continue };
        for Mistake { message, .. } in &mistakes.list {
            let is_rust = |rust: &&str| message.contains(rust);
            let rust = [
                ".powi",
                ".powf",
                ".ln()",
                ".0",
                "sum(|",
                "f64",
                "attribute",
                "`domain",
                "`admissible",
                "Univariate",
            ];
            assert!(!rust.iter().any(is_rust), "{text}: {message}");
        }
    }
}

#[test]
fn mistakes_are_shown_with_their_line() {
    let mistakes = Energy::from_formula("mu/2*(I₁ − 3)\n + mu*lnn(J)").unwrap_err();
    let shown = Mistakes { name: "rubber".to_owned(), ..mistakes }.to_string();
    let expected = "\n --> rubber:2:7\n  |\n2 |  + mu*lnn(J)\n  |       ^^^";
    assert!(shown.ends_with(expected), "{shown}");
}

/// A function that is a parameter is a spline at run time.
#[test]
fn functions_of_other_types_need_a_compiler() {
    let text = "#[material] fn E([l1, l2, l3]: [f64; 3], f: Curve) -> f64 { f(l1) + f(l2) + f(l3) }";
    let mistakes = Energy::from_rust(text).unwrap_err();
    assert!(mistakes.list[0].message.contains("is a `Spline`"), "{mistakes}");
    assert!(
        Energy::from_rust("const X: f64 = 1.0;").unwrap_err().to_string().contains("no energy is declared")
    );
}

#[test]
fn texts_beyond_all_limits_are_refused() {
    let long = "mu + ".repeat(20_000) + "mu";
    let deep = "(".repeat(500) + "mu" + &")".repeat(500);
    let powers = "2^".repeat(500) + "mu";
    for text in [long, deep, powers] {
        assert!(Energy::from_text(&text).is_err());
    }
}
