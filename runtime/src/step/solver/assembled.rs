//! Second derivatives as a sparse matrix, for solvers that factor it.

use faer::sparse::SparseColMatRef;

use crate::point::Filter;
use crate::step::newton::{Definiteness, Solution};
use crate::step::objective::Objective;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::pattern::Pattern;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::{Body, Pins};

use super::interface::{SolveError, Solver};

/// A solver that fills a matrix and hands it to a factorisation.
#[derive(Clone)]
pub(super) struct Assembled<F> {
    stiffnesses: ElementStiffnesses,
    matrix: Matrix,
    /// The nodes that are not pinned: those of the pattern but for the ones that are held.
    free: Vec<usize>,
    /// Whether each free node of the pattern is pinned all the same, since it was not when that was made;
    /// empty where no node is.
    held: Vec<bool>,
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

    /// The error for a pivot of this column that fails whatever is added.
    pub(super) fn not_positive(&self, column: usize, shift: f64) -> SolveError {
        let nodes = self.pattern.node_of_free();
        // A solver of a caller's own may name any column.
        SolveError::NotPositive { node: nodes.get(column / 3).copied().unwrap_or(0), shift }
    }
}

impl<F> Assembled<F> {
    pub(super) fn new(
        body: &Body,
        pins: &Pins,
        pairs: &[[usize; 2]],
        factorisation: impl FnOnce(&Pattern) -> Result<F, LinearError>,
    ) -> Result<Self, LinearError> {
        let pattern = Pattern::with_pairs(body.rest().len(), body.elements(), pairs, pins)?;
        Ok(Self {
            factorisation: factorisation(&pattern)?,
            stiffnesses: ElementStiffnesses::new(body),
            free: pattern.node_of_free().to_vec(),
            held: Vec::new(),
            unknowns: vec![0.0; pattern.unknowns()],
            matrix: Matrix { values: vec![0.0; pattern.entries().row_idx().len()], pattern },
        })
    }
}

/// Separates held nodes from the others: their rows and columns become those of the unit matrix.
fn hold(pattern: &Pattern, held: &[bool], values: &mut [f64]) {
    for column in 0..held.len() {
        for (row, block) in pattern.blocks_of(column) {
            if !(held[row] || held[column]) {
                continue;
            }
            for r in 0..3 {
                for c in 0..if row == column { r + 1 } else { 3 } {
                    values[pattern.scalar(column, block, r, c)] =
                        if row == column && r == c { 1.0 } else { 0.0 };
                }
            }
        }
    }
}

impl<F: Factorisation> Solver for Assembled<F> {
    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn set_pins(&mut self, pins: &Pins) -> bool {
        let nodes = self.matrix.pattern.node_of_free();
        let is_pinned = |node: &usize| pins.nodes().binary_search(node).is_ok();
        let held: Vec<bool> = nodes.iter().map(is_pinned).collect();
        let count = held.iter().filter(|is_held| **is_held).count();
        // The pattern leaves out nodes that were pinned when it was made: a new one is needed to let them go.
        if nodes.len() - count != self.matrix.pattern.free_of_node().len() - pins.nodes().len() {
            return false;
        }
        self.free =
            nodes.iter().zip(&held).filter(|(_, is_held)| !**is_held).map(|(&node, _)| node).collect();
        self.held = if count == 0 { Vec::new() } else { held };
        true
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
        objective.blocks.add_product(displacement, total);
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
        let Self { stiffnesses, matrix, held, unknowns, factorisation, .. } = self;
        let nodes = matrix.pattern.node_of_free();
        for (unknown, &node) in unknowns.chunks_exact_mut(3).zip(nodes) {
            for c in 0..3 {
                unknown[c] = -gradient[node][c];
            }
        }
        for (unknown, _) in unknowns.chunks_exact_mut(3).zip(&*held).filter(|(_, is_held)| **is_held) {
            unknown.fill(0.0);
        }
        let fill = |shift: f64, Matrix { pattern, values }: &mut Matrix| {
            let quadratic = &objective.quadratic;
            let diagonal =
                |node: usize| quadratic.guarded_diagonal(node) + shift * quadratic.regularisation(node);
            stiffnesses.fill(pattern, diagonal, values);
            objective.blocks.add_to_entries(pattern, values);
            if !held.is_empty() {
                hold(pattern, held, values);
            }
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
