//! Many points at once: slices of deformation gradients in, slices of energies, stresses and tangents out.
//!
//! This is the interface for finite-element codes that have their own elements: it knows points, not meshes. A [`Batch`] says
//! of which material, with which filter, instructions and layout of the slices; its methods are the kernels. They
//! allocate nothing, but for some 80 kB of room on the first call in each thread. Points go through in tiles of 64:
//! decomposition, energy, outputs, each stage with as many points side by side as the registers hold, and what lies between
//! the stages stays in the inner caches.
//!
//! ```
//! use piola::batch::Batch;
//! use piola::material;
//! use piola::point::Filter;
//!
//! /// Rubber.
//! #[material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let rubber = Rubber::new(1e6, 4e6)?;
//! let batch = Batch { filter: Filter::Clamp, ..Batch::new(&rubber) };
//! // Nine numbers for each of a thousand points, row by row: a simple shear.
//! let F: Vec<f64> = [1.0, 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0].repeat(1000);
//! let (mut P, mut dP_dF) = (vec![0.0; 9 * 1000], vec![0.0; 81 * 1000]);
//! let survey = batch.tangents(&F, &mut P, &mut dP_dF)?;
//! assert!(survey.is_clean());
//! assert!((P[9 * 999 + 1] - 0.2e6).abs() < 1e-3);
//! # Ok(())
//! # }
//! ```
//!
//! **Bits.** Within a back end a point's numbers are the same whatever the other points, its place, the number of points and
//! of threads. Two back ends differ by rounding.
//!
//! **Status.** A point that cannot be computed is no error of a call: its numbers mean nothing, and a [`Survey`] counts such
//! points and names the first.
//!
//! **Parameters.** A material is the same for all points; with [`Each`](crate::material::Each) every point has its own.
//!
//! **Without a decomposition.** Of an energy that is written in I1, I2 and J alone, [`Batch::energies`] and
//! [`Batch::stresses`] come from these, several times as fast; a point outside the domain, near its end, or out of their range
//! takes the way of all others.
//!
//! This module knows no sparsity and no particular material.

#![expect(non_snake_case, reason = "F, P, dF, dP as in the literature")]

use std::fmt;

use crate::lanes::{Backend, PastCaches};
use crate::point::Filter;

#[cfg(feature = "system")]
pub(crate) mod element;
mod energy;
mod form;
mod jobs;
#[cfg(feature = "system")]
pub(crate) mod operator;
mod sink;
mod stage;
mod tile;
mod workspace;

pub use energy::{Energy, TileOf, Verdict};
pub use sink::Layout;
pub use stage::{Points, Stages};
pub use tile::Rows;

#[cfg(any(feature = "system", test))]
pub(crate) use form::PACKED_12;
#[cfg(all(test, feature = "system"))]
pub(crate) use form::STIFFEST;
use jobs::{Tile, Work};
use sink::{Sink, Source};
use stage::{
    Decompose, Forces, Invariants, Judge, Marks, Product, Respond, StiffnessForm, Stress, StressByInvariants,
    TangentForm,
};
use tile::first_bits;
use workspace::Workspace;

/// A material and how to compute with it.
#[derive(Clone, Copy)]
pub struct Batch<'a, E> {
    /// The material, as every [`Material`](crate::Material) is one.
    pub energy: &'a dyn Energy<E>,
    /// What becomes of negative eigenvalues of dP/dF.
    pub filter: Filter,
    /// The instructions to compute with.
    pub backend: Backend,
    /// How the numbers of the points lie in every slice of a call.
    pub layout: Layout,
    /// Whether tangents are written past the caches: about twice as fast where they are larger than the last one, and
    /// slower where they would have stayed. Needs [`Layout::Lines`] and slices aligned to 64 bytes, else it does nothing.
    pub streams: bool,
    /// Whether the points are shared among the threads of rayon's pool.
    pub threads: bool,
}

impl<'a, E: Stages> Batch<'a, E> {
    /// Unfiltered, with the best instructions of this processor, point by point, on one thread.
    #[must_use]
    pub fn new(energy: &'a dyn Energy<E>) -> Self {
        Self {
            energy,
            filter: Filter::None,
            backend: Backend::best(),
            layout: Layout::Points,
            streams: false,
            threads: false,
        }
    }

