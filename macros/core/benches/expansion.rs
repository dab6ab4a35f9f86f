//! The time that each material of the catalogue adds to compilation:
//! `cargo bench -p piola-codegen --bench expansion`.
//!
//! By default Cargo builds procedural macros without optimisation, which then take longer:
//! `cargo bench -p piola-codegen --bench expansion --profile dev --config profile.dev.opt-level=0`.

use std::path::Path;

use divan::Bencher;
use piola_codegen::{declarations, expand};

fn main() {
    divan::main();
}

#[divan::bench(args = files())]
fn expansion(bencher: Bencher<'_, '_>, file: &str) {
    let source = std::fs::read_to_string(catalogue().join(file)).expect("a file of the catalogue");
    let found = declarations(&source).expect("Rust");
    bencher.with_inputs(|| found.clone()).bench_local_values(|found| {
        found.into_iter().map(|(arguments, item)| expand(arguments, item)).collect::<Vec<_>>()
    });
}

/// The sources of the catalogue, which this crate reads as text.
fn catalogue() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../materials/src"))
}

/// The files that declare a material.
fn files() -> Vec<String> {
    let folder = std::fs::read_dir(catalogue()).expect("the catalogue");
    let mut files: Vec<_> = folder
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            let source = std::fs::read_to_string(path).expect("a file of the catalogue");
            declarations(&source).is_ok_and(|found| !found.is_empty())
        })
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
        .collect();
    files.sort();
    files
}
