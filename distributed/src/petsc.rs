//! Interface to PETSc: vectors of a divided body, sparse matrices, Krylov solvers, partitions of graphs.
//!
//! No other module calls PETSc or contains unsafe code. Each type owns one object of PETSc, which it destroys
//! when it is dropped; the library runs until then. All functions are collective: all ranks must call them,
//! in the same order. This module does not depend on meshes or on materials.

#![expect(unsafe_code, reason = "PETSc is a C library: this is the interface to it")]

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::rc::Rc;

use mpi::environment::Universe;
use mpi::raw::AsRaw;
use mpi::topology::SimpleCommunicator;
use piola::step::divided::{End, Iteration};

use ffi::PetscInt;

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

/// Error for an integer that is too large for PETSc's integers.
fn too_large(number: usize) -> PetscError {
    let bits = PetscInt::BITS;
    PetscError {
        message: format!(
            "{number} does not fit into the {bits}-bit integers of this PETSc; build PETSc with 64-bit indices"
        ),
    }
}

fn int(number: usize) -> Result<PetscInt, PetscError> {
    PetscInt::try_from(number).map_err(|_| too_large(number))
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
    /// Default options that were set because the user had not set them.
    defaults: RefCell<Vec<String>>,
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
        let failed = |message: &str| PetscError { message: message.to_owned() };
        // Partitioners such as PTScotch divide graphs on several threads, each of which sends messages to
        // other ranks. With a lower level of thread support they occasionally hang.
        let universe = mpi::initialize_with_threading(mpi::Threading::Multiple)
            .map(|(universe, _)| universe)
            .ok_or_else(|| failed("MPI was started before"))?;
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
        Ok(Self(Rc::new(Running { world, _universe: universe, defaults: RefCell::default() })))
    }

    /// Communicator of all ranks.
    #[must_use]
    pub fn world(&self) -> &SimpleCommunicator {
        &self.0.world
    }

    /// True if an option has this value.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn is_set_to(&self, name: &str, value: &str) -> Result<bool, PetscError> {
        let dashed = dashed(name)?;
        let (mut text, mut is_set): ([c_char; 64], _) = ([0; 64], ffi::PetscBool_PETSC_FALSE);
        // SAFETY: the name is a C string, PETSc writes a C string of at most the given number of bytes, and
        // the results go to variables that outlive the call.
        let text = unsafe {
            let (to, bytes) = (text.as_mut_ptr(), text.len());
            check(ffi::PetscOptionsGetString(null_mut(), null(), dashed.as_ptr(), to, bytes, &mut is_set))?;
            CStr::from_ptr(to)
        };
        Ok(is_set == ffi::PetscBool_PETSC_TRUE && text.to_bytes() == value.as_bytes())
    }

    /// Sets an option, unless the user has set it.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn default_option(&self, name: &str, value: &str) -> Result<(), PetscError> {
        let dashed = dashed(name)?;
        let mut is_set = ffi::PetscBool_PETSC_FALSE;
        // SAFETY: the name is a C string, and the result goes to a variable that outlives the call.
        check(unsafe { ffi::PetscOptionsHasName(null_mut(), null(), dashed.as_ptr(), &mut is_set) })?;
        if is_set == ffi::PetscBool_PETSC_FALSE {
            set_option(name, Some(value))?;
            self.0.defaults.borrow_mut().push(name.to_owned());
        }
        Ok(())
    }

    /// Options of the user that PETSc has not used up to now: they are misspelt, or belong to a solver that
    /// is not in use.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn unused_options(&self) -> Result<Vec<String>, PetscError> {
        let (mut count, mut names, mut values) = (0, null_mut(), null_mut());
        // SAFETY: the three results go to variables that outlive the call.
        check(unsafe { ffi::PetscOptionsLeftGet(null_mut(), &mut count, &mut names, &mut values) })?;
        let mut unused = Vec::new();
        for index in 0..usize::try_from(count).unwrap_or(0) {
            // SAFETY: `names` holds `count` C strings until they are released below.
            let name = unsafe { CStr::from_ptr(*names.add(index)) }.to_string_lossy().into_owned();
            if !self.0.defaults.borrow().contains(&name) {
                unused.push(name);
            }
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

/// Real number in a vector that is sent as f64, the type of PETSc.
pub trait Entry: Copy {
    /// Nearest value of this type.
    fn of(number: f64) -> Self;

    /// Value in f64.
    fn wide(self) -> f64;
}

impl Entry for f64 {
    fn of(number: f64) -> Self {
        number
    }

    fn wide(self) -> f64 {
        self
    }
}

impl Entry for f32 {
    fn of(number: f64) -> Self {
        number as Self
    }

    fn wide(self) -> f64 {
        self.into()
    }
}

/// Vector with some components for each row. Each rank owns some rows, and has copies of other rows.
pub struct GhostedVector {
    _library: Library,
    raw: ffi::Vec,
    local: usize,
    owned: usize,
}

impl GhostedVector {
    /// Vector with a number of owned rows on this rank and copies of the rows with the numbers `ghosts`. Rows
    /// are numbered rank after rank, and have this number of `components`.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn new(
        library: &Library,
        components: usize,
        owned: usize,
        ghosts: &[usize],
    ) -> Result<Self, PetscError> {
        let numbers: Vec<PetscInt> = ghosts.iter().map(|&number| int(number)).collect::<Result<_, _>>()?;
        let mut raw = null_mut();
        // SAFETY: the number of ghosts is correct, PETSc copies them, and the result outlives the call.
        check(unsafe {
            ffi::VecCreateGhostBlock(
                library.comm(),
                int(components)?,
                int(components * owned)?,
                DECIDE,
                int(ghosts.len())?,
                numbers.as_ptr(),
                &mut raw,
            )
        })?;
        let [local, owned] = [owned + ghosts.len(), owned].map(|rows| components * rows);
        Ok(Self { _library: library.clone(), raw, local, owned })
    }

    /// Replaces the copies, the last rows of `all`, by the entries of their owners.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn copy<E: Entry>(&mut self, all: &mut [E]) -> Result<(), PetscError> {
        let owned = self.owned;
        self.with_local(|entries| entries.iter_mut().zip(&all[..owned]).for_each(|(e, x)| *e = x.wide()))?;
        self.update(ffi::InsertMode_INSERT_VALUES, ffi::ScatterMode_SCATTER_FORWARD)?;
        let copies = &mut all[owned..];
        self.with_local(|entries| copies.iter_mut().zip(&entries[owned..]).for_each(|(x, e)| *x = E::of(*e)))
    }

    /// Adds the copies, the last rows of `all`, to the entries of their owners.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn sum<E: Entry>(&mut self, all: &mut [E]) -> Result<(), PetscError> {
        self.with_local(|entries| entries.iter_mut().zip(&*all).for_each(|(e, x)| *e = x.wide()))?;
        self.update(ffi::InsertMode_ADD_VALUES, ffi::ScatterMode_SCATTER_REVERSE)?;
        let owned = &mut all[..self.owned];
        self.with_local(|entries| owned.iter_mut().zip(&*entries).for_each(|(x, e)| *x = E::of(*e)))
    }

    fn update(&mut self, mode: ffi::InsertMode, direction: ffi::ScatterMode) -> Result<(), PetscError> {
        // SAFETY: the vector was created by `VecCreateGhostBlock`, and is not destroyed before this.
        unsafe {
            check(ffi::VecGhostUpdateBegin(self.raw, mode, direction))?;
            check(ffi::VecGhostUpdateEnd(self.raw, mode, direction))
        }
    }

    /// Calls `work` with the owned entries and the copies.
    fn with_local(&mut self, work: impl FnOnce(&mut [f64])) -> Result<(), PetscError> {
        let mut form = null_mut();
        // SAFETY: the vector has copies, and the result outlives the call.
        check(unsafe { ffi::VecGhostGetLocalForm(self.raw, &mut form) })?;
        let done = with_entries(form, self.local, work);
        // SAFETY: the form is the result of the call above, and its entries are released.
        check(unsafe { ffi::VecGhostRestoreLocalForm(self.raw, &mut form) })?;
        done
    }
}

