//! What the documentation of the catalogue says is what its programs get.

use std::fs;
use std::path::{Path, PathBuf};

use piola::Inversion;
use piola::material::Description;
use piola_codegen::read::parse::{Declaration, documentation};
use piola_materials::{CATALOGUE, Entry};
use piola_tests::declared::declarations;

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../materials/src")
}

/// The documentation of each energy, by name of type.
fn documented() -> Vec<(String, String)> {
    let documentation = |declaration: &Declaration| documentation(&declaration.attributes);
    let all = declarations().expect("the catalogue's sources");
    all.iter().map(|declaration| (declaration.name.to_string(), documentation(declaration))).collect()
}

/// The values of `mu = [1.0, 2.0], kappa = 2e7`.
fn values(text: &str, description: &Description) -> Option<Vec<Vec<f64>>> {
    let mut rest = text;
    let values = description.parameters.iter().map(|parameter| {
        let start = format!("{} = ", parameter.name);
        rest = rest.strip_prefix(", ").unwrap_or(rest).strip_prefix(&start)?;
        let end = if parameter.is_list { rest.find(']')? + 1 } else { rest.find(',').unwrap_or(rest.len()) };
        let (value, after) = rest.split_at(end);
        rest = after;
        value.trim_matches(['[', ']']).split(", ").map(|number| number.parse().ok()).collect()
    });
    values.collect()
}

#[test]
fn typical_parameters_are_those_of_the_documentation() {
    let documented = documented();
    for Entry { name, description, typical } in CATALOGUE {
        let (_, text) =
            documented.iter().find(|(other, _)| other == description.name).expect("a declaration");
        let (_, after) = text.split_once("Typical: `").unwrap_or_else(|| panic!("{name} names none"));
        let (stated, source) = after.split_once("`, ").unwrap_or_else(|| panic!("{name} names no source"));
        assert!(!source.is_empty(), "{name} names no source");
        let stated = values(stated, description).unwrap_or_else(|| panic!("{name} states {stated}"));
        assert_eq!(stated, *typical, "{name}");
    }
}

#[test]
fn typical_parameters_are_accepted() {
    for entry in CATALOGUE {
        let inversions = match entry.description.extends {
            true => &[Inversion::Refuse, Inversion::Extend { epsilon: 0.1 }][..],
            false => &[Inversion::Refuse],
        };
        for &inversion in inversions {
            let moduli = entry.moduli(entry.typical, inversion);
            assert!(moduli.is_ok(), "{}: {}", entry.name, moduli.expect_err("refused"));
        }
    }
}

/// The table of the crate's documentation: name, type, domain, and what happens beyond it.
fn table() -> String {
    let mut table = String::new();
    for Entry { name, description, .. } in CATALOGUE {
        let Description { name: type_name, domain, refusal, .. } = description;
        let inversion = refusal.unwrap_or("extends");
        table += &format!("//! | `{name}` | [`{type_name}`] | {domain} | {inversion} |\n");
    }
    table
}

#[test]
fn the_crate_lists_every_energy() {
    let text = fs::read_to_string(sources().join("lib.rs")).expect("the crate's documentation");
    let table = table();
    assert!(text.contains(&table), "the table in lib.rs should be\n{table}");
}
