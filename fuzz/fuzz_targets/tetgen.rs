//! Tetrahedra of TetGen, nodes and elements in one text: the reader and its users keep the rules of
//! `piola_hostile` for any bytes.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O tetgen fuzz/corpus/tetgen fuzz/seeds/tetgen
//! ```

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    piola_hostile::tetgen(scratch.path(), bytes);
});