/// Calls `work` with the `count` entries of a vector on this rank.
fn with_entries(raw: ffi::Vec, count: usize, work: impl FnOnce(&mut [f64])) -> Result<(), PetscError> {
    let mut entries = null_mut();
    // SAFETY: the vector exists, and the result outlives the call.
    check(unsafe { ffi::VecGetArray(raw, &mut entries) })?;
    if count == 0 || entries.is_null() {
        work(&mut []);
    } else {
        // SAFETY: callers pass the number of entries on this rank, entries are f64 in any PETSc with real
        // numbers, and the array is not used elsewhere until it is released.
        work(unsafe { std::slice::from_raw_parts_mut(entries, count) });
    }
    // SAFETY: the array is the result of the call above, and its slice is not used any more.
    check(unsafe { ffi::VecRestoreArray(raw, &mut entries) })
}

/// Calls `work` with the entries of a vector on this rank, without changing them.
fn with_given<T>(raw: ffi::Vec, work: impl FnOnce(&[f64]) -> T) -> Result<T, PetscError> {
    let (mut entries, mut count) = (null(), 0);
    // SAFETY: the vector exists, and the results outlive the calls.
    unsafe {
        check(ffi::VecGetLocalSize(raw, &mut count))?;
        check(ffi::VecGetArrayRead(raw, &mut entries))?;
    }
    let done = match usize::try_from(count) {
        // SAFETY: the vector has `count` entries here, entries are f64 in any PETSc with real numbers, and
        // they do not change until the array is released.
        Ok(count) if count > 0 && !entries.is_null() => {
            work(unsafe { std::slice::from_raw_parts(entries, count) })
        }
        _ => work(&[]),
    };
    // SAFETY: the array is the result of the call above, and its slice is not used any more.
    check(unsafe { ffi::VecRestoreArrayRead(raw, &mut entries) })?;
    Ok(done)
}

