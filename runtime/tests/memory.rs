//! The lanes of each back end access no memory outside of the slices that they are given: a slice that is too
//! short is a panic.
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

/// Brings points to a line, or the first points of a line to their places.
struct Turn<'a, E, const N: usize> {
    from: &'a [E],
    to: &'a mut [E],
    points: usize,
    is_to_line: bool,
}

impl<E: Scalar, const N: usize> Kernel<E> for Turn<'_, E, N> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        if self.is_to_line {
            R::points_to_line::<N>(self.from, self.to);
        } else {
            R::line_to_points::<N>(self.from, self.points, self.to);
        }
    }
}

#[test]
fn points_and_lines_are_turned_into_each_other_within_their_slices() {
    fn check<E: Scalar + Debug, const N: usize>(backend: Backend) {
        for (points, is_to_line) in (1..=E::LINE).flat_map(|points| [(points, true), (points, false)]) {
            // The line without what follows its last entry.
            let (of_line, of_points) = ((N - 1) * E::LINE + points, points * N);
            let (from, to) = if is_to_line { (of_points, of_line) } else { (of_line, of_points) };
            let (from, mut to) = (counted::<E>(from), vec![E::default(); to].into_boxed_slice());
            let turned = outcome(backend, Turn::<E, N> { from: &from, to: &mut to, points, is_to_line });
            assert!(turned.is_some(), "{backend}: {N} of {points}");
            for (p, k) in (0..points).flat_map(|p| (0..N).map(move |k| (p, k))) {
                let (in_points, in_line) = (p * N + k, k * E::LINE + p);
                let (is, was) = if is_to_line { (in_line, in_points) } else { (in_points, in_line) };
                assert_eq!(to[is], from[was], "{backend}: {k} of {N} of {p} of {points}, {is_to_line}");
            }
            // In allocations of their own.
            let mut short: Box<[E]> = to[..to.len() - 1].into();
            let cut = Turn::<E, N> { from: &from, to: &mut short, points, is_to_line };
            assert!(outcome(backend, cut).is_none(), "{backend}: {N} of {points} into too few");
            if !is_to_line {
                let few: Box<[E]> = from[..from.len() - 1].into();
                let cut = Turn::<E, N> { from: &few, to: &mut to, points, is_to_line };
                assert!(outcome(backend, cut).is_none(), "{backend}: {N} of {points} of too few");
            }
        }
    }
    fn check_all<E: Scalar + Debug>(backend: Backend) {
        check::<E, 1>(backend);
        check::<E, 3>(backend);
        check::<E, 6>(backend);
        check::<E, 9>(backend);
        check::<E, 16>(backend);
        check::<E, 81>(backend);
    }
    for_each(check_all::<f64>, check_all::<f32>);
}
