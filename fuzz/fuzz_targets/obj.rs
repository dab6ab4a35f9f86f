//! Surfaces in OBJ files: the reader and its users keep the rules of `piola_hostile` for any bytes.
//!
//! ```sh
//! cargo +nightly fuzz run -s none -O obj fuzz/corpus/obj fuzz/seeds/obj
//! ```

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    piola_hostile::obj(scratch.path(), bytes);
});
