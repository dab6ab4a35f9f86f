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
use form::BlockStiffness;
use form::{FullStiffness, FullTangent, StiffnessForm};
use measure::{MeasuredStress, MeasuredTangent};
use stress::{Stress, StressByInvariants, stress_of};
use tangents::{FilterBlocks, Shaped, Tangents, TangentsByInvariants, shape_by_invariants};
use workspace::Workspace;

/// Last stages of a tile: P and dP/dF of points without shapes at rest, gradients and stiffnesses of elements
/// with REST components of a shape at rest each.
#[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
pub trait Outputs<const REST: usize>: Scalar {
    /// Form of the second output.
    #[doc(hidden)]
    type Form: Copy;
    #[doc(hidden)]
    fn stress(backend: Backend, kernel: Stress<'_, Self, REST>) -> Status<u64>;
    /// Returns the points that have results.
    #[doc(hidden)]
    fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, REST>) -> u64;
    #[doc(hidden)]
    fn tangents(backend: Backend, form: Self::Form, kernel: Tangents<'_, Self, REST>) -> Status<u64>;
    /// Returns the points that have results.
    #[doc(hidden)]
    fn tangents_by_invariants(
        backend: Backend,
        form: Self::Form,
        kernel: TangentsByInvariants<'_, Self, REST>,
    ) -> u64;
}

/// The kernels above for one format: no function is generic, so that each is compiled once, here. With the
/// feature `f32` there are those of `f32`, too.
#[diagnostic::on_unimplemented(
    message = "there are no batches of `{Self}`",
    note = "those of `f32` come with the feature `f32` of the crate `piola`; those of `f64` with `batch`"
)]
#[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
pub trait Kernels: Outputs<0, Form = ()> + Outputs<10, Form = StiffnessForm> {
    #[doc(hidden)]
    fn decompose(backend: Backend, kernel: Decompose<'_, Self>);
    #[doc(hidden)]
    fn deform(backend: Backend, kernel: Deform<'_, Self>);
    #[doc(hidden)]
    fn invariants(backend: Backend, kernel: Invariants<'_, Self>) -> u64;
    #[doc(hidden)]
    fn filter_blocks(backend: Backend, kernel: FilterBlocks<'_, Self>) -> Status<u64>;
    #[doc(hidden)]
    fn measured_stress(backend: Backend, kernel: MeasuredStress<'_, Self>) -> Status<u64>;
    #[doc(hidden)]
    fn measured_tangent(backend: Backend, kernel: MeasuredTangent<'_, Self>) -> Status<u64>;
    /// Lends the workspace of this thread; allocates one if it is in use already or there is none yet.
    #[doc(hidden)]
    fn with_workspace<T>(body: impl FnOnce(&mut Workspace<Self>) -> T) -> T;
}

macro_rules! formats {
    ($($Number:ident)*) => {$(
        #[expect(private_interfaces, reason = "as in the trait")]
        impl Outputs<0> for $Number {
            type Form = ();

            fn stress(backend: Backend, kernel: Stress<'_, Self, 0>) -> Status<u64> {
                backend.run(kernel)
            }

            fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, 0>) -> u64 {
                stress_of(backend, kernel)
            }

            fn tangents(backend: Backend, (): (), kernel: Tangents<'_, Self, 0>) -> Status<u64> {
                backend.run(Shaped(kernel, FullTangent))
            }

            fn tangents_by_invariants(
                backend: Backend,
                (): (),
                kernel: TangentsByInvariants<'_, Self, 0>,
            ) -> u64 {
                shape_by_invariants(backend, kernel, FullTangent)
            }
        }

        #[expect(private_interfaces, reason = "as in the trait")]
        impl Outputs<10> for $Number {
            type Form = StiffnessForm;

            fn stress(backend: Backend, kernel: Stress<'_, Self, 10>) -> Status<u64> {
                backend.run(kernel)
            }

            fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, 10>) -> u64 {
                stress_of(backend, kernel)
            }

            fn tangents(backend: Backend, form: StiffnessForm, kernel: Tangents<'_, Self, 10>) -> Status<u64> {
                match form {
                    StiffnessForm::Full => backend.run(Shaped(kernel, FullStiffness)),
                    StiffnessForm::Blocks => backend.run(Shaped(kernel, BlockStiffness)),
                }
            }

            fn tangents_by_invariants(
                backend: Backend,
                form: StiffnessForm,
                kernel: TangentsByInvariants<'_, Self, 10>,
            ) -> u64 {
                match form {
                    StiffnessForm::Full => shape_by_invariants(backend, kernel, FullStiffness),
                    StiffnessForm::Blocks => shape_by_invariants(backend, kernel, BlockStiffness),
                }
            }
        }

        #[expect(private_interfaces, reason = "as in the trait")]
        impl Kernels for $Number {
            fn decompose(backend: Backend, kernel: Decompose<'_, Self>) {
                backend.run(kernel);
            }

            fn deform(backend: Backend, kernel: Deform<'_, Self>) {
                backend.run(kernel);
            }

            fn invariants(backend: Backend, kernel: Invariants<'_, Self>) -> u64 {
                backend.run(kernel)
            }

            fn filter_blocks(backend: Backend, kernel: FilterBlocks<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

            fn measured_stress(backend: Backend, kernel: MeasuredStress<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

            fn measured_tangent(backend: Backend, kernel: MeasuredTangent<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

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
    )*};
}
formats!(f64);
// Not compiled a second time for the unit tests, which need those of `f64` only.
#[cfg(all(feature = "f32", not(test)))]
formats!(f32);
