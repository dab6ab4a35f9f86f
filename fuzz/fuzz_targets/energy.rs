//! Texts of energies: the compiler and the material that it makes keep the rules of `piola_hostile` for any
//! bytes.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O energy fuzz/corpus/energy fuzz/seeds/energy
//! ```

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    piola_hostile::energy(scratch.path(), bytes);
});