impl Drop for GhostedVector {
    fn drop(&mut self) {
        // SAFETY: the vector exists, this is its only owner, and PETSc still runs.
        let _ = unsafe { ffi::VecDestroy(&mut self.raw) };
    }
}

/// Vector of unknowns, N for each row.
pub struct Vector<const N: usize> {
    _library: Library,
    raw: ffi::Vec,
    rows: usize,
}

impl<const N: usize> Vector<N> {
    /// Vector of zeros, with a number of rows on this rank.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn new(library: &Library, rows: usize) -> Result<Self, PetscError> {
        let mut raw = null_mut();
        // SAFETY: the result goes to a variable that outlives the call.
        check(unsafe { ffi::VecCreateMPI(library.comm(), int(N * rows)?, DECIDE, &mut raw) })?;
        let vector = Self { _library: library.clone(), raw, rows };
        // SAFETY: the vector exists, and N divides the number of its entries on each rank.
        check(unsafe { ffi::VecSetBlockSize(raw, int(N)?) })?;
        Ok(vector)
    }

    /// Calls `work` with the entries of this rank.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn with(&mut self, work: impl FnOnce(&mut [[f64; N]])) -> Result<(), PetscError> {
        with_entries(self.raw, N * self.rows, |entries| work(entries.as_chunks_mut().0))
    }
}

impl<const N: usize> Drop for Vector<N> {
    fn drop(&mut self) {
        // SAFETY: the vector exists, this is its only owner, and PETSc still runs.
        let _ = unsafe { ffi::VecDestroy(&mut self.raw) };
    }
}

/// Stiffness and preconditioner as functions that PETSc calls. Their vectors have the unknowns of the free
/// nodes of this rank.
pub trait Operators {
    /// Replaces `product`, N, by the product of the stiffness with a displacement, m.
    ///
    /// # Errors
    /// [`PetscError`].
    fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Replaces `z`, m, by an approximation of A⁻¹ r.
    ///
    /// # Errors
    /// [`PetscError`].
    fn precondition(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) -> Result<(), PetscError>;

