//! Linear system of a Newton iteration, on one rank, and its solution by PETSc.
//!
//! The stiffness of a rank is the sum over its elements: half of a matrix of 3×3 blocks, with a row for each
//! node of the rank, copies included. The sum over the ranks is the whole stiffness. PETSc's conjugate
//! gradients call two functions: the product with the stiffness, and piola's preconditioner, which is block
//! Jacobi or multigrid. PETSc solves the last level of multigrid. If an option selects another
//! preconditioner, a whole matrix in compressed rows is passed to PETSc instead.

use std::cell::RefCell;
use std::rc::Rc;

use piola_bodies::step::divided::{End, Iteration, Machine, Preconditioner, Solution, System};
use piola_bodies::step::{NewtonError, StepError};
use piola_bodies::system::{Body, LinearError, NodalStiffness};

use crate::division::RowsOfRank;
use crate::error::Error;
use crate::petsc::{Krylov, Matrix, Operators, PetscError, Vector};
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
pub(crate) struct LinearSystem {
    team: Team,
    nodes: RowsOfRank,
    /// Relative tolerance of the first linear system, and upper bound of later tolerances.
    tolerance: f64,
    max_iterations: usize,
    /// Indices of the free owned nodes.
    free: Vec<usize>,
    /// Mass of each owned node relative to the part of its mass that the elements of this rank have.
    shares: Vec<f64>,
    /// Number of iterations of each linear system.
    systems: Vec<usize>,
    matrix_free: Rc<RefCell<MatrixFree>>,
    form: Form,
    right: Vector,
    solution: Vector,
    /// True if the options have been checked for unused ones: at first, and with levels of multigrid.
    is_checked: [bool; 2],
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
    exchange: Vector,
    team: Team,
    is_free: Vec<bool>,
    /// Vector with an entry for each node of the rank, and its product with the stiffness.
    x: Vec<[f64; 3]>,
    product: Vec<[f64; 3]>,
}

impl Operators for MatrixFree {
    fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), PetscError> {
        let Self { stiffness, exchange, x: all, product: of_all, .. } = self;
        // The entries of pinned nodes follow, and are zero.
        all[..x.len()].copy_from_slice(x);
        exchange.copy(all.as_flattened_mut())?;
        // Both vectors have the length of the stiffness.
        let _ = stiffness.multiply(all, of_all);
        exchange.sum(of_all.as_flattened_mut())?;
        product.copy_from_slice(&of_all[..product.len()]);
        Ok(())
    }

    fn precondition(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.preconditioner.apply(r, z);
        self.team.take_failure().map_err(|error| match error {
            Error::Petsc(error) => error,
            other => PetscError { message: other.to_string() },
        })
    }

    fn view(&self) -> (String, Option<&Krylov>) {
        let Some((rows, last)) = self.preconditioner.levels() else {
            return ("blocks on the diagonal".to_owned(), None);
        };
        let rows: Vec<String> = rows.iter().map(ToString::to_string).collect();
        (format!("multigrid: levels of {} rows; the last is solved by", rows.join(", ")), Some(&last.krylov))
    }
}

impl LinearSystem {
    /// Sets up PETSc's solver for the body of a share.
    ///
    /// # Errors
    /// [`Error::Petsc`], also for an option with a value that PETSc does not support; [`Error::OnRank`].
    pub(crate) fn new(
        team: &Team,
        share: &Share,
        body: &Body,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<Self, Error> {
        let library = &team.library;
        let stiffness = team.agree(NodalStiffness::of_body(body).map_err(Error::from))?;
        let own = body.masses();
        let mut masses = own.to_vec();
        Vector::new(library, 1, share.owned, &share.copies)?.sum(&mut masses)?;
        for (name, value) in DEFAULTS {
            library.default_option(name, value)?;
        }
        let nodes = share.ids.len();
        let rows = || RowsOfRank::new(team, share.owned, share.copies.clone());
        let matrix_free = Rc::new(RefCell::new(MatrixFree {
            stiffness,
            preconditioner: Preconditioner::new(share.owned, rows()),
            exchange: Vector::new(library, 3, share.owned, &share.copies)?,
            team: team.clone(),
            is_free: share.free_numbers.iter().map(Option::is_some).collect(),
            x: vec![[0.0; 3]; nodes],
            product: vec![[0.0; 3]; nodes],
        }));
        let form = if library.option("pc_type")?.as_deref() == Some(SHELL) {
            let matrix = Matrix::of_function(library, share.free, matrix_free.clone())?;
            Form::MatrixFree(Krylov::new(library, Rc::new(matrix), "", None)?)
        } else {
            Form::Assembled(Assembled::new(team, share, &matrix_free.borrow().stiffness)?)
        };
        let vector = || Vector::new(library, 3, share.free, &[]);
        Ok(Self {
            team: team.clone(),
            nodes: rows(),
            tolerance,
            max_iterations,
            free: (0..share.free).collect(),
            shares: masses.iter().zip(own).take(share.owned).map(|(whole, own)| whole / own).collect(),
            systems: Vec::new(),
            matrix_free,
            form,
            right: vector()?,
            solution: vector()?,
            is_checked: [false; 2],
        })
    }

    /// Numbers of iterations of the linear systems since the last call, those of failed attempts included.
    pub(crate) fn take_systems(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.systems)
    }

