//! Linear system of a Newton iteration, on one rank, and its solution by PETSc.
//!
//! The stiffness of a rank is the sum over its elements: half of a matrix of 3×3 blocks, with a row for each
//! node of the rank, copies included. The sum over the ranks is the whole stiffness. PETSc's conjugate
//! gradients call two functions: the product with the stiffness, and piola's preconditioner, which is block
//! Jacobi or multigrid. PETSc solves the last level of multigrid. If an option selects another
//! preconditioner, a whole matrix in compressed rows is passed to PETSc instead.

use std::cell::RefCell;
use std::rc::Rc;

use piola_bodies::step::divided::{End, Iteration, Preconditioner};
use piola_bodies::system::NodalStiffness;

use crate::division::RowsOfRank;
use crate::error::Error;
use crate::petsc::{Failure, GhostedVector, Krylov, Matrix, Operators, PetscError, Vector};
use crate::share::Share;
use crate::team::Team;

/// Default options of PETSc. The preconditioner is piola's. With `-pc_type gamg` it is smoothed aggregation,
/// with two steps of Chebyshev's iteration and Jacobi's diagonal on each level, and with the aggregates of
/// the first system for all later systems.
const DEFAULTS: &[(&str, &str)] = &[
    ("pc_type", SHELL),
    ("pc_gamg_type", "agg"),
    ("pc_gamg_agg_nsmooths", "1"),
    ("pc_gamg_threshold", "0.01"),
    ("pc_gamg_reuse_interpolation", "true"),
    ("mg_levels_ksp_type", "chebyshev"),
    ("mg_levels_ksp_max_it", "2"),
    ("mg_levels_pc_type", "jacobi"),
    ("fallback_pc_type", "jacobi"),
];

/// PETSc's name for a preconditioner that is a function, such as piola's.
const SHELL: &str = "shell";

/// Largest number of iterations with an old preconditioner of PETSc, relative to the number for the matrix of
/// the preconditioner.
const PATIENCE: f64 = 2.0;

/// Linear system of the free nodes: matrix, vectors and solver.
pub struct LinearSystem {
    matrix_free: Rc<RefCell<MatrixFree>>,
    form: Form,
    right: Vector<3>,
    solution: Vector<3>,
    /// True if the options have been checked for unused ones: at first, and with levels of multigrid.
    is_checked: [bool; 2],
}

/// Right side, memory for the solution, and limits of the solver.
struct Task<'a> {
    right: &'a Vector<3>,
    solution: &'a mut Vector<3>,
    tolerance: f64,
    max_iterations: usize,
}

/// Form of the matrix in PETSc.
enum Form {
    /// Matrix and preconditioner as functions.
    MatrixFree(Krylov),
    /// Whole matrix of PETSc.
    Assembled(Assembled),
}

/// Stiffness of a rank, and piola's preconditioner.
struct MatrixFree {
    stiffness: NodalStiffness,
    preconditioner: Preconditioner<RowsOfRank>,
    exchange: GhostedVector,
    failure: Failure,
    is_free: Vec<bool>,
    /// Vector with an entry for each node of the rank, and its product with the stiffness.
    x: Vec<[f64; 3]>,
    product: Vec<[f64; 3]>,
}

impl Operators for MatrixFree {
    fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), PetscError> {
        // The entries of pinned nodes follow, and are zero.
        self.x[..x.len()].copy_from_slice(x);
        self.multiply_x()?;
        product.copy_from_slice(&self.product[..product.len()]);
        Ok(())
    }

    fn precondition(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.preconditioner.apply(r, z);
        self.failure.take()
    }

    fn view(&self) -> (String, Option<&Krylov>) {
        let Some((rows, last)) = self.preconditioner.levels() else {
            return ("blocks on the diagonal".to_owned(), None);
        };
        let rows: Vec<String> = rows.iter().map(ToString::to_string).collect();
        (format!("multigrid: levels of {} rows; the last is solved by", rows.join(", ")), Some(last.krylov()))
    }
}