    /// ψ, Pa, of each F. Computes no derivative.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn energies(&self, F: &[E], energies: &mut [E]) -> Result<Survey, LengthError> {
        let count = self.count(&[("F", F.len(), 9), ("energies", energies.len(), 1)])?;
        let work = Work { inputs: [(F, 9)], outputs: [(energies, 1)] };
        Ok(jobs::for_each_tile(work, 0..count, self.threads, &|tile| {
            let Tile { workspace, start, count, inputs: [F], outputs: [energies] } = tile;
            let Workspace { F: lines, points, invariants, energies_by_invariants, energies: values, .. } =
                workspace;
            let F = Source::new(self.backend, self.layout, F, lines);
            let mut by_invariants = 0;
            if self.energy.has_invariants() {
                let in_range = E::invariants(self.backend, Invariants { F, count, invariants });
                let tile = self.tile(invariants, start, count);
                by_invariants = in_range & self.energy.energies_by_invariants(tile, energies_by_invariants);
                energies.copy_from_slice(&energies_by_invariants.0[0][..count]);
            }
            if by_invariants == first_bits(count) {
                return Marks::default();
            }
            self.decompose(F, count, points);
            let verdict = self.energy.energies(self.tile(&points.stretches, start, count), values);
            for point in (0..count).filter(|point| by_invariants >> point & 1 == 0) {
                energies[point] = values.0[0][point];
            }
            let Verdict { refused, nonfinite } = verdict;
            Marks { refused, nonfinite, ..Marks::default() }.without(by_invariants)
        }))
    }

    /// P, Pa: nine numbers of each F. Computes no second derivative.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn stresses(&self, F: &[E], P: &mut [E]) -> Result<Survey, LengthError> {
        let count = self.count(&[("F", F.len(), 9), ("P", P.len(), 9)])?;
        let work = Work { inputs: [(F, 9)], outputs: [(P, 9)] };
        Ok(jobs::for_each_tile(work, 0..count, self.threads, &|tile| {
            let Tile { workspace, start, count, inputs: [F], outputs: [P] } = tile;
            let Workspace { F: lines, points, invariants, gradients, line, stress, .. } = workspace;
            let F = Source::new(self.backend, self.layout, F, lines);
            let mut by_invariants = 0;
            if self.energy.has_invariants() {
                let in_range = E::invariants(self.backend, Invariants { F, count, invariants });
                let tile = self.tile(invariants, start, count);
                by_invariants = in_range & self.energy.gradients_by_invariants(tile, gradients);
                let P = self.sink(&mut *P);
                let kernel = StressByInvariants { F, invariants, gradients, count, line, P };
                by_invariants &= E::stress_by_invariants(self.backend, kernel);
            }
            if by_invariants == first_bits(count) {
                return Marks::default();
            }
            // The points that the invariants have served keep what they got.
            stress.copy_from(P);
            self.decompose(F, count, points);
            let refused = self.energy.gradients(self.tile(&points.stretches, start, count), gradients);
            let kernel = Stress { points, gradients: &gradients.0, count, line, P: self.sink(&mut *P) };
            let marks = Marks { refused, ..E::stress(self.backend, kernel) };
            for point in (0..count).filter(|point| by_invariants >> point & 1 == 1) {
                for k in 0..9 {
                    let place = self.layout.index::<E>(point, 9, k);
                    P[place] = stress.0.as_flattened()[place];
                }
            }
            marks.without(by_invariants)
        }))
    }

    /// P, Pa, and all entries of dP/dF, Pa, filtered: 81 numbers of each F, row 3i+j for entry (i, j) of P and column 3k+l
    /// for entry (k, l) of F.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn tangents(&self, F: &[E], P: &mut [E], dP_dF: &mut [E]) -> Result<Survey, LengthError> {
        self.respond(TangentForm::Full, F, P, ("dP_dF", dP_dF, 81))
    }

    /// As [`Batch::tangents`], of dP/dF the 45 entries on and above the diagonal, row by row.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn packed_tangents(&self, F: &[E], P: &mut [E], dP_dF: &mut [E]) -> Result<Survey, LengthError> {
        self.respond(TangentForm::Packed, F, P, ("dP_dF", dP_dF, 45))
    }

    /// P, Pa, and dP/dF, filtered, as the [`FACTORS`] numbers that [`Batch::products`] starts from.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn factored_tangents(&self, F: &[E], P: &mut [E], factors: &mut [E]) -> Result<Survey, LengthError> {
        self.respond(TangentForm::Factored, F, P, ("factors", factors, FACTORS))
    }

    /// dP = (dP/dF) dF of each point, from what [`Batch::factored_tangents`] has written.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn products(&self, factors: &[E], dF: &[E], dP: &mut [E]) -> Result<(), LengthError> {
        let lengths = [("factors", factors.len(), FACTORS), ("dF", dF.len(), 9), ("dP", dP.len(), 9)];
        let count = self.count(&lengths)?;
        let work = Work { inputs: [(factors, FACTORS), (dF, 9)], outputs: [(dP, 9)] };
        jobs::for_each_tile(work, 0..count, self.threads, &|tile| {
            let Workspace { dF: increments, factors: stored, line, .. } = tile.workspace;
            let ([factors, dF], [dP]) = (tile.inputs, tile.outputs);
            let kernel = Product {
                stored: Source::new(self.backend, self.layout, factors, stored),
                dF: Source::new(self.backend, self.layout, dF, increments),
                count: tile.count,
                line,
                dP: self.sink(dP),
            };
            E::product(self.backend, kernel);
            Marks::default()
        });
        Ok(())
    }

    /// Gradients of linear tetrahedra's energies in their nodal positions, N, and stiffnesses, N/m, filtered.
    ///
    /// `rest` holds [`REST`] numbers of each: Dm⁻¹ row by row, 1/m, and the volume, m³, as in
    /// [`RestShape`](crate::mesh::RestShape); F = Ds Dm⁻¹. Of the gradients there are 12 numbers, coordinate a of node n
    /// at 3n+a; **forces are minus these**. Of the stiffnesses all 144 entries, unknown 3n+a in row and column 3n+a.
    ///
    /// [`BlockMatrix`](crate::system::BlockMatrix) sums them into a sparse matrix.
    ///
    /// The filter acts on dP/dF and is pulled back. At a pole, where a twist is beyond 10⁶ times the rest of the
    /// tangent, it is cut there, because a factorisation could not resolve more.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn stiffnesses(
        &self,
        F: &[E],
        rest: &[E],
        gradients: &mut [E],
        stiffnesses: &mut [E],
    ) -> Result<Survey, LengthError> {
        self.respond_elements(StiffnessForm::Full, F, rest, gradients, (stiffnesses, 144))
    }

    /// As [`Batch::stiffnesses`], of each stiffness the 78 entries on and above the diagonal, row by row.
    ///
    /// # Errors
    /// Where the lengths of the slices do not fit together.
    pub fn packed_stiffnesses(
        &self,
        F: &[E],
        rest: &[E],
        gradients: &mut [E],
        stiffnesses: &mut [E],
    ) -> Result<Survey, LengthError> {
        self.respond_elements(StiffnessForm::Packed, F, rest, gradients, (stiffnesses, 78))
    }

    fn respond(
        &self,
        form: TangentForm,
        F: &[E],
        P: &mut [E],
        (name, tangents, numbers): (&'static str, &mut [E], usize),
    ) -> Result<Survey, LengthError> {
        let lengths = [("F", F.len(), 9), ("P", P.len(), 9), (name, tangents.len(), numbers)];
        let count = self.count(&lengths)?;
        let work = Work { inputs: [(F, 9)], outputs: [(P, 9), (tangents, numbers)] };
        Ok(jobs::for_each_tile(work, 0..count, self.threads, &|tile| {
            let order = PastCaches::new();
            let Workspace { F: lines, points, blocks, line, .. } = tile.workspace;
            let ([F], [P, tangents]) = (tile.inputs, tile.outputs);
            self.decompose(Source::new(self.backend, self.layout, F, lines), tile.count, points);
            let judged = self.blocks(points, tile.start, tile.count, blocks);
            let (points, count) = (&*points, tile.count);
            let kernel = Stress { points, gradients: &blocks.0, count, line, P: self.sink(P) };
            let stressed = E::stress(self.backend, kernel);
            let (has_pole, to) = (self.energy.has_pole(), self.large_sink(tangents, &order));
            let kernel = Respond { points, blocks, rest: Source::NONE, count, has_pole, line, to };
            E::tangent(self.backend, form, kernel).or(stressed).or(judged)
        }))
    }

    fn respond_elements(
        &self,
        form: StiffnessForm,
        F: &[E],
        rest: &[E],
        gradients: &mut [E],
        (stiffnesses, numbers): (&mut [E], usize),
    ) -> Result<Survey, LengthError> {
        let count = self.count(&[
            ("F", F.len(), 9),
            ("rest", rest.len(), REST),
            ("gradients", gradients.len(), 12),
            ("stiffnesses", stiffnesses.len(), numbers),
        ])?;
        let work =
            Work { inputs: [(F, 9), (rest, REST)], outputs: [(gradients, 12), (stiffnesses, numbers)] };
        Ok(jobs::for_each_tile(work, 0..count, self.threads, &|tile| {
            let order = PastCaches::new();
            let Workspace { F: lines, points, blocks, rest: shapes, line, .. } = tile.workspace;
            let ([F, rest], [gradients, stiffnesses]) = (tile.inputs, tile.outputs);
            self.decompose(Source::new(self.backend, self.layout, F, lines), tile.count, points);
            let judged = self.blocks(points, tile.start, tile.count, blocks);
            let (points, count) = (&*points, tile.count);
            let rest = Source::new(self.backend, self.layout, rest, shapes);
            let to = self.sink(gradients);
            let kernel = Forces { points, gradients: &blocks.0, rest, count, line, to };
            let forced = E::forces(self.backend, kernel);
            let (has_pole, to) = (self.energy.has_pole(), self.large_sink(stiffnesses, &order));
            let kernel = Respond { points, blocks, rest, count, has_pole, line, to };
            E::stiffness(self.backend, form, kernel).or(forced).or(judged)
        }))
    }

    fn decompose(&self, F: Source<'_, E, 9>, count: usize, points: &mut Points<E>) {
        let is_signed = self.energy.ends_at_zero_volume();
        E::decompose(self.backend, Decompose { F, count, is_signed, points });
    }

    /// The filtered blocks of a tile.
    fn blocks(&self, points: &Points<E>, start: usize, count: usize, blocks: &mut Rows<E, 15>) -> Marks {
        let refused = self.energy.blocks(self.tile(&points.stretches, start, count), blocks);
        let has_pole = self.energy.has_pole();
        let kernel = Judge { points, blocks, count, filter: self.filter, has_pole };
        Marks { refused, ..E::judge(self.backend, kernel) }
    }

    fn tile<'t>(&self, arguments: &'t Rows<E, 3>, start: usize, count: usize) -> TileOf<'t, E> {
        TileOf { backend: self.backend, start, count, arguments }
    }

    fn sink<'t>(&self, to: &'t mut [E]) -> Sink<'t, E> {
        Sink { to, layout: self.layout, past_caches: None }
    }

    /// For what may be larger than the caches.
    fn large_sink<'t>(&self, to: &'t mut [E], order: &'t PastCaches) -> Sink<'t, E> {
        Sink { to, layout: self.layout, past_caches: self.streams.then_some(order) }
    }

    /// The number of points of slices that must all have as many.
    fn count(&self, slices: &[(&'static str, usize, usize)]) -> Result<usize, LengthError> {
        let (_, length, numbers) = slices[0];
        let group = match self.layout {
            Layout::Points => 1,
            Layout::Lines => E::LINE,
        };
        let count = length / numbers / group * group;
        let parameters = self.energy.points().map(|points| ("materials", points, 1));
        let misfit = slices.iter().chain(&parameters).find(|(_, length, numbers)| *length != count * numbers);
        match misfit {
            None => Ok(count),
            Some(&(slice, found, numbers)) => {
                Err(LengthError { slice, found, numbers, points: count, group })
            }
        }
    }
}

/// Numbers of a point that [`Batch::factored_tangents`] writes: U, V, the Hessian in the stretches, flips, twists.
pub const FACTORS: usize = 30;

/// Numbers of an element's rest shape: Dm⁻¹ row by row, the volume.
pub const REST: usize = 10;

/// What a call says of its points beside their numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// How many lie outside the domain of the energy.
    pub refused: usize,
    /// How many are at a pole of the tangent, which got a bounded value.
    pub bounded: usize,
    /// How many have an infinite or NaN deformation or result, or one within a factor 16 of it.
    pub nonfinite: usize,
    /// Of how many the filter changed the tangent.
    pub filtered: usize,
    /// The first that is refused or not finite.
    pub first: Option<usize>,
}

