//! Prints what `#[piola::material]` writes for each declaration of a Rust source file, formatted.
//!
//! ```text
//! cargo run -p piola-codegen --example expand -- materials/src/neo_hookean.rs
//! ```

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name a Rust source file that declares a material")?;
    let source = std::fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
    for (arguments, item) in piola_codegen::declarations(&source)? {
        let file = syn::parse2::<syn::File>(piola_codegen::expand(arguments, item))?;
        println!("{}", prettyplease::unparse(&file));
    }
    Ok(())
}
