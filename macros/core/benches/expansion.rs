//! The time that each material of the catalogue adds to compilation:
//! `cargo bench -p piola-codegen --bench expansion`.
//!
//! By default Cargo builds procedural macros without optimisation, which then take longer:
//! `cargo bench -p piola-codegen --bench expansion --profile dev --config profile.dev.opt-level=0`.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use catalogue::catalogue;
use piola_codegen::expand;

#[path = "../tests/shared/catalogue.rs"]
mod catalogue;

/// Number of expansions of each material, of which the shortest counts.
const TURNS: usize = 50;

fn main() {
    println!("milliseconds, the least and the median of {TURNS}");
    for (file, found) in catalogue() {
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