    /// Solves for the displacement, m, of the owned nodes that balances a gradient, N, with multiples of the
    /// regularisation added to an indefinite matrix, unless it must be definite.
    fn find_direction(
        &mut self,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, Error> {
        let System { objective, x, gradient, must_be_definite, .. } = system;
        objective.add_second_derivatives(&mut self.matrix_free.borrow_mut().stiffness);
        let tolerance = system.tolerance.min(self.tolerance);
        let mut solution = Solution::default();
        loop {
            // A solver may leave it changed, as `-ksp_diagonal_scale` does.
            self.right.with::<3>(|right| {
                right.iter_mut().zip(gradient).for_each(|(right, gradient)| *right = gradient.map(|g| -g));
            })?;
            let Self { matrix_free, form, right, solution: displacement, shares, max_iterations, .. } = self;
            let most = *max_iterations;
            let mut solve =
                |krylov: &mut Krylov, limit: usize| krylov.solve(right, displacement, tolerance, limit);
            let Iteration { iterations, mut end } = match form {
                Form::MatrixFree(krylov) => {
                    let inertia = |node: usize| shares[node] * objective.inertia(node);
                    matrix_free_solve(matrix_free, x, inertia, tolerance, most, |limit| solve(krylov, limit))?
                }
                Form::Assembled(assembled) => {
                    assembled.assemble(&matrix_free.borrow().stiffness, x)?;
                    assembled.solve(tolerance, most, !must_be_definite, solve)?
                }
            };
            direction.fill([0.0; 3]);
            displacement.with::<3>(|found| direction[..found.len()].copy_from_slice(found))?;
            let not_finite = direction.iter().flatten().filter(|x| !x.is_finite()).count();
            if self.team.count(not_finite) > 0 {
                end = End::NotFinite;
            }
            self.check_options()?;
            self.systems.push(iterations);
            solution.iterations += iterations;
            let products = gradient.iter().zip(&*direction).take(self.free.len());
            let own = products.map(|(g, d)| g[0] * d[0] + g[1] * d[1] + g[2] * d[2]).sum();
            let [slope] = self.team.sum([own]);
            let descends = end != End::NotFinite && slope < 0.0 && slope.is_finite();
            if matches!(end, End::Converged | End::Limit) && descends {
                solution.truncated = end == End::Limit;
                return Ok(Some(solution));
            }
            if must_be_definite {
                return Ok(None);
            }
            // Conjugate gradients that end at negative curvature return a direction of descent.
            if end == End::NegativeCurvature && descends {
                solution.truncated = true;
                return Ok(Some(solution));
            }
            let shift = if solution.shift == 0.0 { 1.0 } else { 10.0 * solution.shift };
            if shift > 1e12 {
                // PETSc does not name the node.
                return Err(StepError::from(NewtonError::NotPositive { node: 0, shift: 1e12 }).into());
            }
            let added = shift - solution.shift;
            let mut matrix_free = self.matrix_free.borrow_mut();
            for node in 0..x.len() {
                matrix_free.stiffness.add_to_diagonal(node, added * objective.regularisation(node));
            }
            solution.shift = shift;
        }
    }

    /// Checks for unused options of the user. Options of the last level are checked only if there are levels.
    fn check_options(&mut self) -> Result<(), Error> {
        let is_with_levels = match self.form {
            Form::MatrixFree(_) => self.matrix_free.borrow().preconditioner.levels().is_some(),
            Form::Assembled(_) => true,
        };
        if !std::mem::replace(&mut self.is_checked[usize::from(is_with_levels)], true) {
            let mut names = self.team.library.unused_options()?;
            names.retain(|name| is_with_levels || !name.starts_with("coarse_"));
            if !names.is_empty() {
                let names: Vec<_> = names.iter().map(|name| format!("-{name}")).collect();
                return Err(Error::usage(format!(
                    "PETSc does not use {}: the name is misspelt, or belongs to a solver that is not in use",
                    names.join(", ")
                )));
            }
        }
        Ok(())
    }
}

impl Machine for LinearSystem {
    type Nodes = RowsOfRank;

    fn nodes(&self) -> &RowsOfRank {
        &self.nodes
    }

    fn nodes_mut(&mut self) -> &mut RowsOfRank {
        &mut self.nodes
    }

    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn begin(&mut self) {
        self.matrix_free.borrow_mut().preconditioner.forget();
        if let Form::Assembled(assembled) = &mut self.form {
            assembled.pace = None;
        }
    }

    fn with_stiffness<T>(&mut self, work: impl FnOnce(&mut NodalStiffness) -> T) -> T {
        work(&mut self.matrix_free.borrow_mut().stiffness)
    }

