//! Measured points in CSV files: the reader and its users keep the rules of `piola_hostile` for any bytes.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O csv fuzz/corpus/csv fuzz/seeds/csv
//! ```

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    piola_hostile::csv(scratch.path(), bytes);
});
