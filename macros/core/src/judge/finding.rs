//! Findings: broken rules, each as the tokens that break it and the message about them.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::Expr;

use super::source::Source;
use crate::algebra::expr::Id;

/// A broken rule.
pub(crate) struct Finding {
    /// The tokens that break it.
    pub(crate) tokens: TokenStream,
    /// The mistake, and a correction that is ready to paste.
    pub(crate) message: String,
}

impl Finding {
    pub(crate) fn new(tokens: impl ToTokens, message: impl Into<String>) -> Self {
        Self { tokens: tokens.into_token_stream(), message: message.into() }
    }
}

/// Collects findings about the parts of an energy.
///
/// A part that breaks one rule often breaks others by the same token: the root of an expression that vanishes
/// at rest has no finite stress there, and no value on one side of it. Such a part is reported once, by the
/// first rule.
pub(crate) struct Findings<'a> {
    pub(crate) source: &'a Source<'a>,
    pub(crate) found: Vec<Finding>,
    blamed: Vec<Id>,
}

impl<'a> Findings<'a> {
    pub(crate) fn new(source: &'a Source<'a>) -> Self {
        Self { source, found: Vec::new(), blamed: Vec::new() }
    }

    /// True if a part that has already been reported breaks this rule too.
    pub(crate) fn is_known(&self, breaks: impl FnMut(Id) -> bool) -> bool {
        self.blamed.iter().copied().any(breaks)
    }

    /// Adds the finding about a part, or about the whole energy.
    pub(crate) fn add(&mut self, part: Option<&Expr>, message: impl Into<String>) {
        self.blamed.push(part.and_then(|part| self.source.nodes.of(part)).unwrap_or(self.source.energy));
        self.found.push(Finding::new(part, message));
    }
}
