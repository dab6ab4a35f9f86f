//! Energies that are declared on the command line: formulas, and files of Rust.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const NEO_HOOKEAN: &str = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2";
const OGDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../materials/src/ogden.rs");

fn piola(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    command.current_dir(folder).args(arguments).output().expect("the command starts")
}

#[track_caller]
fn answer(folder: &Path, arguments: &[&str]) -> String {
    let output = piola(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// The message of a command that is refused before anything is done.
#[track_caller]
fn refusal(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let output = piola(folder.path(), arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "{arguments:?} wrote files");
    String::from_utf8(output.stderr).expect("text")
}

/// A body of the formula moves as one of the catalogue's material does, to the last bit.
#[test]
fn a_body_of_a_formula_moves_like_that_of_the_compiled_material() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let parameters = ["--param", "mu=345kPa", "--param", "lambda=3.1MPa", "--frames", "3"];
    let run = |out: &str, material: [&str; 2]| {
        let mut arguments = vec!["run", "dinosaur", "--out", out];
        arguments.extend(material.into_iter().chain(parameters));
        answer(folder.path(), &arguments);
        fs::read(folder.path().join(out).join("frame_0003.ply")).expect("a frame")
    };
    let compiled = run("compiled", ["--material", "neo_hookean"]);
    assert!(run("typed", ["--energy", NEO_HOOKEAN]) == compiled, "the frames differ");
    let summary = fs::read_to_string(folder.path().join("typed/summary.json")).expect("a summary");
    assert!(summary.contains("\"material\": \"Energy\""), "{summary}");
}

/// A run that is cut off is resumed from its files alone, which include the energy, even a long one.
#[test]
fn a_run_of_a_formula_or_a_file_is_resumed() {
    let long =
        fs::read_to_string(OGDEN).expect("a file").replace("#[", &format!("// {}\n#[", "x".repeat(20_000)));
    for material in [
        &["--energy", NEO_HOOKEAN, "--param", "mu=345kPa", "--param", "lambda=3.1MPa"][..],
        &["--material", "long.rs"],
    ] {
        let folder = tempfile::tempdir().expect("a scratch folder");
        fs::write(folder.path().join("long.rs"), &long).expect("a file");
        let run = |out: &str, frames: &str, more: &[&str]| {
            let arguments = [&["run", "dinosaur", "--out", out, "--frames", frames], material, more].concat();
            answer(folder.path(), &arguments);
        };
        run("whole", "4", &[]);
        run("parts", "2", &[]);
        run("parts", "4", &["--resume"]);
        let frame = |out: &str| fs::read(folder.path().join(out).join("frame_0004.ply")).expect("a frame");
        assert!(frame("whole") == frame("parts"), "the frames differ");
    }
}

#[test]
fn curves_and_fits_take_formulas_and_files() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let typical = ["--mode", "uniaxial", "--rows", "3"];
    let of = |material: &[&str]| {
        let arguments: Vec<_> =
            ["curve"].into_iter().chain(material.iter().copied()).chain(typical).collect();
        let text = answer(folder.path(), &arguments);
        text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(of(&[OGDEN]), of(&["ogden"]));
    let fitted = |material: &[&str]| {
        let options = ["--data", "treloar", "--hold", "kappa", "--starts", "2"];
        let arguments: Vec<_> = ["fit"].into_iter().chain(material.iter().copied()).chain(options).collect();
        answer(folder.path(), &arguments)
    };
    let formula =
        fitted(&["--energy", "mu/2*(I1 - 3)", "--free-rest", "--kappa", "2e7", "--param", "mu=0.4MPa"]);
    assert!(formula.contains("kappa=2e7") && formula.contains(" held"), "{formula}");
    assert!(fitted(&[OGDEN]).contains("--param mu="), "Ogden's from its file");
}

/// At constant volume the pressure does no work, and a stress at rest is a pressure: neo-Hooke's and Mooney's
/// curves as they are printed.
#[test]
fn formulas_of_incompressible_solids_are_taken_as_printed_at_constant_volume() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let printed = "C_10*(I_1 - 3) + C_01*(I_2 - 3)";
    let parameters = ["--param", "C_10=0.2MPa", "--param", "C_01=0.01MPa"];
    let range = ["--incompressible", "--mode", "uniaxial", "--from", "2", "--to", "3", "--rows", "2"];
    let text = answer(folder.path(), &[&["curve", "--energy", printed], &parameters[..], &range].concat());
    let row = text.lines().find(|line| line.trim_start().starts_with("2.0000")).expect("a row");
    let stress: f64 = row.split_whitespace().nth(1).expect("a stress").parse().expect("a number");
    let expected = 2.0 * (2.0 - 0.25) * (0.2e6 + 0.01e6 / 2.0);
    assert!((stress / expected - 1.0).abs() < 1e-5, "{row}: not {expected}");
    let fit =
        ["fit", "--energy", "mu/2*(I1 - 3)", "--data", "treloar", "--starts", "2", "--param", "mu=0.4MPa"];
    assert!(answer(folder.path(), &fit).contains("incompressible, fitted to treloar"));
    assert!(
        refusal(&["fit", "--compressible"].into_iter().chain(fit.into_iter().skip(1)).collect::<Vec<_>>())
            .contains("this leaves the stress `mu` at rest")
    );
}

