//! The code in the tutorial compiles, and the messages are those of the compiler.

use std::fs;
use std::path::Path;

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn it_shows_the_files_of_its_crate() {
    let tutorial = read("docs/your-first-material.md");
    let files =
        ["src/lib.rs", "tests/contract.rs", "examples/fit.rs", "examples/horse.rs", "examples/curve.rs"];
    for file in files {
        let shown = format!("\n`{file}`:\n\n```rust\n{}```\n", read(&format!("docs/biderman/{file}")));
        assert!(tutorial.contains(&shown), "{file} and the tutorial differ");
    }
    assert_eq!(tutorial.matches("`:\n\n```rust\n").count(), files.len());
}

#[test]
fn the_first_attempt_is_refused_as_it_says() {
    let tutorial = read("docs/your-first-material.md");
    let (_, attempt) = tutorial.split_once("```rust\n").expect("a block");
    let (attempt, _) = attempt.split_once("```\n").expect("the end of a block");
    let declarations = piola_codegen::declarations(attempt).expect("Rust");
    let [(arguments, item)] = &declarations[..] else { panic!("one declaration") };
    let Err(error) = piola_codegen::analyse(arguments.clone(), item.clone(), None) else {
        panic!("no mistake")
    };
    let said: Vec<_> = error.into_iter().map(|error| format!("error: {error}\n")).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(tutorial.contains(&said[0]), "the tutorial lacks\n{}", said[0]);
}
