//! The numbers of many points, and calls with them.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::hint::black_box;
use std::ops::{Deref, DerefMut};

use piola::batch::{Batch, Kernels, Layout, LengthError, REST, Tetrahedra};
use piola::lanes::Scalar;

use super::task::{CORNERS, Task, deformation};
use piola::__private::random::Random;

/// Inputs and outputs of a task, for a multiple of 64 points.
#[derive(Debug)]
pub struct Arrays<E> {
    task: Task,
    layout: Layout,
    F: Aligned<E>,
    rest_shapes: Aligned<E>,
    outputs: [Aligned<E>; 2],
    positions: Vec<[E; 3]>,
    tetrahedra: Vec<[usize; 4]>,
}

impl<E: Kernels> Arrays<E> {
    /// Arrays of random points, which are equal for every task, format and layout.
    #[must_use]
    pub fn new(task: Task, layout: Layout, points: usize) -> Self {
        let input = |numbers: usize, draw: &dyn Fn(&mut Random) -> Vec<f64>| {
            let (mut array, mut random) = (Aligned::new(points * numbers), Random::new(1));
            for point in 0..points {
                for (k, number) in draw(&mut random).into_iter().enumerate() {
                    array[layout.index::<E>(point, numbers, k)] = E::splat(number);
                }
            }
            array
        };
        let F = input(9, &|random| deformation(random).concat());
        let rest_shapes = input(REST, &|random| task.rest_shape(random));
        let outputs = task.signature().1.map(|numbers| Aligned::new(points * numbers));
        // Four nodes in a row are a tetrahedron, whose first corner is a node 4 n.
        let positions = (0..points + 3).map(|node| CORNERS[node % 4].map(E::splat)).collect();
        let corner = |first: usize, k: usize| first + (k + 4 - first % 4) % 4;
        let tetrahedra = (0..points).map(|first| [0, 1, 2, 3].map(|k| corner(first, k))).collect();
        Self { task, layout, F, rest_shapes, outputs, positions, tetrahedra }
    }

    /// Runs the task with the material, filter and back end of a batch.
    #[inline]
    pub fn run(&mut self, batch: &Batch<'_, E>) {
        let batch = batch.with_layout(self.layout);
        black_box(self.call(&batch)).expect("slices of matching lengths");
        black_box(&self.outputs);
    }

    #[inline]
    fn call(&mut self, batch: &Batch<'_, E>) -> Result<(), LengthError> {
        let (F, rest_shapes, [first, large]) = (&self.F, &self.rest_shapes, &mut self.outputs);
        match self.task {
            Task::Energies => batch.energies(F, first).map(drop),
            Task::Stresses => batch.stresses(F, first).map(drop),
            Task::Tangents => batch.tangents(F, first, large).map(drop),
            Task::Stiffnesses => batch.stiffnesses(F, rest_shapes, first, large).map(drop),
            Task::StiffnessesAt => {
                let tetrahedra = Tetrahedra::new(self.positions.len(), &self.tetrahedra);
                let tetrahedra = tetrahedra.expect("nodes that exist");
                batch.stiffnesses_at(tetrahedra, &self.positions, rest_shapes, first, large).map(drop)
            }
        }
    }
}

/// Numbers from the start of a cache line on, as stores past the caches require.
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
