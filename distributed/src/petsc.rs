//! The border to PETSc: vectors of a divided body, sparse matrices, Krylov solvers, partitions of graphs.
//!
//! No other module calls PETSc, and no other has code that the compiler cannot check. Each type owns one
//! object of PETSc, keeps the library running while it lives, and destroys it in the end. All functions are
//! collective: every rank calls them, in one order. This module knows no meshes and no materials.

#![expect(unsafe_code, reason = "PETSc is a library of C: this is its border")]

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::rc::Rc;

use mpi::environment::Universe;
use mpi::raw::AsRaw;
use mpi::topology::SimpleCommunicator;

use ffi::PetscInt;

#[allow(
    clippy::all,
    dead_code,
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unreachable_pub,
    reason = "generated from headers of C, of which each version breaks others of these"
)]
mod ffi {
    include!(concat!(env!("OUT_DIR"), "/petsc_functions.rs"));
}

/// What PETSc says has failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("PETSc: {message}")]
pub struct PetscError {
    /// The message of the function that failed first.
    pub message: String,
}

/// A number that PETSc's integers do not hold.
fn too_large(number: usize) -> PetscError {
    let bits = PetscInt::BITS;
    PetscError {
        message: format!(
            "this PETSc counts with {bits} bits, and {number} does not fit; build it with 64-bit indices"
        ),
    }
}

fn int(number: usize) -> Result<PetscInt, PetscError> {
    PetscInt::try_from(number).map_err(|_| too_large(number))
}

/// What PETSc calls PETSC_DECIDE and PETSC_DETERMINE, macros of C: a size that it finds itself.
const DECIDE: PetscInt = -1;

thread_local! {
    /// The message of the first function that has failed since it was taken last.
    static MESSAGE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Keeps the message of the function that failed first, in place of printing it.
///
/// # Safety
/// `text` must be null or point to a string of C.
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
        // SAFETY: it is not null, and the caller says that it is then a string of C.
        let text = unsafe { CStr::from_ptr(text) }.to_string_lossy().trim().to_owned();
        // Where the thread is about to end there is nobody left to read it.
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

/// MPI and PETSc, running until the last handle and the last object that it was given to is gone.
#[derive(Clone)]
pub struct Library(Rc<Running>);

struct Running {
    world: SimpleCommunicator,
    /// Ends MPI, after PETSc has ended.
    _universe: Universe,
    /// Options that were set here unless a user had set them.
    defaults: RefCell<Vec<String>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        // SAFETY: PETSc was initialised when this was made, and no object of it is left: each holds a handle
        // of this.
        let _ = unsafe { ffi::PetscFinalize() };
    }
}

impl Library {
    /// Starts MPI and PETSc with options of PETSc, names without their dash.
    ///
    /// # Errors
    /// [`PetscError`] if MPI or PETSc cannot be started, or has been before.
    pub fn start(options: &[(String, Option<String>)]) -> Result<Self, PetscError> {
        let failed = |message: &str| PetscError { message: message.to_owned() };
        // Partitioners such as PTScotch divide graphs on several threads, each of which talks to other ranks:
        // on fewer rights than these they hang now and then.
        let universe = mpi::initialize_with_threading(mpi::Threading::Multiple)
            .map(|(universe, _)| universe)
            .ok_or_else(|| failed("MPI has been started before"))?;
        let world = universe.world();
        // Signals end the program as they end others.
        set_option("no_signal_handler", None)?;
        for (name, value) in options {
            set_option(name, value.as_deref())?;
        }
        // SAFETY: MPI runs, and PETSc does not: only here it is initialised, and MPI starts once in a
        // process.
        check(unsafe { ffi::PetscInitializeNoArguments() })?;
        // SAFETY: the handler has the signature that PETSc asks for, lives as long as the program and needs
        // no context.
        check(unsafe { ffi::PetscPushErrorHandler(Some(keep_message), null_mut()) })?;
        Ok(Self(Rc::new(Running { world, _universe: universe, defaults: RefCell::default() })))
    }

    /// All ranks.
    #[must_use]
    pub fn world(&self) -> &SimpleCommunicator {
        &self.0.world
    }

