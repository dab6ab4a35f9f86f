//! Steps that keep energy and momenta, whose equation no function's minimum solves.
//!
//! The stage is that of the midpoint rule, with the [discrete gradient](crate::system::DiscreteGradient) ∇̄Ψ
//! between the states before and after the step in the place of ∇Ψ in the middle:
//!
//! ```text
//! r(x) = M a(x) + D v(x) + ∇̄Ψ(xₙ, 2 x − xₙ) − M g − f + ∇ terms(x) = 0
//! ```
//!
//! Its Jacobian J is not symmetric. The equation of a share of the step has the accelerations of a shorter
//! one, and all else as in the whole. See [`super::equation`] for the method that solves it.
//!
//! Systems are solved by a sparse LU factorisation, faer's, whose symbolic part is kept as long as the same
//! entries come.

use faer::Mat;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};

use crate::system::{Body, DiscreteGradient, DiscreteGradientError, LinearError};

use super::equation::{StepEquation, StepStart, solve_step};
use super::line_search::LineSearchSettings;
use super::newton::{NewtonError, NewtonReport, NewtonSettings};
use super::objective::{Objective, Quadratic};

/// Memory of the method.
#[derive(Clone)]
pub(super) struct Conservation {
    gradient: DiscreteGradient,
    matrix: Matrix,
    /// Positions before the step, and with the pins moved.
    before: Vec<[f64; 3]>,
    start: Vec<[f64; 3]>,
    /// Displacement from the state before the step to the one after.
    displacement: Vec<[f64; 3]>,
    residual: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    correction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
    /// The solution for the share of the step that was solved for last.
    solution: Vec<[f64; 3]>,
}

impl Conservation {
    pub(super) fn new(body: &Body) -> Self {
        let zero = || vec![[0.0; 3]; body.rest().len()];
        Self {
            gradient: DiscreteGradient::new(body),
            matrix: Matrix::default(),
            before: zero(),
            start: zero(),
            displacement: zero(),
            residual: zero(),
            direction: zero(),
            correction: zero(),
            trial: zero(),
            solution: zero(),
        }
    }

    /// Moves `x` from the positions before the step to those in its middle, the pinned nodes by `pins_move`.
    pub(super) fn solve(
        &mut self,
        objective: &mut Objective<'_>,
        free: &[usize],
        x: &mut [[f64; 3]],
        pins_move: Option<&Vec<[f64; 3]>>,
        settings: &NewtonSettings,
        line_search: &LineSearchSettings,
    ) -> Result<NewtonReport, NewtonError> {
        self.gradient.begin(objective.body, x).map_err(inverted)?;
        self.before.copy_from_slice(x);
        for (x, d) in x.iter_mut().zip(pins_move.into_iter().flatten()) {
            (0..3).for_each(|c| x[c] += d[c]);
        }
        self.start.copy_from_slice(x);
        let mut equation = Equation { memory: self, objective, free, x, share: 1.0 };
        solve_step(&mut equation, settings, line_search)
    }
}

/// The equation of a step, or of a share of it.
struct Equation<'a, 'b> {
    memory: &'a mut Conservation,
    objective: &'a mut Objective<'b>,
    free: &'a [usize],
    x: &'a mut [[f64; 3]],
    share: f64,
}

impl StepEquation for Equation<'_, '_> {
    type Jacobian = Lu<usize, f64>;
    type Error = NewtonError;

    fn start(&mut self, share: f64, start: StepStart) -> Result<f64, NewtonError> {
        self.share = share;
        for &node in self.free {
            let before = self.memory.start[node];
            let ahead = self.objective.quadratic.stage.ahead(node, before);
            self.x[node] = start.position(share, before, ahead, self.memory.solution[node]);
        }
        if let Some(term) = self.objective.terms.refusing(self.x) {
            return Err(NewtonError::TermRefuses { term });
        }
        self.memory.trial.copy_from_slice(self.x);
        self.residual().map_err(inverted)
    }

