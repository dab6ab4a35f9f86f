//! Phrases that several messages share: corrections that are ready to paste.

use quote::ToTokens;

use super::source::Source;
use crate::algebra::expr::{Graph, Id, Node};
use crate::read::spelling::list;

/// The longest term, in bytes, that a message quotes: a longer one is better read in the source.
pub(crate) const QUOTABLE: usize = 40;

/// True if a printed expression is abbreviated, so that it cannot be pasted.
pub(crate) fn is_cut(text: &str) -> bool {
    text.contains('…')
}

/// The isochoric invariants in place of the plain ones: `I1b` for `I1`, or both.
pub(crate) fn in_place(names: &[&str]) -> String {
    let isochoric: Vec<_> = names.iter().map(|name| format!("{name}b")).collect();
    format!("{} for {}", list(&isochoric), list(names))
}

/// The declared domain where J > 0, with further conditions.
pub(crate) fn positive_domain(source: &Source<'_>, further: Vec<String>) -> String {
    let declared = source.declaration.bounds().map(|condition| condition.to_token_stream().to_string());
    let conditions: Vec<_> = std::iter::once("J > 0.0".to_owned()).chain(declared).chain(further).collect();
    format!("`domain({})`", conditions.join(", "))
}

/// The declared conditions on parameters with further ones.
pub(crate) fn with_admissible(source: &Source<'_>, further: Vec<String>) -> String {
    let declared = source.declaration.options.admissible.iter();
    let declared = declared.map(|condition| condition.to_token_stream().to_string().replace(" [", "["));
    let conditions: Vec<_> = declared.chain(further).collect();
    format!("`admissible({})`", conditions.join(", "))
}

/// True if a condition on an expression of parameters can be declared as it is printed: such conditions have
/// no sums.
pub(crate) fn is_declarable(graph: &Graph, of: Id, condition: &str) -> bool {
    !graph.contains(of, |node| matches!(node, Node::Sum(..))) && !is_cut(condition)
}
