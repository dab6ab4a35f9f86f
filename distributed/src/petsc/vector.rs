//! Vectors of PETSc, with or without copies of rows of other ranks.

use std::ptr::{null, null_mut};

use piola::lanes::Real;

use super::{DECIDE, Library, PetscError, PetscInt, check, ffi, int};

/// Vector with some components for each row. Each rank owns some rows, and may have copies of other rows.
pub(crate) struct Vector {
    _library: Library,
    pub(super) raw: ffi::Vec,
    local: usize,
    owned: usize,
}

impl Vector {
    /// Vector of zeros with a number of owned rows on this rank and copies of the rows with the numbers
    /// `ghosts`. Rows are numbered rank after rank, and have this number of `components`.
    pub(crate) fn new(
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

    /// Calls `work` with the owned rows, of N components each.
    pub(crate) fn with<const N: usize>(
        &mut self,
        work: impl FnOnce(&mut [[f64; N]]),
    ) -> Result<(), PetscError> {
        with_entries(self.raw, self.owned, |entries| work(entries.as_chunks_mut().0))
    }

    /// Replaces the copies, the last rows of `all`, by the entries of their owners, which are sent in f64.
    pub(crate) fn copy<E: Real + Into<f64>>(&mut self, all: &mut [E]) -> Result<(), PetscError> {
        let owned = self.owned;
        self.with_local(|entries| entries.iter_mut().zip(&all[..owned]).for_each(|(e, x)| *e = (*x).into()))?;
        self.update(ffi::InsertMode_INSERT_VALUES, ffi::ScatterMode_SCATTER_FORWARD)?;
        let copies = &mut all[owned..];
        self.with_local(|entries| {
            copies.iter_mut().zip(&entries[owned..]).for_each(|(x, e)| *x = E::splat(*e))
        })
    }

    /// Adds the copies, the last rows of `all`, to the entries of their owners, as in
    /// [`copy`](Self::copy).
    pub(crate) fn sum<E: Real + Into<f64>>(&mut self, all: &mut [E]) -> Result<(), PetscError> {
        self.with_local(|entries| entries.iter_mut().zip(&*all).for_each(|(e, x)| *e = (*x).into()))?;
        self.update(ffi::InsertMode_ADD_VALUES, ffi::ScatterMode_SCATTER_REVERSE)?;
        let owned = &mut all[..self.owned];
        self.with_local(|entries| owned.iter_mut().zip(&*entries).for_each(|(x, e)| *x = E::splat(*e)))
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
pub(super) fn with_entries(
    raw: ffi::Vec,
    count: usize,
    work: impl FnOnce(&mut [f64]),
) -> Result<(), PetscError> {
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
pub(super) fn with_given<T>(raw: ffi::Vec, work: impl FnOnce(&[f64]) -> T) -> Result<T, PetscError> {
    let (mut entries, mut count) = (null(), 0);
    // SAFETY: the vector exists, and the results outlive the calls.
    unsafe {
        check(ffi::VecGetLocalSize(raw, &mut count))?;
        check(ffi::VecGetArrayRead(raw, &mut entries))?;
    }
    let done = match usize::try_from(count) {
        Ok(count) if count > 0 && !entries.is_null() => {
            // SAFETY: the vector has `count` entries here, entries are f64 in any PETSc with real numbers,
            // and they do not change until the array is released.
            work(unsafe { std::slice::from_raw_parts(entries, count) })
        }
        _ => work(&[]),
    };
    // SAFETY: the array is the result of the call above, and its slice is not used any more.
    check(unsafe { ffi::VecRestoreArrayRead(raw, &mut entries) })?;
    Ok(done)
}

destroyed!(Vector, ffi::VecDestroy);
