//! Last level of piola's multigrid, solved by PETSc: a matrix with six unknowns for each row, and its solver.
//!
//! The solver has all options of PETSc, with the prefix `coarse_`. This module does not depend on bodies.

use std::rc::Rc;

use piola_bodies::step::divided::{LastLevel, LastSolver};

use crate::petsc::{Krylov, Matrix, PetscError, Vector};
use crate::team::Team;

/// Default options of PETSc for the solver of the last level.
const DEFAULTS: &[(&str, &str)] = &[
    ("coarse_redundant_pc_type", "cholesky"),
    ("coarse_redundant_pc_factor_shift_type", "positive_definite"),
    ("coarse_pc_gamg_threshold", "0.01"),
    ("coarse_mg_levels_ksp_max_it", "2"),
    ("coarse_mg_levels_pc_type", "jacobi"),
];

/// Largest number of rows for which every rank factors the whole matrix: multigrid would not reduce it
/// further.
const FACTORED: usize = 512;

/// Tolerance of linear dependence: norm of the orthogonal part of a motion, relative to the motion.
const DEPENDENT: f64 = 1e-9;

/// Solver of the last level of piola's multigrid.
pub(crate) struct Coarse {
    /// Solver of PETSc, for `-ksp_view`.
    pub(crate) krylov: Krylov,
    b: Vector,
    x: Vector,
    team: Team,
}

impl Coarse {
    /// Sets up a solver for a level of which this rank owns `owned` rows. `numbers` are the global numbers of
    /// all rows of this rank, copies of rows of other ranks last. Errors of solutions are noted by the team.
    ///
    /// # Errors
    /// [`PetscError`], also for an option with a value that PETSc does not support.
    pub(crate) fn new(
        team: &Team,
        owned: usize,
        numbers: &[usize],
        level: &LastLevel<'_>,
    ) -> Result<Self, PetscError> {
        let library = &team.library;
        for (name, value) in DEFAULTS {
            library.default_option(name, value)?;
        }
        let mut places = Vec::new();
        let mut values = Vec::new();
        for (row, column, block) in level.blocks() {
            for r in 0..6 {
                for c in 0..6 {
                    let place = [6 * numbers[row] + r, 6 * numbers[column] + c];
                    places.push(place);
                    values.push(block[r][c]);
                    if row != column {
                        places.push([place[1], place[0]]);
                        values.push(block[r][c]);
                    }
                }
            }
        }
        let matrix = Matrix::new(library, 6 * owned, 6, places.iter().copied())?;
        matrix.set_values(&values)?;
        let kind = if team.count(owned) <= FACTORED { "redundant" } else { "gamg" };
        matrix.set_motions(&orthonormal(team, level.motions)?)?;
        let vector = || Vector::new(library, 6, owned, &[]);
        Ok(Self {
            krylov: Krylov::new(library, Rc::new(matrix), "coarse_", Some(kind))?,
            b: vector()?,
            x: vector()?,
            team: team.clone(),
        })
    }

    fn replace(&mut self, b: &mut [[f32; 6]]) -> Result<(), PetscError> {
        self.b.with::<6>(|entries| {
            entries.iter_mut().zip(&*b).for_each(|(entry, b)| *entry = b.map(f64::from));
        })?;
        self.krylov.apply(&self.b, &mut self.x)?;
        self.x.with::<6>(|x| b.iter_mut().zip(x).for_each(|(b, x)| *b = x.map(|x| x as f32)))
    }
}

impl LastSolver for Coarse {
    fn solve(&mut self, b: &mut [[f32; 6]]) {
        let done = self.replace(b);
        self.team.note(done);
    }
}

/// Orthonormal basis of the columns of these blocks; dependent columns are left out.
fn orthonormal(team: &Team, motions: &[[[f64; 6]; 6]]) -> Result<Vec<Vector>, PetscError> {
    let mut found: Vec<Vec<[f64; 6]>> = Vec::new();
    let dot = |a: &[[f64; 6]], b: &[[f64; 6]]| {
        team.sum([a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()])[0]
    };
    for c in 0..6 {
        let mut motion: Vec<[f64; 6]> = motions.iter().map(|block| block.map(|row| row[c])).collect();
        let before = dot(&motion, &motion).sqrt();
        // Gram–Schmidt orthogonalisation, twice.
        for other in found.iter().chain(&found) {
            let along = dot(other, &motion);
            for (x, other) in motion.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
                *x -= along * other;
            }
        }
        let length = dot(&motion, &motion).sqrt();
        if length > DEPENDENT * before {
            motion.as_flattened_mut().iter_mut().for_each(|x| *x /= length);
            found.push(motion);
        }
    }
    let vector = |motion: &Vec<[f64; 6]>| {
        let mut vector = Vector::new(&team.library, 6, motion.len(), &[])?;
        vector.with::<6>(|entries| entries.copy_from_slice(motion))?;
        Ok(vector)
    };
    found.iter().map(vector).collect()
}
