//! The body in motion: executes orders between steps, steps in real time, and answers pages that request
//! frames.
//!
//! It never waits for a page. A page gets a frame for each request, made of the state at that moment; without
//! a request nothing is made and nothing is kept.

use std::collections::VecDeque;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::time::Duration;

use piola_declare::Energy;
use piola_scenes::error::Error;
use rayon::ThreadPool;

use crate::protocol::{Act, Run, Words};
use crate::session::Session;
use crate::show::{self, FrameStats};

/// Longest time for which orders are taken between two steps, unless a single one takes longer.
pub const TURN: Duration = Duration::from_millis(20);
/// Number of steps over which the speed is averaged.
const TIMED: usize = 32;
/// Longest lag of steps behind the clock on the wall before the clock is set back: a body too slow for real
/// time is played slowly, and does not race when it could.
const LAG: Duration = Duration::from_millis(100);

/// A request of a [conversation](crate::conversation).
#[derive(Debug)]
pub enum Order {
    /// A change of the body, its material or its time step.
    Act {
        /// The change.
        act: Act,
        /// The energy of an act that has the text of one, compiled.
        energy: Option<Energy>,
        /// Channel for the reason if it is refused.
        answer: Sender<Answer>,
    },
    /// A change of when steps are made.
    Run(Run),
    /// Request for a frame of a later state than the page has seen.
    Look {
        /// The state and the setup that it has seen last.
        seen: Seen,
        /// Channel for the frame.
        answer: Sender<Answer>,
    },
    /// A page has gone; its pulls, which are those with these drags, end too.
    Leave {
        /// The numbers of its drags.
        drags: Range<u64>,
    },
}

/// Numbers of a state that a page has seen, and of its description of scene and material; 0 before the first.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    state: u64,
    setup: u64,
}

/// The answer to an order: messages for the page.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The state that the page sees with them, unless they refuse an act.
    pub(crate) seen: Option<Seen>,
    pub(crate) words: Vec<Words>,
}

impl Answer {
    /// The answer that an act is refused, for this reason.
    pub(crate) fn refusal(act: &Act, error: Error) -> Self {
        Self { seen: None, words: vec![Words::Text(show::refused(act, error))] }
    }
}

/// A session, with everything that drives it.
#[derive(Debug)]
pub struct Driver {
    /// Time since a fixed moment.
    clock: fn() -> Duration,
    /// Threads that make the steps, or `None` for the caller.
    threads: Option<ThreadPool>,
    session: Session,
    /// File for saved states.
    save: Option<PathBuf>,
    stats: FrameStats,
    /// Time at which the step before was due.
    before: Duration,
    /// Times of the last steps.
    times: VecDeque<Duration>,
    /// Pages that wait for a frame, and the state that each has seen.
    lookers: Vec<(Seen, Sender<Answer>)>,
    /// Counts the states that could be seen, and the changes of their setup.
    present: Seen,
    /// Description of scene and material, unless they have changed since.
    setup: Option<Arc<str>>,
}

impl Driver {
    /// A driver of a session, with the time since a fixed moment, threads that make the steps instead of the
    /// caller, and a file for saved states.
    #[must_use]
    pub fn new(
        clock: fn() -> Duration,
        threads: Option<ThreadPool>,
        session: Session,
        save: Option<PathBuf>,
    ) -> Self {
        Self {
            before: clock(),
            clock,
            threads,
            session,
            save,
            stats: FrameStats { real_time: true, ..FrameStats::default() },
            times: VecDeque::with_capacity(TIMED),
            lookers: Vec::new(),
            present: Seen { state: 1, setup: 0 },
            setup: None,
        }
    }

    /// Makes a step if one is due, and answers the pages.
    pub fn turn(&mut self) {
        if !self.stats.paused && self.due() <= (self.clock)() {
            self.step();
        }
        self.answer();
    }

    /// Time for which there is nothing to do without an order; `None` if the body is paused.
    #[must_use]
    pub fn rest(&self) -> Option<Duration> {
        (!self.stats.paused).then(|| self.due().saturating_sub((self.clock)()))
    }

