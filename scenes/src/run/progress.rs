//! Figures of a run so far, and the state from which it continues.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::moment::Moment;
use crate::output::{StepCounts, unseal};
use crate::settings::Settings;

/// Largest size of a state of a run, in bytes; a longer file is refused.
pub(super) const MAX_LENGTH: u64 = 1 << 32;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Progress {
    pub(super) inverted_at_start: usize,
    pub(super) stationary_start: bool,
    pub(super) min_det_f: f64,
    pub(super) newton_iterations: usize,
    #[serde(default)]
    pub(super) steps: StepCounts,
    /// Elastic energy in the last frame, J.
    pub(super) energy: f64,
    /// Mean distance that nodes have moved up to each frame, m.
    pub(super) motion: Vec<f64>,
}

/// A state of a run, from which it continues as if it had not been interrupted.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Saved {
    format: Format,
    pub(super) vtu: bool,
    pub(super) moment: Moment,
    pub(super) progress: Progress,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "piola run 1")]
    One,
}

impl Saved {
    pub(super) fn new(vtu: bool, moment: Moment, progress: Progress) -> Self {
        Self { format: Format::One, vtu, moment, progress }
    }

    /// Reads a state, and checks that a run with these settings can continue from it.
    pub(super) fn read(text: &str, settings: &Settings, vtu: bool) -> Result<Self, String> {
        let saved: Self = unseal(text).map_err(|error| format!("its state cannot be read: {error}"))?;
        let frame = saved.moment.clock().frame();
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
        match difference(saved.moment.settings(), settings) {
            Some(difference) => Err(difference),
            None => Ok(saved),
        }
    }
}

/// The first setting in which two runs differ, apart from the numbers of frames and threads, which do not
/// affect any frame.
fn difference(before: &Settings, now: &Settings) -> Option<String> {
    let values = |settings: &Settings| match serde_json::to_value(settings) {
        Ok(Value::Object(values)) => values,
        _ => serde_json::Map::new(),
    };
    let (before, now) = (values(before), values(now));
    let differs = |name: &&String| {
        !["frames", "threads"].contains(&name.as_str()) && before.get(*name) != now.get(*name)
    };
    let name = now.keys().find(differs)?;
    let text =
        |values: &serde_json::Map<String, Value>| values.get(name).map(Value::to_string).unwrap_or_default();
    Some(format!("its setting `{name}` was {}, and is {} now", text(&before), text(&now)))
}
