//! Public names are unique in a crate, so that a search for one finds what is meant.

use std::collections::{BTreeMap, BTreeSet};

use piola_tidy::imports::name_of;
use piola_tidy::{attributes_of, crates, forbid};
use quote::ToTokens;
use syn::Visibility;

/// The lint `unreachable_pub` ensures that `pub` items can be reached from outside. A re-export is not a
/// second item, nor is the same item of the same module for another platform or feature.
#[test]
fn no_two_public_items_of_a_crate_have_one_name() {
    let mut found = Vec::new();
    for one in crates().iter().filter(|one| one.is_published) {
        let mut places: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for module in &one.modules {
            for item in &module.items {
                let is_hidden = attributes_of(item).iter().any(|attribute| {
                    let text = attribute.to_token_stream().to_string();
                    attribute.path().is_ident("doc") && text.contains("hidden")
                });
                if let Some((kind, name, Some(Visibility::Public(_)))) = name_of(item)
                    && !is_hidden
                {
                    places.entry(name).or_default().insert(format!("{kind} in {module}"));
                }
            }
        }
        for (name, places) in places.into_iter().filter(|(_, places)| places.len() > 1) {
            let places: Vec<String> = places.into_iter().collect();
            found.push(format!("{}: {name}: {}", one.name, places.join(", ")));
        }
    }
    forbid("names of more than one public item", &found);
}
