//! Prints the operations of each result of the declarations in Rust source files.
//!
//! ```text
//! cargo run -p piola-codegen --example counts -- materials/src/ogden.rs materials/src/neo_hookean.rs
//! ```

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

use std::error::Error;

use piola_codegen::schedule::count::{LEGEND, table};

fn main() -> Result<(), Box<dyn Error>> {
    println!("{LEGEND}.");
    for path in std::env::args().skip(1) {
        let source = std::fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
        let declarations = piola_codegen::declarations(&source)?;
        if declarations.is_empty() {
            return Err(format!("{path}: no function has the attribute `material`").into());
        }
        for (arguments, item) in declarations {
            let (declaration, mut model) = piola_codegen::analyse(arguments, item, None)?;
            println!("\n## {}\n\n{}", declaration.name, table(&declaration, &model.counts()).trim_end());
        }
    }
    Ok(())
}
