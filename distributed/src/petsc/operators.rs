//! Functions that PETSc calls: the product with a stiffness, and a preconditioner.

use std::cell::RefCell;
use std::ffi::c_void;
use std::ptr::null_mut;
use std::rc::Rc;

use super::vector::{with_entries, with_given};
use super::{Krylov, MESSAGE, PetscError, check, ffi, string};

/// Stiffness and preconditioner as functions that PETSc calls. Their vectors have the unknowns of the free
/// nodes of this rank.
pub trait Operators {
    /// Replaces `product`, N, by the product of the stiffness with a displacement, m.
    fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Replaces `z`, m, by an approximation of A⁻¹ r.
    fn precondition(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Description of the preconditioner for `-ksp_view`, and the solver within it.
    fn view(&self) -> (String, Option<&Krylov>);
}

/// Context of PETSc's objects that are functions.
pub(super) type Shared = Rc<RefCell<dyn Operators>>;

/// Calls an operator for vectors of PETSc. The message of an error is kept like a message of PETSc.
fn call(
    operators: *mut c_void,
    x: ffi::Vec,
    y: ffi::Vec,
    work: impl FnOnce(&mut dyn Operators, &[[f64; 3]], &mut [[f64; 3]]) -> Result<(), PetscError>,
) -> ffi::PetscErrorCode {
    // SAFETY: contexts are created from boxes of this type, which exist as long as the object of PETSc that
    // refers to them.
    let operators: &Shared = unsafe { &*operators.cast() };
    let done = with_given(x, |x| {
        let mut done = Ok(());
        let mut operators = operators.borrow_mut();
        with_entries(y, x.len(), |y| done = work(&mut *operators, x.as_chunks().0, y.as_chunks_mut().0))?;
        done
    });
    let Err(error) = done.and_then(|done| done) else { return 0 };
    MESSAGE.with(|message| *message.borrow_mut() = Some(error.message));
    FAILED
}

/// Value of the C macro PETSC_ERR_LIB: an error in a library that PETSc calls.
const FAILED: ffi::PetscErrorCode = 76;

/// Computes the product of a matrix that is a function.
///
/// # Safety
/// `matrix` must be a result of [`Matrix::of_function`](super::Matrix::of_function).
pub(super) unsafe extern "C" fn multiply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> ffi::PetscErrorCode {
    let mut operators: *mut c_void = null_mut();
    // SAFETY: the matrix exists, and its context is a pointer, which goes to a variable that outlives the
    // call.
    match unsafe { ffi::MatShellGetContext(matrix, (&raw mut operators).cast()) } {
        0 => call(operators, x, y, |operators, x, product| operators.multiply(x, product)),
        code => code,
    }
}

/// Applies a preconditioner that is a function.
///
/// # Safety
/// `preconditioner` must have been set by [`Krylov::precondition_by`](super::Krylov::precondition_by).
pub(super) unsafe extern "C" fn precondition(
    preconditioner: ffi::PC,
    r: ffi::Vec,
    z: ffi::Vec,
) -> ffi::PetscErrorCode {
    let mut operators: *mut c_void = null_mut();
    // SAFETY: as in `multiply`.
    match unsafe { ffi::PCShellGetContext(preconditioner, (&raw mut operators).cast()) } {
        0 => call(operators, r, z, |operators, r, z| operators.precondition(r, z)),
        code => code,
    }
}

/// Shows a preconditioner that is a function, and the solver within it.
///
/// # Safety
/// `preconditioner` must have been set by [`Krylov::precondition_by`](super::Krylov::precondition_by).
pub(super) unsafe extern "C" fn view(
    preconditioner: ffi::PC,
    viewer: ffi::PetscViewer,
) -> ffi::PetscErrorCode {
    let mut operators: *mut c_void = null_mut();
    // SAFETY: as in `multiply`.
    let code = unsafe { ffi::PCShellGetContext(preconditioner, (&raw mut operators).cast()) };
    if code != 0 {
        return code;
    }
    // SAFETY: as in `call`.
    let operators: &Shared = unsafe { &*operators.cast() };
    let operators = operators.borrow();
    let (text, within) = operators.view();
    let Ok(text) = string(&text) else { return FAILED };
    // SAFETY: the viewer is PETSc's, the format has one C string, and the solver exists.
    let shown = unsafe {
        check(ffi::PetscViewerASCIIPrintf(viewer, c"  %s\n".as_ptr(), text.as_ptr()))
            .and_then(|()| check(ffi::PetscViewerASCIIPushTab(viewer)))
            .and_then(|()| within.map_or(Ok(()), |within| check(ffi::KSPView(within.raw, viewer))))
            .and_then(|()| check(ffi::PetscViewerASCIIPopTab(viewer)))
    };
    if shown.is_ok() { 0 } else { FAILED }
}
