//! The time that each material of the catalogue adds to compilation:
//! `cargo bench -p piola-codegen --bench expansion`.
//!
//! By default Cargo builds procedural macros without optimisation, which then take longer:
//! `cargo bench -p piola-codegen --bench expansion --profile dev --config profile.dev.opt-level=0`.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use piola_codegen::{declarations, expand};

/// Number of expansions of each material, of which the shortest counts.
const TURNS: usize = 50;

fn main() {
    println!("milliseconds, the least and the median of {TURNS}");
    for file in files() {
        let source = std::fs::read_to_string(catalogue().join(&file)).expect("a file of the catalogue");
        let found = declarations(&source).expect("Rust");
        let mut times: Vec<Duration> = (0..TURNS)
            .map(|_| {
                let (found, start) = (found.clone(), Instant::now());
                for (arguments, item) in found {
                    black_box(expand(arguments, item));
                }
                start.elapsed()
            })
            .collect();
        times.sort();
        let [least, median] = [times[0], times[TURNS / 2]].map(|time| time.as_secs_f64() * 1e3);
        println!("{file:30} {least:8.2} {median:8.2}");
    }
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
