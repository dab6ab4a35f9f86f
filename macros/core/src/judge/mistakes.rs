//! Mistakes of an energy, told apart by the parts that they stand on.

use std::fmt::Display;

use syn::Expr;

use super::Written;
use crate::algebra::expr::Id;
use crate::read::diagnostics::Diagnostics;

/// Collects the mistakes of an energy, with the parts that are guilty of them.
///
/// A part that breaks one rule often breaks others by the same token: the root of what vanishes at rest has no finite stress
/// there, and no value on one side of it. Such a part is reported once, by the first rule; other parts are further mistakes.
pub(super) struct Mistakes<'a> {
    diagnostics: &'a mut Diagnostics,
    guilty: Vec<Id>,
}

impl<'a> Mistakes<'a> {
    /// None so far.
    pub(super) fn new(diagnostics: &'a mut Diagnostics) -> Self {
        Self { diagnostics, guilty: Vec::new() }
    }

    /// Whether none has been reported.
    pub(super) fn is_empty(&self) -> bool {
        self.guilty.is_empty()
    }

    /// Whether a part that has been reported breaks this rule too, so that this is no mistake of its own.
    pub(super) fn is_known(&self, breaks: impl FnMut(Id) -> bool) -> bool {
        self.guilty.iter().copied().any(breaks)
    }

    /// Adds the mistake of a part, or of the whole energy.
    pub(super) fn report(&mut self, written: &Written<'_>, part: Option<&Expr>, message: impl Display) {
        self.guilty.push(part.and_then(|part| written.nodes.of(part)).unwrap_or(written.energy));
        self.diagnostics.error(part, message);
    }
}
