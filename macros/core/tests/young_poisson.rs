//! Energies that Young's modulus and Poisson's ratio determine.

use std::fs;
use std::path::Path;

use piola_codegen::algebra::young_poisson::Determined;
use piola_codegen::analyse;
use piola_codegen::declarations;
use proc_macro2::TokenStream;

/// The energies with `from_young_poisson`. Of the others, some have one modulus, some more than two
/// parameters in their moduli, and in some, as Gent's, an exponent or limit enters too.
const DETERMINED: [&str; 17] = [
    "Bazant",
    "CiarletNeoHookean",
    "ExponentiatedHencky",
    "FixedCorotated",
    "Hencky",
    "IsochoricNeoHookean",
    "Khajehsaeid",
    "Knowles",
    "Murnaghan",
    "NeoHookean",
    "PengLandel",
    "RotatedLinear",
    "StVenantKirchhoff",
    "StableNeoHookean",
    "ValanisLandel",
    "Varga",
    "Yeoh",
];

#[test]
fn the_catalogue_has_these() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../materials/src");
    let mut found = Vec::new();
    for file in fs::read_dir(&folder).expect("the catalogue's sources") {
        let source = fs::read_to_string(file.expect("a file").path()).expect("a source");
        for (arguments, item) in declarations(&source).expect("Rust") {
            let (declaration, model) = analyse(arguments, item, None).expect("a material");
            if model.from_young_poisson.is_some() {
                found.push(declaration.name.to_string());
            }
        }
    }
    found.sort();
    assert_eq!(found, DETERMINED);
}

/// Each determined parameter with its coefficients of μ and λ and its constant.
#[track_caller]
fn check(arguments: &str, body: &str, expected: &[(usize, [&str; 3])]) {
    let item = format!("fn E([l1, l2, l3]: [f64; 3], a: f64, b: f64, n: f64) -> f64 {{ {body} }}");
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let (_, model) = analyse(tokens(arguments), tokens(&item), None).expect("a material");
    let solved = |one: Determined| (one.parameter, [one.mu, one.lambda, one.constant].map(|c| c.to_string()));
    let found: Vec<_> = model.from_young_poisson.into_iter().flat_map(|both| both.0.map(solved)).collect();
    let expected: Vec<_> = expected.iter().map(|&(k, c)| (k, c.map(str::to_owned))).collect();
    assert_eq!(found, expected, "{body}");
}

#[test]
fn two_linear_equations_are_solved() {
    let exponent = " + (I1b - 3.0).powi(2) * n * n";
    let energy = |text: &str| format!("{text}{exponent}");
    // μ = 2a, λ = b − 4a/3
    check(
        "domain(J > 0.0)",
        &energy("a * (I1b - 3.0) + b / 2.0 * (J - 1.0).powi(2)"),
        &[(0, ["1/2", "0", "0"]), (1, ["2/3", "1", "0"])],
    );
    // μ = a + 6, λ = b
    check(
        "domain(J > 0.0)",
        &energy("(a / 2.0 + 3.0) * (I1 - 3.0 - 2.0 * J.ln()) + b / 2.0 * J.ln().powi(2)"),
        &[(0, ["1", "0", "-6"]), (1, ["0", "1", "0"])],
    );
}

#[test]
fn what_is_not_two_linear_equations_is_left_alone() {
    let check = |arguments: &str, body: &str| check(arguments, body, &[]);
    // Three parameters.
    check("domain(J > 0.0)", "(a + n) / 2.0 * (I1 - 3.0 - 2.0 * J.ln()) + b * (J - 1.0).powi(2)");
    // One.
    check("domain(J > 0.0)", "a * (I1 - 3.0 - 2.0 * J.ln()) + (b + n) * (J - 1.0).powi(4)");
    // Both in the same proportion.
    check("domain(J > 0.0)", "(a + b) * (I1 - 3.0 - 2.0 * J.ln()) + n * (J - 1.0).powi(4)");
    // Not affine.
    check(
        "domain(J > 0.0)",
        "a * b * (I1 - 3.0 - 2.0 * J.ln()) + b * (J - 1.0).powi(2) + n * (J - 1.0).powi(4)",
    );
    // A stressed rest state has another response.
    check("prestressed", "a * I1 + b * J * J + n * (J - 1.0).powi(4)");
}
