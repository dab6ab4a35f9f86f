//! Prints what `#[piola::material]` writes for each declaration of a Rust source file, formatted.
//!
//! ```text
//! cargo run -p piola-codegen --example expand -- materials/src/neo_hookean.rs
//! ```

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::error::Error;
use std::fmt::Write as _;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name a Rust source file that declares a material")?;
    let source = std::fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
    print!("{}", expansions(&source).map_err(|error| format!("{path}: {error}"))?);
    Ok(())
}

fn expansions(source: &str) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    for (arguments, item) in piola_codegen::declarations(source)? {
        let file = syn::parse2::<syn::File>(piola_codegen::expand(arguments, item))?;
        writeln!(text, "{}", prettyplease::unparse(&file))?;
    }
    if text.is_empty() { Err("no function has the attribute `material`".into()) } else { Ok(text) }
}

#[cfg(test)]
mod tests {
    use super::expansions;

    #[test]
    fn a_file_without_materials_is_a_failure() {
        let error = expansions("mod elsewhere; fn main() {}").expect_err("no material");
        assert_eq!(error.to_string(), "no function has the attribute `material`");
    }
}
