//! Time limits for the other side of a connection, and a stream that enforces them.

use std::io::{self, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Limit for a whole request; a browser sends it at once.
pub(super) const REQUEST: Duration = limit(5, 100);
/// Limit for sending one answer, frame or message; on one machine that takes milliseconds.
pub(super) const ANSWER: Duration = limit(10, 100);
/// Silence of a page after which it is pinged. A paused page may be silent for hours.
pub(super) const PING: Duration = limit(20, 100);
/// Silence after which a page is disconnected. A browser answers a ping by itself, even for a page in the
/// background or one that computes; while the machine sleeps, this clock stands still.
pub(super) const SILENCE: Duration = limit(60, 500);

/// Time after which a connection is closed, which holds one of a few places: seconds, or in the unit tests
/// milliseconds.
const fn limit(seconds: u64, in_tests: u64) -> Duration {
    if cfg!(test) { Duration::from_millis(in_tests) } else { Duration::from_secs(seconds) }
}

/// A connection whose reads and writes together end by a set time, regardless of the speed of the other side.
#[derive(Debug)]
pub(super) struct TimedStream {
    pub(super) stream: TcpStream,
    until: Instant,
}

impl TimedStream {
    /// A connection without any time yet.
    pub(super) fn new(stream: TcpStream) -> Self {
        Self { stream, until: Instant::now() }
    }

    /// Gives this much time to the reads and writes to come, from now on.
    pub(super) fn allow(&mut self, time: Duration) {
        self.until = Instant::now() + time;
    }

    fn left(&self) -> io::Result<Duration> {
        let left = self.until.saturating_duration_since(Instant::now());
        // Errors of systems when a read or a write takes too long.
        if left.is_zero() { Err(ErrorKind::WouldBlock.into()) } else { Ok(left) }
    }
}

impl Read for TimedStream {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(Some(self.left()?))?;
        self.stream.read(bytes)
    }
}

impl Write for TimedStream {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(Some(self.left()?))?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// True if a read or a write has ended because its time was over.
pub(super) fn is_silence(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut)
}
