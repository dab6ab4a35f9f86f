//! Messages of a page: JSON in one of the forms of [`Message`], and nothing else. Messages for it are
//! [`Words`].
//!
//! ```
//! use piola_viewer::protocol::{Act, Message};
//!
//! let text = r#"{"act": {"pull": {"drag": 1, "vertex": 7, "target": [0.0, 1.0, 0.5]}}}"#;
//! let pull = Act::Pull { drag: 1, vertex: 7, target: [0.0, 1.0, 0.5] };
//! let read = serde_json::from_str::<Message>;
//! assert!(read(text).is_ok_and(|message| message == Message::Act(pull)));
//! assert!(read(r#"{"act": {"jump": {}}}"#).is_err());
//! ```

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// A message for a page.
#[derive(Clone, Debug)]
pub enum Words {
    /// JSON.
    Text(Arc<str>),
    /// Numbers, as [`topology`](crate::topology) describes them.
    Binary(Arc<[u8]>),
}

/// A message from a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Message {
    /// Changes the body, its material or its time step.
    Act(Act),
    /// Changes when steps are made.
    Run(Run),
    /// Requests one frame: the present one, or the next if the page has seen that.
    Look {},
}

/// A change of the state from which the next step starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Act {
    /// Draws a vertex of the surface towards a point, by a spring, until it is released.
    Pull {
        /// Number by which a page identifies its drags; a drag that has begun moves on.
        drag: u64,
        /// The vertex, from 0.
        vertex: usize,
        /// The point, m.
        target: [f64; 3],
    },
    /// Ends a pull, if there is one.
    Release {
        /// Number of the drag.
        drag: u64,
    },
    /// Ends all pulls except for those of the scene.
    ReleaseAll {},
    /// Replaces the material; the body stays where it is.
    Material {
        /// Name in the catalogue.
        name: String,
        /// True to scale it to the small-strain moduli of the body, instead of its typical ones.
        as_stiff: bool,
    },
    /// Replaces the material by an energy as it is typed; the body stays where it is.
    Energy {
        /// A formula, or a declaration in Rust.
        text: String,
        /// Values of parameters, several for a list. A missing one is taken from a parameter of the same name
        /// in the present material, or else chosen so that the body is about as stiff as before.
        parameters: BTreeMap<String, Vec<f64>>,
    },
    /// Changes a parameter of the material.
    Parameter {
        /// Its name.
        name: String,
        /// All its values, several for a list.
        values: Vec<f64>,
    },
    /// Changes the time step.
    TimeStep {
        /// The length, s.
        seconds: f64,
    },
    /// Resets the body, with the present material, to the start of the scene.
    Reset {},
    /// Saves the state.
    Save {},
    /// Returns to the state that was saved last, material and time step included.
    Restore {},
}

/// A change of when steps are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Run {
    /// Pauses or resumes.
    Pause {
        /// True to pause.
        paused: bool,
    },
    /// Makes a single step, and pauses.
    Step {},
    /// Steps in real time, or as fast as steps can be solved.
    Pace {
        /// True to keep to real time.
        real_time: bool,
    },
}
