//! Conjugate gradients on products of the elements.

use crate::point::Filter;
use crate::step::damping::Viscosity;
use crate::step::objective::{Objective, Quadratic};
use crate::system::element::Evaluated;
use crate::system::factored::FactoredStiffness;
use crate::system::linear::block_jacobi::BlockJacobi;
use crate::system::linear::conjugate_gradients::{ConjugateGradients, System};
use crate::system::{Body, Pins};

use super::interface::{Definiteness, Solution, SolveError, Solver};

/// [`LinearSolver::ConjugateGradients`](super::LinearSolver::ConjugateGradients).
///
/// Unknowns are the coordinates of all nodes, pinned ones too: right sides and products are set to zero
/// there.
#[derive(Clone)]
pub(super) struct MatrixFree {
    stiffness: FactoredStiffness,
    pinned: Vec<usize>,
    free: Vec<usize>,
    blocks: Vec<[[f64; 3]; 3]>,
    preconditioner: BlockJacobi,
    conjugate_gradients: ConjugateGradients,
    tolerance: f64,
    max_iterations: usize,
}

impl MatrixFree {
    pub(super) fn new(body: &Body, pins: &Pins, tolerance: f64, max_iterations: usize) -> Self {
        let nodes = body.rest().len();
        let is_free = |node: &usize| pins.nodes().binary_search(node).is_err();
        Self {
            stiffness: FactoredStiffness::new(body),
            pinned: pins.nodes().to_vec(),
            free: (0..nodes).filter(is_free).collect(),
            blocks: vec![[[0.0; 3]; 3]; nodes],
            preconditioner: BlockJacobi::new(nodes),
            conjugate_gradients: ConjugateGradients::new(3 * nodes),
            tolerance,
            max_iterations,
        }
    }
}

impl Solver for MatrixFree {
    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn joins(&self, a: usize, b: usize) -> bool {
        self.stiffness.joins(a, b)
    }

    fn linearise(&mut self, objective: &mut Objective<'_>, filter: Filter) -> Evaluated {
        objective.elastic.linearise(objective.body, filter, &mut self.stiffness)
    }

    fn add_product(&mut self, objective: &Objective<'_>, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        self.stiffness.add_product(displacement, total);
        objective.quadratic.add_product(displacement, total);
        if let Some(viscosity) = objective.viscosity {
            viscosity.add_product(objective.body, |node| displacement[node], total);
        }
    }

    fn solve(
        &mut self,
        objective: &Objective<'_>,
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError> {
        let Self { stiffness, pinned, blocks, preconditioner, conjugate_gradients, .. } = self;
        stiffness.diagonal_blocks(blocks);
        objective.quadratic.add_to_blocks(blocks);
        if let Some(viscosity) = objective.viscosity {
            viscosity.add_to_blocks(objective.body, blocks);
        }
        preconditioner.factor(blocks);

        for (direction, gradient) in direction.iter_mut().zip(gradient) {
            *direction = gradient.map(|g| -g);
        }
        pinned.iter().for_each(|&node| direction[node] = [0.0; 3]);
        let Objective { body, quadratic, viscosity, .. } = objective;
        let mut system =
            Linearised { stiffness, quadratic, body, viscosity: *viscosity, pinned, preconditioner };
        let tolerance = tolerance.min(self.tolerance);
        let unknowns = direction.as_flattened_mut();
        let iteration = conjugate_gradients.solve(&mut system, unknowns, tolerance, self.max_iterations);
        let solution = Solution::of(iteration, definiteness)?;
        if solution.is_some() && unknowns.iter().any(|x| !x.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        Ok(solution)
    }

    fn boxed_clone(&self) -> Box<dyn Solver> {
        Box::new(self.clone())
    }
}

/// The second derivatives as an operator on displacements that are zero at pinned nodes.
struct Linearised<'a> {
    stiffness: &'a mut FactoredStiffness,
    quadratic: &'a Quadratic<'a>,
    body: &'a Body,
    viscosity: Option<&'a Viscosity>,
    pinned: &'a [usize],
    preconditioner: &'a BlockJacobi,
}

impl System for Linearised<'_> {
    fn apply(&mut self, x: &[f64], product: &mut [f64]) {
        let (x, product) = (vectors(x), product.as_chunks_mut().0);
        self.stiffness.multiply(x, product);
        self.quadratic.add_product(x, product);
        if let Some(viscosity) = self.viscosity {
            viscosity.add_product(self.body, |node| x[node], product);
        }
        self.pinned.iter().for_each(|&node| product[node] = [0.0; 3]);
    }

    fn precondition(&mut self, r: &[f64], z: &mut [f64]) {
        self.preconditioner.solve(vectors(r), z.as_chunks_mut().0);
    }
}

/// Entries as vectors, one for each node.
fn vectors(entries: &[f64]) -> &[[f64; 3]] {
    entries.as_chunks().0
}
