//! The rules of the house.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Rust sources below a folder of the workspace, with their text.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the workspace") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                found.push((path, text));
            }
        }
    }
    assert!(!found.is_empty(), "{folder} has sources");
    found
}

#[track_caller]
fn forbid(folder: &str, words: &[&str]) {
    for (path, text) in sources(folder) {
        for (number, line) in text.lines().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            for word in words {
                assert!(
                    !code.contains(word),
                    "{}:{}: `{word}` does not belong here",
                    path.display(),
                    number + 1
                );
            }
        }
    }
}

#[test]
fn imports_point_one_way() {
    forbid("macros/core/src", &["nalgebra", "piola_materials", "faer"]);
    forbid("runtime/src", &["piola_materials", "piola_scenes", "piola_tests", "piola_codegen"]);
    forbid("materials/src", &["piola_scenes", "piola_tests", "piola_codegen", "nalgebra", "faer"]);
    forbid("laboratory/src", &["piola_materials", "piola_scenes", "piola_tests", "piola_codegen"]);
    forbid("scenes/src", &["piola_cli", "piola_tests", "piola_codegen", "tungstenite"]);
    forbid("cli/src", &["piola_tests", "piola_codegen"]);
    // Inside the runtime: lanes and material below point, point below system, system below step.
    forbid(
        "runtime/src/lanes",
        &["crate::material", "crate::point", "crate::mesh", "crate::system", "crate::step"],
    );
    forbid("runtime/src/point", &["crate::mesh", "crate::system", "crate::step"]);
    forbid("runtime/src/mesh", &["crate::point", "crate::system", "crate::step", "crate::material"]);
    forbid("runtime/src/system", &["crate::step"]);
}

/// Vector instructions are unsafe, and at home in `lanes`; there every block says why it is sound.
#[test]
fn unsafe_code_stays_in_the_lanes_and_says_why() {
    let folders = [
        "macros",
        "runtime",
        "laboratory",
        "materials",
        "scenes",
        "cli",
        "tests/src",
        "tests/examples",
        "tests/benches",
        "tests/speed",
    ];
    for (path, text) in folders.into_iter().flat_map(sources) {
        let lines: Vec<&str> = text.lines().collect();
        for (number, line) in lines.iter().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            if !code.contains("unsafe ") {
                continue;
            }
            let place = format!("{}:{}", path.display(), number + 1);
            assert!(
                path.components().any(|part| part.as_os_str() == "lanes"),
                "{place}: unsafe outside of lanes"
            );
            let above = lines[number.saturating_sub(8)..number].join("\n");
            assert!(above.contains("SAFETY:") || above.contains("# Safety"), "{place}: why is this sound?");
        }
    }
}

#[test]
fn nothing_is_left_undone() {
    for folder in ["macros", "runtime", "laboratory", "materials", "scenes", "cli"] {
        for (path, text) in sources(folder) {
            for mark in [["TO", "DO"], ["FIX", "ME"]].map(|parts| parts.concat()) {
                assert!(!text.contains(&mark), "{}: {mark}", path.display());
            }
        }
    }
}

/// The README shows a program that the test target `readme` compiles and runs.
#[test]
fn the_readme_shows_the_example() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let example = fs::read_to_string(root().join("materials/examples/own_energy.rs")).expect("the example");
    let (_, rest) = readme.split_once("```rust\n").expect("a Rust block in the README");
    let (shown, _) = rest.split_once("```").expect("the end of the block");
    assert_eq!(shown, example, "README.md and materials/examples/own_energy.rs differ");
}
