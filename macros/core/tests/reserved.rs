//! Names that parameters cannot have: methods and constants of the traits of materials.

use std::fs;
use std::path::Path;

use piola_codegen::analyse;
use quote::quote;
use syn::{Ident, Item, TraitItem};

/// Reads the runtime as text, on which this crate does not depend.
#[test]
fn members_of_the_traits_of_materials_are_reserved() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../runtime/src");
    for (file, name) in [
        ("material.rs", "Material"),
        ("material.rs", "Declared"),
        ("material/fittable.rs", "Fittable"),
        ("material/parameter.rs", "Graded"),
    ] {
        let source = fs::read_to_string(folder.join(file)).expect("a file of the runtime");
        let items = syn::parse_file(&source).expect("Rust").items;
        let found = items.into_iter().find_map(|item| match item {
            Item::Trait(item) if item.ident == name => Some(item),
            _ => None,
        });
        for member in found.expect(name).items {
            match member {
                TraitItem::Fn(function) => check(name, &function.sig.ident),
                TraitItem::Const(constant) => check(name, &constant.ident),
                _ => {}
            }
        }
    }
}

fn check(name: &str, member: &Ident) {
    let item = quote!(fn E([l1, l2, l3]: [f64; 3], #member: f64) -> f64 { #member * (I1 - 2.0 * J - 1.0) });
    let message = analyse(quote!(), item, None).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(message.contains("is reserved"), "{name}::{member}: {message:?}");
}
