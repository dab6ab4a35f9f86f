//! Figures of a run so far, and the state from which it continues.

use std::io::Write;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::measure;
use crate::moment::Moment;
use crate::output::{Folder, STATE_FILE, StepCounts, frame_file, read_text, seal, unseal};
use crate::play::Play;
use crate::settings::{Settings, difference};

/// Largest size of a state of a run, in bytes; a longer file is refused.
const MAX_LENGTH: u64 = 1 << 32;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Progress {
    pub(super) inverted_at_start: usize,
    pub(super) min_det_f: f64,
    pub(super) newton_iterations: usize,
    #[serde(default)]
    pub(super) steps: StepCounts,
    /// Elastic energy in the last frame, J.
    pub(super) energy: f64,
    /// Mean distance that nodes have moved up to each frame, m.
    pub(super) motion: Vec<f64>,
}

impl Progress {
    /// Figures before the first frame is written.
    pub(super) fn at_start(play: &Play) -> Self {
        let (mesh, start) = (&play.geometry.mesh, play.simulation.positions());
        Self {
            inverted_at_start: measure::inverted(&mesh.positions, start, &mesh.tets),
            min_det_f: f64::INFINITY,
            newton_iterations: 0,
            steps: StepCounts::default(),
            energy: 0.0,
            motion: Vec::new(),
        }
    }
}

/// A state of a run, from which it continues as if it had not been interrupted.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved {
    format: Format,
    vtu: bool,
    moment: Moment,
    progress: Progress,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "piola run 2")]
    One,
}

/// Writes the state of a run, with tetrahedra or without, to its folder.
pub(super) fn save(folder: &Folder, vtu: bool, play: &Play, progress: &Progress) -> Result<(), Error> {
    let saved = Saved { format: Format::One, vtu, moment: Moment::of(play), progress: progress.clone() };
    folder.write(STATE_FILE, true, |file| file.write_all(&seal(&saved)?))
}

/// Takes a body to the last state of the run in a folder, if a run with its settings, and with tetrahedra or
/// without, can continue from there.
pub(super) fn restore(folder: &Folder, vtu: bool, play: &mut Play) -> Result<Progress, Error> {
    let refused = |reason| {
        Error::Usage(format!(
            "the run in {} cannot continue: {reason}; give the options that it was begun with, or leave out --resume \
             to begin anew",
            folder.path.display()
        ))
    };
    let text = read_text(&folder.path.join(STATE_FILE), MAX_LENGTH)?;
    let Saved { mut moment, progress, .. } =
        read(text.trim_end_matches('\n'), &play.settings, vtu).map_err(refused)?;
    moment.settings = play.settings.clone();
    *play = moment.resume(play.geometry.clone())?;
    for frame in 0..=play.clock.frame {
        if !folder.path.join(frame_file(frame)).is_file() {
            return Err(refused(format!("{} is missing", frame_file(frame))));
        }
    }
    Ok(progress)
}

/// Reads a state, and checks that a run with these settings can continue from it.
fn read(text: &str, settings: &Settings, vtu: bool) -> Result<Saved, String> {
    let saved: Saved = unseal(text).map_err(|error| format!("its state cannot be read: {error}"))?;
    let frame = saved.moment.clock.frame;
    let motion = &saved.progress.motion;
    if motion.len() != frame + 1 || !motion.iter().all(|way| way.is_finite()) {
        return Err("its state names other frames than it has".into());
    }
    if saved.vtu != vtu {
        let option = if vtu { "without" } else { "with" };
        return Err(format!("it was begun {option} --vtu"));
    }
    if frame > settings.frames {
        return Err(format!("it has {frame} frames already, and {} are wanted", settings.frames));
    }
    // The numbers of frames and threads affect no frame.
    let lasting = |settings: &Settings| {
        serde_json::to_value(Settings { frames: 1, threads: 1, ..settings.clone() }).unwrap_or_default()
    };
    match difference(&lasting(&saved.moment.settings), &lasting(settings)) {
        Some(difference) => Err(difference),
        None => Ok(saved),
    }
}
