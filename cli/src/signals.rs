//! Signals that end the program.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown, register_usize};

/// Listens to SIGINT, which Ctrl-C sends, and to SIGTERM; returns a function for the exit code of the signal
/// that has come, if one has: 128 and its number, as shells count.
///
/// The first is noted, so that a run ends with the frames that it has; the second ends the program at once.
pub(crate) fn listen() -> io::Result<impl Fn() -> Option<u8>> {
    let received = Arc::new(AtomicUsize::new(0));
    let is_second = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        register_conditional_shutdown(signal, 128 + signal, is_second.clone())?;
        register(signal, is_second.clone())?;
        register_usize(signal, received.clone(), signal as usize)?;
    }
    Ok(move || {
        let signal = u8::try_from(received.load(Ordering::Relaxed)).ok();
        signal.filter(|&signal| signal > 0).map(|signal| 128 + signal)
    })
}
