//! Kernels that are independent of the material, compiled once for each format and back end.
//!
//! A tile of points goes through them in stages: decomposition, the material's response, which is not here,
//! and its outputs. Between two stages a tile's numbers lie in [`Rows`](rows::Rows): frames and stretches,
//! then the fifteen numbers of the energy. Each stage keeps few enough numbers alive for the registers.
//!
//! Independent of materials, threads, and slices of callers other than a tile's part of them.

pub(crate) mod deformation;
pub(crate) mod form;
pub(crate) mod measure;
pub(crate) mod rows;
pub(crate) mod sink;
pub(crate) mod stress;
pub(crate) mod svd_tile;
pub(crate) mod tangents;
#[cfg(all(feature = "interpreter", not(test)))]
pub(crate) mod tetrahedron;
pub(crate) mod workspace;

use std::cell::Cell;

use crate::lanes::{Backend, Scalar};
use crate::status::Status;
use deformation::{Decompose, Deform, Invariants};
use measure::{MeasuredStress, MeasuredTangent};
use stress::{Stress, StressByInvariants};
use tangents::{FilterBlocks, Tangents, TangentsByInvariants};
use workspace::Workspace;

/// Passes every kernel to a macro, with the function that runs it.
macro_rules! with_kernels {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            [$($context)*]
            decompose(Decompose) -> () = Backend::run,
            deform(Deform) -> () = Backend::run,
            invariants(Invariants) -> u64 = Backend::run,
            filter_blocks(FilterBlocks) -> Status<u64> = Backend::run,
            measured_stress(MeasuredStress) -> Status<u64> = Backend::run,
            measured_tangent(MeasuredTangent) -> Status<u64> = Backend::run,
            stress(Stress) -> Status<u64> = stress::run,
            stress_by_invariants(StressByInvariants) -> u64 = stress::run_by_invariants,
            tangents(Tangents) -> Status<u64> = tangents::run,
            tangents_by_invariants(TangentsByInvariants) -> u64 = tangents::run_by_invariants,
        }
    };
}

macro_rules! declare_kernels {
    ([] $($name:ident($Kernel:ident) -> $Output:ty = $run:path,)*) => {
        /// The kernels above for one format: no function is generic, so that each is compiled once, here.
        /// With the feature `f32` there are those of `f32`, too.
        #[diagnostic::on_unimplemented(
            message = "there are no batches of `{Self}`",
            note = "those of `f32` come with the feature `f32` of the crate `piola`; those of `f64` with `batch`"
        )]
        #[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
        pub trait Kernels: Scalar {
            $(
                #[doc(hidden)]
                fn $name(backend: Backend, kernel: $Kernel<'_, Self>) -> $Output;
            )*
            /// Lends the workspace of this thread; allocates one if it is in use already or there is none.
            #[doc(hidden)]
            fn with_workspace<T>(body: impl FnOnce(&mut Workspace<Self>) -> T) -> T;
        }
    };
}
with_kernels!(declare_kernels);

macro_rules! compile_kernels {
    ([$Number:ident] $($name:ident($Kernel:ident) -> $Output:ty = $run:path,)*) => {
        #[expect(private_interfaces, reason = "as in the trait")]
        impl Kernels for $Number {
            $(
                fn $name(backend: Backend, kernel: $Kernel<'_, Self>) -> $Output {
                    $run(backend, kernel)
                }
            )*

            fn with_workspace<T>(body: impl FnOnce(&mut Workspace<Self>) -> T) -> T {
                thread_local!(static SPARE: Cell<Option<Box<Workspace<$Number>>>> = const { Cell::new(None) });
                // At the end of a thread there is no keeping any more.
                let spare = SPARE.try_with(Cell::take).ok().flatten();
                let mut workspace = spare.unwrap_or_else(Workspace::new);
                let result = body(&mut workspace);
                let _ = SPARE.try_with(|spare| spare.set(Some(workspace)));
                result
            }
        }
    };
}
with_kernels!(compile_kernels f64);
// Not compiled a second time for the unit tests, which need those of `f64` only.
#[cfg(all(feature = "f32", not(test)))]
with_kernels!(compile_kernels f32);
