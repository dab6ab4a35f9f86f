//! The thread that owns the body: waits for orders and for the time of the next step.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use piola_bodies::step::StepReport;
use piola_scenes::error::Error as SceneError;
use piola_viewer::driver::{Driver, Host, Order, TURN};
use piola_viewer::session::Session;
use rayon::ThreadPool;

/// Wait for an order when no step is due in any time that a clock can represent.
const FOREVER: Duration = Duration::from_secs(3600);

/// The clock of this machine, and threads to make steps with.
struct OwnThreads {
    start: Instant,
    threads: ThreadPool,
}

impl Host for OwnThreads {
    fn now(&self) -> Duration {
        self.start.elapsed()
    }

    fn step(&self, session: &mut Session) -> Result<StepReport, SceneError> {
        self.threads.install(|| session.step())
    }
}

/// Plays a session, whose state a page saves to a file, until every sender of orders is gone.
pub(super) fn run(threads: ThreadPool, session: Session, save: Option<PathBuf>, orders: &Receiver<Order>) {
    let mut driver = Driver::new(OwnThreads { start: Instant::now(), threads }, session, save);
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
