//! What was done to a body, as a file from which the same motion comes again, to the last bit.
//!
//! A line of JSON for the state at the start, one for each act with the number of the step before which it took effect,
//! and now and then one that says how many steps there have been. The last of these is where the recording ends.

use std::collections::VecDeque;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::protocol::Act;
use super::state::State;
use piola_scenes::error::Error;

/// So much of the end is lost at most where a viewer is ended from outside.
const MARKS: Duration = Duration::from_secs(1);

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Line {
    Start(Box<State>),
    Act {
        /// How many steps there have been.
        steps: u64,
        act: Act,
    },
    Until {
        /// How many steps there have been.
        steps: u64,
    },
}

/// A recording that is being made.
#[derive(Debug)]
pub struct Recorder {
    file: File,
    path: PathBuf,
    marked: Instant,
}

impl Recorder {
    /// Begins a recording, over the file of an earlier one.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn begin(path: &Path, state: State) -> Result<Self, Error> {
        let failure = |error: std::io::Error| Error::Write { path: path.into(), reason: error.to_string() };
        let file = File::create(path).map_err(failure)?;
        let mut recorder = Self { file, path: path.into(), marked: Instant::now() };
        recorder.write(&Line::Start(Box::new(state)))?;
        Ok(recorder)
    }

    /// Keeps an act that was done after so many steps.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn act(&mut self, steps: u64, act: &Act) -> Result<(), Error> {
        self.write(&Line::Act { steps, act: act.clone() })
    }

    /// Notes, at most once in a second, how many steps there have been.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn stepped(&mut self, steps: u64) -> Result<(), Error> {
        if self.marked.elapsed() < MARKS {
            return Ok(());
        }
        self.end(steps)
    }

    /// Notes how many steps there have been.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn end(&mut self, steps: u64) -> Result<(), Error> {
        self.marked = Instant::now();
        self.write(&Line::Until { steps })
    }

    fn write(&mut self, line: &Line) -> Result<(), Error> {
        let failure = |reason: String| Error::Write { path: self.path.clone(), reason };
        let mut text = serde_json::to_vec(line).map_err(|error| failure(error.to_string()))?;
        text.push(b'\n');
        self.file.write_all(&text).map_err(|error| failure(error.to_string()))
    }
}

/// A recording that is played back.
#[derive(Clone, Debug)]
pub struct Recording {
    start: State,
    acts: VecDeque<(u64, Act)>,
    until: u64,
}

impl Recording {
    /// Reads a recording. A last line without an end, as an interrupted viewer may leave it, is left out.
    ///
    /// # Errors
    /// [`Error::File`], the line named.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let file = path.display();
        let text = fs::read_to_string(path)
            .map_err(|error| Error::File { reason: format!("{file}: cannot be read: {error}") })?;
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        let mut start = None;
        let (mut acts, mut until) = (VecDeque::new(), 0);
        for (number, line) in whole.lines().enumerate() {
            let failure = |reason: &dyn std::fmt::Display| Error::File {
                reason: format!("{file}:{}: is no line of a recording: {reason}", number + 1),
            };
            let steps = match serde_json::from_str(line).map_err(|error| failure(&error))? {
                Line::Start(state) if number == 0 => {
                    start = Some(*state);
                    continue;
                }
                Line::Start(_) => return Err(failure(&"there is one start, at the top")),
                Line::Act { steps, act } => {
                    acts.push_back((steps, act));
                    steps
                }
                Line::Until { steps } => steps,
            };
            if steps < until {
                return Err(failure(&"it goes back in time"));
            }
            until = steps;
        }
        let start = start
            .ok_or_else(|| Error::File { reason: format!("{file}: is no recording: it has no start") })?;
        Ok(Self { start, acts, until })
    }

    /// The state before its first step.
    #[must_use]
    pub fn start(&self) -> &State {
        &self.start
    }

    /// The next act to be done after so many steps, and takes it out.
    pub fn next_before(&mut self, steps: u64) -> Option<Act> {
        let is_due = self.acts.front().is_some_and(|(due, _)| *due <= steps);
        if is_due { self.acts.pop_front().map(|(_, act)| act) } else { None }
    }

    /// Whether it ends after so many steps.
    #[must_use]
    pub fn is_over(&self, steps: u64) -> bool {
        steps >= self.until && self.acts.is_empty()
    }
}
