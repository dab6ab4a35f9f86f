//! Handles: values that a caller owns behind a pointer.

use std::sync::{Mutex, MutexGuard, TryLockError};

use crate::error::{Code, Failure};
use crate::lent;

/// Place of a new handle.
pub(crate) struct New<T>(lent::Out<*mut T>);

impl<T> New<T> {
    /// # Safety
    /// As for [`Out::new`](lent::Out::new).
    pub(crate) unsafe fn at(name: &'static str, to: *mut *mut T) -> Self {
        // SAFETY: that of this function.
        Self(unsafe { lent::Out::new(name, to) })
    }

    /// Hands a value to the caller. A call that fails leaves null behind, which may be freed.
    pub(crate) fn give(self, make: impl FnOnce() -> Result<T, Failure>) -> Result<(), Failure> {
        self.0.demand()?;
        self.0.write(std::ptr::null_mut())?;
        self.0.write(Box::into_raw(Box::new(make()?)))
    }
}

/// Drops a value that the caller gives back, which comes from [`New::give`].
pub(crate) fn free<T>(value: Option<Box<T>>) {
    crate::error::guard(|| {
        drop(value);
        Ok(())
    });
}

/// Waits for other calls that use this handle.
pub(crate) fn wait<T>(value: &Mutex<T>) -> Result<MutexGuard<'_, T>, Failure> {
    value.lock().map_err(|_| poisoned())
}

/// Fails if another call uses this handle, which may be the one that a callback belongs to.
pub(crate) fn enter<T>(value: &Mutex<T>) -> Result<MutexGuard<'_, T>, Failure> {
    value.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => Failure::new(Code::Busy, "another call uses this handle"),
        TryLockError::Poisoned(_) => poisoned(),
    })
}

fn poisoned() -> Failure {
    Failure::new(Code::Panic, "an earlier call has left this handle half changed: free it")
}
