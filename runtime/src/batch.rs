//! Many points at once: slices of deformation gradients in, slices of energies, stresses and tangents out.
//!
//! This is the interface for finite-element codes that have their own elements: it handles points, and of
//! meshes only the nodes of single elements ([`Batch::stiffnesses_at`], [`Quadrature`]). A [`Batch`] holds
//! the material, the filter, the instructions and the layout of the slices; its methods are the kernels. They
//! allocate nothing, except for some 80 kB of scratch memory on the first call in each thread. Points go
//! through in tiles of 64: decomposition, energy, outputs, each stage with as many points side by side as the
//! registers hold, and intermediate results stay in the inner caches.
//!
//! The [front page](crate#points-in-batches) of the crate has programs.
//!
//! **Matrices by columns**, as nalgebra, glam and Eigen keep them, need no conversion: F by columns is Fᵀ by
//! rows, and for an isotropic solid ψ(Fᵀ) = ψ(F) and P(Fᵀ) = P(F)ᵀ. The results are then by columns as well,
//! row and column 3j+i of dP/dF for entry (i, j). This holds for all results that depend on F alone, not for
//! tetrahedra and not for S, τ and σ.
//!
//! **Few points** in a call cost more each, because registers are computed whole: `cargo speed-report
//! --table` shows. Gather 64 or more, such as those of several elements, or take them one by one
//! from [`point`](crate::point).
//!
//! **Other elements** than linear tetrahedra, hexahedra for one, sum the results of their points by a
//! [`Quadrature`].
//!
//! **Bits.** Within a back end a point's results are the same regardless of the other points, its place, and
//! the number of points and of threads. Two back ends differ by rounding.
//!
//! **Status.** A point that cannot be computed is not an error of a call: its results are invalid, and a
//! [`Survey`] counts such points and names the first.
//!
//! **Parameters.** A material is the same for all points; with [`PerPoint`](crate::material::PerPoint) every
//! point has a material of its own.
//!
//! **Other measures.** [`Batch::measured_tangents`] has S, τ and σ with their tangents. Plane strain, plane
//! stress and displacement gradients are computed point by point, by the functions of
//! [`point`](crate::point).
//!
//! **Without a decomposition.** For an energy that is written in I1, I2 and J, or in sums over the stretches
//! that these determine, energies, stresses, and unfiltered tangents and stiffnesses are computed from the
//! invariants, two to four times as fast. Points outside the domain, near its end, out of range, or with
//! terms by invariants that cancel are decomposed. [`has_invariants`](crate::Material::has_invariants) is
//! true for such an energy.
//!
//! This module is independent of sparsity and of any particular material.

#![expect(non_snake_case, reason = "F, P, dF, dP as in the literature")]

use std::fmt;

use crate::kernels::deformation::Deform;
use crate::kernels::form::Outputs;
use crate::kernels::sink::Source;
use crate::kernels::workspace::Workspace;
use crate::lanes::Backend;
use crate::point::Filter;
use crate::status::{Status, StatusCell, Survey};

mod csr;
#[doc(hidden)]
pub mod element;
mod jobs;
pub(crate) mod material;
mod measured;
mod quadrature;
pub(crate) mod tetrahedra;
mod tile;

pub use crate::kernels::Kernels;
pub use crate::kernels::sink::Layout;
pub use csr::{CsrError, CsrPlaces};
pub use material::TileMaterial;
pub use quadrature::Quadrature;
pub use tetrahedra::Tetrahedra;

use jobs::Work;
use tile::{Call, Job, Tile};

/// A material with the settings to evaluate it at many points at once.
#[derive(Clone, Copy)]
pub struct Batch<'a, E> {
    call: Call<'a, E>,
    threads: bool,
    statuses: &'a [StatusCell],
}

impl<'a, E: Kernels> Batch<'a, E> {
    /// A batch without filter, with the best instructions of this processor, point by point, on one thread.
    ///
    /// The material is a [`Material`](crate::Material), or a [`PerPoint`](crate::material::PerPoint).
    #[must_use]
    pub fn new(material: &'a dyn TileMaterial<E>) -> Self {
        let call = Call {
            material,
            properties: material.properties(),
            filter: Filter::None,
            backend: Backend::best(),
            layout: Layout::Points,
            keeps_svd: false,
        };
        Self { call, threads: false, statuses: &[] }
    }

    /// Sets the treatment of negative eigenvalues of dP/dF.
    #[must_use]
    pub fn with_filter(mut self, filter: Filter) -> Self {
        self.call.filter = filter;
        self
    }

    /// Sets the vector instructions of the kernels.
    #[must_use]
    pub fn with_backend(mut self, backend: Backend) -> Self {
        self.call.backend = backend;
        self
    }

