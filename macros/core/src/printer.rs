//! Expressions as text: formulas for documentation, and Rust for messages.

pub mod formula;
pub mod source;