    fn linearise(&mut self) -> Result<Lu<usize, f64>, NewtonError> {
        self.assemble()?;
        self.memory.matrix.factor(3 * self.free.len()).map_err(NewtonError::Linear)
    }

    fn correct(&mut self, factor: &Lu<usize, f64>) -> Result<f64, NewtonError> {
        let Conservation { residual, correction, .. } = &mut *self.memory;
        let mut b = Mat::from_fn(3 * self.free.len(), 1, |row, _| -residual[self.free[row / 3]][row % 3]);
        factor.solve_in_place(b.as_mut());
        correction.fill([0.0; 3]);
        for (unknown, &node) in self.free.iter().enumerate() {
            correction[node] = std::array::from_fn(|c| b[(3 * unknown + c, 0)]);
        }
        Ok(norm(self.free, correction))
    }

    fn take_direction(&mut self) -> f64 {
        std::mem::swap(&mut self.memory.direction, &mut self.memory.correction);
        self.objective.terms.longest_step(self.x, &self.memory.direction)
    }

    fn try_step(&mut self, step: f64) -> Result<Option<f64>, NewtonError> {
        for node in 0..self.x.len() {
            let d = self.memory.direction[node];
            self.memory.trial[node] = std::array::from_fn(|c| self.x[node][c] + step * d[c]);
        }
        Ok(match self.objective.terms.refusing(&self.memory.trial) {
            None => self.residual().ok(),
            Some(_) => None,
        })
    }

    fn accept(&mut self) {
        self.x.copy_from_slice(&self.memory.trial);
    }

    fn keep_solution(&mut self) {
        self.memory.solution.copy_from_slice(self.x);
    }
}

impl Equation<'_, '_> {
    /// Evaluates r at the positions to be tried and returns its norm over the free nodes.
    fn residual(&mut self) -> Result<f64, DiscreteGradientError> {
        let Conservation { gradient, before, displacement, residual, trial, .. } = &mut *self.memory;
        for (node, d) in displacement.iter_mut().enumerate() {
            *d = std::array::from_fn(|c| 2.0 * (trial[node][c] - before[node][c]));
        }
        gradient.evaluate(self.objective.body, displacement)?;
        self.objective.quadratic_gradient(trial, residual);
        self.objective.terms.add_gradient(trial, residual);
        gradient.add_gradient(self.objective.body, residual)?;
        if self.share < 1.0 {
            let Quadratic { stage, masses, .. } = self.objective.quadratic;
            for &node in self.free {
                let [whole, shorter] =
                    [1.0, self.share].map(|share| stage.acceleration(node, trial[node], share));
                for c in 0..3 {
                    residual[node][c] += masses[node] * (shorter[c] - whole[c]);
                }
            }
        }
        Ok(norm(self.free, &self.memory.residual))
    }

    /// Inertia that a share adds, beside that of the whole step: 1/share² − 1 times as much.
    fn more_inertia(&self) -> f64 {
        (self.share * self.share).recip() - 1.0
    }

