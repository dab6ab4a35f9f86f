//! Derivatives come from declarations.

use piola_tidy::{crates, forbid};
use syn::Item;

/// Traits by which an energy answers.
const ANSWERS: [&str; 3] = ["Material", "Response", "Specimen"];

/// File that hands stretches on to programs whose derivatives the compiler has found.
const FORWARDING: &str = "runtime/src/interpreter/material.rs";

/// No other shipped code answers for a material: it would compute an energy or a derivative by hand.
#[test]
fn no_derivative_is_written_by_hand() {
    let (mut found, mut forwards) = (Vec::new(), false);
    for module in crates().iter().filter(|one| one.is_published).flat_map(|one| &one.modules) {
        for item in &module.items {
            if is_answer(item) {
                match module.file.display().to_string() {
                    file if file == FORWARDING => forwards = true,
                    file => found.push(file),
                }
            }
        }
    }
    forbid("implementations of a material by hand", &found);
    assert!(forwards, "{FORWARDING} forwards nothing: this test looks for the wrong names");
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
