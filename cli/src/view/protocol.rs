//! What a page may say: JSON of one of the forms of [`Message`], and nothing else.
//!
//! ```
//! use piola_cli::view::protocol::{Act, Message};
//!
//! let text = r#"{"act": {"pull": {"hand": 1, "vertex": 7, "target": [0.0, 1.0, 0.5]}}}"#;
//! let pull = Act::Pull { hand: 1, vertex: 7, target: [0.0, 1.0, 0.5] };
//! assert_eq!(Message::parse(text), Ok(Message::Act(pull)));
//! assert!(Message::parse(r#"{"act": {"jump": {}}}"#).is_err());
//! ```

use serde::{Deserialize, Serialize};

/// A message from a page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Message {
    /// Changes the body, its material or its time step.
    Act(Act),
    /// Says when steps are made.
    Run(Run),
    /// Asks for one frame: the present one, or the next if that has been seen.
    Look {},
}

/// What changes the state that the next step starts from; recordings consist of these.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Act {
    /// Draws a vertex of the surface towards a point, by a spring, until it is released.
    Pull {
        /// By which a page tells its pulls apart; one that holds already moves on.
        hand: u64,
        /// The vertex, from 0.
        vertex: usize,
        /// The point, m.
        target: [f64; 3],
    },
    /// Ends a pull; nothing where there is none.
    Release {
        /// As given to the pull.
        hand: u64,
    },
    /// Ends all pulls but those of the scene.
    ReleaseAll {},
    /// Makes the body of another material, which starts where the body is.
    Material {
        /// As in the catalogue.
        name: String,
        /// Whether it gets the small-strain moduli that the body has, in place of its typical ones.
        as_stiff: bool,
    },
    /// Gives a parameter of the material another value.
    Parameter {
        /// Its name.
        name: String,
        /// All its values, several for a list.
        values: Vec<f64>,
    },
    /// Takes steps of another length.
    TimeStep {
        /// The length, s.
        seconds: f64,
    },
    /// Puts the body where the scene starts, of the present material.
    Reset {},
    /// Keeps the state.
    Save {},
    /// Goes back to the state that was kept last, material and time step included.
    Restore {},
}

/// When steps are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Run {
    /// None for now, or on again.
    Pause {
        /// Whether to pause.
        paused: bool,
    },
    /// A single one, and pauses.
    Step {},
    /// As fast as the clock on the wall, or as fast as they can be solved.
    Pace {
        /// Whether to keep to the clock.
        real_time: bool,
    },
}

impl Message {
    /// Reads a message.
    ///
    /// # Errors
    /// With the reason, where it is none.
    pub fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonsense_is_refused_with_its_reason() {
        for (text, guilty) in [
            ("", "EOF"),
            ("look", "expected value"),
            (r#"{"look": {}, "act": {}}"#, "expected"),
            (r#"{"look": {"far": 1}}"#, "far"),
            (r#"{"leap": {}}"#, "leap"),
            (r#"{"act": {"pull": {"hand": 1, "vertex": -7, "target": [0, 1, 2]}}}"#, "-7"),
            (r#"{"act": {"pull": {"hand": 1, "vertex": 7, "target": [0, 1]}}}"#, "length 3"),
            (r#"{"act": {"pull": {"hand": 1, "vertex": 7, "target": [0, 1, null]}}}"#, "null"),
            (r#"{"act": {"time_step": {"seconds": 1e999}}}"#, "out of range"),
            (r#"{"act": {"time_step": {"seconds": NaN}}}"#, "expected"),
        ] {
            let reason = Message::parse(text).expect_err(text);
            assert!(reason.contains(guilty), "{text}: {reason}");
        }
    }
}
