//! Time of an expansion compared with work that only the compiler's own libraries do: a macro must not be
//! felt.
//!
//! Both are measured in turn on one thread, in time of the processor that Linux gives this thread, so that
//! neither a slow machine nor a busy one makes them differ. Milliseconds are what the bench `expansion`
//! measures.

use std::hint::black_box;
use std::time::{Duration, Instant};

use catalogue::catalogue;
use piola_codegen::expand;
use quote::ToTokens;

#[path = "shared/catalogue.rs"]
mod catalogue;

/// Longest expansion, in units of parsing and printing the [`reference`]. The slowest of the catalogue, Flory
/// and Erman's with its quotients of quotients, takes 4.4, the next one 3.3.
const LONGEST: f64 = 7.0;

/// A measurement that something disturbs, such as a neighbour in the caches, is repeated up to this often.
const ATTEMPTS: usize = 40;

#[test]
fn every_declaration_of_the_catalogue_expands_in_no_time() {
    let start = Instant::now();
    let now = || processor_time().unwrap_or_else(|| start.elapsed());
    let time = |work: &dyn Fn()| {
        let before = now();
        work();
        now() - before
    };
    let text = reference();
    let parse_and_print = || {
        let file = syn::parse_file(black_box(&text)).expect("Rust");
        black_box(file.to_token_stream().to_string());
    };
    for (name, declared) in catalogue() {
        for (arguments, item) in declared {
            let expansion = || drop(black_box(expand(arguments.clone(), item.clone())));
            let (mut unit, mut shortest) = (Duration::MAX, Duration::MAX);
            let is_short = (0..ATTEMPTS).any(|_| {
                unit = unit.min(time(&parse_and_print));
                shortest = shortest.min(time(&expansion));
                shortest < unit.mul_f64(LONGEST)
            });
            assert!(is_short, "{name}: {shortest:?}, where the reference takes {unit:?}");
        }
    }
}

/// Text of two hundred small functions.
fn reference() -> String {
    "fn f(x: f64, y: f64) -> f64 { let z = x * (y + 1.0) - y / 3.0; z.powi(2) + f(y, z) }\n".repeat(200)
}

/// Time of a processor that this thread has used, if Linux reports it: other processes do not count.
fn processor_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
