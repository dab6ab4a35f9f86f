//! Signals that end the program.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown, register_usize};

/// Listens to SIGINT, which Ctrl-C sends, and to SIGTERM.
///
/// The first is noted, so that a run ends with the frames that it has; the second ends the program at once.
#[derive(Debug)]
pub(crate) struct Signals {
    received: Arc<AtomicUsize>,
}

impl Signals {
    pub(crate) fn listen() -> io::Result<Self> {
        let received = Arc::new(AtomicUsize::new(0));
        let is_second = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            register_conditional_shutdown(signal, 128 + signal, is_second.clone())?;
            register(signal, is_second.clone())?;
            register_usize(signal, received.clone(), signal as usize)?;
        }
        Ok(Self { received })
    }

    /// Exit code for the signal that has come, if one has: 128 and its number, as shells count.
    pub(crate) fn exit_code(&self) -> Option<u8> {
        let signal = self.received.load(Ordering::Relaxed);
        u8::try_from(signal).ok().filter(|&signal| signal > 0).map(|signal| 128 + signal)
    }
}
