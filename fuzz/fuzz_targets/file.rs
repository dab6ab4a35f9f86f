//! Files: the reader of a format and its users keep the rules of `piola_hostile` for any bytes. The variable
//! `PIOLA_FORMAT` names the format, one of the folders with seeds: csv, energy, msh, obj, state, tetgen.
//!
//! ```sh
//! PIOLA_FORMAT=msh cargo +nightly fuzz run -s none -O file fuzz/corpus/msh fuzz/seeds/msh
//! ```

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use piola_hostile::{FORMATS, Judge};

static JUDGE: LazyLock<Judge> = LazyLock::new(|| {
    let name = std::env::var("PIOLA_FORMAT").expect("PIOLA_FORMAT is not set");
    FORMATS.iter().find(|(format, _)| *format == name).expect("PIOLA_FORMAT is not a format").1
});

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    (*JUDGE)(scratch.path(), bytes);
});
