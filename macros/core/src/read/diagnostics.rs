//! Diagnostics: mistakes are collected, so that all of them are reported at once.

use std::fmt::Display;

use proc_macro2::Span;
use quote::ToTokens;

use crate::read::notation::Notation;

/// Mistakes found so far.
#[derive(Debug, Default)]
pub struct Diagnostics {
    found: Option<syn::Error>,
    notation: Notation,
}

impl Diagnostics {
    /// No mistakes yet, in a declaration of this notation.
    #[must_use]
    pub fn new(notation: Notation) -> Self {
        Self { found: None, notation }
    }

    /// The notation of the declaration.
    #[must_use]
    pub fn notation(&self) -> Notation {
        self.notation
    }

    /// Adds a mistake at its tokens, all of which are underlined.
    pub fn error(&mut self, tokens: impl ToTokens, message: impl Display) {
        self.push(syn::Error::new_spanned(tokens, self.notation.message(&message.to_string())));
    }

    /// Adds the mistake of a failed step and continues.
    pub fn take<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// True if there are no mistakes so far.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.found.is_none()
    }

    /// The value, unless there were mistakes.
    ///
    /// # Errors
    /// All mistakes as one.
    pub fn finish<T>(self, value: Option<T>) -> syn::Result<T> {
        match (self.found, value) {
            (None, Some(value)) => Ok(value),
            (Some(error), _) => Err(error),
            (None, None) => {
                Err(syn::Error::new(Span::call_site(), "this is not the declaration of an energy"))
            }
        }
    }

    fn push(&mut self, error: syn::Error) {
        match &mut self.found {
            Some(all) => all.combine(error),
            None => self.found = Some(error),
        }
    }
}