    /// Assembles the Jacobian at x, where r was evaluated last.
    fn assemble(&mut self) -> Result<(), NewtonError> {
        let more = self.more_inertia();
        let Self { memory: Conservation { gradient, matrix, .. }, objective, x, .. } = self;
        objective.terms.linearise(x, objective.blocks);
        if let Some(node) = objective.blocks.missing() {
            return Err(NewtonError::NoSuchNode { node, nodes: x.len() });
        }
        gradient
            .linearise(objective.body)
            .map_err(|error| NewtonError::ElementNotFinite { element: tag(error) })?;
        let mut unknowns = vec![None; x.len()];
        for (unknown, &node) in self.free.iter().enumerate() {
            unknowns[node] = Some(3 * unknown);
        }
        matrix.begin();
        let tangents = gradient.tangents(objective.body);
        for (index, (element, tangent)) in objective.body.elements().iter().zip(tangents).enumerate() {
            // The state after the step moves twice as far as the middle.
            let mut tangent = tangent.map(|row| row.map(|entry| 2.0 * entry));
            if let Some(viscosity) = objective.viscosity {
                viscosity.add_element_to(index, &mut tangent);
            }
            for (i, &row) in element.nodes.iter().enumerate() {
                for (j, &column) in element.nodes.iter().enumerate() {
                    let block = |a: usize, c: usize| tangent[3 * i + a][3 * j + c];
                    matrix.add(unknowns[row], unknowns[column], block);
                }
            }
        }
        for (row, column, entries) in objective.blocks.both_ways() {
            matrix.add(unknowns[row], unknowns[column], |a, c| entries[a][c]);
        }
        for &node in self.free {
            let quadratic = &objective.quadratic;
            let diagonal = quadratic.guarded_diagonal(node) + more * quadratic.inertia(node);
            matrix.add(unknowns[node], unknowns[node], |a, c| if a == c { diagonal } else { 0.0 });
        }
        Ok(())
    }
}

fn inverted(error: DiscreteGradientError) -> NewtonError {
    NewtonError::Inverted { element: tag(error) }
}

/// The element that has no gradient between two states. Lengths are all those of the body.
fn tag(error: DiscreteGradientError) -> usize {
    match error {
        DiscreteGradientError::Element { tag } => tag,
        DiscreteGradientError::Length(_) => usize::MAX,
    }
}

/// Norm over the free nodes.
fn norm(free: &[usize], vectors: &[[f64; 3]]) -> f64 {
    let square = |x: [f64; 3]| x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    free.iter().map(|&node| square(vectors[node])).sum::<f64>().sqrt()
}

/// A sparse matrix that comes again and again with the same entries.
#[derive(Clone, Default)]
struct Matrix {
    places: Vec<Pair<usize, usize>>,
    values: Vec<f64>,
    analysed: Option<Analysis>,
}

/// The pattern of a matrix and the symbolic part of its factorisation.
#[derive(Clone)]
struct Analysis {
    places: Vec<Pair<usize, usize>>,
    pattern: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    symbolic: SymbolicLu<usize>,
}

impl Matrix {
    fn begin(&mut self) {
        self.places.clear();
        self.values.clear();
    }

    /// Adds a 3×3 block whose first entry is at this row and column; nothing where a node has none.
    fn add(&mut self, row: Option<usize>, column: Option<usize>, block: impl Fn(usize, usize) -> f64) {
        let Some((row, column)) = row.zip(column) else { return };
        for a in 0..3 {
            for c in 0..3 {
                self.places.push(Pair::new(row + a, column + c));
                self.values.push(block(a, c));
            }
        }
    }

    /// The factors of a matrix of so many rows and columns.
    fn factor(&mut self, rows: usize) -> Result<Lu<usize, f64>, LinearError> {
        // Its size alone can be wrong with a matrix whose pattern is symmetric and has its diagonal.
        let analysis = match self.analysed.take().filter(|analysed| analysed.places == self.places) {
            Some(analysis) => analysis,
            None => {
                let (pattern, order) = SymbolicSparseColMat::try_new_from_indices(rows, rows, &self.places)
                    .map_err(|_| LinearError::OutOfMemory)?;
                let symbolic = SymbolicLu::try_new(pattern.as_ref()).map_err(|_| LinearError::OutOfMemory)?;
                Analysis { places: self.places.clone(), pattern, order, symbolic }
            }
        };
        let Analysis { pattern, order, symbolic, .. } = &analysis;
        let matrix = SparseColMat::new_from_argsort(pattern.clone(), order, &self.values)
            .map_err(|_| LinearError::OutOfMemory)?;
        let factor = Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref())
            .map_err(|_| LinearError::OutOfMemory)?;
        self.analysed = Some(analysis);
        Ok(factor)
    }
}
