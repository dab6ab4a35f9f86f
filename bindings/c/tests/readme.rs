//! The programs in the README are those that are compiled.

use std::path::Path;

#[track_caller]
fn check(language: &str, program: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| std::fs::read_to_string(folder.join(file)).expect("a file of this crate");
    let block = format!("```{language}\n{}```\n", read(program));
    assert!(read("README.md").contains(&block), "the README has another program than {program}");
}

#[test]
fn the_programs_of_the_readme_are_compiled() {
    check("c", "clients/example.c");
    check("cpp", "clients/example.cpp");
}
