//! The first attempt of the tutorial gives the message that it shows.

use std::fs;
use std::path::Path;

#[test]
fn the_first_attempt_is_refused_as_it_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/your-first-material.md");
    let tutorial = fs::read_to_string(path).expect("the tutorial");
    let (_, attempt) = tutorial.split_once("```rust\n").expect("a block");
    let (attempt, _) = attempt.split_once("```\n").expect("the end of a block");
    let declarations = piola_codegen::declarations(attempt).expect("Rust");
    let [(arguments, item)] = &declarations[..] else { panic!("one declaration") };
    let Err(error) = piola_codegen::analyse(arguments.clone(), item.clone()) else { panic!("no mistake") };
    let said: Vec<_> = error.into_iter().map(|error| format!("error: {error}\n")).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(tutorial.contains(&said[0]), "the tutorial lacks\n{}", said[0]);
}
