//! The declarations of the catalogue, which this crate reads as text.

use std::fs;
use std::path::Path;

use piola_codegen::declarations;
use proc_macro2::TokenStream;

/// A declaration: the arguments of the attribute, and the function.
pub(crate) type Declared = (TokenStream, TokenStream);

/// The name of each file that declares materials, and its declarations.
pub(crate) fn catalogue() -> Vec<(String, Vec<Declared>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../materials/src");
    let files = fs::read_dir(folder).expect("the catalogue").map(|entry| entry.expect("an entry").path());
    let file = |path: std::path::PathBuf| {
        let name = path.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let source = fs::read_to_string(path).expect("a file of the catalogue");
        (name, declarations(&source).expect("Rust"))
    };
    let mut found: Vec<_> = files.map(file).filter(|(_, declared)| !declared.is_empty()).collect();
    found.sort_by(|(a, _), (b, _)| a.cmp(b));
    found
}