impl MatrixFree {
    /// Multiplies the stiffness by the vector `x` of the owned nodes.
    fn multiply_x(&mut self) -> Result<(), PetscError> {
        let Self { stiffness, exchange, x, product, .. } = self;
        exchange.copy(x.as_flattened_mut())?;
        // Both vectors have the length of the stiffness.
        let _ = stiffness.multiply(x, product);
        exchange.sum(product.as_flattened_mut())
    }
}

impl LinearSystem {
    /// Sets up PETSc's solver for a stiffness of the nodes of a share.
    ///
    /// # Errors
    /// [`Error::Petsc`], also for an option with a value that PETSc does not support.
    pub fn new(team: &Team, share: &Share, stiffness: NodalStiffness) -> Result<Self, Error> {
        let library = team.library();
        for (name, value) in DEFAULTS {
            library.default_option(name, value)?;
        }
        let (nodes, failure) = (share.ids.len(), Failure::default());
        let rows = RowsOfRank::new(team, &failure, share.owned, share.copies.clone());
        let matrix_free = Rc::new(RefCell::new(MatrixFree {
            stiffness,
            preconditioner: Preconditioner::new(share.owned, rows),
            exchange: GhostedVector::new(library, 3, share.owned, &share.copies)?,
            failure,
            is_free: share.free_numbers.iter().map(Option::is_some).collect(),
            x: vec![[0.0; 3]; nodes],
            product: vec![[0.0; 3]; nodes],
        }));
        let form = if library.is_set_to("pc_type", SHELL)? {
            let matrix = Matrix::of_function(library, share.free, matrix_free.clone())?;
            let mut krylov = Krylov::new(library, Rc::new(RefCell::new(matrix)), "")?;
            krylov.precondition_by(matrix_free.clone())?;
            Form::MatrixFree(krylov)
        } else {
            Form::Assembled(Assembled::new(team, share, &matrix_free.borrow().stiffness)?)
        };
        let vector = || Vector::new(library, share.free);
        Ok(Self { matrix_free, form, right: vector()?, solution: vector()?, is_checked: [false; 2] })
    }

    /// Calls `work` with the stiffness of this rank's elements.
    pub fn with_stiffness<T>(&mut self, work: impl FnOnce(&mut NodalStiffness) -> T) -> T {
        work(&mut self.matrix_free.borrow_mut().stiffness)
    }

    /// Adds `stiffness(node)`, N/m, to the diagonal of each owned node.
    pub fn add_to_diagonal(&mut self, share: &Share, stiffness: impl Fn(usize) -> f64) {
        let mut matrix_free = self.matrix_free.borrow_mut();
        (0..share.owned).for_each(|node| matrix_free.stiffness.add_to_diagonal(node, stiffness(node)));
    }

