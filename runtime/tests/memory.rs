//! The lanes of each back end touch no memory outside of the slices that they are given: what is too short is
//! a panic.
//!
//! Slices end where their allocation ends. A sanitizer, which `.ci/run` asks for, sees what lies beyond being
//! read; without one these tests compare what was copied.

use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind};

use piola::lanes::{Backend, Kernel, Lanes, Scalar};

/// Numbers 1, 2, 3, … in an allocation of their own.
fn counted<E: Scalar>(count: usize) -> Box<[E]> {
    (1..=count).map(|k| E::splat(k as f64)).collect()
}

/// The result of a kernel; `None` if it panics.
fn outcome<E: Scalar, K: Kernel<E>>(backend: Backend, kernel: K) -> Option<K::Output> {
    catch_unwind(AssertUnwindSafe(|| backend.run(kernel))).ok()
}

/// Calls a check for each back end and number format.
fn for_each(check_f64: fn(Backend), check_f32: fn(Backend)) {
    for backend in Backend::available() {
        check_f64(backend);
        check_f32(backend);
    }
}

/// Copies a register's worth of a slice, and returns how many numbers that is.
struct CopyRegister<'a, E> {
    from: &'a [E],
    to: &'a mut [E],
    is_by_lines: bool,
}

impl<E: Scalar> Kernel<E> for CopyRegister<'_, E> {
    type Output = usize;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> usize {
        let register = if self.is_by_lines { R::load_lines(self.from, 1) } else { R::load(self.from) };
        register.store(self.to);
        R::LANES
    }
}

#[test]
fn registers_are_loaded_and_stored_within_their_slices() {
    fn check<E: Scalar>(backend: Backend) {
        let (long, mut to) = (counted::<E>(64), counted::<E>(64));
        let kernel = CopyRegister { from: &long, to: &mut to, is_by_lines: false };
        let lanes = outcome(backend, kernel).expect("64 numbers fill a register");
        for is_by_lines in [false, true] {
            for (from, to) in (0..=lanes + 1).flat_map(|from| (0..=lanes + 1).map(move |to| (from, to))) {
                let (from, mut to) = (counted::<E>(from), vec![E::default(); to].into_boxed_slice());
                let fits = from.len() >= lanes && to.len() >= lanes;
                let copied = outcome(backend, CopyRegister { from: &from, to: &mut to, is_by_lines });
                assert_eq!(copied.is_some(), fits, "{backend}: {} to {}", from.len(), to.len());
                if fits {
                    assert_eq!(to[..lanes], from[..lanes], "{backend}");
                    assert!(to[lanes..].iter().all(|&x| x == E::default()), "{backend}");
                }
            }
        }
    }
    for_each(check::<f64>, check::<f32>);
}

#[test]
fn slices_are_copied_past_the_caches_within_their_ends() {
    fn check<E: Scalar>(backend: Backend) {
        for start in 0..18 {
            for count in 0..66 {
                // From the start of a register and from everywhere between.
                let (from, mut to) =
                    (counted::<E>(count), vec![E::default(); start + count].into_boxed_slice());
                backend.store_non_temporal(&from, &mut to[start..]);
                assert_eq!(to[start..], *from, "{backend}: {count} numbers from {start} on");
                assert!(to[..start].iter().all(|&x| x == E::default()), "{backend}");
            }
        }
        let longer =
            AssertUnwindSafe(|| backend.store_non_temporal(&counted::<E>(64), &mut counted::<E>(63)));
        assert!(catch_unwind(longer).is_err(), "{backend}");
    }
    for_each(check::<f64>, check::<f32>);
}

struct Transpose<'a, E> {
    size: [usize; 2],
    from: &'a [E],
    to: &'a mut [E],
    strides: [usize; 2],
}

impl<E: Scalar> Kernel<E> for Transpose<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let [from_stride, to_stride] = self.strides;
        R::transpose(self.size, self.from, from_stride, self.to, to_stride);
    }
}

#[test]
fn matrices_are_transposed_within_their_slices() {
    fn check<E: Scalar + Debug>(backend: Backend) {
        for (rows, columns) in (1..=20).flat_map(|rows| (1..=20).map(move |columns| (rows, columns))) {
            for (more_from, more_to) in [(0, 0), (3, 1)] {
                let strides = [columns + more_from, rows + more_to];
                // Without what follows the last entry.
                let from = counted::<E>((rows - 1) * strides[0] + columns);
                let mut to = vec![E::default(); (columns - 1) * strides[1] + rows].into_boxed_slice();
                let size = [rows, columns];
                let transposed = outcome(backend, Transpose { size, from: &from, to: &mut to, strides });
                assert!(transposed.is_some(), "{backend}: {rows}×{columns}");
                for i in 0..rows {
                    for j in 0..columns {
                        assert_eq!(to[j * strides[1] + i], from[i * strides[0] + j], "{backend}: {size:?}");
                    }
                }
                // In allocations of their own.
                let few: Box<[E]> = from[..from.len() - 1].into();
                let mut short: Box<[E]> = to[..to.len() - 1].into();
                let cut = Transpose { size, from: &few, to: &mut to, strides };
                assert!(outcome(backend, cut).is_none(), "{backend}: {size:?} of too few");
                let cut = Transpose { size, from: &from, to: &mut short, strides };
                assert!(outcome(backend, cut).is_none(), "{backend}: {size:?} into too few");
            }
        }
    }
    for_each(check::<f64>, check::<f32>);
}
