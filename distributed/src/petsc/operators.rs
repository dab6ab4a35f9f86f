//! Functions that PETSc calls: the product with a stiffness, and a preconditioner.

use std::cell::RefCell;
use std::ffi::c_void;
use std::ptr::null_mut;
use std::rc::Rc;

use super::vector::{with_entries, with_given};
use super::{Krylov, MESSAGE, PetscError, check, ffi, string};

/// Stiffness and preconditioner as functions that PETSc calls. Their vectors have the unknowns of the free
/// nodes of this rank.
pub(crate) trait Operators {
    /// Replaces `product`, N, by the product of the stiffness with a displacement, m.
    fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Replaces `z`, m, by an approximation of A⁻¹ r.
    fn precondition(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Description of the preconditioner for `-ksp_view`, and the solver within it.
    fn view(&self) -> (String, Option<&Krylov>);
}

/// Context of PETSc's objects that are functions.
pub(super) type Shared = Rc<RefCell<dyn Operators>>;

/// Value of the C macro PETSC_ERR_LIB: an error in a library that PETSc calls.
const FAILED: ffi::PetscErrorCode = 76;

/// Calls `work` with the operators that are the context of an object of PETSc, which `context` writes. The
/// message of an error is kept like a message of PETSc.
fn call(
    context: impl FnOnce(*mut *mut c_void) -> ffi::PetscErrorCode,
    work: impl FnOnce(&Shared) -> Result<(), PetscError>,
) -> ffi::PetscErrorCode {
    let mut operators: *mut c_void = null_mut();
    let done = check(context(&raw mut operators)).and_then(|()| {
        // SAFETY: contexts are created from boxes of this type, which exist as long as the object of PETSc
        // that refers to them.
        work(unsafe { &*operators.cast::<Shared>() })
    });
    let Err(error) = done else { return 0 };
    MESSAGE.with(|message| *message.borrow_mut() = Some(error.message));
    FAILED
}

/// Calls `work` with the entries of two vectors of PETSc, the second of which it writes.
fn with_vectors(
    x: ffi::Vec,
    y: ffi::Vec,
    work: impl FnOnce(&[[f64; 3]], &mut [[f64; 3]]) -> Result<(), PetscError>,
) -> Result<(), PetscError> {
    with_given(x, |x| {
        let mut done = Ok(());
        with_entries(y, x.len(), |y| done = work(x.as_chunks().0, y.as_chunks_mut().0))?;
        done
    })?
}

/// Computes the product of a matrix that is a function.
///
/// # Safety
/// `matrix` must be a result of [`Matrix::of_function`](super::Matrix::of_function).
pub(super) unsafe extern "C" fn multiply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> ffi::PetscErrorCode {
    // SAFETY: the matrix exists, and its context is a pointer, which goes to a variable that outlives the
    // call.
    let context = |to: *mut *mut c_void| unsafe { ffi::MatShellGetContext(matrix, to.cast()) };
    call(context, |operators| with_vectors(x, y, |x, product| operators.borrow_mut().multiply(x, product)))
}

/// Applies a preconditioner that is a function.
///
/// # Safety
/// `preconditioner` must be that of a [`Krylov`] for a matrix with operators.
pub(super) unsafe extern "C" fn precondition(
    preconditioner: ffi::PC,
    r: ffi::Vec,
    z: ffi::Vec,
) -> ffi::PetscErrorCode {
    // SAFETY: as in `multiply`.
    let context = |to: *mut *mut c_void| unsafe { ffi::PCShellGetContext(preconditioner, to.cast()) };
    call(context, |operators| with_vectors(r, z, |r, z| operators.borrow_mut().precondition(r, z)))
}

/// Shows a preconditioner that is a function, and the solver within it.
///
/// # Safety
/// `preconditioner` must be that of a [`Krylov`] for a matrix with operators.
pub(super) unsafe extern "C" fn view(
    preconditioner: ffi::PC,
    viewer: ffi::PetscViewer,
) -> ffi::PetscErrorCode {
    // SAFETY: as in `multiply`.
    let context = |to: *mut *mut c_void| unsafe { ffi::PCShellGetContext(preconditioner, to.cast()) };
    call(context, |operators| {
        let operators = operators.borrow();
        let (text, within) = operators.view();
        let text = string(&text)?;
        // SAFETY: the viewer is PETSc's, the format has one C string, and the solver exists.
        unsafe {
            check(ffi::PetscViewerASCIIPrintf(viewer, c"  %s\n".as_ptr(), text.as_ptr()))?;
            check(ffi::PetscViewerASCIIPushTab(viewer))?;
            if let Some(within) = within {
                check(ffi::KSPView(within.raw, viewer))?;
            }
            check(ffi::PetscViewerASCIIPopTab(viewer))
        }
    })
}
