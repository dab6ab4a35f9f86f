//! Interface to PETSc: vectors of a divided body, sparse matrices, Krylov solvers, partitions of graphs.
//!
//! No module outside of this one calls PETSc or contains unsafe code. Each type owns one object of PETSc,
//! which it destroys when it is dropped; the library runs until then. All functions are collective: all ranks
//! must call them, in the same order. A [`PetscError`] has the message of the function of PETSc that failed.
//! This module does not depend on meshes or on materials.

#![expect(unsafe_code, reason = "PETSc is a C library: this is the interface to it")]

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::rc::Rc;

use mpi::environment::Universe;
use mpi::raw::AsRaw;
use mpi::topology::SimpleCommunicator;

use ffi::PetscInt;

/// Destroys the object of PETSc of a type when its owner is dropped.
macro_rules! destroyed {
    ($Type:ty, $destroy:path) => {
        impl Drop for $Type {
            fn drop(&mut self) {
                // SAFETY: the object exists, this is its only owner, and PETSc still runs, because the owner
                // has a handle of the library.
                let _ = unsafe { $destroy(&mut self.raw) };
            }
        }
    };
}

mod krylov;
mod matrix;
mod operators;
mod vector;

pub(crate) use krylov::Krylov;
pub(crate) use matrix::Matrix;
pub(crate) use operators::Operators;
pub(crate) use vector::Vector;

#[allow(
    clippy::all,
    dead_code,
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unreachable_pub,
    reason = "generated from C headers, which violate different lints in each version"
)]
mod ffi {
    include!(concat!(env!("OUT_DIR"), "/petsc_functions.rs"));
}

/// Error of PETSc.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("PETSc: {message}")]
pub struct PetscError {
    /// Message of the function that failed first.
    pub message: String,
}

fn int(number: usize) -> Result<PetscInt, PetscError> {
    let (bits, remedy) = (PetscInt::BITS, "build PETSc with 64-bit indices");
    let message = || format!("{number} does not fit into the {bits}-bit integers of this PETSc; {remedy}");
    PetscInt::try_from(number).map_err(|_| PetscError { message: message() })
}

/// Value of the C macros PETSC_DECIDE and PETSC_DETERMINE: a size that PETSc computes.
const DECIDE: PetscInt = -1;

