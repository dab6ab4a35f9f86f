//! The threads that compute: a pool of their own, so that their number can be set, and a new one after a
//! fork, which copies a process without its threads.

use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::value_error;

/// The pool of a process, whose number distinguishes it from that of its parent.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Computes on the threads of the pool.
pub(crate) fn on_threads<T: Send>(compute: impl FnOnce() -> T + Send) -> PyResult<T> {
    Ok(pool()?.install(compute))
}

/// Computes with a value behind a lock, on the threads of the pool and without the interpreter.
pub(crate) fn with_locked<T: Send, R: Send>(
    py: Python<'_>,
    value: &Mutex<T>,
    compute: impl FnOnce(&mut T) -> R + Send,
) -> PyResult<R> {
    py.detach(|| {
        // Locked before the pool is entered: a thread of it that waits may take up another call meanwhile.
        let value = &mut *value.lock().unwrap_or_else(PoisonError::into_inner);
        on_threads(|| compute(value))
    })
}

fn pool() -> PyResult<Arc<ThreadPool>> {
    let mut current = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    match &*current {
        Some((process, pool)) if *process == process::id() => Ok(pool.clone()),
        _ => replace(&mut current, 0),
    }
}

/// Replaces the pool of threads by one of `count` threads; 0 for one on each core.
fn replace(current: &mut Option<(u32, Arc<ThreadPool>)>, count: usize) -> PyResult<Arc<ThreadPool>> {
    let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|k| format!("piola-{k}")).build();
    let pool = Arc::new(pool.map_err(|error| value_error(format!("cannot start threads: {error}")))?);
    let before = current.replace((process::id(), pool.clone()));
    if let Some((process, pool)) = before
        && process != process::id()
    {
        // Its threads are those of the parent: there is none to be ended.
        std::mem::forget(pool);
    }
    Ok(pool)
}

/// Number of threads that share the points of a large call, and the elements of a body.
#[pyfunction]
pub(crate) fn num_threads() -> PyResult<usize> {
    Ok(pool()?.current_num_threads())
}

/// Sets the number of threads: 0 for the variable `RAYON_NUM_THREADS`, or one on each core without it.
///
/// The results do not depend on it. Raises ValueError if that number cannot be started.
#[pyfunction]
#[pyo3(signature = (count, /))]
pub(crate) fn set_num_threads(count: usize) -> PyResult<()> {
    const MOST: usize = 4096;
    if count > MOST {
        return Err(value_error(format!("the number of threads is {count}; it must be at most {MOST}")));
    }
    let mut current = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    replace(&mut current, count).map(drop)
}
