//! Texts of either kind: a declaration in Rust, or a formula.

use proc_macro2::{TokenStream, TokenTree};

use crate::energy::Energy;
use crate::mistakes::Mistakes;

impl Energy {
    /// The energy of a text: a declaration in Rust if it has a function, else a formula.
    ///
    /// # Errors
    /// All [`Mistakes`], those of [`Energy::from_rust`] or [`Energy::from_formula`].
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        if is_rust(text) { Self::from_rust(text) } else { Self::from_formula(text) }
    }
}

/// Whether a text has the word `fn`, which is no name in a formula.
fn is_rust(text: &str) -> bool {
    fn has_function(tokens: TokenStream) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Ident(word) => word == "fn",
            TokenTree::Group(group) => has_function(group.stream()),
            _ => false,
        })
    }
    match text.parse() {
        Ok(tokens) => has_function(tokens),
        Err(_) => text.split_whitespace().any(|word| word == "fn"),
    }
}

#[cfg(feature = "serde")]
mod files {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Energy;

    /// Written as its text.
    impl Serialize for Energy {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_str(self.text())
        }
    }

    /// Compiled from its text.
    impl<'de> Deserialize<'de> for Energy {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            Self::from_text(&String::deserialize(deserializer)?).map_err(D::Error::custom)
        }
    }
}
