//! Functions of batches that return a `Result` do so for any arguments: wrong lengths, NaN, infinities, the
//! ends of the range, nodes that are missing, repeated, or more than any memory holds.
//!
//! `tests/tidy` checks that none of these functions is left out.
#![cfg(feature = "batch")]

mod arguments;
mod batches;
