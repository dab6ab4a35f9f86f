//! Tetrahedra of TetGen, nodes and elements in one text: whatever they are, the reader and what follows it
//! keep what `piola_hostile` says.
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
