//! Names that parameters cannot have: methods and constants of the traits of materials.

use std::fs;
use std::path::Path;

use piola_codegen::read::parse::is_reserved;
use syn::{Item, TraitItem};

/// Reads the runtime as text, on which this crate does not depend.
#[test]
fn members_of_the_traits_of_materials_are_reserved() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../runtime/src");
    for (file, name) in
        [("material.rs", "Material"), ("material.rs", "Declared"), ("material/parameter.rs", "Graded")]
    {
        let source = fs::read_to_string(folder.join(file)).expect("a file of the runtime");
        let items = syn::parse_file(&source).expect("Rust").items;
        let found = items.into_iter().find_map(|item| match item {
            Item::Trait(item) if item.ident == name => Some(item),
            _ => None,
        });
        for member in found.expect(name).items {
            let member = match member {
                TraitItem::Fn(function) => function.sig.ident,
                TraitItem::Const(constant) => constant.ident,
                _ => continue,
            };
            assert!(is_reserved(&member), "{name}::{member}");
        }
    }
}
