//! The real numbers that every kernel and every generated material computes with.
//!
//! A kernel is written once over [`Real`] and instantiated for `f64` and `f32`, for several of them side by
//! side in the registers of a processor (`Lanes`), and for multiprecision types in tests. So a `Real` may be
//! many numbers at once: there is no comparison that yields a `bool`, only masks, and no branch on a value,
//! only [`Real::select`].
//!
//! The width of the registers is known at run time only. A `Kernel` is a computation written for any lanes;
//! a [`Backend`], AVX-512, AVX2 or portable, runs it with its own. Scalars and lanes share all code above the
//! operations of IEEE arithmetic, elementary functions included, and no lane depends on its neighbours:
//! within a back end a number gets the same bits in any lane.
//!
//! This module has no matrices and no materials. It is the only one with unsafe code.

mod backend;
mod complement;
mod elementary;
mod lanes2;
mod polynomial;
mod primitive;
mod real;
#[cfg(all(feature = "interpreter", not(test)))]
pub(crate) mod recorded;
mod scalar;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use backend::Backend;
#[doc(hidden)] // kernels are of this crate
pub use backend::Kernel;
pub(crate) use complement::scaled_complement;
#[doc(hidden)] // in place of the registers of a processor
pub use lanes2::Lanes2;
pub(crate) use real::stage;
pub use real::{Mask, Real};
#[doc(hidden)] // for recorded programs
pub use real::{Numbers, Replace, Truth};
#[doc(hidden)] // how the interpreter is compiled once for each format
pub use vector::ByFormat;
#[doc(hidden)] // for kernels
pub use vector::Lanes;
pub use vector::Scalar;