#[test]
fn the_contract_is_checked_without_a_crate() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text = answer(
        folder.path(),
        &["contract", OGDEN, "--param", "mu=1e5", "--param", "alpha=2", "--extend", "0.1"],
    );
    assert!(text.contains("keeps the contract") && text.contains("below 0.1, it does as well"), "{text}");
    assert!(text.lines().filter(|line| line.contains("comparisons")).count() >= 20, "{text}");
    // Terms that are large and nearly cancel: f32 keeps nothing of their sum.
    let lossy = [
        "contract",
        "--energy",
        "mu/2*(I1 - 3 - 2*ln(J)) + k*((J + 1e6)^2 - (1 + 1e6)^2 - 2*(J - 1)*(1 + 1e6))",
    ];
    let output = piola(folder.path(), &[&lossy[..], &["--param", "mu=1", "--param", "k=1"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("does not keep the contract") && message.contains("single_precision"),
        "{message}"
    );
    assert!(answer(folder.path(), &["contract", "gent"]).contains("gent keeps the contract"));
}

/// The parameters of the example are those that were given, or typical ones.
#[test]
fn a_file_of_source_text_says_its_parameters() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let emit = |more: &[&str]| {
        let arguments = [&["emit", "ogden", "--target", "c", "--functions", "energy", "-o", "ogden.h"], more];
        answer(folder.path(), &arguments.concat())
    };
    let typical = "--param mu=630000,1200,-10000 --param alpha=1.3,5,-2 --param kappa=2e7";
    assert_eq!(emit(&[]), format!("wrote ogden.h, whose example is {typical}\n"));
    assert!(emit(&["--param", "kappa=3MPa"]).ends_with("--param kappa=3000000\n"));
}

/// What is printed for a formula is Rust that declares the same energy.
#[test]
fn a_formula_is_printed_as_a_declaration() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text = answer(folder.path(), &["declare", "C10*(I1 - 3) + C01*(I2 - 3)", "--free-rest", "--kappa"]);
    for part in
        ["#[material(domain(J > 0.0), extend, fit)]", "C10: f64", "* J.ln()", "// ψ₁ = ", "// D⁻₁₂ = "]
    {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
    fs::write(folder.path().join("rivlin.rs"), text).expect("a file");
    let parameters = ["--param", "C10=1e5", "--param", "C01=1e4", "--param", "kappa=1e7"];
    let checked =
        answer(folder.path(), &[&["check", "rivlin.rs", "--resolution", "5"][..], &parameters].concat());
    assert!(checked.contains("C10"), "{checked}");
}

#[test]
fn mistakes_are_told_at_their_places() {
    let wrong = "mu/2*(I1 - 3) - mu*lnn(J) + lambda/2*ln(J)^2";
    let message = refusal(&["run", "dinosaur", "--energy", wrong, "--param", "mu=1", "--param", "lambda=1"]);
    assert!(message.contains("did you mean `ln`?"), "{message}");
    assert!(
        message.contains("1 | mu/2*(I1 - 3) - mu*lnn(J)") && message.contains("|                    ^^^"),
        "{message}"
    );
    let message = refusal(&["curve", "--energy", NEO_HOOKEAN, "--param", "mu=1", "--param", "lamda=1"]);
    assert!(message.contains("`lambda` has no value: did you mean `lamda`?"), "{message}");
    let message = refusal(&["curve", "--energy", "mu/2*(I1 - 3)", "--param", "mu=1"]);
    assert!(message.contains("`- mu*ln(J)`") && message.contains("the option `--free-rest`"), "{message}");
    assert!(refusal(&["curve", "nowhere.rs"]).contains("nowhere.rs: cannot be read"));
}
