//! Deeply nested declarations end in a message and not in an overflow of the stack, and long ones are
//! materials.

use std::thread;

use piola_codegen::analyse;
use proc_macro2::TokenStream;

/// Rubber, free of stress at rest.
const ENERGY: &str = "mu * (I1 - 3.0 - 2.0 * J.ln())";

/// Forms that can be nested, as functions of the depth.
const FORMS: [fn(usize) -> String; 12] = [
    |n| format!("{}{ENERGY}{}", "(".repeat(n), ")".repeat(n)),
    |n| format!("{}{ENERGY}{}", "{".repeat(n), "}".repeat(n)),
    |n| format!("{}({ENERGY})", "-".repeat(n)),
    |n| format!("{ENERGY} * J{}", ".sqrt()".repeat(n)),
    |n| format!("{ENERGY} * {}1.0{}", "(0.0 + ".repeat(n), ")".repeat(n)),
    |n| format!("{ENERGY} * {}1.0{}", "(1.0 - ".repeat(n), ")".repeat(n)),
    |n| format!("{}{ENERGY}{}", "sum(|p| ".repeat(n), ")".repeat(n)),
    |n| format!("{} {ENERGY}", "mu = ".repeat(n)),
    |n| format!("{} {ENERGY}", "|mu| ".repeat(n)),
    |n| format!("{} {ENERGY}", "return ".repeat(n)),
    |n| format!("{}{{ {ENERGY} }}", "if mu { mu } else ".repeat(n)),
    |n| format!("{ENERGY}{}", " as f64".repeat(n)),
];

/// The mistakes in a declaration, in a thread with as little stack as editors give it.
fn mistakes(arguments: &str, parameter: &str, body: &str) -> String {
    let [arguments, item] = [
        arguments.to_owned(),
        format!("fn Solid([l1, l2, l3]: [f64; 3], mu: {parameter}) -> f64 {{ {body} }}"),
    ];
    let parse = |text: &str| -> TokenStream { text.parse().expect("tokens") };
    let analyse = move || match analyse(parse(&arguments), parse(&item)) {
        Ok(_) => String::new(),
        Err(mistakes) => mistakes.into_iter().map(|mistake| mistake.to_string() + "\n").collect(),
    };
    let thread = thread::Builder::new().stack_size(2 << 20).spawn(analyse).expect("a thread");
    thread.join().expect("no panic")
}

#[test]
fn what_is_nested_too_deep_is_a_mistake_and_nothing_else() {
    let own = "this is nested more than 64 deep: name parts of it by `let`\n";
    for form in FORMS {
        assert!(!mistakes("", "f64", &form(12)).contains(own), "{}", form(12));
        for depth in [65, 1000, 3000] {
            assert_eq!(mistakes("", "f64", &form(depth)), own, "{} nested {depth} deep", form(1));
        }
    }
    for depth in [65, 1000] {
        let (open, close) = ("(".repeat(depth), ")".repeat(depth));
        assert_eq!(mistakes(&format!("domain({open}J{close} > 0.0)"), "f64", ENERGY), own);
        assert_eq!(mistakes("", &format!("{open}f64{close}"), ENERGY), own);
    }
}

#[test]
fn fifty_parentheses_and_thousands_of_terms_are_a_material() {
    assert_eq!(mistakes("domain(J > 0.0)", "f64", &FORMS[0](50)), "");
    let terms: Vec<String> = (1..=3000).map(|k| format!("{k}.0 * {ENERGY}")).collect();
    assert_eq!(mistakes("domain(J > 0.0)", "f64", &terms.join(" + ")), "");
    assert_eq!(mistakes("domain(J > 0.0)", "f64", &format!("{ENERGY}{}", " * 1.0".repeat(3000))), "");
}