    /// Sets an option unless the user has.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn default_option(&self, name: &str, value: &str) -> Result<(), PetscError> {
        let dashed = dashed(name)?;
        let mut is_set = ffi::PetscBool_PETSC_FALSE;
        // SAFETY: the name is a string of C, and the answer goes to a variable that outlives the call.
        check(unsafe { ffi::PetscOptionsHasName(null_mut(), null(), dashed.as_ptr(), &mut is_set) })?;
        if is_set == ffi::PetscBool_PETSC_FALSE {
            set_option(name, Some(value))?;
            self.0.defaults.borrow_mut().push(name.to_owned());
        }
        Ok(())
    }

    /// Options of the user that nothing has asked for so far: they are misspelt, or belong to what is not in
    /// use.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn unused_options(&self) -> Result<Vec<String>, PetscError> {
        let (mut count, mut names, mut values) = (0, null_mut(), null_mut());
        // SAFETY: the three answers go to variables that outlive the call.
        check(unsafe { ffi::PetscOptionsLeftGet(null_mut(), &mut count, &mut names, &mut values) })?;
        let mut unused = Vec::new();
        for index in 0..usize::try_from(count).unwrap_or(0) {
            // SAFETY: `names` holds `count` strings of C until they are given back below.
            let name = unsafe { CStr::from_ptr(*names.add(index)) }.to_string_lossy().into_owned();
            if !self.0.defaults.borrow().contains(&name) {
                unused.push(name);
            }
        }
        // SAFETY: these are the answers of the call above, and no string of them is used from here on.
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
    CString::new(text).map_err(|_| PetscError { message: "an option holds a zero byte".to_owned() })
}

fn set_option(name: &str, value: Option<&str>) -> Result<(), PetscError> {
    let (name, value) = (dashed(name)?, value.map(string).transpose()?);
    let value = value.as_ref().map_or(null(), |value| value.as_ptr());
    // SAFETY: both are null or strings of C, which PETSc copies; it allows this before it is initialised.
    check(unsafe { ffi::PetscOptionsSetValue(null_mut(), name.as_ptr(), value) })
}

/// A vector of three components for each node, of which each rank owns some and has copies of others.
pub struct GhostedVector {
    _library: Library,
    raw: ffi::Vec,
    local: usize,
    owned: usize,
}

impl GhostedVector {
    /// A vector of so many nodes of this rank, which are numbered one rank after another, and copies of the
    /// nodes with the numbers `ghosts`.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn new(library: &Library, owned: usize, ghosts: &[usize]) -> Result<Self, PetscError> {
        let numbers: Vec<PetscInt> = ghosts.iter().map(|&number| int(number)).collect::<Result<_, _>>()?;
        let mut raw = null_mut();
        // SAFETY: there are as many numbers as the call says, which PETSc copies, and the answer outlives it.
        check(unsafe {
            ffi::VecCreateGhostBlock(
                library.comm(),
                3,
                int(3 * owned)?,
                DECIDE,
                int(ghosts.len())?,
                numbers.as_ptr(),
                &mut raw,
            )
        })?;
        Ok(Self { _library: library.clone(), raw, local: owned + ghosts.len(), owned })
    }

    /// Begins to send the owned entries to the ranks that have copies.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn begin_copies(&mut self, owned: &[[f64; 3]]) -> Result<(), PetscError> {
        self.with_local(|entries| entries.iter_mut().zip(owned).for_each(|(entry, &x)| *entry = x))?;
        self.update(true, ffi::InsertMode_INSERT_VALUES, ffi::ScatterMode_SCATTER_FORWARD)
    }

    /// Waits for the copies, and stores them.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn end_copies(&mut self, ghosts: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.update(false, ffi::InsertMode_INSERT_VALUES, ffi::ScatterMode_SCATTER_FORWARD)?;
        let owned = self.owned;
        self.with_local(|entries| ghosts.iter_mut().zip(&entries[owned..]).for_each(|(ghost, &x)| *ghost = x))
    }

    /// Begins to send what this rank adds to nodes that others own; `all` holds its owned nodes, then its
    /// copies.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn begin_sum(&mut self, all: &[[f64; 3]]) -> Result<(), PetscError> {
        self.with_local(|entries| entries.iter_mut().zip(all).for_each(|(entry, &x)| *entry = x))?;
        self.update(true, ffi::InsertMode_ADD_VALUES, ffi::ScatterMode_SCATTER_REVERSE)
    }

    /// Waits for what other ranks add, and stores the sums of the owned nodes.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn end_sum(&mut self, owned: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.update(false, ffi::InsertMode_ADD_VALUES, ffi::ScatterMode_SCATTER_REVERSE)?;
        self.with_local(|entries| owned.iter_mut().zip(&*entries).for_each(|(sum, &x)| *sum = x))
    }

    /// Begins an update, or ends the one that was begun.
    fn update(
        &mut self,
        begins: bool,
        mode: ffi::InsertMode,
        direction: ffi::ScatterMode,
    ) -> Result<(), PetscError> {
        let step = if begins { ffi::VecGhostUpdateBegin } else { ffi::VecGhostUpdateEnd };
        // SAFETY: the vector was made by `VecCreateGhostBlock` and is not destroyed before this.
        check(unsafe { step(self.raw, mode, direction) })
    }

    /// Works on the owned entries and the copies.
    fn with_local(&mut self, work: impl FnOnce(&mut [[f64; 3]])) -> Result<(), PetscError> {
        let mut form = null_mut();
        // SAFETY: the vector has copies, and the answer outlives the call.
        check(unsafe { ffi::VecGhostGetLocalForm(self.raw, &mut form) })?;
        let done = with_entries(form, self.local, work);
        // SAFETY: the form is that of the call above, and its entries are given back.
        check(unsafe { ffi::VecGhostRestoreLocalForm(self.raw, &mut form) })?;
        done
    }
}

