//! The numbers of many points, and calls with them.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::hint::black_box;
use std::ops::{Deref, DerefMut};

use piola::batch::{Batch, Layout, LengthError, Stages, Tetrahedra};
use piola::lanes::{Backend, Kernel, Lanes, Real, Scalar};

use super::task::{CORNERS, Task};
use piola::random::Random;

/// Inputs and outputs of a task, for a multiple of 64 points.
#[derive(Debug)]
pub struct Arrays<E> {
    task: Task,
    layout: Layout,
    points: usize,
    inputs: [Aligned<E>; 2],
    outputs: [Aligned<E>; 2],
    positions: Vec<[E; 3]>,
    tetrahedra: Vec<[usize; 4]>,
}

/// Points that are moved together.
const CHUNK: usize = 64;

impl<E: Stages> Arrays<E> {
    /// Arrays of random points, which are equal for every task, format and layout.
    #[must_use]
    pub fn new(task: Task, layout: Layout, points: usize) -> Self {
        let inputs = task.inputs().map(|input| {
            let (numbers, mut random) = (input.numbers(), Random::new(1));
            let mut array = Aligned::new(points * numbers);
            for point in 0..points {
                for (k, number) in input.draw(&mut random).into_iter().enumerate() {
                    array[layout.index::<E>(point, numbers, k)] = E::splat(number);
                }
            }
            array
        });
        let outputs = task.outputs().map(|numbers| Aligned::new(points * numbers));
        // Four nodes in a row are a tetrahedron, whose first corner is a node 4 n.
        let positions = (0..points + 3).map(|node| CORNERS[node % 4].map(E::splat)).collect();
        let corner = |first: usize, k: usize| first + (k + 4 - first % 4) % 4;
        let tetrahedra = (0..points).map(|first| [0, 1, 2, 3].map(|k| corner(first, k))).collect();
        Self { task, layout, points, inputs, outputs, positions, tetrahedra }
    }

    /// Does the task with the material, filter and back end of a batch.
    pub fn run(&mut self, batch: &Batch<'_, E>) {
        let batch = batch.with_layout(self.layout);
        black_box(self.call(&batch)).expect("slices of matching lengths");
        black_box(&self.outputs);
    }

    fn call(&mut self, batch: &Batch<'_, E>) -> Result<(), LengthError> {
        let ([F, second], [first, large]) = (&self.inputs, &mut self.outputs);
        match self.task {
            Task::Energies => batch.energies(F, first).map(drop),
            Task::Stresses => batch.stresses(F, first).map(drop),
            Task::Tangents => batch.tangents(F, first, large).map(drop),
            Task::PackedTangents => batch.packed_tangents(F, first, large).map(drop),
            Task::FactoredTangents => batch.factored_tangents(F, first, large).map(drop),
            // What stands where F does elsewhere are the factors.
            Task::Products => batch.products(F, second, first),
            Task::Stiffnesses => batch.stiffnesses(F, second, first, large).map(drop),
            Task::PackedStiffnesses => batch.packed_stiffnesses(F, second, first, large).map(drop),
            Task::StiffnessesAt => {
                let tetrahedra = Tetrahedra::new(self.positions.len(), &self.tetrahedra);
                let tetrahedra = tetrahedra.expect("nodes that exist");
                batch.stiffnesses_at(tetrahedra, &self.positions, second, first, large).map(drop)
            }
        }
    }

    /// Reads and writes what the task does and computes nothing: the time below which no kernel can be.
    ///
    /// `streams` as of a [`Batch`].
    pub fn move_only(&mut self, backend: Backend, streams: bool) {
        let [reads, also_reads] = self.inputs.each_ref().map(|array| array.len() / self.points * CHUNK);
        let [writes, large_writes] = self.outputs.each_ref().map(|array| array.len() / self.points * CHUNK);
        // A part that stays in the innermost cache beside what is read.
        let pattern = Aligned::<E>::new(large_writes / 4);
        for chunk in 0..self.points / CHUNK {
            let [from, also_from] = &self.inputs;
            backend.run(Read(&from[chunk * reads..][..reads]));
            backend.run(Read(&also_from[chunk * also_reads..][..also_reads]));
            let [to, large_to] = &mut self.outputs;
            backend.run(Write(&mut to[chunk * writes..][..writes]));
            let large_to = &mut large_to[chunk * large_writes..][..large_writes];
            if !streams {
                backend.run(Write(large_to));
            } else if !pattern.is_empty() {
                for part in large_to.chunks_mut(pattern.len()) {
                    backend.store_non_temporal(&pattern, part);
                }
            }
        }
    }
}

/// Loads each number once, in several sums that don't wait for each other.
struct Read<'a, E>(&'a [E]);

impl<E: Scalar> Kernel<E> for Read<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let mut sum = R::Interleaved::splat(0.0);
        for part in self.0.chunks_exact(R::Interleaved::LANES) {
            sum = sum + R::Interleaved::load(part);
        }
        black_box(sum);
    }
}

/// Stores each number once.
struct Write<'a, E>(&'a mut [E]);

impl<E: Scalar> Kernel<E> for Write<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        // Unknown to the compiler, which would call a library for zeros.
        let number = R::splat(black_box(0.0));
        for part in self.0.chunks_exact_mut(R::LANES) {
            number.store(part);
        }
    }
}

/// Numbers from the start of a cache line on, as stores past the caches want them.
#[derive(Debug)]
pub(super) struct Aligned<E> {
    numbers: Vec<E>,
    start: usize,
}

impl<E: Scalar> Aligned<E> {
    pub(super) fn new(count: usize) -> Self {
        let mut numbers = vec![E::default(); count + E::LINE];
        let start = numbers.as_ptr().align_offset(64);
        numbers.truncate(start + count);
        Self { numbers, start }
    }
}

impl<E> Deref for Aligned<E> {
    type Target = [E];

    fn deref(&self) -> &[E] {
        &self.numbers[self.start..]
    }
}

impl<E> DerefMut for Aligned<E> {
    fn deref_mut(&mut self) -> &mut [E] {
        &mut self.numbers[self.start..]
    }
}
