//! How the numbers of many points lie in a slice, and how lanes get into it and out of it.

use super::tile::{ROW, Rows};
use super::workspace::Line;
use crate::lanes::{Backend, Element, Kernel, Lanes, PastCaches};

/// How N numbers of each of many points lie in a slice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Point by point: number k of point p at p N + k. Lanes are transposed in registers.
    #[default]
    Points,
    /// In lines of [`LINE`](Element::LINE) = L points, 8 of `f64` or 16 of `f32`, which fill 64 bytes: number k of point p
    /// at (⌊p/L⌋ N + k) L + p mod L. Lanes move as they are. The number of points must be a multiple of L: fill the last
    /// line up with identities.
    Lines,
}

impl Layout {
    /// Where number k of a point is.
    #[must_use]
    pub fn index<E: Element>(self, point: usize, numbers: usize, k: usize) -> usize {
        match self {
            Self::Points => point * numbers + k,
            Self::Lines => (point / E::LINE * numbers + k) * E::LINE + point % E::LINE,
        }
    }
}

/// N numbers of each point of a tile, where lanes can load them.
#[derive(Clone, Copy)]
pub(super) enum Source<'a, E, const N: usize> {
    /// As they lie in a slice of [`Layout::Lines`].
    Lines(&'a [E]),
    /// Filled by [`Rows::fill`].
    Rows(&'a Rows<E, N>),
}

impl<'a, E: Element, const N: usize> Source<'a, E, N> {
    /// From a tile's part of a slice; `rows` is where points are turned to.
    pub(super) fn new(backend: Backend, layout: Layout, from: &'a [E], rows: &'a mut Rows<E, N>) -> Self {
        match layout {
            Layout::Lines => Self::Lines(from),
            Layout::Points => {
                rows.fill(backend, layout, from);
                Self::Rows(rows)
            }
        }
    }

    /// The numbers of the points from `at` on.
    #[inline(always)]
    pub(super) fn get_all<R: Lanes<Element = E>>(&self, at: usize) -> [R; N] {
        match self {
            Self::Rows(rows) => rows.get_all(at),
            Self::Lines(from) => {
                let from = &from[at / E::LINE * N * E::LINE + at % E::LINE..];
                let from = &from[..(N.max(1) - 1) * E::LINE + R::LANES];
                let mut numbers = [R::splat(0.0); N];
                for k in 0..N {
                    numbers[k] = R::load(&from[k * E::LINE..]);
                }
                numbers
            }
        }
    }
}

impl<E: Element, const N: usize> Rows<E, N> {
    /// From a tile's part of a slice.
    pub(super) fn fill(&mut self, backend: Backend, layout: Layout, from: &[E]) {
        match layout {
            Layout::Points => backend.run(Turn { from, rows: self }),
            Layout::Lines => {
                for (line, numbers) in from.chunks_exact(N * E::LINE).enumerate() {
                    for (row, numbers) in self.0.iter_mut().zip(numbers.chunks_exact(E::LINE)) {
                        row[line * E::LINE..][..E::LINE].copy_from_slice(numbers);
                    }
                }
            }
        }
    }
}

/// Into the rows of a tile from a slice of points.
struct Turn<'a, E, const N: usize> {
    from: &'a [E],
    rows: &'a mut Rows<E, N>,
}

impl<E: Element, const N: usize> Kernel<E> for Turn<'_, E, N> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Element = E>>(self) {
        let Self { from, rows } = self;
        let count = from.len() / N;
        let whole = if N < R::LANES { 0 } else { count - count % R::LANES };
        let mut at = 0;
        while at < whole {
            let mut k = 0;
            while k < N {
                // The last square overlaps the one before where N is no multiple.
                k = k.min(N - R::LANES);
                let to = &mut rows.0.as_flattened_mut()[k * ROW + at..];
                R::transpose(&from[at * N + k..], N, to, ROW);
                k += R::LANES;
            }
            at += R::LANES;
        }
        for (point, numbers) in from.chunks_exact(N).enumerate().skip(whole) {
            for (row, number) in rows.0.iter_mut().zip(numbers) {
                row[point] = *number;
            }
        }
    }
}

/// Where the numbers of a tile go.
pub(super) struct Sink<'a, E> {
    /// The part of the slice that belongs to the tile.
    pub(super) to: &'a mut [E],
    pub(super) layout: Layout,
    /// Past the caches, with non-temporal stores, if given what keeps them in order.
    pub(super) past_caches: Option<&'a PastCaches>,
}

impl<E: Element> Sink<'_, E> {
    /// The place for the N numbers of the points from `at` on: number k belongs at k LINE. [`Sink::finish`] must follow.
    #[inline(always)]
    pub(super) fn place<'a, R: Lanes<Element = E>, const N: usize>(
        &'a mut self,
        line: &'a mut Line<E>,
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
        self.layout == Layout::Lines && self.past_caches.is_none()
    }

    /// Brings what is in a place to the slice; `count` is how many points the tile has.
    #[inline(always)]
    pub(super) fn finish<R: Lanes<Element = E>, const N: usize>(
        &mut self,
        line: &Line<E>,
        at: usize,
        count: usize,
    ) {
        if self.is_direct() {
            return;
        }
        let (start, offset) = (at / E::LINE * N * E::LINE, at % E::LINE);
        let line = &line.0.as_flattened()[..N * E::LINE];
        if let (Layout::Lines, Some(order)) = (self.layout, self.past_caches) {
            let to = &mut self.to[start..][..N * E::LINE];
            for k in 0..N {
                let place = k * E::LINE + offset;
                R::load(&line[place..]).stream(&mut to[place..], order);
            }
            return;
        }
        let to = &mut self.to[at * N..];
        if N >= R::LANES && at + R::LANES <= count {
            let mut k = 0;
            while k < N {
                // The last square overlaps the one before where N is no multiple.
                k = k.min(N - R::LANES);
                R::transpose(&line[k * E::LINE + offset..], E::LINE, &mut to[k..], N);
                k += R::LANES;
            }
        } else {
            for (lane, numbers) in to.chunks_exact_mut(N).take(R::LANES).enumerate() {
                for (k, number) in numbers.iter_mut().enumerate() {
                    *number = line[k * E::LINE + offset + lane];
                }
            }
        }
    }
}
