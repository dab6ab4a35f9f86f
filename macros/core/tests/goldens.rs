//! What the compiler writes of the catalogue, as committed: whole expansions, and how many operations each result takes.
//!
//! `PIOLA_BLESS=1 cargo test -p piola-codegen --test goldens` writes the files anew.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use piola_codegen::count::{LEGEND, counts, table};
use piola_codegen::{declarations, expand, understand};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The sources of the catalogue, which this crate knows as text alone.
fn catalogue() -> PathBuf {
    root().join("../../materials/src")
}

/// Compares with the file `tests/goldens/{name}`, or writes it.
#[track_caller]
fn check(name: &str, actual: &str) {
    let path = root().join("tests/goldens").join(name);
    if std::env::var_os("PIOLA_BLESS").is_some() {
        fs::write(path, actual).expect("a golden is written");
        return;
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    let (mut old, mut new) = (expected.lines(), actual.lines());
    let mut number = 0;
    loop {
        number += 1;
        let (old, new) = (old.next(), new.next());
        assert!(
            old == new,
            "tests/goldens/{name} differs in line {number}:\n- {}\n+ {}\nIf that is meant, set PIOLA_BLESS=1 and run the test \
             again: it writes the file, and its difference is for review",
            old.unwrap_or("(its end)"),
            new.unwrap_or("(the end)"),
        );
        if old.is_none() {
            return;
        }
    }
}

/// Of the only declaration of a file of the catalogue.
#[track_caller]
fn check_expansion(material: &str) {
    let source =
        fs::read_to_string(catalogue().join(format!("{material}.rs"))).expect("a file of the catalogue");
    let (arguments, item) = declarations(&source).expect("Rust").pop().expect("a declaration");
    let file = syn::parse2(expand(arguments, item)).expect("an expansion is Rust");
    check(&format!("{material}.rs"), &prettyplease::unparse(&file));
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
fn an_energy_with_a_bound_expands_as_committed() {
    check_expansion("gent");
}

#[test]
fn results_take_the_operations_committed() {
    let folder = fs::read_dir(catalogue()).expect("the catalogue");
    let mut paths: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let mut text = format!("# Operations of the catalogue\n\n{LEGEND}.\n");
    for path in paths {
        let source = fs::read_to_string(path).expect("a file of the catalogue");
        for (arguments, item) in declarations(&source).expect("Rust") {
            let (declaration, mut model) = understand(arguments, item).expect("an energy without mistakes");
            let table = table(&declaration, &counts(&mut model));
            write!(text, "\n## {}\n\n{table}", declaration.name).expect("text");
        }
    }
    check("counts.md", &text);
}