    fn solve(
        &mut self,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, NewtonError> {
        let owned = self.shares.len();
        let system = System { gradient: &system.gradient[..owned], ..system };
        match self.find_direction(system, &mut direction[..owned]) {
            Err(Error::Step(StepError::Newton(error @ NewtonError::NotPositive { .. }))) => Err(error),
            // An earlier exchange may have failed, too.
            found => match self.team.note(found) {
                Some(solution) if !self.team.has_failed() => Ok(solution),
                _ => Err(LinearError::External.into()),
            },
        }
    }
}

/// Solves with piola's preconditioner, and again with a new one if the first needs too many iterations. The
/// argument of `solve` is a limit of iterations.
fn matrix_free_solve(
    matrix_free: &RefCell<MatrixFree>,
    x: &[[f64; 3]],
    inertia: impl Fn(usize) -> f64,
    tolerance: f64,
    max_iterations: usize,
    mut solve: impl FnMut(usize) -> Result<Iteration, PetscError>,
) -> Result<Iteration, Error> {
    let mut given_up = 0;
    loop {
        let limit = {
            let MatrixFree { stiffness, preconditioner, is_free, team, .. } = &mut *matrix_free.borrow_mut();
            let taken = preconditioner.take(stiffness, is_free, x, &inertia);
            team.take_failure()?;
            taken?;
            preconditioner.patience(tolerance).min(max_iterations - given_up)
        };
        let mut iteration = solve(limit)?;
        let again = matrix_free.borrow_mut().preconditioner.judge(iteration, tolerance);
        iteration.iterations += given_up;
        if !again || iteration.iterations >= max_iterations {
            return Ok(iteration);
        }
        given_up = iteration.iterations;
    }
}

/// Whole matrix of PETSc, and solvers with preconditioners of PETSc.
struct Assembled {
    /// Global number of each node among the free nodes; `None` for a pinned node.
    numbers: Vec<Option<usize>>,
    matrix: Rc<Matrix>,
    krylov: Krylov,
    fallback: Krylov,
    places: Vector,
    values: Vec<f64>,
    /// Number of iterations per digit directly after the set-up of the preconditioner; `None` before.
    pace: Option<f64>,
}

impl Assembled {
    /// Computes the places of all entries.
    fn new(team: &Team, share: &Share, stiffness: &NodalStiffness) -> Result<Self, Error> {
        let library = &team.library;
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
            (0..9).map(move |entry| [3 * row + entry / 3, 3 * column + entry % 3])
        };
        let matrix = Matrix::new(library, 3 * share.free, 3, blocks.iter().copied().flat_map(entries))?;
        let matrix = Rc::new(matrix);
        Ok(Self {
            numbers: share.free_numbers.clone(),
            krylov: Krylov::new(library, matrix.clone(), "", None)?,
            fallback: Krylov::new(library, matrix.clone(), "fallback_", None)?,
            matrix,
            places: Vector::new(library, 3, share.free, &[])?,
            values: Vec::with_capacity(9 * blocks.len()),
            pace: None,
        })
    }

    /// Assembles the stiffness; the nodes are at `positions`, m.
    fn assemble(&mut self, stiffness: &NodalStiffness, positions: &[[f64; 3]]) -> Result<(), PetscError> {
        let is_free = |node: usize| self.numbers[node].is_some();
        self.values.clear();
        for (row, column, entries) in stiffness.blocks() {
            if is_free(row) && is_free(column) {
                self.values.extend(entries.as_flattened());
                if row != column {
                    self.values.extend((0..9).map(|at| entries[at % 3][at / 3]));
                }
            }
        }
        self.matrix.set_values(&self.values)?;
        self.places.with::<3>(|places| places.copy_from_slice(&positions[..places.len()]))?;
        self.matrix.set_rigid_motions(&self.places)
    }

    /// Solves, and uses the fallback if the matrix or its preconditioner is found to be indefinite. The
    /// arguments of `solve` are a solver and a limit of iterations.
    ///
    /// The preconditioner of an earlier matrix is used while it converges fast enough, because the set-up of
    /// a new one takes as long as many iterations.
    fn solve(
        &mut self,
        tolerance: f64,
        max_iterations: usize,
        may_fall_back: bool,
        mut solve: impl FnMut(&mut Krylov, usize) -> Result<Iteration, PetscError>,
    ) -> Result<Iteration, PetscError> {
        let Self { krylov, fallback, pace, .. } = self;
        let digits = -tolerance.log10();
        let mut given_up = 0;
        if let Some(pace) = *pace {
            krylov.keep_preconditioner(true)?;
            let patience = ((PATIENCE * pace * digits).ceil() as usize).clamp(1, max_iterations);
            let iteration = solve(krylov, patience)?;
            if iteration.end == End::Converged {
                return Ok(iteration);
            }
            given_up = iteration.iterations;
        }
        krylov.keep_preconditioner(false)?;
        let mut iteration = solve(krylov, max_iterations)?;
        let is_solved = iteration.end == End::Converged;
        *pace = is_solved.then(|| iteration.iterations.max(1) as f64 / digits.max(1e-3));
        if may_fall_back && matches!(iteration.end, End::NegativeCurvature | End::NotFinite) {
            given_up += iteration.iterations;
            iteration = solve(fallback, max_iterations)?;
        }
        iteration.iterations += given_up;
        Ok(iteration)
    }
}
