//! Derivatives come from declarations.

use piola_tidy::{crates, forbid};
use quote::ToTokens;
use syn::Item;

/// Traits by which an energy answers.
const ANSWERS: [&str; 3] = ["Material", "Response", "Specimen"];

/// Files that hand stretches on, to programs whose derivatives the compiler has found and to other materials.
const FORWARDING: [&str; 2] = ["runtime/src/interpreter/material.rs", "laboratory/src/specimen.rs"];

/// No other shipped code answers for a material: it would compute an energy or a derivative by hand.
#[test]
fn no_derivative_is_written_by_hand() {
    let (mut found, mut forwarding) = (Vec::new(), Vec::new());
    for module in crates().iter().filter(|one| one.is_published).flat_map(|one| &one.modules) {
        for item in &module.items {
            if is_answer(item) {
                let file = module.file.display().to_string();
                let tokens = item.to_token_stream().to_string();
                let computes = ["*", "/", "powi", "powf"].iter().any(|token| tokens.contains(token));
                // Only the interpreter may compute.
                let forwards = FORWARDING.contains(&file.as_str()) && !(computes && file != FORWARDING[0]);
                let files = if forwards { &mut forwarding } else { &mut found };
                files.push(file);
            }
        }
    }
    forbid("implementations of a material by hand", &found);
    for file in FORWARDING {
        assert!(
            forwarding.iter().any(|one| one == file),
            "{file} forwards nothing: this test looks for the wrong names"
        );
    }
}

/// True of the implementation of a trait of [`ANSWERS`].
fn is_answer(item: &Item) -> bool {
    let Item::Impl(implementation) = item else { return false };
    let name = implementation.trait_.as_ref().and_then(|(path, _)| path.segments.last());
    name.is_some_and(|name| ANSWERS.iter().any(|answer| name.ident == answer))
}

#[test]
fn an_implementation_by_hand_is_seen() {
    for (code, expected) in [
        ("impl<M: Material> piola::Material for Scaled<M> {}", true),
        ("impl Response<f64> for Law {}", true),
        ("impl<M: Material> Scaled<M> {}", false),
        ("impl<M: Material> Display for Scaled<M> {}", false),
    ] {
        assert_eq!(is_answer(&syn::parse_str(code).expect("an item")), expected, "{code}");
    }
}
