//! Acts on a body in a file, from which the same motion comes again, to the last bit.
//!
//! A [sealed](piola_scenes::output::Sealer) line for the state at the start, one for each act with the number
//! of the step before which it took effect, and now and then one that says how many steps there have been.
//! The last of these is where the recording ends.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use piola_scenes::error::Error as SceneError;
use piola_scenes::output::{SealError, Sealer, Unsealer};
use piola_scenes::settings::Files;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::protocol::Act;
use crate::state::{MAX_DRAG, MAX_LENGTH, State, text_of};

/// Time between marks: at most this much of the end is lost if a viewer is ended from outside.
const MARKS: Duration = Duration::from_secs(1);
/// Most acts in a recording: pulls with a mouse for hours.
const MAX_ACTS: usize = 1_000_000;
/// Most steps in a recording: a year of them in real time.
const MAX_STEPS: u64 = 1_000_000_000;
/// The longest line of an act, in bytes: a list of parameters as long as a page can send it.
const MAX_ACT: usize = 64 * 1024;
/// First bytes of a recording, with eight zeros in place of a checksum.
const BEGINNING: &[u8] = br#"{"crc32":"00000000","content":{"start":{"#;

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
///
/// It ends with the first error; what is in the file by then can be played back.
#[derive(Debug)]
pub struct Recorder {
    file: File,
    sealer: Sealer,
    path: PathBuf,
    marked: Instant,
    /// Bytes of whole lines in the file.
    length: u64,
    acts: usize,
}

impl Recorder {
    /// Begins a recording, over the file of an earlier one.
    ///
    /// # Errors
    /// [`Error::Scene`], or [`Error::NotRecordedOver`] if the file holds something else.
    pub fn begin(path: &Path, state: State) -> Result<Self, Error> {
        let failed = |source| SceneError::Write { path: path.into(), source };
        if !may_be_replaced(path).map_err(failed)? {
            return Err(Error::NotRecordedOver { path: path.into() });
        }
        let mut sealer = Sealer::new();
        let start = sealer.line(&Line::Start(Box::new(state))).map_err(|error| failed(error.into()))?;
        check_length(start.len() as u64)?;
        // Only now is an earlier recording given up.
        let file = File::create(path).map_err(failed)?;
        let marked = Instant::now();
        let mut recorder = Self { file, sealer, path: path.into(), marked, length: 0, acts: 0 };
        recorder.append(&start)?;
        Ok(recorder)
    }

    /// Records an act that was done after a number of steps.
    ///
    /// # Errors
    /// [`Error::Scene`], or [`Error::RecordingFull`].
    pub fn act(&mut self, steps: u64, act: &Act) -> Result<(), Error> {
        self.acts += 1;
        if self.acts > MAX_ACTS {
            return Err(Error::RecordingFull("a million acts"));
        }
        self.write(&Line::Act { steps, act: act.clone() })
    }

    /// Records the number of steps, at most once in a second.
    ///
    /// # Errors
    /// [`Error::Scene`], or [`Error::RecordingFull`].
    pub fn stepped(&mut self, steps: u64) -> Result<(), Error> {
        if self.marked.elapsed() < MARKS {
            return Ok(());
        }
        self.end(steps)
    }

    /// Records the number of steps.
    ///
    /// # Errors
    /// [`Error::Scene`], or [`Error::RecordingFull`].
    pub fn end(&mut self, steps: u64) -> Result<(), Error> {
        self.marked = Instant::now();
        self.write(&Line::Until { steps })
    }

    fn write(&mut self, line: &Line) -> Result<(), Error> {
        if let &Line::Act { steps, .. } | &Line::Until { steps } = line
            && steps > MAX_STEPS
        {
            return Err(Error::RecordingFull("a thousand million steps"));
        }
        let failed = |source| SceneError::Write { path: self.path.clone(), source };
        let text = self.sealer.line(line).map_err(|error| failed(error.into()))?;
        if text.len() > MAX_ACT {
            return Err(Error::RecordingFull("64 KiB for an act"));
        }
        self.append(&text)
    }

    fn append(&mut self, text: &[u8]) -> Result<(), Error> {
        let length = self.length + text.len() as u64;
        check_length(length)?;
        if let Err(source) = self.file.write_all(text) {
            // Where even this fails, the last line is cut off, and reading leaves it out.
            let _ = self.file.set_len(self.length);
            return Err(SceneError::Write { path: self.path.clone(), source }.into());
        }
        self.length = length;
        Ok(())
    }
}

