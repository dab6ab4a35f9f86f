//! piola for programs in C: the functions that `include/piola.h` declares, which is made from this crate.
//!
//! A function checks what it is lent, calls piola, and returns a [`Code`](error::Code);
//! [`piola_error_message`](error::piola_error_message) returns the text of the error. Nothing unwinds into a
//! caller, and nothing is computed here: no mathematics belongs into this crate.
//!
//! **Unsafe code** is what a border is made of. That of arrays, texts and results is in `lent`. The macro of
//! `functions` applies it to the arguments of a function, whose body is safe; the reason is the requirements
//! of the header on the caller.

#![deny(unsafe_op_in_unsafe_fn)]
#![allow(non_snake_case)] // F, P, dP_dF as in the literature, and `F_length` next to them
#![allow(clippy::too_many_arguments)] // an array takes two arguments in C
#![allow(clippy::missing_safety_doc)] // said once for all functions, at the head of the header

// In the order in which the header has them.
pub mod error;

pub mod energy;
pub mod material;
pub mod options;

pub mod batch;
pub mod elements;

pub mod csr;

pub mod body;
pub mod response;

pub mod simulation;
pub mod term;

mod functions;
mod handle;
mod lent;
