//! Energies that are declared on the command line: formulas, and files of Rust.

use std::fs;

use crate::{Folder, OGDEN, assert_contains, stderr};

const NEO_HOOKEAN: &str = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2";

/// A body of the formula moves as one of the catalogue's material does, to the last bit.
#[test]
fn a_body_of_a_formula_moves_like_that_of_the_catalogue() {
    let folder = Folder::new();
    let run = |out: &str, material: &str| {
        let parameters = "--param mu=345kPa --param lambda=3.1MPa";
        folder.answer(&format!("run dinosaur --frames 3 --out {out} {material} {parameters}"));
        fs::read(folder.path(out).join("frame_0003.ply")).expect("a frame")
    };
    let listed = run("listed", "--material neo_hookean");
    assert!(run("typed", &format!("--energy '{NEO_HOOKEAN}'")) == listed, "the frames differ");
    assert_eq!(folder.summary("typed")["material"], "Energy");
}

#[test]
fn curves_and_fits_take_formulas_and_files() {
    let folder = Folder::new();
    let of = |material: &str| {
        let text = folder.answer(&format!("curve '{material}' --mode uniaxial --rows 3"));
        text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(of(OGDEN), of("ogden"));
    let fitted =
        |material: &str| folder.answer(&format!("fit {material} --data treloar --hold kappa --starts 2"));
    let formula = fitted("--energy 'mu/2*(I1 - 3)' --free-rest --kappa 2e7 --param mu=0.4MPa");
    assert_contains(&formula, &["kappa=2e7", " held"]);
    assert_contains(&fitted(&format!("'{OGDEN}'")), &["--param mu="]);
}

/// At constant volume the pressure does no work, and a stress at rest is a pressure: neo-Hooke's and Mooney's
/// curves as they are printed.
#[test]
fn formulas_of_incompressible_solids_are_taken_as_printed_at_constant_volume() {
    let folder = Folder::new();
    let printed = "--energy 'C_10*(I_1 - 3) + C_01*(I_2 - 3)' --param C_10=0.2MPa --param C_01=0.01MPa";
    let range = "--incompressible --mode uniaxial --from 2 --to 3 --rows 2";
    let text = folder.answer(&format!("curve {printed} {range}"));
    let row = text.lines().find(|line| line.trim_start().starts_with("2.0000")).expect("a row");
    let stress: f64 = row.split_whitespace().nth(1).expect("a stress").parse().expect("a number");
    let expected = 2.0 * (2.0 - 0.25) * (0.2e6 + 0.01e6 / 2.0);
    assert!((stress / expected - 1.0).abs() < 1e-5, "{row}: not {expected}");
    let fit = "fit --energy 'mu/2*(I1 - 3)' --data treloar --starts 2 --param mu=0.4MPa";
    assert_contains(&folder.answer(fit), &["incompressible, fitted to treloar"]);
    let message = folder.refusal(&format!("{fit} --compressible"));
    assert_contains(&message, &["this leaves the stress `mu` at rest"]);
}

#[test]
fn the_contract_is_checked_without_a_crate() {
    let folder = Folder::new();
    let ogden = format!("contract '{OGDEN}' --param mu=1e5 --param alpha=2 --extend 0.1");
    let text = folder.answer(&ogden);
    assert_contains(&text, &["keeps the contract", "below 0.1, it does as well"]);
    assert!(text.lines().filter(|line| line.contains("comparisons")).count() >= 20, "{text}");
    // Terms that are large and nearly cancel: f32 keeps nothing of their sum.
    let lossy = "mu/2*(I1 - 3 - 2*ln(J)) + k*((J + 1e6)^2 - (1 + 1e6)^2 - 2*(J - 1)*(1 + 1e6))";
    let output = folder.piola(&format!("contract --energy '{lossy}' --param mu=1 --param k=1"));
    assert_eq!(output.status.code(), Some(1));
    assert_contains(&stderr(&output), &["does not keep the contract", "single_precision"]);
    assert_contains(&folder.answer("contract gent"), &["gent keeps the contract"]);
    // The remedy that works, and no other, where an exponential overflows in its extension.
    let steep = "contract --energy 'mu/(2*b)*(exp(b*(I1b - 3)) - 1) + k/2*(J - 1)^2' --param mu=1e5 --param b=0.5 \
                 --param k=1e7";
    let told = stderr(&folder.piola(&format!("{steep} --extend 0.1")));
    assert_contains(&told, &["does not keep the contract", "choose a greater `epsilon`"]);
    assert!(!told.contains("see the rule `domain`"), "{told}");
    assert_contains(&folder.answer(&format!("{steep} --extend 0.3")), &["below 0.3, it does as well"]);
}

/// The parameters of the example are those that were given, or typical ones.
#[test]
fn a_file_of_source_text_says_its_parameters() {
    let folder = Folder::new();
    let emit =
        |more: &str| folder.answer(&format!("emit ogden --target c --functions energy -o ogden.h {more}"));
    let typical = "--param mu=630000,1200,-10000 --param alpha=1.3,5,-2 --param kappa=2e7";
    assert_eq!(emit(""), format!("wrote ogden.h, whose example is {typical}\n"));
    assert!(emit("--param kappa=3MPa").ends_with("--param kappa=3000000\n"));
}

/// What is printed for a formula is Rust that declares the same energy.
#[test]
fn a_formula_is_printed_as_a_declaration() {
    let folder = Folder::new();
    let text = folder.answer("declare 'C10*(I1 - 3) + C01*(I2 - 3)' --free-rest --kappa");
    assert_contains(&text, &["#[material(domain(J > 0.0), extend)]", "C10: f64", "* J.ln()"]);
    assert_contains(&text, &["// ψ₁ = ", "// D⁻₁₂ = "]);
    folder.write("rivlin.rs", text);
    let parameters = "--param C10=1e5 --param C01=1e4 --param kappa=1e7";
    let checked = folder.answer(&format!("check rivlin.rs --resolution 5 {parameters}"));
    assert_contains(&checked, &["C10"]);
}

#[test]
fn mistakes_are_told_at_their_places() {
    let refusal = |arguments: &str| Folder::new().refusal(arguments);
    let wrong = "mu/2*(I1 - 3) - mu*lnn(J) + lambda/2*ln(J)^2";
    let message = refusal(&format!("run dinosaur --energy '{wrong}' --param mu=1 --param lambda=1"));
    assert_contains(&message, &["did you mean `ln`?", "1 | mu/2*(I1 - 3) - mu*lnn(J)"]);
    assert_contains(&message, &["|                    ^^^"]);
    let message = refusal(&format!("curve --energy '{NEO_HOOKEAN}' --param mu=1 --param lamda=1"));
    assert_contains(&message, &["`lambda` has no value: did you mean `lamda`?"]);
    let message = refusal("curve --energy 'mu/2*(I1 - 3)' --param mu=1");
    assert_contains(&message, &["`- mu*ln(J)`", "the option `--free-rest`"]);
    assert_contains(&refusal("curve nowhere.rs"), &["nowhere.rs: cannot be read"]);
    let folder = Folder::new();
    folder.write("open.rs", "#[material]\nfn A([l1, l2, l3]: [f64; 3], m: f64) -> f64 { m * (I1b - 3.0 }\n");
    assert_contains(&folder.refusal("curve open.rs"), &["--> open.rs:2:"]);
}