    /// Adds the product of the stiffness with a displacement, m, of the nodes of the rank to `total`, N, at
    /// the owned nodes.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn add_product(
        &mut self,
        displacement: &[[f64; 3]],
        total: &mut [[f64; 3]],
    ) -> Result<(), PetscError> {
        let matrix_free = &mut *self.matrix_free.borrow_mut();
        matrix_free.x.copy_from_slice(displacement);
        matrix_free.multiply_x()?;
        for (total, product) in total.as_flattened_mut().iter_mut().zip(matrix_free.product.as_flattened()) {
            *total += product;
        }
        matrix_free.x.fill([0.0; 3]);
        Ok(())
    }

    /// Discards the preconditioner, so that later results do not depend on earlier systems.
    pub fn begin(&mut self) {
        self.matrix_free.borrow_mut().preconditioner.forget();
        if let Form::Assembled(assembled) = &mut self.form {
            assembled.pace = None;
        }
    }

    /// Solves for the displacement, m, that balances a gradient, N, at the free nodes; these are the first
    /// entries of both slices. The nodes are at `x`, m, and `inertia(node)`, N/m, is the part of inertia in
    /// the diagonal. With `may_fall_back`, the fallback solves a system whose matrix is indefinite with
    /// PETSc's preconditioner.
    ///
    /// # Errors
    /// [`Error::Petsc`], [`Error::UnusedOptions`] after the first system.
    #[expect(clippy::too_many_arguments, reason = "a system, its nodes, and the limits of its solver")]
    pub fn solve(
        &mut self,
        team: &Team,
        share: &Share,
        x: &[[f64; 3]],
        inertia: impl Fn(usize) -> f64,
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        (tolerance, max_iterations): (f64, usize),
        may_fall_back: bool,
    ) -> Result<Iteration, Error> {
        let Self { matrix_free, form, right, solution, .. } = self;
        right.with(|right| {
            right.iter_mut().zip(gradient).for_each(|(right, gradient)| *right = gradient.map(|g| -g));
        })?;
        let mut task = Task { right, solution, tolerance, max_iterations };
        let mut iteration = match form {
            Form::MatrixFree(krylov) => solve(matrix_free, krylov, &mut task, x, inertia)?,
            Form::Assembled(assembled) => {
                assembled.assemble(share, &matrix_free.borrow().stiffness, x)?;
                assembled.solve(&mut task, may_fall_back)?
            }
        };
        direction.fill([0.0; 3]);
        self.solution.with(|solution| direction[..share.free].copy_from_slice(solution))?;
        let not_finite = direction.iter().flatten().filter(|x| !x.is_finite()).count();
        if team.count(not_finite) > 0 {
            iteration.end = End::NotFinite;
        }
        self.check_options(team)?;
        Ok(iteration)
    }

    /// Checks for unused options of the user. Options of the last level are checked only if there are levels.
    fn check_options(&mut self, team: &Team) -> Result<(), Error> {
        let is_with_levels = match self.form {
            Form::MatrixFree(_) => self.matrix_free.borrow().preconditioner.levels().is_some(),
            Form::Assembled(_) => true,
        };
        if !std::mem::replace(&mut self.is_checked[usize::from(is_with_levels)], true) {
            let mut names = team.library().unused_options()?;
            names.retain(|name| is_with_levels || !name.starts_with("coarse_"));
            if !names.is_empty() {
                return Err(Error::UnusedOptions { names });
            }
        }
        Ok(())
    }
}

/// Solves with piola's preconditioner, and again with a new one if the first needs too many iterations.
fn solve(
    matrix_free: &RefCell<MatrixFree>,
    krylov: &mut Krylov,
    task: &mut Task<'_>,
    x: &[[f64; 3]],
    inertia: impl Fn(usize) -> f64,
) -> Result<Iteration, Error> {
    let Task { right, solution, tolerance, max_iterations } = task;
    let mut given_up = 0;
    loop {
        let limit = {
            let MatrixFree { stiffness, preconditioner, is_free, failure, .. } =
                &mut *matrix_free.borrow_mut();
            let taken = preconditioner.take(stiffness, is_free, x, &inertia);
            failure.take()?;
            taken?;
            preconditioner.patience(*tolerance).min(*max_iterations - given_up)
        };
        let mut iteration = krylov.solve(right, solution, *tolerance, limit)?;
        let again = matrix_free.borrow_mut().preconditioner.judge(iteration, *tolerance);
        iteration.iterations += given_up;
        if !again || iteration.iterations >= *max_iterations {
            return Ok(iteration);
        }
        given_up = iteration.iterations;
    }
}

/// Whole matrix of PETSc, and solvers with preconditioners of PETSc.
struct Assembled {
    matrix: Rc<RefCell<Matrix>>,
    krylov: Krylov,
    fallback: Krylov,
    places: Vector<3>,
    values: Vec<f64>,
    /// Number of iterations per digit directly after the set-up of the preconditioner; `None` before.
    pace: Option<f64>,
}

