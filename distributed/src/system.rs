//! The linear system of a Newton iteration, as PETSc assembles and solves it.

use std::cell::RefCell;
use std::rc::Rc;

use crate::elastic::Elastic;
use crate::error::Error;
use crate::petsc::{Ending, Krylov, Matrix, PetscError, Vector};
use crate::share::Share;
use crate::team::Team;

/// Options of PETSc unless the user sets others: smoothed aggregation for conjugate gradients, two steps of
/// Chebyshev's iteration and Jacobi's diagonal on each level, and the aggregates of the first system for all
/// later ones.
const DEFAULTS: &[(&str, &str)] = &[
    ("pc_type", "gamg"),
    ("pc_gamg_type", "agg"),
    ("pc_gamg_agg_nsmooths", "1"),
    ("pc_gamg_threshold", "0.01"),
    ("pc_gamg_reuse_interpolation", "true"),
    ("mg_levels_ksp_type", "chebyshev"),
    ("mg_levels_ksp_max_it", "2"),
    ("mg_levels_pc_type", "jacobi"),
    ("fallback_pc_type", "jacobi"),
];

/// An old preconditioner may take so many times the iterations that it took for its own matrix.
const PATIENCE: f64 = 2.0;

/// The unknowns of free nodes, matrix and solver.
pub struct LinearSystem {
    matrix: Rc<RefCell<Matrix>>,
    krylov: Krylov,
    fallback: Krylov,
    right: Vector,
    solution: Vector,
    places: Vector,
    values: Vec<f64>,
    free: usize,
    /// Iterations a digit right after the preconditioner was made; `None` before.
    pace: Option<f64>,
    /// Whether the options have been looked through for those without use.
    is_checked: bool,
}

impl LinearSystem {
    /// Finds the places of all entries, and sets PETSc's solver up.
    ///
    /// # Errors
    /// [`Error::Petsc`], also for an option with a value that PETSc does not know.
    pub fn new(team: &Team, share: &Share, elastic: &Elastic) -> Result<Self, Error> {
        let library = team.library();
        let mut blocks = Vec::new();
        let mut block = |row: usize, column: usize| {
            blocks.extend(share.free_numbers[row].zip(share.free_numbers[column]).map(<[usize; 2]>::from));
        };
        elastic.blocks(|row, column, _| {
            block(row, column);
            if row != column {
                block(column, row);
            }
        });
        let diagonal = share.free_numbers[..share.free].iter().flatten();
        let entries = |[row, column]: [usize; 2]| {
            (0..9).map(move |entry| [Some(3 * row + entry / 3), Some(3 * column + entry % 3)])
        };
        let on_diagonal = |&node: &usize| (0..3).map(move |c| [Some(3 * node + c); 2]);
        let places = blocks.iter().copied().flat_map(entries).chain(diagonal.flat_map(on_diagonal));
        let mut matrix = Matrix::new(library, 3 * share.free, 3, places)?;
        matrix.set_symmetric()?;
        let values = vec![0.0; 9 * blocks.len() + 3 * share.free];
        drop(blocks);
        for (name, value) in DEFAULTS {
            library.default_option(name, value)?;
        }
        let matrix = Rc::new(RefCell::new(matrix));
        let vector = || Vector::new(library, share.free);
        Ok(Self {
            krylov: Krylov::new(library, matrix.clone(), "cg", "")?,
            fallback: Krylov::new(library, matrix.clone(), "cg", "fallback_")?,
            matrix,
            right: vector()?,
            solution: vector()?,
            places: vector()?,
            values,
            free: share.free,
            pace: None,
            is_checked: false,
        })
    }

