//! The thread that owns the body: takes orders between steps, steps in real time, and answers pages that ask
//! for frames.
//!
//! It waits for no page. A page gets a frame for each time it asks, made of the state at that moment; for one
//! that does not ask nothing is made and nothing is kept.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use piola_scenes::error::Error as SceneError;
use rayon::ThreadPool;
use tungstenite::Utf8Bytes;

use super::protocol::{Act, Run};
use super::recording::{Recorder, Recording};
use super::session::Session;
use super::show::{self, Frame, FrameStats};
use crate::error::Error;

/// How long orders may be taken between two steps, and acts of a recording between two looks at the orders. A
/// single one takes as long as it takes.
const TURN: Duration = Duration::from_millis(20);
/// Number of steps over which the speed is averaged.
const TIMED: usize = 32;
/// How far steps may lag behind the clock on the wall before the clock is set back: a body too slow for real
/// time is played slowly, and does not race when it could.
const LAG: Duration = Duration::from_millis(100);
/// How long to wait for an order where no step is due in any time that a clock can name.
const FOREVER: Duration = Duration::from_secs(3600);

/// A request of a connection.
#[derive(Debug)]
pub(super) enum Order {
    Act {
        act: Act,
        answer: Sender<Answer>,
    },
    Run(Run),
    /// A frame is wanted, of a later state than the one with this number.
    Look {
        seen: u64,
        answer: Sender<Answer>,
    },
    /// A connection has ended; its pulls, which are those with these drags, end too.
    Leave {
        drags: std::ops::Range<u64>,
    },
}

/// The answer to an order.
#[derive(Clone, Debug)]
pub(super) enum Answer {
    Frame(Frame),
    /// An act was refused; a message for the page.
    Refused(Utf8Bytes),
}

/// A session, with everything that drives it.
#[derive(Debug)]
pub(super) struct Driver {
    session: Session,
    threads: ThreadPool,
    /// File for saved states.
    save: Option<PathBuf>,
    recorder: Option<Recorder>,
    /// A recording that is played back; acts of pages are refused meanwhile.
    replay: Option<Recording>,
    stats: FrameStats,
    /// When the step before was due.
    before: Instant,
    /// Times of the last steps.
    times: VecDeque<Duration>,
    /// Connections that wait for a frame, and the state that each has seen.
    lookers: Vec<(u64, Sender<Answer>)>,
    /// Counts the states that could be seen.
    state: u64,
    revision: u64,
    /// Scene and material in words, and whether they have changed since.
    setup: Utf8Bytes,
    is_setup_stale: bool,
}

impl Driver {
    pub(super) fn new(
        session: Session,
        threads: ThreadPool,
        save: Option<PathBuf>,
        recorder: Option<Recorder>,
        replay: Option<Recording>,
    ) -> Self {
        Self {
            session,
            threads,
            save,
            recorder,
            replay,
            stats: FrameStats { real_time: true, ..FrameStats::default() },
            before: Instant::now(),
            times: VecDeque::with_capacity(TIMED),
            lookers: Vec::new(),
            state: 1,
            revision: 0,
            setup: Utf8Bytes::default(),
            is_setup_stale: true,
        }
    }