impl Survey {
    /// Of no points.
    pub(crate) const NONE: Self = Self { refused: 0, bounded: 0, nonfinite: 0, filtered: 0, first: None };

    /// Whether the numbers of every point mean something.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.refused == 0 && self.nonfinite == 0
    }

    /// Of the points of a tile, the first of which is number `start`.
    pub(crate) fn of(marks: &Marks, start: usize) -> Self {
        let count = |bits: u64| bits.count_ones() as usize;
        let bad = marks.refused | marks.nonfinite;
        Self {
            refused: count(marks.refused),
            bounded: count(marks.bounded),
            nonfinite: count(marks.nonfinite),
            filtered: count(marks.filtered),
            first: (bad != 0).then(|| start + bad.trailing_zeros() as usize),
        }
    }

    /// Of these points and those that follow them.
    pub(crate) fn and(self, next: Self) -> Self {
        Self {
            refused: self.refused + next.refused,
            bounded: self.bounded + next.bounded,
            nonfinite: self.nonfinite + next.nonfinite,
            filtered: self.filtered + next.filtered,
            first: self.first.or(next.first),
        }
    }
}

/// Slices whose lengths do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthError {
    /// The slice that does not fit, as the method calls it.
    pub slice: &'static str,
    /// Its length.
    pub found: usize,
    /// Numbers that it holds for each point.
    pub numbers: usize,
    /// How many points there are.
    pub points: usize,
    /// The layout wants a multiple of this many points.
    pub group: usize,
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { slice, found, numbers, points, group } = self;
        write!(
            f,
            "`{slice}` has {found} numbers; {points} points of {numbers} numbers each would make {}",
            points * numbers
        )?;
        if *group > 1 {
            write!(f, ", and the layout in lines wants a multiple of {group} points")?;
        }
        Ok(())
    }
}

impl std::error::Error for LengthError {}

#[cfg(test)]
mod tests;