/// Works on the entries of a vector that this rank holds, three for each of so many nodes.
fn with_entries(raw: ffi::Vec, nodes: usize, work: impl FnOnce(&mut [[f64; 3]])) -> Result<(), PetscError> {
    let mut entries = null_mut();
    // SAFETY: the vector exists, and the answer outlives the call.
    check(unsafe { ffi::VecGetArray(raw, &mut entries) })?;
    if nodes > 0 && !entries.is_null() {
        // SAFETY: vectors are made with three entries for each of so many nodes on this rank, f64 as in all
        // PETSc of real numbers, and nobody else has the array until it is given back. An array of three has
        // the alignment of one.
        work(unsafe { std::slice::from_raw_parts_mut(entries.cast::<[f64; 3]>(), nodes) });
    }
    // SAFETY: the array is that of the call above, and the slice made of it is gone.
    check(unsafe { ffi::VecRestoreArray(raw, &mut entries) })
}

impl Drop for GhostedVector {
    fn drop(&mut self) {
        // SAFETY: the vector exists, this is its only owner, and PETSc still runs.
        let _ = unsafe { ffi::VecDestroy(&mut self.raw) };
    }
}

/// A vector of unknowns, three for each node.
pub struct Vector {
    _library: Library,
    raw: ffi::Vec,
    nodes: usize,
}

impl Vector {
    /// Zeros for so many nodes of this rank.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn new(library: &Library, nodes: usize) -> Result<Self, PetscError> {
        let mut raw = null_mut();
        // SAFETY: the answer goes to a variable that outlives the call.
        check(unsafe { ffi::VecCreateMPI(library.comm(), int(3 * nodes)?, DECIDE, &mut raw) })?;
        let vector = Self { _library: library.clone(), raw, nodes };
        // SAFETY: the vector exists, and three divides the number of its entries on each rank.
        check(unsafe { ffi::VecSetBlockSize(raw, 3) })?;
        Ok(vector)
    }

    /// Works on the entries of this rank.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn with(&mut self, work: impl FnOnce(&mut [[f64; 3]])) -> Result<(), PetscError> {
        with_entries(self.raw, self.nodes, work)
    }
}

impl Drop for Vector {
    fn drop(&mut self) {
        // SAFETY: the vector exists, this is its only owner, and PETSc still runs.
        let _ = unsafe { ffi::VecDestroy(&mut self.raw) };
    }
}

/// A square sparse matrix in compressed rows, divided among the ranks by rows.
pub struct Matrix {
    library: Library,
    raw: ffi::Mat,
    places: usize,
}

