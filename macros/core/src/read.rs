//! The reading of a declaration: from its tokens to a [`Declaration`](parse::Declaration), and from the
//! syntax of its energy to an expression graph.

pub mod diagnostics;
pub mod domain;
pub mod notation;
pub mod parse;
pub mod resolve;
pub mod spelling;
pub mod unit;
