//! The stiffness of a tile of linear tetrahedra as an operator: its products, without its entries.
//!
//! With W = √v Dm⁻¹ V the stiffness between the nodes 1, 2, 3 of an element is (U ⊗ W) A (U ⊗ W)ᵀ, as dP/dF
//! is with V in the place of W (see [`assemble_blocks`](crate::point::assemble_blocks)). So the thirty
//! numbers of a tangent's factors, with W, are a stiffness, and the operations of dP = (dP/dF) dF multiply by
//! it: displacements with the edges Ds give
//!
//! ```text
//! U A(Uᵀ Ds W) Wᵀ
//! ```
//!
//! the column n of which belongs to node n + 1, and node 0 takes minus the sum of them. Neither V nor Dm⁻¹ is
//! needed any more.

#![expect(non_snake_case, reason = "F, U, V, W, D as in the literature")]

use super::form::{Factored, put, put_at_nodes};
use super::material::{Arguments, TileMaterial};
use super::rest::{RestShapes, by_elements};
use super::sink::{Line, Lines, Sink, Source};
use super::stage::{Decompose, Deform, Judge, Respond, Stages, StiffnessForm};
use super::tetrahedra::set_edges;
use super::tile::for_each_group;
use super::workspace::Workspace;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::material::Blocks;
use crate::point::matrix::{dot, three, thrice, to_matrix};
use crate::point::{Filter, Matrix3, Tangent};
use crate::status::Status;

/// The stiffnesses of up to [`TILE`](super::tile::TILE) elements of one material where they were linearised
/// last: zero before that.
#[derive(Clone, Debug)]
pub(crate) struct StiffnessFactors {
    backend: Backend,
    /// Index of the first element among those of the material.
    start: usize,
    count: usize,
    /// U, W, ψij, flips, twists.
    factors: Lines<f64, 30>,
}

impl StiffnessFactors {
    /// Elements of which the first is number `start` of the material's.
    pub(crate) fn new(backend: Backend, start: usize, count: usize) -> Self {
        Self { backend, start, count, factors: Lines::zero() }
    }

    /// Output for [`StiffnessForm::Factored`].
    pub(super) fn sink(&mut self) -> Sink<'_, f64> {
        self.factors.sink()
    }

    /// Takes the filtered stiffnesses where the nodes of each element are at `corners`.
    pub(crate) fn linearise(
        &mut self,
        rest: &RestShapes,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        corners: impl Iterator<Item = [[f64; 3]; 4]>,
    ) -> Status<u64> {
        f64::with_workspace(|workspace| {
            for (lane, corners) in corners.enumerate() {
                set_edges(&mut workspace.F, lane, corners);
            }
            self.respond(rest, material, filter, workspace)
        })
    }

    /// The stages from edges to factors.
    fn respond(
        &mut self,
        rest: &RestShapes,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        workspace: &mut Workspace<f64>,
    ) -> Status<u64> {
        let Self { backend, start, count, ref mut factors } = *self;
        let Workspace { F: edges, points, blocks, line, .. } = workspace;
        let (rest, is_signed, has_pole) =
            (rest.source(), material.properties().ends_at_zero_volume, material.properties().has_pole);
        f64::deform(backend, Deform { edges, rest, count });
        f64::decompose(backend, Decompose { F: edges.source(), count, is_signed, points });
        let arguments = Arguments { backend, start, count, rows: &points.stretches };
        let refused = material.tile_blocks(arguments, blocks);
        let judged = f64::judge(backend, Judge { points, blocks, count, filter, has_pole });
        let kernel = Respond { points, blocks, rest, count, has_pole, line, to: factors.sink() };
        f64::stiffness(backend, StiffnessForm::Factored, kernel) | judged | refused
    }

    /// Stiffness times displacement, N, 12 components of each element; `corners` are the displacements of its
    /// nodes.
    pub(crate) fn multiply(&self, corners: impl Iterator<Item = [[f64; 3]; 4]>, products: &mut [f64]) {
        f64::with_workspace(|Workspace { F: edges, line, .. }| {
            for (lane, corners) in corners.enumerate() {
                set_edges(edges, lane, corners);
            }
            let (factors, edges, count) = (self.factors.source(), edges.source(), self.count);
            self.backend.run(Multiply { factors, edges, count, line, to: by_elements(products) });
        });
    }

    /// Column of this coordinate in the 3×3 stiffness of each node with itself, 12 entries for each element:
    /// row a of node n at 3n+a.
    pub(crate) fn diagonal_columns(&self, coordinate: usize, columns: &mut [f64]) {
        f64::with_workspace(|Workspace { line, .. }| {
            let (factors, count) = (self.factors.source(), self.count);
            self.backend.run(DiagonalColumns { factors, coordinate, count, line, to: by_elements(columns) });
        });
    }
}

/// Kernel from factors and edges of displacements to products at the nodes.
struct Multiply<'a> {
    factors: Source<'a, f64, 30>,
    edges: Source<'a, f64, 9>,
    count: usize,
    line: &'a mut Line<f64>,
    to: Sink<'a, f64>,
}

impl Kernel<f64> for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = f64>>(self) {
        let Self { factors, edges, count, line, mut to } = self;
        for_each_group!(R, count, |at| {
            let stiffness = Factored::restore(factors.get_all::<R>(at));
            let product = stiffness.apply(&to_matrix(edges.get_all(at)));
            let place = to.place::<R, 12>(line, at);
            thrice!(a => { put_at_nodes(a, product[a], place) });
            to.finish::<R, 12>(line, at, count);
        });
    }
}

/// Distance between two components of a point in an output.
const LINE: usize = <f64 as Scalar>::LINE;

/// Kernel from factors to a column of the blocks on the diagonal.
struct DiagonalColumns<'a> {
    factors: Source<'a, f64, 30>,
    coordinate: usize,
    count: usize,
    line: &'a mut Line<f64>,
    to: Sink<'a, f64>,
}

impl Kernel<f64> for DiagonalColumns<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = f64>>(self) {
        let Self { factors, coordinate, count, line, mut to } = self;
        for_each_group!(R, count, |at| {
            let Tangent { U, V: W, blocks } = Factored::restore(factors.get_all::<R>(at));
            let w0 = three!(l => -(W[0][l] + W[1][l] + W[2][l]));
            let place = to.place::<R, 12>(line, at);
            put_diagonal(&U, w0, &blocks, coordinate, place);
            thrice!(n => { put_diagonal(&U, W[n], &blocks, coordinate, &mut place[(3 * n + 3) * LINE..]) });
            to.finish::<R, 12>(line, at, count);
        });
    }
}

/// Column c of a node's stiffness with itself, w being its row of W: U A(u wᵀ) w with u = Uᵀ e_c.
#[inline(always)]
fn put_diagonal<R: Lanes>(U: &Matrix3<R>, w: [R; 3], blocks: &Blocks<R>, c: usize, to: &mut [R::Scalar]) {
    let D = three!(k => three!(l => U[c][k] * w[l]));
    let response = blocks.apply(&D);
    let traction = three!(k => dot(response[k], w));
    thrice!(a => { put(to, a, dot(U[a], traction)) });
}