    /// Description of the preconditioner for `-ksp_view`, and the solver within it.
    fn view(&self) -> (String, Option<&Krylov>);
}

/// Context of PETSc's objects that are functions.
type Shared = Rc<RefCell<dyn Operators>>;

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
/// `matrix` must be a result of [`Matrix::of_function`].
unsafe extern "C" fn multiply(matrix: ffi::Mat, x: ffi::Vec, y: ffi::Vec) -> ffi::PetscErrorCode {
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
/// `preconditioner` must have been set by [`Krylov::precondition_by`].
unsafe extern "C" fn precondition(preconditioner: ffi::PC, r: ffi::Vec, z: ffi::Vec) -> ffi::PetscErrorCode {
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
/// `preconditioner` must have been set by [`Krylov::precondition_by`].
unsafe extern "C" fn view(preconditioner: ffi::PC, viewer: ffi::PetscViewer) -> ffi::PetscErrorCode {
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

/// Square sparse matrix in compressed rows, divided among the ranks by rows; or a function.
pub struct Matrix {
    library: Library,
    raw: ffi::Mat,
    places: usize,
    /// Operators to which the matrix refers.
    _operators: Option<Box<Shared>>,
}

impl Matrix {
    /// Matrix with `rows` rows on this rank, in square blocks, with entries at these places. A place may
    /// occur more than once, and in the rows of another rank. Places of `None` are left out.
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
        // SAFETY: the result goes to a variable that outlives the call.
        check(unsafe { ffi::MatCreate(library.comm(), &mut raw) })?;
        let matrix = Self { library: library.clone(), raw, places: row_numbers.len(), _operators: None };
        let kind = string("aij")?;
        // SAFETY: the matrix exists and has neither type nor sizes; `kind` is a C string; the two slices have
        // the given length, and PETSc may overwrite them, because they are not read again.
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

    /// Matrix that is a function: the product with an operator on the free nodes of this rank.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn of_function(library: &Library, nodes: usize, operators: Shared) -> Result<Self, PetscError> {
        type Product = unsafe extern "C" fn(ffi::Mat, ffi::Vec, ffi::Vec) -> ffi::PetscErrorCode;
        let (rows, operators) = (int(3 * nodes)?, Box::new(operators));
        let context: *const Shared = &raw const *operators;
        let mut raw = null_mut();
        // SAFETY: the result goes to a variable that outlives the call; the context exists as long as the
        // matrix.
        check(unsafe {
            let context = context.cast_mut().cast();
            ffi::MatCreateShell(library.comm(), rows, rows, DECIDE, DECIDE, context, &mut raw)
        })?;
        let matrix = Self { library: library.clone(), raw, places: 0, _operators: Some(operators) };
        // SAFETY: the matrix exists, and PETSc calls the function of this operation with the arguments of
        // `multiply`.
        check(unsafe {
            let function = std::mem::transmute::<Product, unsafe extern "C" fn()>(multiply);
            ffi::MatShellSetOperation(raw, ffi::MatOperation_MATOP_MULT, Some(function))
        })?;
        Ok(matrix)
    }

    /// Declares that the matrix is always symmetric.
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
    /// [`PetscError`], also unless there is one value for each place.
    pub fn set_values(&mut self, values: &[f64]) -> Result<(), PetscError> {
        if values.len() != self.places {
            let message = format!("{} values for {} places of a matrix", values.len(), self.places);
            return Err(PetscError { message });
        }
        // SAFETY: the matrix has as many places as there are values.
        check(unsafe { ffi::MatSetValuesCOO(self.raw, values.as_ptr(), ffi::InsertMode_INSERT_VALUES) })
    }

    /// Sets the near null space for preconditioners to the rigid motions of nodes at these places, m.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn set_rigid_motions(&mut self, places: &Vector<3>) -> Result<(), PetscError> {
        let mut space = null_mut();
        // SAFETY: the vector exists, and the result goes to a variable that outlives the call.
        check(unsafe { ffi::MatNullSpaceCreateRigidBody(places.raw, &mut space) })?;
        self.set_near_null_space(space)
    }

    /// Sets the near null space for preconditioners to these vectors, which must be orthonormal.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn set_motions<const N: usize>(&mut self, motions: &[Vector<N>]) -> Result<(), PetscError> {
        let vectors: Vec<ffi::Vec> = motions.iter().map(|vector| vector.raw).collect();
        let (is_constant, count) = (ffi::PetscBool_PETSC_FALSE, int(vectors.len())?);
        let mut space = null_mut();
        // SAFETY: the number of vectors is correct, PETSc keeps references to them, and the result goes to a
        // variable that outlives the call.
        check(unsafe {
            let comm = self.library.comm();
            ffi::MatNullSpaceCreate(comm, is_constant, count, vectors.as_ptr(), &mut space)
        })?;
        self.set_near_null_space(space)
    }

    fn set_near_null_space(&mut self, mut space: ffi::MatNullSpace) -> Result<(), PetscError> {
        // SAFETY: both objects exist, the matrix keeps a reference to the space, and the space is destroyed
        // once.
        unsafe {
            let set = check(ffi::MatSetNearNullSpace(self.raw, space));
            check(ffi::MatNullSpaceDestroy(&mut space))?;
            set
        }
    }

    /// Rank of each row of this rank, chosen by a partitioner so that few neighbours are separated.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn partition(&self) -> Result<Vec<usize>, PetscError> {
        let (mut partitioning, mut set) = (null_mut(), null_mut());
        let mut ranks = Vec::new();
        // SAFETY: the matrix exists, the results outlive the calls, and created objects are destroyed once.
        // If a call fails, created objects leak, without other consequences.
        unsafe {
            check(ffi::MatPartitioningCreate(self.library.comm(), &mut partitioning))?;
            check(ffi::MatPartitioningSetAdjacency(partitioning, self.raw))?;
            check(ffi::MatPartitioningSetFromOptions(partitioning))?;
            check(ffi::MatPartitioningApply(partitioning, &mut set))?;
            check(ffi::MatPartitioningDestroy(&mut partitioning))?;
        }
        let (mut entries, mut count) = (null(), 0);
        // SAFETY: the set exists, and the results outlive the calls.
        unsafe {
            check(ffi::ISGetLocalSize(set, &mut count))?;
            check(ffi::ISGetIndices(set, &mut entries))?;
        }
        for index in 0..usize::try_from(count).unwrap_or(0) {
            // SAFETY: there are `count` entries until they are released below.
            ranks.push(usize::try_from(unsafe { *entries.add(index) }).unwrap_or(0));
        }
        // SAFETY: the entries are the result of the call above, and are not used from here on; the set is
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

/// Solver of linear systems, configured by the options of PETSc.
pub struct Krylov {
    raw: ffi::KSP,
    /// Matrix to which the solver refers.
    matrix: Rc<RefCell<Matrix>>,
    /// Operators to which the preconditioner refers.
    operators: Option<Box<Shared>>,
}

impl Krylov {
    /// Solver for a matrix, by conjugate gradients unless options with the prefix `prefix` select another
    /// one.
    ///
    /// # Errors
    /// [`PetscError`], also for an option with a value that PETSc does not support.
    pub fn new(library: &Library, matrix: Rc<RefCell<Matrix>>, prefix: &str) -> Result<Self, PetscError> {
        let solver = Self::of_kind(library, matrix, "cg", prefix)?;
        // SAFETY: the solver exists.
        unsafe {
            check(ffi::KSPSetNormType(solver.raw, ffi::KSPNormType_KSP_NORM_UNPRECONDITIONED))?;
            check(ffi::KSPSetFromOptions(solver.raw))?;
        }
        Ok(solver)
    }

    /// Solver that applies a preconditioner of this kind once, unless options with the prefix `prefix` select
    /// another one.
    ///
    /// # Errors
    /// [`PetscError`], also for an option with a value that PETSc does not support.
    pub fn once(
        library: &Library,
        matrix: Rc<RefCell<Matrix>>,
        kind: &str,
        prefix: &str,
    ) -> Result<Self, PetscError> {
        let solver = Self::of_kind(library, matrix, "preonly", prefix)?;
        let (kind, preconditioner) = (string(kind)?, solver.preconditioner()?);
        // SAFETY: both objects exist, and the text is a C string, which PETSc copies.
        unsafe {
            check(ffi::PCSetType(preconditioner, kind.as_ptr()))?;
            check(ffi::KSPSetFromOptions(solver.raw))?;
        }
        Ok(solver)
    }

    fn of_kind(
        library: &Library,
        matrix: Rc<RefCell<Matrix>>,
        kind: &str,
        prefix: &str,
    ) -> Result<Self, PetscError> {
        let mut raw = null_mut();
        // SAFETY: the result goes to a variable that outlives the call.
        check(unsafe { ffi::KSPCreate(library.comm(), &mut raw) })?;
        let mat = matrix.borrow().raw;
        let solver = Self { raw, matrix, operators: None };
        let (kind, prefix) = (string(kind)?, string(prefix)?);
        // SAFETY: solver and matrix exist, and both texts are C strings, which PETSc copies.
        unsafe {
            check(ffi::KSPSetOptionsPrefix(raw, prefix.as_ptr()))?;
            check(ffi::KSPSetType(raw, kind.as_ptr()))?;
            check(ffi::KSPSetOperators(raw, mat, mat))?;
        }
        Ok(solver)
    }

    fn preconditioner(&self) -> Result<ffi::PC, PetscError> {
        let mut preconditioner = null_mut();
        // SAFETY: the solver exists, and the result goes to a variable that outlives the call.
        check(unsafe { ffi::KSPGetPC(self.raw, &mut preconditioner) })?;
        Ok(preconditioner)
    }

    /// Preconditions by operators; the type of the preconditioner in options is `shell`.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn precondition_by(&mut self, operators: Shared) -> Result<(), PetscError> {
        let preconditioner = self.preconditioner()?;
        let operators = self.operators.insert(Box::new(operators));
        let context: *const Shared = &raw const **operators;
        // SAFETY: the preconditioner exists, the name is a C string, which PETSc copies, the context exists
        // as long as the solver, and the functions have the signatures that PETSc requires.
        unsafe {
            check(ffi::PCShellSetContext(preconditioner, context.cast_mut().cast()))?;
            check(ffi::PCShellSetApply(preconditioner, Some(precondition)))?;
            check(ffi::PCShellSetView(preconditioner, Some(view)))?;
            check(ffi::PCShellSetName(preconditioner, c"piola".as_ptr()))
        }
    }

    /// Keeps the preconditioner for the next system, or sets up a new one.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn keep_preconditioner(&mut self, keep: bool) -> Result<(), PetscError> {
        let keep = if keep { ffi::PetscBool_PETSC_TRUE } else { ffi::PetscBool_PETSC_FALSE };
        // SAFETY: the solver exists.
        check(unsafe { ffi::KSPSetReusePreconditioner(self.raw, keep) })
    }

    /// Solves A x = b from x = 0 to a residual of `tolerance` times |b|.
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn solve<const N: usize>(
        &mut self,
        b: &Vector<N>,
        x: &mut Vector<N>,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<Iteration, PetscError> {
        let matrix = self.matrix.borrow().raw;
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
    ///
    /// # Errors
    /// [`PetscError`].
    pub fn apply<const N: usize>(&mut self, b: &Vector<N>, x: &mut Vector<N>) -> Result<(), PetscError> {
        // SAFETY: solver and vectors exist.
        check(unsafe { ffi::KSPSolve(self.raw, b.raw, x.raw) })
    }
}

impl Drop for Krylov {
    fn drop(&mut self) {
        // SAFETY: the solver exists, this is its only owner, and PETSc still runs: the matrix has a handle of
        // the library.
        let _ = unsafe { ffi::KSPDestroy(&mut self.raw) };
    }
}
