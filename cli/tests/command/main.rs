//! The command `piola`, used as in a shell.

mod bad_input;
mod bench;
mod declared;
mod folders;
mod runs;
mod shell;

use shell::{Folder, assert_contains, stderr};

/// A file that declares an energy.
const OGDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../materials/src/ogden.rs");
