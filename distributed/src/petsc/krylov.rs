//! Krylov solvers of PETSc, and their preconditioners.

use std::ptr::null_mut;
use std::rc::Rc;

use piola_bodies::step::divided::{End, Iteration};

use super::operators::{Shared, precondition, view};
use super::{Library, Matrix, PetscError, Vector, check, ffi, int, string};

/// Solver of linear systems, configured by the options of PETSc.
pub(crate) struct Krylov {
    pub(super) raw: ffi::KSP,
    /// Matrix to which the solver refers, and its operators, to which the preconditioner refers.
    matrix: Rc<Matrix>,
}

impl Krylov {
    /// Solver for a matrix by conjugate gradients or, with `once`, by a preconditioner of this kind that is
    /// applied once, unless options with the prefix `prefix` select another one. Operators of the matrix are
    /// the preconditioner that has the type `shell` in options.
    ///
    /// # Errors
    /// [`PetscError`], also for an option with a value that PETSc does not support.
    pub(crate) fn new(
        library: &Library,
        matrix: Rc<Matrix>,
        prefix: &str,
        once: Option<&str>,
    ) -> Result<Self, PetscError> {
        let mut raw = null_mut();
        // SAFETY: the result goes to a variable that outlives the call.
        check(unsafe { ffi::KSPCreate(library.comm(), &mut raw) })?;
        let mat = matrix.raw;
        let solver = Self { raw, matrix };
        let kind = string(if once.is_some() { "preonly" } else { "cg" })?;
        let (prefix, once) = (string(prefix)?, once.map(string).transpose()?);
        // SAFETY: solver, preconditioner and matrix exist, and all texts are C strings, which PETSc copies.
        unsafe {
            check(ffi::KSPSetOptionsPrefix(raw, prefix.as_ptr()))?;
            check(ffi::KSPSetType(raw, kind.as_ptr()))?;
            check(ffi::KSPSetOperators(raw, mat, mat))?;
            match once {
                Some(once) => check(ffi::PCSetType(solver.preconditioner()?, once.as_ptr()))?,
                None => check(ffi::KSPSetNormType(raw, ffi::KSPNormType_KSP_NORM_UNPRECONDITIONED))?,
            }
            check(ffi::KSPSetFromOptions(raw))?;
        }
        if let Some(operators) = &solver.matrix.operators {
            let preconditioner = solver.preconditioner()?;
            let context: *const Shared = &raw const **operators;
            // SAFETY: the preconditioner exists, the name is a C string, which PETSc copies, the context
            // exists as long as the matrix, which the solver holds, and the functions have the signatures
            // that PETSc requires.
            unsafe {
                check(ffi::PCShellSetContext(preconditioner, context.cast_mut().cast()))?;
                check(ffi::PCShellSetApply(preconditioner, Some(precondition)))?;
                check(ffi::PCShellSetView(preconditioner, Some(view)))?;
                check(ffi::PCShellSetName(preconditioner, c"piola".as_ptr()))?;
            }
        }
        Ok(solver)
    }

    fn preconditioner(&self) -> Result<ffi::PC, PetscError> {
        let mut preconditioner = null_mut();
        // SAFETY: the solver exists, and the result goes to a variable that outlives the call.
        check(unsafe { ffi::KSPGetPC(self.raw, &mut preconditioner) })?;
        Ok(preconditioner)
    }

    /// Keeps the preconditioner for the next system, or sets up a new one.
    pub(crate) fn keep_preconditioner(&mut self, keep: bool) -> Result<(), PetscError> {
        let keep = if keep { ffi::PetscBool_PETSC_TRUE } else { ffi::PetscBool_PETSC_FALSE };
        // SAFETY: the solver exists.
        check(unsafe { ffi::KSPSetReusePreconditioner(self.raw, keep) })
    }

    /// Solves A x = b from x = 0 to a residual of `tolerance` times |b|.
    pub(crate) fn solve(
        &mut self,
        b: &Vector,
        x: &mut Vector,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<Iteration, PetscError> {
        let matrix = self.matrix.raw;
        let (mut reason, mut iterations) = (0, 0);
        // SAFETY: solver, matrix and vectors exist, and the results outlive the calls.
        unsafe {
            check(ffi::KSPSetOperators(self.raw, matrix, matrix))?;
            check(ffi::KSPSetTolerances(self.raw, tolerance, 1e-300, 1e10, int(max_iterations)?))?;
            check(ffi::KSPSolve(self.raw, b.raw, x.raw))?;
            check(ffi::KSPGetConvergedReason(self.raw, &mut reason))?;
            check(ffi::KSPGetIterationNumber(self.raw, &mut iterations))?;
        }
        let end = match reason {
            reason if reason > 0 => End::Converged,
            ffi::KSPConvergedReason_KSP_DIVERGED_INDEFINITE_MAT
            | ffi::KSPConvergedReason_KSP_DIVERGED_INDEFINITE_PC => End::NegativeCurvature,
            ffi::KSPConvergedReason_KSP_DIVERGED_NANORINF
            | ffi::KSPConvergedReason_KSP_DIVERGED_PC_FAILED => End::NotFinite,
            _ => End::Limit,
        };
        Ok(Iteration { iterations: usize::try_from(iterations).unwrap_or(0), end })
    }

    /// Solves A x = b to the tolerance of the options.
    pub(crate) fn apply(&mut self, b: &Vector, x: &mut Vector) -> Result<(), PetscError> {
        // SAFETY: solver and vectors exist.
        check(unsafe { ffi::KSPSolve(self.raw, b.raw, x.raw) })
    }
}

destroyed!(Krylov, ffi::KSPDestroy);
