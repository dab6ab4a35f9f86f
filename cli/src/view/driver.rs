//! The thread that owns the body: waits for orders and for the time of the next step.

use std::path::PathBuf;
use std::sync::LazyLock;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use piola_viewer::driver::{Driver, Order, TURN};
use piola_viewer::session::Session;
use rayon::ThreadPool;

/// Wait for an order while the body is paused.
const FOREVER: Duration = Duration::from_secs(3600);

/// Time since its first call.
fn clock() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Plays a session, whose state a page saves to a file, until every sender of orders is gone.
pub(super) fn run(threads: ThreadPool, session: Session, save: Option<PathBuf>, orders: &Receiver<Order>) {
    let mut driver = Driver::new(clock, Some(threads), session, save);
    loop {
        match orders.recv_timeout(driver.rest().unwrap_or(FOREVER)) {
            Ok(order) => driver.obey(order),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        let start = Instant::now();
        while start.elapsed() < TURN
            && let Ok(order) = orders.try_recv()
        {
            driver.obey(order);
        }
        driver.turn();
    }
}