impl Matrix {
    /// A matrix of `rows` rows on this rank, in blocks of so many unknowns, with entries at these places; a
    /// place may come more than once, and in the rows of another rank. Negative places are left out.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn new(
        library: &Library,
        rows: usize,
        block: usize,
        places: impl Iterator<Item = [Option<usize>; 2]> + Clone,
    ) -> Result<Self, PetscError> {
        let side = |side: usize| -> Result<Vec<PetscInt>, PetscError> {
            places.clone().map(|place| place[side].map_or(Ok(-1), int)).collect()
        };
        let (mut row_numbers, mut columns) = (side(0)?, side(1)?);
        let rows = int(rows)?;
        let mut raw = null_mut();
        // SAFETY: the answer goes to a variable that outlives the call.
        check(unsafe { ffi::MatCreate(library.comm(), &mut raw) })?;
        let matrix = Self { library: library.clone(), raw, places: row_numbers.len() };
        let kind = string("aij")?;
        // SAFETY: the matrix exists and has neither type nor sizes; `kind` is a string of C; the two slices
        // have the length that the call says, and PETSc may overwrite them, for nobody reads them again.
        unsafe {
            check(ffi::MatSetSizes(raw, rows, rows, DECIDE, DECIDE))?;
            check(ffi::MatSetType(raw, kind.as_ptr()))?;
            check(ffi::MatSetBlockSize(raw, int(block)?))?;
            check(ffi::MatSetPreallocationCOO(
                raw,
                row_numbers.len() as ffi::PetscCount,
                row_numbers.as_mut_ptr(),
                columns.as_mut_ptr(),
            ))?;
        }
        Ok(matrix)
    }

    /// Says that the matrix will always be symmetric.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn set_symmetric(&mut self) -> Result<(), PetscError> {
        for option in [ffi::MatOption_MAT_SYMMETRIC, ffi::MatOption_MAT_SYMMETRY_ETERNAL] {
            // SAFETY: the matrix exists, and both are options of matrices.
            check(unsafe { ffi::MatSetOption(self.raw, option, ffi::PetscBool_PETSC_TRUE) })?;
        }
        Ok(())
    }

    /// Replaces all entries by the sums of these values, one for each place.
    ///
    /// # Errors
    /// [`PetscError`], also if there is not one value for each place.
    pub fn set_values(&mut self, values: &[f64]) -> Result<(), PetscError> {
        if values.len() != self.places {
            let message = format!("{} values for {} places of a matrix", values.len(), self.places);
            return Err(PetscError { message });
        }
        // SAFETY: the matrix has as many places as there are values.
        check(unsafe { ffi::MatSetValuesCOO(self.raw, values.as_ptr(), ffi::InsertMode_INSERT_VALUES) })
    }

    /// Tells preconditioners that rigid motions of nodes at these places, m, are nearly in the null space.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn set_rigid_motions(&mut self, places: &Vector) -> Result<(), PetscError> {
        let mut space = null_mut();
        // SAFETY: both objects exist, and the space, which the matrix keeps a reference to, is destroyed
        // once.
        unsafe {
            check(ffi::MatNullSpaceCreateRigidBody(places.raw, &mut space))?;
            let set = check(ffi::MatSetNearNullSpace(self.raw, space));
            check(ffi::MatNullSpaceDestroy(&mut space))?;
            set
        }
    }

    /// The rank to which a partitioner gives each row of this rank, as few neighbours as possible being
    /// parted.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn partition(&self) -> Result<Vec<usize>, PetscError> {
        let (mut partitioning, mut set) = (null_mut(), null_mut());
        let mut ranks = Vec::new();
        // SAFETY: the matrix exists, the answers outlive the calls, and what was created is destroyed once;
        // where a call fails, PETSc loses what was created, which leaks and nothing else.
        unsafe {
            check(ffi::MatPartitioningCreate(self.library.comm(), &mut partitioning))?;
            check(ffi::MatPartitioningSetAdjacency(partitioning, self.raw))?;
            check(ffi::MatPartitioningSetFromOptions(partitioning))?;
            check(ffi::MatPartitioningApply(partitioning, &mut set))?;
            check(ffi::MatPartitioningDestroy(&mut partitioning))?;
        }
        let (mut entries, mut count) = (null(), 0);
        // SAFETY: the set exists, the answers outlive the calls.
        unsafe {
            check(ffi::ISGetLocalSize(set, &mut count))?;
            check(ffi::ISGetIndices(set, &mut entries))?;
        }
        for index in 0..usize::try_from(count).unwrap_or(0) {
            // SAFETY: there are `count` entries until they are given back below.
            ranks.push(usize::try_from(unsafe { *entries.add(index) }).unwrap_or(0));
        }
        // SAFETY: the entries are those of the call above, and are not used from here on; the set is
        // destroyed once.
        unsafe {
            check(ffi::ISRestoreIndices(set, &mut entries))?;
            check(ffi::ISDestroy(&mut set))?;
        }
        Ok(ranks)
    }
}

