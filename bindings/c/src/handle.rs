//! Handles: values that a caller owns behind a pointer.

use std::sync::{Mutex, MutexGuard, TryLockError};

use crate::error::{Code, Failure};
use crate::lent;

/// Hands a value to the caller.
///
/// # Safety
/// `to` is null, which is an error, or there is room for a pointer.
pub(crate) unsafe fn give<T>(
    name: &str,
    to: *mut *mut T,
    make: impl FnOnce() -> Result<T, Failure>,
) -> Result<(), Failure> {
    if to.is_null() {
        return Err(Failure::new(Code::Pointer, format_args!("`{name}` is null")));
    }
    // SAFETY: that of this function. A call that fails leaves null behind, which may be freed.
    unsafe { lent::report(name, to, std::ptr::null_mut()) }?;
    let handle = Box::into_raw(Box::new(make()?));
    // SAFETY: as before.
    unsafe { lent::report(name, to, handle) }
}

/// Takes a value back and drops it. Does nothing with null.
///
/// # Safety
/// `handle` is null, or comes from [`give`] and is not used any more.
pub(crate) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: it was made by `Box::into_raw`, and belongs to nobody else.
        let value = unsafe { Box::from_raw(handle) };
        crate::error::guard(|| {
            drop(value);
            Ok(())
        });
    }
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
