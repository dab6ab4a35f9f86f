//! Texts of either kind: a declaration in Rust, or a formula.

use proc_macro2::{TokenStream, TokenTree};

use crate::energy::Energy;
use crate::formula::FormulaOptions;
use crate::mistakes::Mistakes;

impl Energy {
    /// The energy of a text: a declaration in Rust if it has a function, else a formula.
    ///
    /// # Errors
    /// All [`Mistakes`] of [`Energy::from_rust`] or [`Energy::from_formula`].
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        Self::from_text_with(text, &FormulaOptions::default())
    }

    /// The energy of a text, with these options if it is a formula.
    ///
    /// # Errors
    /// All [`Mistakes`] of [`Energy::from_rust`] or [`Energy::from_formula_with`].
    pub fn from_text_with(text: &str, options: &FormulaOptions) -> Result<Self, Mistakes> {
        if is_rust(text) { Self::from_rust(text) } else { Self::from_formula_with(text, options) }
    }
}

/// True if a text has the word `fn` before a name: in a formula it could only be one itself.
fn is_rust(text: &str) -> bool {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return text.split_whitespace().any(|word| word == "fn");
    };
    let mut left = vec![tokens];
    while let Some(tokens) = left.pop() {
        let mut is_behind = false;
        for token in tokens {
            if is_behind && matches!(token, TokenTree::Ident(_)) {
                return true;
            }
            is_behind = matches!(&token, TokenTree::Ident(word) if word == "fn");
            if let TokenTree::Group(group) = token {
                left.push(group.stream());
            }
        }
    }
    false
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
