//! Collects mistakes, so that all of them are reported at once.

use std::fmt::Display;

use proc_macro2::Span;

/// Mistakes found so far.
#[derive(Debug, Default)]
pub struct Diagnostics(Option<syn::Error>);

impl Diagnostics {
    /// Adds a mistake at a token.
    pub fn error(&mut self, span: Span, message: impl Display) {
        self.push(syn::Error::new(span, message));
    }

    /// Adds the mistake of a failed step and goes on.
    pub fn take<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// Whether there are none so far.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.0.is_none()
    }

    /// The value, unless there were mistakes.
    ///
    /// # Errors
    /// All mistakes as one.
    pub fn finish<T>(self, value: Option<T>) -> syn::Result<T> {
        match (self.0, value) {
            (None, Some(value)) => Ok(value),
            (Some(error), _) => Err(error),
            (None, None) => {
                Err(syn::Error::new(Span::call_site(), "this is not the declaration of an energy"))
            }
        }
    }

    fn push(&mut self, error: syn::Error) {
        match &mut self.0 {
            Some(all) => all.combine(error),
            None => self.0 = Some(error),
        }
    }
}
