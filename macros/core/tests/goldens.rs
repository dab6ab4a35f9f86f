//! Output of the compiler for the catalogue, as committed: whole expansions, the formulas that rustdoc shows,
//! and how many operations each result takes.
//!
//! `PIOLA_BLESS=1 cargo test -p piola-codegen --test goldens` writes the files anew.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use catalogue::{Declared, catalogue};
use piola_codegen::schedule::count::{LEGEND, table};
use piola_codegen::{analyse, expand};

#[path = "shared/catalogue.rs"]
mod catalogue;

/// Compares with the file `tests/goldens/{name}`, or writes it.
#[track_caller]
fn check(name: &str, actual: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens").join(name);
    if std::env::var_os("PIOLA_BLESS").is_some() {
        fs::write(path, actual).expect("a golden is written");
        return;
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    let same = expected.lines().zip(actual.lines()).take_while(|(old, new)| old == new).count();
    assert!(
        expected.lines().eq(actual.lines()),
        "tests/goldens/{name} differs in line {}:\n- {}\n+ {}\nIf that is meant, set PIOLA_BLESS=1 and run the test \
         again: it writes the file, and its difference is for review",
        same + 1,
        expected.lines().nth(same).unwrap_or("(its end)"),
        actual.lines().nth(same).unwrap_or("(the end)"),
    );
}

/// Compares the expansion of the only declaration of a file of the catalogue.
#[track_caller]
fn check_expansion(material: &str) {
    let found = catalogue().into_iter().find(|(name, _)| name == material);
    let declared = found.and_then(|(_, mut all)| all.pop()).expect("a declaration");
    check(&format!("{material}.expanded"), &expansion(declared));
}

fn expansion((arguments, item): Declared) -> String {
    prettyplease::unparse(&syn::parse2(expand(arguments, item)).expect("an expansion is Rust"))
}

/// All declarations of the catalogue, in the order of their files.
fn all() -> impl Iterator<Item = Declared> {
    catalogue().into_iter().flat_map(|(_, declared)| declared)
}

#[test]
fn an_energy_of_invariants_expands_as_committed() {
    check_expansion("neo_hookean");
}

#[test]
fn an_energy_with_lists_expands_as_committed() {
    check_expansion("ogden");
}

#[test]
fn results_take_the_operations_committed() {
    let mut text = format!("# Operations of the catalogue\n\n{LEGEND}.\n");
    for (arguments, item) in all() {
        let (declaration, mut model) = analyse(arguments, item).expect("an energy without mistakes");
        let table = table(&declaration, &model.counts());
        write!(text, "\n## {}\n\n{table}", declaration.name).expect("text");
    }
    check("counts.md", &text);
}

#[test]
fn rustdoc_shows_the_formulas_committed() {
    let mut text = "# Formulas of the catalogue\n".to_owned();
    for declared in all() {
        let expansion = expansion(declared);
        let (_, shown) = expansion.split_once("/// **Derivatives**").expect("a section");
        let (shown, rest) = shown.split_once("/// **Operations**").expect("the next section");
        let lines: Vec<_> = shown.lines().map(|line| line.trim_start_matches("///").trim_start()).collect();
        let name = rest.split_once("pub struct ").map_or("", |(_, rest)| rest);
        let name = name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
        for result in ["ψ₁", "ψ₁₁", "ψ₁₂", "D⁻₁₂", "D⁺₁₂"] {
            let is_whole = |line: &&str| line.starts_with(&format!("{result} = ")) && !line.contains('…');
            assert_eq!(lines.iter().filter(|line| is_whole(line)).count(), 1, "{name}: {result}");
        }
        write!(text, "\n## {name}\n\n**Derivatives** {}\n", lines.join("\n").trim_end()).expect("text");
    }
    check("formulas.md", &text);
}
