//! Layouts of the components of many points in a slice, and the ways of lanes into it and out of it.

use super::rows::TILE;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};

/// Layout of the N components of each of many points in a slice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Point by point: component k of point p at p N + k. Lanes are transposed in registers.
    #[default]
    Points,
    /// Lines of [`LINE`](Scalar::LINE) = L points, 8 of `f64` or 16 of `f32`, which fill 64 bytes: number k
    /// of point p at (⌊p/L⌋ N + k) L + p mod L. Lanes move as they are. The number of points must be a
    /// multiple of L: fill the last line up with identities.
    Lines,
}

impl Layout {
    /// Number of points that it keeps together.
    pub(crate) fn group<E: Scalar>(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Lines => E::LINE,
        }
    }

    /// Index of component k of a point in the slice.
    #[must_use]
    pub fn index<E: Scalar>(self, point: usize, numbers: usize, k: usize) -> usize {
        match self {
            Self::Points => point * numbers + k,
            Self::Lines => (point / E::LINE * numbers + k) * E::LINE + point % E::LINE,
        }
    }
}

/// Components of each point of a tile, N of them, in [`Layout::Lines`], where lanes can load them.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a, E, const N: usize>(&'a [E]);

impl<'a, E: Scalar, const N: usize> Source<'a, E, N> {
    /// Source from a tile's part of a slice; `lines` is scratch memory for transposed points and for a tile
    /// that is not full.
    pub(crate) fn new(backend: Backend, layout: Layout, from: &'a [E], lines: &'a mut Lines<E, N>) -> Self {
        match layout {
            Layout::Lines if from.len() == N * TILE => return Self(from),
            Layout::Lines => lines.0.as_flattened_mut()[..from.len()].copy_from_slice(from),
            Layout::Points => {
                backend.run(Turn::<E, N> { from, to: lines });
            }
        }
        lines.source()
    }

    /// The numbers of the points from `at` on.
    #[inline(always)]
    pub(crate) fn get_all<R: Lanes<Scalar = E>>(&self, at: usize) -> [R; N] {
        let mut numbers = [R::splat(0.0); N];
        let from = &self.0[at / E::LINE * N * E::LINE + at % E::LINE..];
        // A constant length makes one check of all those to come.
        let last = (R::LANES - 1) / E::LINE * N + N - 1;
        let from = &from[..last * E::LINE + R::LANES.min(E::LINE)];
        for k in 0..N {
            numbers[k] = R::load_lines(&from[k * E::LINE..], N);
        }
        numbers
    }
}

/// Memory for the points of a tile in [`Layout::Lines`].
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct Lines<E, const N: usize>(pub(crate) [[E; N]; TILE]);

impl<E: Scalar, const N: usize> Lines<E, N> {
    pub(crate) fn zero() -> Self {
        Self([[E::default(); N]; TILE])
    }

    pub(crate) fn set(&mut self, point: usize, k: usize, number: E) {
        self.0.as_flattened_mut()[Layout::Lines.index::<E>(point, N, k)] = number;
    }

    /// The components of a point.
    pub(crate) fn get(&self, point: usize) -> [E; N] {
        std::array::from_fn(|k| self.0.as_flattened()[Layout::Lines.index::<E>(point, N, k)])
    }

    /// The numbers of the points from `at` on.
    #[inline(always)]
    pub(crate) fn set_all<R: Lanes<Scalar = E>>(&mut self, at: usize, numbers: [R; N]) {
        let to = &mut self.0.as_flattened_mut()[at / E::LINE * N * E::LINE + at % E::LINE..];
        let to = &mut to[..(N - 1) * E::LINE + R::LANES];
        for k in 0..N {
            numbers[k].store(&mut to[k * E::LINE..]);
        }
    }

    pub(crate) fn source(&self) -> Source<'_, E, N> {
        Source(self.0.as_flattened())
    }
}

/// Room for up to 144 components of one line of points, on their way to a slice in another layout.
#[derive(Debug)]
#[repr(C, align(64))]
pub(crate) struct LineBuffer<E>(pub(crate) [[E; 16]; 144]);

impl<E: Scalar> LineBuffer<E> {
    pub(crate) fn zero() -> Self {
        Self([[E::default(); 16]; 144])
    }
}

/// Kernel from the points of a tile to its lines.
struct Turn<'a, E, const N: usize> {
    from: &'a [E],
    to: &'a mut Lines<E, N>,
}

impl<E: Scalar, const N: usize> Kernel<E> for Turn<'_, E, N> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let lines = self.to.0.as_flattened_mut().chunks_mut(E::LINE * N);
        for (points, line) in self.from.chunks(E::LINE * N).zip(lines) {
            R::points_to_line::<N>(points, line);
        }
    }
}

/// Output of a tile's components to its part of a slice.
pub(crate) struct Sink<'a, E> {
    /// The part of the slice that belongs to the tile.
    pub(crate) to: &'a mut [E],
    pub(crate) layout: Layout,
    /// Points whose output is left unchanged, as bits.
    pub(crate) served: u64,
}

impl<E: Scalar> Sink<'_, E> {
    /// The place for the N components of the points from `at` on: component k belongs at k LINE.
    /// [`Sink::finish`] must follow.
    #[inline(always)]
    pub(crate) fn place<'a, R: Lanes<Scalar = E>, const N: usize>(
        &'a mut self,
        line: &'a mut LineBuffer<E>,
        at: usize,
    ) -> &'a mut [E] {
        let offset = at % E::LINE;
        let from = if self.is_direct() {
            &mut self.to[at / E::LINE * N * E::LINE + offset..]
        } else {
            &mut line.0.as_flattened_mut()[offset..]
        };
        // A constant length makes one check of all those to come.
        &mut from[..(N - 1) * E::LINE + R::LANES]
    }

    #[inline(always)]
    fn is_direct(&self) -> bool {
        self.layout == Layout::Lines && self.served == 0
    }

    /// Copies a place to the slice; `count` is the number of points of the tile.
    #[inline(always)]
    pub(crate) fn finish<R: Lanes<Scalar = E>, const N: usize>(
        &mut self,
        line: &LineBuffer<E>,
        at: usize,
        count: usize,
    ) {
        if self.is_direct() {
            return;
        }
        let offset = at % E::LINE;
        let line = &line.0.as_flattened()[..N * E::LINE];
        if self.served != 0 {
            for lane in (0..R::LANES.min(count - at)).filter(|lane| self.served >> (at + lane) & 1 == 0) {
                for k in 0..N {
                    self.to[self.layout.index::<E>(at + lane, N, k)] = line[k * E::LINE + offset + lane];
                }
            }
            return;
        }
        let points = R::LANES.min(count - at);
        R::line_to_points::<N>(&line[offset..], points, &mut self.to[at * N..]);
    }
}
