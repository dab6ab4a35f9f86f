//! Energies as text, a trial for each and each judge of it: those of the catalogue, compiled where this build
//! has them, and those of the folder `declarations/`, which only [`Energy::from_rust`] compiles:
//! `cargo test -p piola-tests --test declarations`.
//!
//! Equal bits of compiled and interpreted energies are proven by `declare/tests` and `inlined.rs`.
//!
//! [`Energy::from_rust`]: piola_declare::Energy::from_rust

mod batch;
mod constructors;
mod contract;
mod emission;
mod invariants;
mod mistakes;
mod oracle;
mod powers;
mod printed;

use std::process::ExitCode;

use libtest_mimic::{Arguments, Trial};
use piola_tests::declarations::{Sample, samples};
use piola_tests::energies::ENERGIES;

/// Files of valid energies.
const FILES: [&str; 5] = ["compiled", "moduli", "papers", "powers", "printed"];

type Judge = fn(&Sample);

/// The judges of each energy, with the names of their trials.
const JUDGES: [(&str, Judge); 6] = [
    ("batch", batch::judge),
    ("constructors", constructors::judge),
    ("contract", contract::judge),
    ("emission", emission::judge),
    ("invariants", invariants::judge),
    ("oracle", oracle::judge),
];

fn main() -> ExitCode {
    let samples = samples(&FILES);
    let catalogue = ENERGIES.iter().map(Sample::of_catalogue);
    let mut trials = mistakes::trials();
    for sample in catalogue.chain(samples) {
        for (judge, run) in JUDGES {
            let (name, sample) = (format!("{judge}::{}", sample.judged.name), sample.clone());
            trials.push(Trial::test(name, move || {
                run(&sample);
                Ok(())
            }));
        }
    }
    let further = [&constructors::TRIALS[..], &invariants::TRIALS, &powers::TRIALS, &printed::TRIALS];
    trials.extend(further.concat().into_iter().map(|(name, run)| {
        Trial::test(name, move || {
            run();
            Ok(())
        })
    }));
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}