    /// Plays until every sender of orders is gone.
    pub(super) fn run(mut self, orders: &Receiver<Order>) {
        loop {
            match self.wait(orders) {
                Ok(order) => self.obey(order),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            let start = Instant::now();
            while start.elapsed() < TURN
                && let Ok(order) = orders.try_recv()
            {
                self.obey(order);
            }
            if self.is_replay_due() {
                self.play_back();
            } else if self.is_due() {
                self.step();
            }
            self.answer();
        }
    }

    /// The next order, or a time-out when a step or a recording is due.
    fn wait(&self, orders: &Receiver<Order>) -> Result<Order, RecvTimeoutError> {
        if self.is_replay_due() {
            return orders.recv_timeout(Duration::ZERO);
        }
        if self.stats.paused {
            return orders.recv().map_err(|_| RecvTimeoutError::Disconnected);
        }
        let wait = self.due().map(|due| due.saturating_duration_since(Instant::now()));
        orders.recv_timeout(wait.unwrap_or(FOREVER))
    }

    /// When the next step is due, by the clock on the wall; `None` if that is beyond all clocks.
    fn due(&self) -> Option<Instant> {
        if !self.stats.real_time {
            return Some(self.before);
        }
        let dt = Duration::try_from_secs_f64(self.session.settings().dt).ok()?;
        self.before.checked_add(dt)
    }

    fn is_due(&self) -> bool {
        !self.stats.paused && self.due().is_some_and(|due| due <= Instant::now())
    }

    fn obey(&mut self, order: Order) {
        match order {
            Order::Act { act, answer } => {
                let result = match self.replay {
                    Some(_) => {
                        Err(("a recording is played back; take over, or wait for its end".into(), Vec::new()))
                    }
                    None => self.act(&act).and_then(|()| self.save(&act)).map_err(|error| match error {
                        Error::Scene(SceneError::Declaration(mistakes)) => {
                            (mistakes.to_string(), mistakes.list)
                        }
                        error => (for_page(&error), Vec::new()),
                    }),
                };
                if let Err((reason, mistakes)) = result {
                    // A connection that has ended needs no answer.
                    let _ = answer.send(Answer::Refused(show::refused(&act, &reason, &mistakes)));
                }
            }
            Order::Run(Run::Pause { paused }) => {
                self.stats.paused = paused;
                self.stats.trouble = None;
                self.before = Instant::now();
            }
            Order::Run(Run::Step {}) => {
                self.stats.paused = true;
                self.stats.trouble = None;
                // Before the step come the acts that were recorded before it.
                self.play_back();
                if !self.is_replay_due() {
                    self.step();
                }
            }
            Order::Run(Run::Pace { real_time }) => self.stats.real_time = real_time,
            Order::Run(Run::TakeOver {}) => self.replay = None,
            Order::Look { seen, answer } => {
                self.lookers.push((seen, answer));
                return;
            }
            Order::Leave { drags } => {
                let left = self.session.pulls().map(|(drag, _)| drag);
                let left: Vec<_> = left.filter(|drag| drags.contains(drag)).collect();
                if self.replay.is_none() {
                    for drag in left {
                        // A release cannot fail.
                        let _ = self.act(&Act::Release { drag });
                    }
                }
            }
        }
        self.state += 1;
    }

    /// Does an act, and records it.
    fn act(&mut self, act: &Act) -> Result<(), Error> {
        self.session.apply(act)?;
        let steps = self.session.steps();
        self.record(|recorder| recorder.act(steps, act));
        let is_another_body =
            matches!(act, Act::Material { .. } | Act::Energy { .. } | Act::Parameter { .. });
        if is_another_body || matches!(act, Act::Reset {} | Act::Restore {}) {
            self.stats.trouble = None;
        }
        self.is_setup_stale |= !matches!(act, Act::Pull { .. } | Act::Release { .. } | Act::ReleaseAll {});
        Ok(())
    }

    /// Writes the state that a page has saved. Acts of a recording write no files.
    fn save(&self, act: &Act) -> Result<(), Error> {
        match (act, &self.save, self.session.saved()) {
            (Act::Save {}, Some(path), Some(state)) => state.write(path),
            _ => Ok(()),
        }
    }

    fn step(&mut self) {
        let clock = Instant::now();
        let result = self.threads.install(|| self.session.step());
        let took = clock.elapsed();
        match result {
            Ok(report) => {
                if self.times.len() == TIMED {
                    self.times.pop_front();
                }
                self.times.push_back(took);
                let total: Duration = self.times.iter().sum();
                self.stats.steps_per_second = Some(self.times.len() as f64 / total.as_secs_f64());
                self.stats.newton_iterations = report.newton.iterations;
                self.stats.energies = report.energies;
            }
            Err(error) => {
                self.stats.paused = true;
                self.stats.trouble = Some(error.to_string());
            }
        }
        let steps = self.session.steps();
        self.record(|recorder| recorder.stepped(steps));
        self.state += 1;

        let now = Instant::now();
        let due = self.due().unwrap_or(now);
        self.before = if self.stats.real_time && due + LAG > now { due } else { now };
    }

    /// Whether a recording has acts to be done before the step to come, or has come to its end.
    fn is_replay_due(&self) -> bool {
        let steps = self.session.steps();
        self.replay.as_ref().is_some_and(|recording| recording.is_due(steps) || recording.is_over(steps))
    }

    /// Does recorded acts before the step to come, as many as a page can wait for, and pauses at the end of
    /// the recording.
    fn play_back(&mut self) {
        let Some(mut recording) = self.replay.take() else { return };
        let (steps, start) = (self.session.steps(), Instant::now());
        while start.elapsed() < TURN
            && let Some(act) = recording.next_before(steps)
        {
            if let Err(error) = self.act(&act) {
                self.stats.trouble =
                    Some(format!("the recording asks for what is refused: {}", for_page(&error)));
            }
        }
        if recording.is_over(steps) {
            self.stats.paused = true;
        } else {
            self.replay = Some(recording);
        }
        self.state += 1;
    }

    fn record(&mut self, write: impl FnOnce(&mut Recorder) -> Result<(), Error>) {
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = write(recorder)
        {
            self.recorder = None;
            self.stats.recording_ended = Some(format!("the recording ends here: {}", for_page(&error)));
        }
    }

    /// Sends the present state to the connections that have not seen it.
    fn answer(&mut self) {
        if self.lookers.iter().all(|&(seen, _)| seen == self.state) {
            return;
        }
        if self.is_setup_stale {
            // The page is told no more of this machine than the name of its file.
            let file = self.save.as_deref().map(name_of);
            self.setup = show::setup(&self.session, file.as_deref());
            self.revision += 1;
            self.is_setup_stale = false;
        }
        self.stats.replays = self.replay.is_some();
        let frame = Frame {
            state: self.state,
            revision: self.revision,
            setup: self.setup.clone(),
            figures: show::figures(&self.session, &self.stats),
            positions: show::positions(&self.session),
        };
        for (_, looker) in self.lookers.extract_if(.., |&mut (seen, _)| seen != self.state) {
            // A connection that has ended needs no frame.
            let _ = looker.send(Answer::Frame(frame.clone()));
        }
    }
}

/// Message of an error for a page: of a file the name, and of the system's error the kind, which names no
/// path.
fn for_page(error: &Error) -> String {
    match error {
        Error::Scene(SceneError::Write { path, source }) => {
            format!("cannot write {}: {}", name_of(path), source.kind())
        }
        error => error.to_string(),
    }
}

fn name_of(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}