    /// Sets the order of the points' components in every slice of a call.
    #[must_use]
    pub fn with_layout(mut self, layout: Layout) -> Self {
        self.call.layout = layout;
        self
    }

    /// Sets whether the points are shared among the threads of rayon's pool.
    #[must_use]
    pub fn with_threads(self, threads: bool) -> Self {
        Self { threads, ..self }
    }

    /// Writes the status of every point, one entry each, at every call.
    ///
    /// ```
    /// use piola::batch::Batch;
    /// use piola::{StatusCell, material};
    ///
    /// /// Rubber.
    /// #[material(domain(J > 0.0))]
    /// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln()
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let rubber = Rubber::new(1e6)?;
    /// let (rest, inside_out) = ([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0]);
    /// let statuses: [StatusCell; 2] = Default::default();
    /// let survey = Batch::new(&rubber).with_statuses(&statuses).energies(&[rest, inside_out].concat(), &mut [0.0; 2])?;
    /// assert_eq!((survey.refused, statuses.map(|status| status.get().refused)), (1, [false, true]));
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn with_statuses(self, statuses: &'a [StatusCell]) -> Self {
        Self { statuses, ..self }
    }

    /// Energy density ψ, Pa, of each F. Computes no derivative.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn energies(&self, F: &[E], energies: &mut [E]) -> Result<Survey, LengthError> {
        let outputs = [("energies", energies, 1)];
        self.run([("F", F, 9)], outputs, |job, [F], [energies]| job.points(F).energies(energies))
    }

    /// First Piola stress P, Pa: nine components of each F. Computes no second derivative.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn stresses(&self, F: &[E], P: &mut [E]) -> Result<Survey, LengthError> {
        self.run([("F", F, 9)], [("P", P, 9)], |job, [F], [P]| job.points(F).stresses(P))
    }

    /// Stresses P and the 81 entries of the filtered dP/dF of each F, Pa: row 3i+j for entry (i, j) of P,
    /// column 3k+l for entry (k, l) of F.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn tangents(&self, F: &[E], P: &mut [E], dP_dF: &mut [E]) -> Result<Survey, LengthError> {
        let outputs = [("P", P, 9), ("dP_dF", dP_dF, 81)];
        self.run([("F", F, 9)], outputs, |job, [F], [P, dP_dF]| job.points(F).tangents(P, dP_dF, None))
    }

    /// Energies ψ, stresses P and filtered dP/dF, Pa: [`Batch::energies`] and [`Batch::tangents`] with one
    /// decomposition of each F.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn energies_and_tangents(
        &self,
        F: &[E],
        energies: &mut [E],
        P: &mut [E],
        dP_dF: &mut [E],
    ) -> Result<Survey, LengthError> {
        let outputs = [("energies", energies, 1), ("P", P, 9), ("dP_dF", dP_dF, 81)];
        self.run([("F", F, 9)], outputs, |job, [F], [energies, P, dP_dF]| {
            job.points(F).tangents(P, dP_dF, Some(energies))
        })
    }

    /// Gradients of linear tetrahedra's energies in their nodal positions, N, and stiffnesses, N/m, filtered.
    ///
    /// `rest` holds [`REST`] components of each: Dm⁻¹ row by row, 1/m, and the volume, m³, as in `RestShape`;
    /// F = Ds Dm⁻¹. Gradients have 12 components, coordinate a of node n at 3n+a; **forces are minus these**.
    /// Stiffnesses have 144 entries, unknown 3n+a in row and column 3n+a. [`CsrPlaces`] sums
    /// them into a sparse matrix.
    ///
    /// The filter acts on dP/dF and is pulled back. At a pole, where a twist is beyond 10⁶ times the rest of
    /// the tangent, it is cut there, because a factorisation could not resolve more.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn stiffnesses(
        &self,
        F: &[E],
        rest: &[E],
        gradients: &mut [E],
        stiffnesses: &mut [E],
    ) -> Result<Survey, LengthError> {
        let inputs = [("F", F, 9), ("rest", rest, REST)];
        let outputs = [("gradients", gradients, 12), ("stiffnesses", stiffnesses, 144)];
        self.run(inputs, outputs, |job, [F, rest], [gradients, stiffnesses]| {
            let Job { call, workspace, start, count } = job;
            let Workspace { F: lines, rest: shapes, svd, scratch } = workspace;
            let F = Source::new(call.backend, call.layout, F, lines);
            let outputs = Outputs::Elements(Source::new(call.backend, call.layout, rest, shapes));
            let mut tile = Tile { call, start, count, F, outputs, svd, is_decomposed: false, scratch };
            tile.tangents(gradients, stiffnesses, None)
        })
    }

    /// Gradients and stiffnesses as in [`Batch::stiffnesses`] for tetrahedra whose nodes are at `positions`,
    /// m: F = Ds Dm⁻¹ is computed on the way.
    ///
    /// The length of `rest` gives their number. In [`Layout::Lines`] it extends to the end of the last line;
    /// fill it up with shapes of tetrahedra with edges of length 1 along the axes. The
    /// [front page](crate#tetrahedra) of the crate has a program.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn stiffnesses_at(
        &self,
        tetrahedra: Tetrahedra<'_>,
        positions: &[[E; 3]],
        rest: &[E],
        gradients: &mut [E],
        stiffnesses: &mut [E],
    ) -> Result<Survey, LengthError> {
        let group = self.call.layout.group::<E>();
        let (nodes, points) = (tetrahedra.nodes, tetrahedra.corners.len().next_multiple_of(group));
        LengthError::check("positions", 3 * positions.len(), 3, nodes, 1)?;
        LengthError::check("rest", rest.len(), REST, points, group)?;
        let outputs = [("gradients", gradients, 12), ("stiffnesses", stiffnesses, 144)];
        self.run([("rest", rest, REST)], outputs, |job, [rest], [gradients, stiffnesses]| {
            let Job { call, workspace, start, count } = job;
            let Workspace { F: edges, rest: shapes, svd, scratch } = workspace;
            let rest = Source::new(call.backend, call.layout, rest, shapes);
            tetrahedra.set_edges(start, count, positions, edges);
            E::deform(call.backend, Deform { edges, rest, count });
            let (F, outputs) = (edges.source(), Outputs::Elements(rest));
            let mut tile = Tile { call, start, count, F, outputs, svd, is_decomposed: false, scratch };
            tile.tangents(gradients, stiffnesses, None)
        })
    }

    /// Computes every tile of slices, each given with its name and the components it holds for a point.
    fn run<const I: usize, const O: usize>(
        &self,
        inputs: [(&'static str, &[E], usize); I],
        outputs: [(&'static str, &mut [E], usize); O],
        body: impl for<'t> Fn(Job<'t, E>, [&'t [E]; I], [&'t mut [E]; O]) -> Status<u64> + Sync,
    ) -> Result<Survey, LengthError> {
        let (_, first, components) = inputs[0];
        let group = self.call.layout.group::<E>();
        let count = first.len() / components / group * group;
        let lengths = inputs.iter().map(|(name, slice, components)| (*name, slice.len(), *components));
        let lengths =
            lengths.chain(outputs.iter().map(|(name, slice, components)| (*name, slice.len(), *components)));
        let materials = self.call.properties.points.map(|points| ("materials", points, 1));
        let statuses = (!self.statuses.is_empty()).then_some(("statuses", self.statuses.len(), 1));
        lengths.chain(materials).chain(statuses).try_for_each(|(slice, found, components)| {
            LengthError::check(slice, found, components, count, group)
        })?;
        let work = Work {
            call: self.call,
            points: 0..count,
            inputs: inputs.map(|(_, slice, components)| (slice, components)),
            outputs: outputs.map(|(_, slice, components)| (slice, components)),
            statuses: self.statuses,
        };
        Ok(jobs::for_each_tile(work, self.threads, &body))
    }
}

/// Components of an element's rest shape: Dm⁻¹ row by row, 1/m, then the volume, m³, which is positive for
/// any order of the nodes: a negative one reverses forces.
pub const REST: usize = 10;

/// Error of slices whose lengths do not match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthError {
    /// Name of the slice that does not match, as in the signature of the method.
    pub slice: &'static str,
    /// Length of that slice.
    pub found: usize,
    /// Number of components that it must hold for each point.
    pub components: usize,
    /// Number of points.
    pub points: usize,
    /// Divisor of the number of points that the layout requires.
    pub group: usize,
}

impl LengthError {
    /// Checks that a slice has this number of components for each of the points.
    fn check(
        slice: &'static str,
        found: usize,
        components: usize,
        points: usize,
        group: usize,
    ) -> Result<(), Self> {
        match components.checked_mul(points) == Some(found) {
            true => Ok(()),
            false => Err(Self { slice, found, components, points, group }),
        }
    }
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { slice, found, components, points, group } = self;
        write!(
            f,
            "`{slice}` has {found} entries; {points} points of {components} entries each would make {}",
            points.saturating_mul(*components)
        )?;
        if *group > 1 {
            write!(f, ", and the layout in lines requires a multiple of {group} points")?;
        }
        Ok(())
    }
}

impl std::error::Error for LengthError {}