    /// Time at which the next step is due.
    fn due(&self) -> Duration {
        // A time step of a session has a million seconds at most.
        let dt = Duration::try_from_secs_f64(self.session.play().settings.dt).unwrap_or_default();
        if self.stats.real_time { self.before + dt } else { self.before }
    }

    /// Executes an order between two steps.
    pub fn obey(&mut self, order: Order) {
        match order {
            Order::Act { act, energy, answer } => {
                if let Err(error) = self.act(&act, energy) {
                    // A page that has gone needs no answer.
                    let _ = answer.send(Answer::refusal(&act, error));
                }
            }
            Order::Run(Run::Pause { paused }) => {
                self.stats.paused = paused;
                self.stats.trouble = None;
                self.before = (self.clock)();
            }
            Order::Run(Run::Step {}) => {
                self.stats.paused = true;
                self.stats.trouble = None;
                self.step();
            }
            Order::Run(Run::Pace { real_time }) => self.stats.real_time = real_time,
            Order::Look { seen, answer } => {
                self.lookers.push((seen, answer));
                return;
            }
            Order::Leave { drags } => {
                let left = self.session.pulls().map(|(drag, _)| drag);
                let left: Vec<_> = left.filter(|drag| drags.contains(drag)).collect();
                for drag in left {
                    // A release cannot fail.
                    let _ = self.act(&Act::Release { drag }, None);
                }
            }
        }
        self.present.state += 1;
    }

    fn act(&mut self, act: &Act, energy: Option<Energy>) -> Result<(), Error> {
        match (act, energy) {
            (Act::Energy { parameters, .. }, Some(energy)) => self.session.declare(energy, parameters)?,
            _ => self.session.apply(act)?,
        }
        let is_another_body =
            matches!(act, Act::Material { .. } | Act::Energy { .. } | Act::Parameter { .. });
        if is_another_body || matches!(act, Act::Reset {} | Act::Restore {}) {
            self.stats.trouble = None;
        }
        if !matches!(act, Act::Pull { .. } | Act::Release { .. } | Act::ReleaseAll {}) {
            self.setup = None;
        }
        match (act, &self.save, self.session.saved()) {
            (Act::Save {}, Some(path), Some(state)) => state.write(path),
            _ => Ok(()),
        }
    }

    fn step(&mut self) {
        let (start, session) = ((self.clock)(), &mut self.session);
        let result = match &self.threads {
            Some(threads) => threads.install(|| session.step()),
            None => session.step(),
        };
        let took = (self.clock)().saturating_sub(start);
        match result {
            Ok(report) => {
                if self.times.len() == TIMED {
                    self.times.pop_front();
                }
                self.times.push_back(took);
                let total: Duration = self.times.iter().sum();
                self.stats.steps_per_second = Some(self.times.len() as f64 / total.as_secs_f64());
                self.stats.newton_iterations = report.newton.iterations;
                self.stats.elastic_energy = report.energies.elastic;
            }
            Err(error) => {
                self.stats.paused = true;
                self.stats.trouble = Some(error.to_string());
            }
        }
        self.present.state += 1;

        let (now, due) = ((self.clock)(), self.due());
        self.before = if self.stats.real_time && due + LAG > now { due } else { now };
    }

    /// Sends the present state to the pages that have not seen it.
    fn answer(&mut self) {
        if self.lookers.iter().all(|(seen, _)| seen.state == self.present.state) {
            return;
        }
        let setup = self.setup.get_or_insert_with(|| {
            self.present.setup += 1;
            show::setup(&self.session, self.save.as_deref())
        });
        let present = self.present;
        let figures = Words::Text(show::figures(&self.session, &self.stats));
        let frame = [figures, Words::Binary(show::positions(&self.session))];
        for (seen, looker) in self.lookers.extract_if(.., |(seen, _)| seen.state != present.state) {
            let setup = (seen.setup != present.setup).then(|| Words::Text(setup.clone()));
            let words = setup.into_iter().chain(frame.clone()).collect();
            // A page that has gone needs no frame.
            let _ = looker.send(Answer { seen: Some(present), words });
        }
    }
}
