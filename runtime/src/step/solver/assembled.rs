//! Second derivatives as a sparse matrix, for solvers that factor it.

use faer::sparse::SparseColMatRef;

use crate::point::Filter;
use crate::step::objective::Objective;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::pattern::Pattern;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::{Body, Pins};

use super::interface::{Definiteness, Solution, SolveError, Solver};

/// A solver that fills a matrix and hands it to a factorisation.
#[derive(Clone)]
pub(super) struct Assembled<F> {
    stiffnesses: ElementStiffnesses,
    matrix: Matrix,
    /// The right side, then the solution.
    unknowns: Vec<f64>,
    factorisation: F,
}

/// The second derivatives: a pattern and its values.
#[derive(Clone)]
pub(super) struct Matrix {
    pattern: Pattern,
    values: Vec<f64>,
}

/// A way to factor the matrix and to solve with the factor.
pub(super) trait Factorisation: Clone + Send + Sync + 'static {
    /// Solves in place. Leaves `b` unchanged and returns `None` if the matrix is indefinite and definiteness
    /// is required. `fill(k, matrix)` assembles the Hessian plus k diagonal shifts.
    fn solve(
        &mut self,
        matrix: &mut Matrix,
        fill: impl Fn(f64, &mut Matrix),
        b: &mut [f64],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError>;
}

impl Matrix {
    pub(super) fn entries(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.pattern.entries(), &self.values)
    }

    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The error for a pivot of this column that fails whatever is added.
    pub(super) fn not_positive(&self, column: usize, shift: f64) -> SolveError {
        SolveError::NotPositive { node: self.pattern.node_of_free()[column / 3], shift }
    }
}

impl<F> Assembled<F> {
    pub(super) fn new(
        body: &Body,
        pins: &Pins,
        factorisation: impl FnOnce(&Pattern) -> Result<F, LinearError>,
    ) -> Result<Self, LinearError> {
        let pattern = Pattern::new(body.rest().len(), body.elements(), pins)?;
        Ok(Self {
            factorisation: factorisation(&pattern)?,
            stiffnesses: ElementStiffnesses::new(body),
            unknowns: vec![0.0; pattern.unknowns()],
            matrix: Matrix { values: vec![0.0; pattern.entries().row_idx().len()], pattern },
        })
    }
}

impl<F: Factorisation> Solver for Assembled<F> {
    fn free_nodes(&self) -> &[usize] {
        self.matrix.pattern.node_of_free()
    }

    fn joins(&self, a: usize, b: usize) -> bool {
        let pattern = &self.matrix.pattern;
        let free = pattern.free_of_node()[a].zip(pattern.free_of_node()[b]);
        free.is_some_and(|(a, b)| pattern.block(a.max(b), a.min(b)).is_some())
    }

    fn linearise(&mut self, objective: &mut Objective<'_>, filter: Filter) -> Evaluated {
        let survey = objective.elastic.linearise(objective.body, filter, &mut self.stiffnesses);
        if let Some(viscosity) = objective.viscosity {
            viscosity.add_to(&mut self.stiffnesses);
        }
        survey
    }

    fn add_product(&mut self, objective: &Objective<'_>, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        self.stiffnesses.add_product(objective.body, 1.0, |node| displacement[node], total);
        objective.quadratic.add_product(displacement, total);
    }

    fn solve(
        &mut self,
        objective: &Objective<'_>,
        _: &[[f64; 3]],
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError> {
        let Self { stiffnesses, matrix, unknowns, factorisation } = self;
        let nodes = matrix.pattern.node_of_free();
        for (unknown, &node) in unknowns.chunks_exact_mut(3).zip(nodes) {
            for c in 0..3 {
                unknown[c] = -gradient[node][c];
            }
        }
        let fill = |shift: f64, Matrix { pattern, values }: &mut Matrix| {
            let quadratic = &objective.quadratic;
            let diagonal =
                |node: usize| quadratic.guarded_diagonal(node) + shift * quadratic.regularisation(node);
            stiffnesses.fill(pattern, diagonal, values);
            quadratic.add_springs(pattern, values);
        };
        let solution = factorisation.solve(matrix, fill, unknowns, tolerance, definiteness)?;
        let Some(solution) = solution else { return Ok(None) };
        if unknowns.iter().any(|x| !x.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        for (unknown, &node) in unknowns.chunks_exact(3).zip(matrix.pattern.node_of_free()) {
            direction[node] = [unknown[0], unknown[1], unknown[2]];
        }
        Ok(Some(solution))
    }

    fn boxed_clone(&self) -> Box<dyn Solver> {
        Box::new(self.clone())
    }
}