thread_local! {
    /// Message of the first function that failed since the message was last removed.
    static MESSAGE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Error handler that keeps the message of the function that failed first, instead of printing it.
///
/// # Safety
/// `text` must be null or point to a C string.
unsafe extern "C" fn keep_message(
    _: mpi::ffi::MPI_Comm,
    _: c_int,
    _: *const c_char,
    _: *const c_char,
    code: ffi::PetscErrorCode,
    kind: ffi::PetscErrorType,
    text: *const c_char,
    _: *mut c_void,
) -> ffi::PetscErrorCode {
    if kind == ffi::PetscErrorType_PETSC_ERROR_INITIAL && !text.is_null() {
        // SAFETY: it is not null, and is then a C string by the condition on callers.
        let text = unsafe { CStr::from_ptr(text) }.to_string_lossy().trim().to_owned();
        // If the thread is about to end, nothing reads the message.
        let _ = MESSAGE.try_with(|message| message.try_borrow_mut().map(|mut message| *message = Some(text)));
    }
    code
}

fn check(code: ffi::PetscErrorCode) -> Result<(), PetscError> {
    if code == 0 {
        return Ok(());
    }
    let message = MESSAGE.with(|message| message.borrow_mut().take());
    Err(PetscError { message: message.unwrap_or_else(|| format!("error {code}")) })
}

/// Handle of MPI and PETSc, which run until the last handle, and the last object with one, is dropped.
#[derive(Clone)]
pub struct Library(Rc<Running>);

struct Running {
    world: SimpleCommunicator,
    /// Ends MPI, after PETSc has ended.
    _universe: Universe,
}

impl Drop for Running {
    fn drop(&mut self) {
        // SAFETY: PETSc was initialised before this was created, and none of its objects is left: each holds
        // a handle of this.
        let _ = unsafe { ffi::PetscFinalize() };
    }
}

impl Library {
    /// Starts MPI and PETSc with options of PETSc, with names without their dash.
    ///
    /// # Errors
    /// [`PetscError`] if MPI or PETSc cannot be started, or was started before.
    pub fn start(options: &[(String, Option<String>)]) -> Result<Self, PetscError> {
        // Partitioners such as PTScotch divide graphs on several threads, each of which sends messages to
        // other ranks. With a lower level of thread support they occasionally hang.
        let universe = mpi::initialize_with_threading(mpi::Threading::Multiple)
            .map(|(universe, _)| universe)
            .ok_or_else(|| PetscError { message: "MPI was started before".to_owned() })?;
        let world = universe.world();
        // Signals end the program, without a handler of PETSc.
        set_option("no_signal_handler", None)?;
        for (name, value) in options {
            set_option(name, value.as_deref())?;
        }
        // SAFETY: MPI runs, and PETSc does not: it is initialised only here, and MPI starts once in a
        // process.
        check(unsafe { ffi::PetscInitializeNoArguments() })?;
        // SAFETY: the handler has the signature that PETSc requires, exists as long as the program, and does
        // not need a context.
        check(unsafe { ffi::PetscPushErrorHandler(Some(keep_message), null_mut()) })?;
        Ok(Self(Rc::new(Running { world, _universe: universe })))
    }

    /// Communicator of all ranks.
    pub(crate) fn world(&self) -> &SimpleCommunicator {
        &self.0.world
    }

    /// Value of an option, of at most 63 bytes; `None` for an option that is not set.
    pub(crate) fn option(&self, name: &str) -> Result<Option<String>, PetscError> {
        let dashed = dashed(name)?;
        let (mut text, mut is_set): ([c_char; 64], _) = ([0; 64], ffi::PetscBool_PETSC_FALSE);
        // SAFETY: the name is a C string, PETSc writes a C string of at most the given number of bytes, and
        // the results go to variables that outlive the call.
        let text = unsafe {
            let (to, bytes) = (text.as_mut_ptr(), text.len());
            check(ffi::PetscOptionsGetString(null_mut(), null(), dashed.as_ptr(), to, bytes, &mut is_set))?;
            CStr::from_ptr(to)
        };
        Ok((is_set == ffi::PetscBool_PETSC_TRUE).then(|| text.to_string_lossy().into_owned()))
    }

    /// Sets an option, unless the user has set it.
    pub(crate) fn default_option(&self, name: &str, value: &str) -> Result<(), PetscError> {
        if self.option(name)?.is_none() {
            set_option(name, Some(value))?;
            // PETSc counts an option that has been read as used.
            self.option(name)?;
        }
        Ok(())
    }

    /// Options of the user that PETSc has not used up to now: they are misspelt, or belong to a solver that
    /// is not in use.
    pub(crate) fn unused_options(&self) -> Result<Vec<String>, PetscError> {
        let (mut count, mut names, mut values) = (0, null_mut(), null_mut());
        // SAFETY: the three results go to variables that outlive the call.
        check(unsafe { ffi::PetscOptionsLeftGet(null_mut(), &mut count, &mut names, &mut values) })?;
        let mut unused = Vec::new();
        for index in 0..usize::try_from(count).unwrap_or(0) {
            // SAFETY: `names` holds `count` C strings until they are released below.
            unused.push(unsafe { CStr::from_ptr(*names.add(index)) }.to_string_lossy().into_owned());
        }
        // SAFETY: these are the results of the call above, and none of the strings is used from here on.
        check(unsafe { ffi::PetscOptionsLeftRestore(null_mut(), &mut count, &mut names, &mut values) })?;
        Ok(unused)
    }

    fn comm(&self) -> mpi::ffi::MPI_Comm {
        self.0.world.as_raw()
    }
}

fn dashed(name: &str) -> Result<CString, PetscError> {
    string(&format!("-{name}"))
}

fn string(text: &str) -> Result<CString, PetscError> {
    CString::new(text).map_err(|_| PetscError { message: "an option contains a zero byte".to_owned() })
}

fn set_option(name: &str, value: Option<&str>) -> Result<(), PetscError> {
    let (name, value) = (dashed(name)?, value.map(string).transpose()?);
    let value = value.as_ref().map_or(null(), |value| value.as_ptr());
    // SAFETY: both are null or C strings, which PETSc copies; this is allowed before PETSc is initialised.
    check(unsafe { ffi::PetscOptionsSetValue(null_mut(), name.as_ptr(), value) })
}
