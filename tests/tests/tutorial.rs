//! The code in the tutorial compiles, and the messages are those of the compiler.

use std::fs;
use std::path::Path;

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Each block of Rust with the last line of text before it.
fn blocks(tutorial: &str) -> Vec<(&str, &str)> {
    let mut parts = tutorial.split("```rust\n");
    let mut before = parts.next().unwrap_or_default();
    let mut blocks = Vec::new();
    for part in parts {
        let (code, after) = part.split_once("```\n").expect("the end of a block");
        blocks.push((before.trim_end().lines().last().unwrap_or_default(), code));
        before = after;
    }
    blocks
}

#[test]
fn it_shows_the_files_of_its_crate() {
    let tutorial = read("docs/your-first-material.md");
    let mut shown = Vec::new();
    for (before, code) in blocks(&tutorial) {
        let Some(file) = before.strip_prefix('`').and_then(|line| line.strip_suffix("`:")) else { continue };
        assert_eq!(code, read(&format!("docs/biderman/{file}")), "{file} and the tutorial differ");
        shown.push(file);
    }
    assert_eq!(
        shown,
        ["src/lib.rs", "tests/contract.rs", "examples/fit.rs", "examples/horse.rs", "examples/curve.rs"]
    );
}

#[test]
fn the_first_attempt_is_refused_as_it_says() {
    let tutorial = read("docs/your-first-material.md");
    let (_, attempt) = blocks(&tutorial)[0];
    let declarations = piola_codegen::declarations(attempt).expect("Rust");
    let [(arguments, item)] = &declarations[..] else { panic!("one declaration") };
    let Err(error) = piola_codegen::analyse(arguments.clone(), item.clone(), None) else {
        panic!("no mistake")
    };
    let said: Vec<_> = error.into_iter().map(|error| format!("error: {error}\n")).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(tutorial.contains(&said[0]), "the tutorial lacks\n{}", said[0]);
}
