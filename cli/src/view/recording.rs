//! Acts on a body in a file, from which the same motion comes again, to the last bit.
//!
//! A [sealed](piola_scenes::output::Sealer) line for the state at the start, one for each act with the number
//! of the step before which it took effect, and now and then one that says how many steps there have been.
//! The last of these is where the recording ends.

use std::collections::VecDeque;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use piola_scenes::error::Error as SceneError;
use piola_scenes::output::{Sealer, Unsealer};
use piola_scenes::settings::Files;
use serde::{Deserialize, Serialize};

use super::protocol::Act;
use super::state::State;
use crate::error::Error;

/// Time between marks: at most this much of the end is lost if a viewer is ended from outside.
const MARKS: Duration = Duration::from_secs(1);

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Line {
    Start(Box<State>),
    Act {
        /// Number of steps so far.
        steps: u64,
        act: Act,
    },
    Until {
        /// Number of steps so far.
        steps: u64,
    },
}

/// A recording that is being made.
#[derive(Debug)]
pub struct Recorder {
    file: File,
    sealer: Sealer,
    path: PathBuf,
    marked: Instant,
}

impl Recorder {
    /// Begins a recording, over the file of an earlier one.
    ///
    /// # Errors
    /// [`Error::Scene`].
    pub fn begin(path: &Path, state: State) -> Result<Self, Error> {
        let file = File::create(path).map_err(|source| SceneError::Write { path: path.into(), source })?;
        let mut recorder = Self { file, sealer: Sealer::new(), path: path.into(), marked: Instant::now() };
        recorder.write(&Line::Start(Box::new(state)))?;
        Ok(recorder)
    }

    /// Records an act that was done after a number of steps.
    ///
    /// # Errors
    /// [`Error::Scene`].
    pub fn act(&mut self, steps: u64, act: &Act) -> Result<(), Error> {
        self.write(&Line::Act { steps, act: act.clone() })
    }

    /// Records the number of steps, at most once in a second.
    ///
    /// # Errors
    /// [`Error::Scene`].
    pub fn stepped(&mut self, steps: u64) -> Result<(), Error> {
        if self.marked.elapsed() < MARKS {
            return Ok(());
        }
        self.end(steps)
    }

    /// Records the number of steps.
    ///
    /// # Errors
    /// [`Error::Scene`].
    pub fn end(&mut self, steps: u64) -> Result<(), Error> {
        self.marked = Instant::now();
        self.write(&Line::Until { steps })
    }

    fn write(&mut self, line: &Line) -> Result<(), Error> {
        let text = self.sealer.line(line).map_err(io::Error::from);
        let written = text.and_then(|text| self.file.write_all(&text));
        Ok(written.map_err(|source| SceneError::Write { path: self.path.clone(), source })?)
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
    /// Reads a recording. One that ends after any of its lines, as an interrupted viewer leaves it, is whole.
    ///
    /// # Errors
    /// [`Error::Unreadable`] or [`Error::NotRecording`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text =
            fs::read_to_string(path).map_err(|source| Error::Unreadable { path: path.into(), source })?;
        let failure = |line, reason| Error::NotRecording { path: path.into(), line, reason };
        let mut unsealer = Unsealer::new();
        let mut start = None;
        let (mut acts, mut until) = (VecDeque::new(), 0);
        for (line, text) in (1..).zip(text.split_inclusive('\n')) {
            if !text.ends_with('\n') {
                let reason = "the line is cut off; without it, the file can be played up to here";
                return Err(failure(line, reason.into()));
            }
            let steps = match unsealer.line(text).map_err(|error| failure(line, error.to_string()))? {
                Line::Start(state) if line == 1 => {
                    start = Some(*state);
                    continue;
                }
                Line::Start(_) => return Err(failure(line, "there is one start, at the top".into())),
                Line::Act { steps, act } => {
                    acts.push_back((steps, act));
                    steps
                }
                Line::Until { steps } => steps,
            };
            if steps < until {
                return Err(failure(line, "it goes back in time".into()));
            }
            until = steps;
        }
        let start = start.ok_or_else(|| failure(1, "it has no start".into()))?;
        Ok(Self { start, acts, until })
    }

    /// Takes the body from files, or, with `None`, that of the program.
    #[must_use]
    pub fn with_files(self, files: Option<Files>) -> Self {
        Self { start: self.start.with_files(files), ..self }
    }

    /// The state before its first step.
    #[must_use]
    pub fn start(&self) -> &State {
        &self.start
    }

    /// Removes the next act if it is to be done after this number of steps.
    pub fn next_before(&mut self, steps: u64) -> Option<Act> {
        let is_due = self.acts.front().is_some_and(|(due, _)| *due <= steps);
        if is_due { self.acts.pop_front().map(|(_, act)| act) } else { None }
    }

    /// Whether the recording ends after this number of steps.
    #[must_use]
    pub fn is_over(&self, steps: u64) -> bool {
        steps >= self.until && self.acts.is_empty()
    }
}