    /// Assembles the stiffness that the elements have taken last, plus a diagonal of each free node, N/m. The
    /// nodes are at `positions`, m.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn assemble(
        &mut self,
        share: &Share,
        elastic: &Elastic,
        diagonal: impl Fn(usize) -> f64,
        positions: &[[f64; 3]],
    ) -> Result<(), PetscError> {
        let mut rest = self.values.as_mut_slice();
        let mut put = |entries: [[f64; 3]; 3]| {
            let (here, after) = std::mem::take(&mut rest).split_at_mut(9);
            here.copy_from_slice(entries.as_flattened());
            rest = after;
        };
        let is_free = |node: usize| share.free_numbers[node].is_some();
        elastic.blocks(|row, column, entries| {
            if is_free(row) && is_free(column) {
                put(*entries);
                if row != column {
                    put(std::array::from_fn(|r| std::array::from_fn(|c| entries[c][r])));
                }
            }
        });
        for (node, entries) in rest.chunks_exact_mut(3).enumerate() {
            entries.fill(diagonal(node));
        }
        let mut matrix = self.matrix.borrow_mut();
        matrix.set_values(&self.values)?;
        self.places.with(|places| places.copy_from_slice(&positions[..places.len()]))?;
        matrix.set_rigid_motions(&self.places)
    }

    /// Forgets the preconditioner, so that what is to come does not depend on what was before.
    pub fn begin(&mut self) {
        self.pace = None;
    }

    /// Solves for the displacement, m, that balances a gradient, N: of the free nodes, with which both slices
    /// begin. A system that `may_fall_back` goes to the fallback where the matrix, or the preconditioner
    /// made of it, is found indefinite.
    ///
    /// # Errors
    /// [`Error::Petsc`], [`Error::UnusedOptions`] after the first system.
    pub fn solve(
        &mut self,
        team: &Team,
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        max_iterations: usize,
        may_fall_back: bool,
    ) -> Result<(Ending, usize), Error> {
        let free = self.free;
        self.right.with(|right| {
            right.iter_mut().zip(gradient).for_each(|(right, gradient)| *right = gradient.map(|g| -g));
        })?;
        self.solution.with(|solution| solution.fill([0.0; 3]))?;
        let (mut ending, mut iterations) = self.solve_at_pace(tolerance, max_iterations)?;
        if may_fall_back && matches!(ending, Ending::Indefinite | Ending::Failed) {
            let Self { fallback, right, solution, .. } = self;
            solution.with(|solution| solution.fill([0.0; 3]))?;
            let again = fallback.solve(right, solution, tolerance, max_iterations)?;
            (ending, iterations) = (again.0, iterations + again.1);
        }
        direction.fill([0.0; 3]);
        self.solution.with(|solution| direction[..free].copy_from_slice(solution))?;
        let not_finite = direction.iter().flatten().filter(|x| !x.is_finite()).count();
        if team.count(not_finite) > 0 {
            ending = Ending::Failed;
        }
        if !self.is_checked {
            self.is_checked = true;
            let names = team.library().unused_options()?;
            if !names.is_empty() {
                return Err(Error::UnusedOptions { names });
            }
        }
        Ok((ending, iterations))
    }

    /// Solves with the preconditioner of an earlier matrix as long as it gets on: making another costs as
    /// much as many iterations.
    fn solve_at_pace(
        &mut self,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<(Ending, usize), PetscError> {
        let Self { krylov, right, solution, .. } = self;
        let digits = -tolerance.log10();
        let mut given_up = 0;
        if let Some(pace) = self.pace {
            krylov.keep_preconditioner(true)?;
            let patience = ((PATIENCE * pace * digits).ceil() as usize).clamp(1, max_iterations);
            let (ending, iterations) = krylov.solve(right, solution, tolerance, patience)?;
            if ending == Ending::Converged {
                return Ok((ending, iterations));
            }
            given_up = iterations;
            solution.with(|solution| solution.fill([0.0; 3]))?;
        }
        krylov.keep_preconditioner(false)?;
        let (ending, iterations) = krylov.solve(right, solution, tolerance, max_iterations)?;
        self.pace = (ending == Ending::Converged).then(|| iterations.max(1) as f64 / digits.max(1e-3));
        Ok((ending, given_up + iterations))
    }
}
