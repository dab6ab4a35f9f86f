//! The time of an expansion: a type declared by a macro must not noticeably slow compilation.

use std::path::Path;
use std::time::{Duration, Instant};

use piola_codegen::{declarations, expand};

/// With or without optimisation. Without, the slowest take nearly as long on a processor that nothing else
/// uses: see the bench `expansion`.
const LONGEST: Duration = Duration::from_millis(50);

/// An expansion that something else on the machine slows down is repeated.
const ATTEMPTS: usize = 5;

#[test]
fn every_declaration_of_the_catalogue_expands_in_no_time() {
    let start = Instant::now();
    let now = || processor_time().unwrap_or_else(|| start.elapsed());
    let catalogue = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../materials/src");
    for entry in std::fs::read_dir(catalogue).expect("the catalogue") {
        let path = entry.expect("an entry").path();
        let source = std::fs::read_to_string(&path).expect("a file of the catalogue");
        for (arguments, item) in declarations(&source).expect("Rust") {
            let expansion = |_| {
                let before = now();
                let _ = expand(arguments.clone(), item.clone());
                now() - before
            };
            let shortest = (0..ATTEMPTS).map(expansion).min().unwrap_or_default();
            assert!(shortest < LONGEST, "{}: {shortest:?}", path.display());
        }
    }
}

/// What this thread has used of a processor, where Linux says so: whatever else runs does not count.
fn processor_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
