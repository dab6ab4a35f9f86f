//! Public names are unique in a crate, so that a search for one finds what is meant.

use std::collections::{BTreeMap, BTreeSet};

use piola_tidy::{attributes, crates, forbid, name_of};

/// The lint `unreachable_pub` ensures that `pub` items can be reached from outside. A re-export is not a
/// second item, nor is the same item of the same module for another platform or feature.
#[test]
fn no_two_public_items_of_a_crate_have_one_name() {
    let mut places: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for one in crates().iter().filter(|one| one.is_published) {
        for module in &one.modules {
            for item in &module.items {
                let is_hidden = attributes(item).iter().any(|attribute| {
                    let text = attribute.to_string();
                    text.starts_with("doc") && text.contains("hidden")
                });
                if let Some((name, true)) = name_of(item)
                    && !is_hidden
                {
                    places.entry(format!("{name} in {}", one.name)).or_default().insert(module.to_string());
                }
            }
        }
    }
    places.retain(|_, modules| modules.len() > 1);
    let found: Vec<String> = places.iter().map(|(name, modules)| format!("{name}: {modules:?}")).collect();
    forbid("names of more than one public item", &found);
}
