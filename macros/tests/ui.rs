//! Compiler output for mistaken declarations, `ui/*.rs`: their mistakes and nothing else, though each
//! is used.
//!
//! `TRYBUILD=overwrite cargo test -p piola-macros` writes `ui/*.stderr` anew. How tokens are underlined is up
//! to the compiler, so they are compared where it has the version that they were written by; the test
//! `declarations` of `piola-tests` compares whole messages everywhere.

use std::process::Command;

/// The version of rustc that wrote the files.
const WRITTEN_BY: &str = "rustc 1.95.";

#[test]
fn mistakes_are_shown_where_they_are() {
    let output = Command::new("rustc").arg("--version").output().expect("rustc");
    let version = String::from_utf8_lossy(&output.stdout);
    if version.starts_with(WRITTEN_BY) {
        trybuild::TestCases::new().compile_fail("tests/ui/*.rs");
    } else {
        eprintln!("nothing compared: the files were written by {WRITTEN_BY}x, and this is {version}");
    }
}
