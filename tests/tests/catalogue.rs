//! The sources and the manifest of the catalogue agree with its programs.

use std::fs;
use std::path::{Path, PathBuf};

use piola_materials::{CATALOGUE, DECLARATIONS};
use piola_tests::energies::ENERGIES;

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../materials/src")
}

#[test]
fn the_catalogue_is_complete_and_sorted() {
    let is_declaration = |path: &PathBuf| {
        let source = fs::read_to_string(path).expect("a source");
        !piola_codegen::declarations(&source).expect("Rust").is_empty()
    };
    let files = fs::read_dir(sources()).expect("sources").map(|file| file.expect("a source").path());
    let mut declared: Vec<_> = files.filter(is_declaration).collect();
    declared.sort();
    let names: Vec<_> =
        ENERGIES.iter().map(|energy| sources().join(energy.name).with_extension("rs")).collect();
    assert_eq!(declared, names);
    assert!(CATALOGUE.is_sorted_by_key(|entry| entry.name), "entries stand in the order of their names");
}

#[test]
fn every_declaration_has_documentation_typical_parameters_and_units() {
    for energy in ENERGIES.iter() {
        let (name, description) = (energy.name, energy.description());
        assert!(!description.summary.is_empty() && !description.formula.is_empty(), "{name} is documented");
        let typical = description.typical.as_ref().unwrap_or_else(|| panic!("{name} has none"));
        assert!(!typical.source.is_empty(), "{name} names no source");
        for (parameter, values) in description.parameters.iter().zip(typical.values.iter()) {
            assert!(!parameter.doc.is_empty(), "{name}: {} is not documented", parameter.name);
            assert!(!values.is_empty(), "{name}: {} has no value", parameter.name);
            assert!(parameter.unit.is_some(), "{name}: {} has no unit", parameter.name);
        }
    }
}

#[test]
fn energies_of_rubber_are_those_with_typical_parameters_of_it() {
    for (energy, declaration) in ENERGIES.iter().zip(DECLARATIONS) {
        let source = energy.description().typical.as_ref().map_or("", |typical| &typical.source);
        assert_eq!(declaration.is_rubber, source.contains("natural rubber"), "{}", energy.name);
    }
}

#[test]
fn every_energy_has_a_feature_and_every_feature_an_energy() {
    let manifest = fs::read_to_string(sources().join("../Cargo.toml")).expect("the crate's manifest");
    let features: Vec<_> = manifest.lines().filter_map(|line| line.strip_suffix(" = []")).collect();
    let names: Vec<_> = DECLARATIONS.iter().map(|known| known.name.replace('_', "-")).collect();
    assert_eq!(features, names);
    let (_, all) = manifest.split_once("all = [").expect("a feature of all");
    let (all, _) = all.split_once(']').expect("a list");
    let all = all.split(',').map(|name| name.trim().trim_matches('"'));
    assert_eq!(all.filter(|name| !name.is_empty()).collect::<Vec<_>>(), names);
}
