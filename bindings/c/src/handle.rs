//! Handles: values that a caller owns behind a pointer.

use std::sync::{Mutex, MutexGuard, TryLockError};

use crate::error::{Code, Failure};
use crate::lent::Out;

impl<T> Out<*mut T> {
    /// Hands a value to the caller. A call that fails leaves null behind, which may be freed.
    pub(crate) fn give(self, make: impl FnOnce() -> Result<T, Failure>) -> Result<(), Failure> {
        self.demand()?;
        self.write(std::ptr::null_mut())?;
        self.write(Box::into_raw(Box::new(make()?)))
    }
}

/// Drops a value that the caller gives back, which comes from [`Out::give`].
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