impl Assembled {
    /// Computes the places of all entries.
    fn new(team: &Team, share: &Share, stiffness: &NodalStiffness) -> Result<Self, Error> {
        let library = team.library();
        let mut blocks = Vec::new();
        let mut block = |row: usize, column: usize| {
            blocks.extend(share.free_numbers[row].zip(share.free_numbers[column]).map(<[usize; 2]>::from));
        };
        for (row, column, _) in stiffness.blocks() {
            block(row, column);
            if row != column {
                block(column, row);
            }
        }
        let entries = |[row, column]: [usize; 2]| {
            (0..9).map(move |entry| [Some(3 * row + entry / 3), Some(3 * column + entry % 3)])
        };
        let mut matrix = Matrix::new(library, 3 * share.free, 3, blocks.iter().copied().flat_map(entries))?;
        matrix.set_symmetric()?;
        let values = vec![0.0; 9 * blocks.len()];
        drop(blocks);
        let matrix = Rc::new(RefCell::new(matrix));
        Ok(Self {
            krylov: Krylov::new(library, matrix.clone(), "")?,
            fallback: Krylov::new(library, matrix.clone(), "fallback_")?,
            matrix,
            places: Vector::new(library, share.free)?,
            values,
            pace: None,
        })
    }

    /// Assembles the stiffness; the nodes are at `positions`, m.
    fn assemble(
        &mut self,
        share: &Share,
        stiffness: &NodalStiffness,
        positions: &[[f64; 3]],
    ) -> Result<(), PetscError> {
        let mut rest = self.values.as_mut_slice();
        let mut put = |entries: [[f64; 3]; 3]| {
            let (here, after) = std::mem::take(&mut rest).split_at_mut(9);
            here.copy_from_slice(entries.as_flattened());
            rest = after;
        };
        let is_free = |node: usize| share.free_numbers[node].is_some();
        for (row, column, entries) in stiffness.blocks() {
            if is_free(row) && is_free(column) {
                put(*entries);
                if row != column {
                    put(std::array::from_fn(|r| std::array::from_fn(|c| entries[c][r])));
                }
            }
        }
        let mut matrix = self.matrix.borrow_mut();
        matrix.set_values(&self.values)?;
        self.places.with(|places| places.copy_from_slice(&positions[..places.len()]))?;
        matrix.set_rigid_motions(&self.places)
    }

    /// Solves, and uses the fallback if the matrix or its preconditioner is found to be indefinite.
    fn solve(&mut self, task: &mut Task<'_>, may_fall_back: bool) -> Result<Iteration, PetscError> {
        let first = self.solve_at_pace(task)?;
        if !(may_fall_back && matches!(first.end, End::NegativeCurvature | End::NotFinite)) {
            return Ok(first);
        }
        let Task { right, solution, tolerance, max_iterations } = task;
        let Iteration { iterations, end } =
            self.fallback.solve(right, solution, *tolerance, *max_iterations)?;
        Ok(Iteration { iterations: first.iterations + iterations, end })
    }

    /// Solves with the preconditioner of an earlier matrix while it converges fast enough, because the set-up
    /// of a new preconditioner takes as long as many iterations.
    fn solve_at_pace(&mut self, task: &mut Task<'_>) -> Result<Iteration, PetscError> {
        let Self { krylov, pace, .. } = self;
        let Task { right, solution, tolerance, max_iterations } = task;
        let digits = -tolerance.log10();
        let mut given_up = 0;
        if let Some(pace) = *pace {
            krylov.keep_preconditioner(true)?;
            let patience = ((PATIENCE * pace * digits).ceil() as usize).clamp(1, *max_iterations);
            let iteration = krylov.solve(right, solution, *tolerance, patience)?;
            if iteration.end == End::Converged {
                return Ok(iteration);
            }
            given_up = iteration.iterations;
        }
        krylov.keep_preconditioner(false)?;
        let Iteration { iterations, end } = krylov.solve(right, solution, *tolerance, *max_iterations)?;
        *pace = (end == End::Converged).then(|| iterations.max(1) as f64 / digits.max(1e-3));
        Ok(Iteration { iterations: given_up + iterations, end })
    }
}
