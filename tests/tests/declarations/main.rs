//! Energies as text, a trial for each and each judge of it: those of the catalogue, compiled where this build
//! has them, and those of the folder `declarations/`, which only [`Energy::from_rust`] compiles:
//! `cargo test -p piola-tests --test declarations`.
//!
//! Equal bits of compiled and interpreted energies are proven by `interpreted.rs` and `attribute.rs`.
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
            trials.push(trial(&name, move || run(&sample)));
        }
    }
    trials.extend([
        further(constructors::compiled_ones_refuse_what_is_inadmissible),
        further(emission::files_of_a_program_have_one_target_and_one_namespace),
        further(invariants::below_the_threshold_invariants_do_not_hold),
        further(powers::a_series_has_the_digits_of_its_terms),
        further(powers::a_constant_term_counts_as_written),
        further(powers::small_ones_keep_their_digits),
        further(printed::domains_with_a_root_of_the_excess),
        further(printed::a_small_constant_beside_the_excess),
        further(printed::fractions_that_cancel_on_flat_elements),
        further(printed::an_empty_list_is_a_sum_without_terms),
        further(printed::descriptions_tell_lists_and_exponents),
        further(printed::constraints_are_as_many_as_entries),
    ]);
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

fn trial(name: &str, run: impl FnOnce() + Send + 'static) -> Trial {
    Trial::test(name, move || {
        run();
        Ok(())
    })
}

/// A trial that is not about each energy, by the name of its function.
fn further<F: FnOnce() + Send + 'static>(run: F) -> Trial {
    let path = std::any::type_name::<F>();
    trial(path.split_once("::").map_or(path, |(_, name)| name), run)
}
