//! Recordings of the viewer: whatever they are, the reader and what follows it keep what `piola_hostile`
//! says.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O recording fuzz/corpus/recording fuzz/seeds/recording
//! ```

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    piola_hostile::recording(scratch.path(), bytes);
});