impl Drop for Matrix {
    fn drop(&mut self) {
        // SAFETY: the matrix exists, this is its only owner, and PETSc still runs.
        let _ = unsafe { ffi::MatDestroy(&mut self.raw) };
    }
}

/// A solver of linear systems, as the options of PETSc say.
pub struct Krylov {
    raw: ffi::KSP,
    /// Lives as long as the solver refers to it.
    matrix: Rc<RefCell<Matrix>>,
}

/// How a linear system was solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// To the tolerance.
    Converged,
    /// Given up at the limit of iterations, or where it no longer got on.
    GivenUp,
    /// The matrix, or the preconditioner made of it, is not positive definite.
    Indefinite,
    /// Something is infinite or NaN, or the preconditioner could not be made.
    Failed,
}

impl Krylov {
    /// A solver for a matrix: of this kind, such as `cg`, or what the options say whose names begin with
    /// `prefix`.
    ///
    /// # Errors
    /// [`PetscError`], also for an option with a value that PETSc does not know.
    pub fn new(
        library: &Library,
        matrix: Rc<RefCell<Matrix>>,
        kind: &str,
        prefix: &str,
    ) -> Result<Self, PetscError> {
        let mut raw = null_mut();
        // SAFETY: the answer goes to a variable that outlives the call.
        check(unsafe { ffi::KSPCreate(library.comm(), &mut raw) })?;
        let mat = matrix.borrow().raw;
        let solver = Self { raw, matrix };
        let (kind, prefix) = (string(kind)?, string(prefix)?);
        // SAFETY: solver and matrix exist, and both texts are strings of C, which PETSc copies.
        unsafe {
            check(ffi::KSPSetOptionsPrefix(raw, prefix.as_ptr()))?;
            check(ffi::KSPSetType(raw, kind.as_ptr()))?;
            check(ffi::KSPSetNormType(raw, ffi::KSPNormType_KSP_NORM_UNPRECONDITIONED))?;
            check(ffi::KSPSetOperators(raw, mat, mat))?;
            check(ffi::KSPSetFromOptions(raw))?;
        }
        Ok(solver)
    }

    /// Keeps the preconditioner as it is, or makes it anew for the next system.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn keep_preconditioner(&mut self, keep: bool) -> Result<(), PetscError> {
        let keep = if keep { ffi::PetscBool_PETSC_TRUE } else { ffi::PetscBool_PETSC_FALSE };
        // SAFETY: the solver exists.
        check(unsafe { ffi::KSPSetReusePreconditioner(self.raw, keep) })
    }

    /// Solves A x = b to a share `tolerance` of |b|; returns how it ended and the number of iterations.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn solve(
        &mut self,
        b: &Vector,
        x: &mut Vector,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<(Ending, usize), PetscError> {
        let matrix = self.matrix.borrow().raw;
        let (mut reason, mut iterations) = (0, 0);
        // SAFETY: solver, matrix and vectors exist, and the answers outlive the calls.
        unsafe {
            check(ffi::KSPSetOperators(self.raw, matrix, matrix))?;
            check(ffi::KSPSetTolerances(self.raw, tolerance, 1e-300, 1e10, int(max_iterations)?))?;
            check(ffi::KSPSolve(self.raw, b.raw, x.raw))?;
            check(ffi::KSPGetConvergedReason(self.raw, &mut reason))?;
            check(ffi::KSPGetIterationNumber(self.raw, &mut iterations))?;
        }
        let ending = match reason {
            reason if reason > 0 => Ending::Converged,
            ffi::KSPConvergedReason_KSP_DIVERGED_INDEFINITE_MAT
            | ffi::KSPConvergedReason_KSP_DIVERGED_INDEFINITE_PC => Ending::Indefinite,
            ffi::KSPConvergedReason_KSP_DIVERGED_NANORINF
            | ffi::KSPConvergedReason_KSP_DIVERGED_PC_FAILED => Ending::Failed,
            _ => Ending::GivenUp,
        };
        Ok((ending, usize::try_from(iterations).unwrap_or(0)))
    }
}

impl Drop for Krylov {
    fn drop(&mut self) {
        // SAFETY: the solver exists, this is its only owner, and PETSc still runs: the matrix has a handle of
        // it.
        let _ = unsafe { ffi::KSPDestroy(&mut self.raw) };
    }
}
