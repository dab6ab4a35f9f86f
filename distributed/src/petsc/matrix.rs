//! Sparse matrices of PETSc, and partitions of their graphs.

use std::ptr::{null, null_mut};

use super::operators::{Shared, multiply};
use super::{DECIDE, Library, PetscError, PetscInt, Vector, check, ffi, int, string};

/// Square sparse matrix in compressed rows, divided among the ranks by rows; or a function.
pub(crate) struct Matrix {
    library: Library,
    pub(super) raw: ffi::Mat,
    places: usize,
    /// Operators to which the matrix refers.
    pub(super) operators: Option<Box<Shared>>,
}

impl Matrix {
    /// Matrix with `rows` rows on this rank, in square blocks, with entries at these places, that is always
    /// symmetric. A place may occur more than once, and in the rows of another rank.
    pub(crate) fn new(
        library: &Library,
        rows: usize,
        block: usize,
        places: impl Iterator<Item = [usize; 2]> + Clone,
    ) -> Result<Self, PetscError> {
        let side = |side: usize| -> Result<Vec<PetscInt>, PetscError> {
            places.clone().map(|place| int(place[side])).collect()
        };
        let (mut row_numbers, mut columns) = (side(0)?, side(1)?);
        let rows = int(rows)?;
        let mut raw = null_mut();
        // SAFETY: the result goes to a variable that outlives the call.
        check(unsafe { ffi::MatCreate(library.comm(), &mut raw) })?;
        let matrix = Self { library: library.clone(), raw, places: row_numbers.len(), operators: None };
        let kind = string("aij")?;
        // SAFETY: the matrix exists and has neither type nor sizes; `kind` is a C string; the two slices have
        // the given length, and PETSc may overwrite them, because they are not read again; both options are
        // those of matrices.
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
            for option in [ffi::MatOption_MAT_SYMMETRIC, ffi::MatOption_MAT_SYMMETRY_ETERNAL] {
                check(ffi::MatSetOption(raw, option, ffi::PetscBool_PETSC_TRUE))?;
            }
        }
        Ok(matrix)
    }

    /// Matrix that is a function: the product with an operator on the free nodes of this rank.
    pub(crate) fn of_function(
        library: &Library,
        nodes: usize,
        operators: Shared,
    ) -> Result<Self, PetscError> {
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
        let matrix = Self { library: library.clone(), raw, places: 0, operators: Some(operators) };
        // SAFETY: the matrix exists, and PETSc calls the function of this operation with the arguments of
        // `multiply`.
        check(unsafe {
            let function = std::mem::transmute::<Product, unsafe extern "C" fn()>(multiply);
            ffi::MatShellSetOperation(raw, ffi::MatOperation_MATOP_MULT, Some(function))
        })?;
        Ok(matrix)
    }

    /// Replaces all entries by the sums of these values, one for each place.
    ///
    /// # Errors
    /// [`PetscError`], also unless there is one value for each place.
    pub(crate) fn set_values(&self, values: &[f64]) -> Result<(), PetscError> {
        if values.len() != self.places {
            let message = format!("{} values for {} places of a matrix", values.len(), self.places);
            return Err(PetscError { message });
        }
        // SAFETY: the matrix has as many places as there are values.
        check(unsafe { ffi::MatSetValuesCOO(self.raw, values.as_ptr(), ffi::InsertMode_INSERT_VALUES) })
    }

    /// Sets the near null space for preconditioners to the rigid motions of nodes at these places, m.
    pub(crate) fn set_rigid_motions(&self, places: &Vector) -> Result<(), PetscError> {
        let mut space = null_mut();
        // SAFETY: the vector exists, and the result goes to a variable that outlives the call.
        check(unsafe { ffi::MatNullSpaceCreateRigidBody(places.raw, &mut space) })?;
        self.set_near_null_space(space)
    }

    /// Sets the near null space for preconditioners to these vectors, which must be orthonormal.
    pub(crate) fn set_motions(&self, motions: &[Vector]) -> Result<(), PetscError> {
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

    fn set_near_null_space(&self, mut space: ffi::MatNullSpace) -> Result<(), PetscError> {
        // SAFETY: both objects exist, the matrix keeps a reference to the space, and the space is destroyed
        // once.
        unsafe {
            let set = check(ffi::MatSetNearNullSpace(self.raw, space));
            check(ffi::MatNullSpaceDestroy(&mut space))?;
            set
        }
    }

    /// Rank of each row of this rank, chosen by a partitioner so that few neighbours are separated.
    pub(crate) fn partition(&self) -> Result<Vec<usize>, PetscError> {
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

destroyed!(Matrix, ffi::MatDestroy);