fn check_length(length: u64) -> Result<(), Error> {
    if length > MAX_LENGTH { Err(Error::RecordingFull("256 MiB")) } else { Ok(()) }
}

/// Whether nothing but a recording is lost if the file is written anew.
fn may_be_replaced(path: &Path) -> io::Result<bool> {
    match path.metadata() {
        // An empty file holds nothing, and a pipe or a device keeps nothing.
        Ok(file) if !file.is_file() || file.len() == 0 => return Ok(true),
        Ok(_) => {}
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        Err(error) => return Err(error),
    }
    let mut beginning = Vec::new();
    File::open(path)?.take(BEGINNING.len() as u64).read_to_end(&mut beginning)?;
    let is_alike =
        |(&byte, &wanted): (&u8, &u8)| byte == wanted || wanted == b'0' && byte.is_ascii_hexdigit();
    Ok(beginning.len() == BEGINNING.len() && beginning.iter().zip(BEGINNING).all(is_alike))
}

/// A recording that is played back.
#[derive(Clone, Debug)]
pub struct Recording {
    start: State,
    acts: VecDeque<(u64, Act)>,
    until: u64,
}

impl Recording {
    /// Reads a recording.
    ///
    /// # Errors
    /// [`Error::Unreadable`], or like [`Recording::parse`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::parse(&text_of(path)?, path)
    }

    /// Parses the text of a recording; `path` is for messages. One that ends after any of its lines, or in
    /// the middle of one, as an interrupted viewer leaves it, is played up to there.
    ///
    /// # Errors
    /// [`Error::NotRecording`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, Error> {
        let failure = |line, reason| Error::NotRecording { path: path.into(), line, reason };
        let mut unsealer = Unsealer::new();
        let mut start = None;
        let (mut acts, mut until) = (VecDeque::new(), 0);
        for (line, text) in (1..).zip(text.split_inclusive('\n')) {
            let is_last = !text.ends_with('\n');
            let content = match unsealer.line(text) {
                // A viewer that was ended while it wrote.
                Err(SealError::NotJson(_)) if is_last && is_cut_off(text) => break,
                content => content.map_err(|error| failure(line, error.to_string()))?,
            };
            let steps = match content {
                Line::Start(state) if line == 1 => {
                    start = Some(*state);
                    continue;
                }
                _ if line == 1 => return Err(failure(1, "it has no start".into())),
                Line::Start(_) => return Err(failure(line, "there is one start, at the top".into())),
                Line::Act { steps, act } => {
                    let refused = if text.len() > MAX_ACT {
                        Some("an act is longer than 64 KiB")
                    } else if acts.len() == MAX_ACTS {
                        Some("there are more than a million acts")
                    } else if act.drag().is_some_and(|drag| drag >= MAX_DRAG) {
                        Some("the number of a drag is 2^62 or more")
                    } else {
                        None
                    };
                    if let Some(reason) = refused {
                        return Err(failure(line, reason.into()));
                    }
                    acts.push_back((steps, act));
                    steps
                }
                Line::Until { steps } => steps,
            };
            if steps > MAX_STEPS {
                return Err(failure(line, "there are more than a thousand million steps".into()));
            }
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

    /// Numbers of the drags to come.
    pub fn drags(&self) -> impl Iterator<Item = u64> {
        self.acts.iter().filter_map(|(_, act)| act.drag())
    }

    /// Removes the next act if it is to be done after this number of steps.
    pub fn next_before(&mut self, steps: u64) -> Option<Act> {
        if self.is_due(steps) { self.acts.pop_front().map(|(_, act)| act) } else { None }
    }

    /// Whether an act is to be done after this number of steps.
    #[must_use]
    pub fn is_due(&self, steps: u64) -> bool {
        self.acts.front().is_some_and(|(due, _)| *due <= steps)
    }

    /// Whether the recording ends after this number of steps.
    #[must_use]
    pub fn is_over(&self, steps: u64) -> bool {
        steps >= self.until && self.acts.is_empty()
    }
}

/// Whether a text that is not JSON is not just JSON with something behind it.
fn is_cut_off(text: &str) -> bool {
    let mut but_one = text.chars();
    but_one.next_back();
    serde_json::from_str::<IgnoredAny>(but_one.as_str()).is_err()
}
