//! What the report measures, as `report.json` has it.

use serde::{Deserialize, Serialize};

/// All of it. What does not apply or is not finite is `null`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(bound(deserialize = "'de: 'static"))]
pub(crate) struct Report {
    pub(crate) machine: String,
    /// Instructions of the lanes.
    pub(crate) back_end: String,
    /// Of the sources, where they are a Git checkout.
    pub(crate) commit: Option<String>,
    /// Seconds since 1970.
    pub(crate) time: u64,
    pub(crate) rows: Vec<PointRow>,
    pub(crate) steps: Vec<StepRow>,
    pub(crate) histories: Vec<HistoryRow>,
    pub(crate) adaptive: Vec<AdaptiveRow>,
    pub(crate) growth: Vec<GrowthRow>,
}

/// A method at a family of deformation gradients.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct PointRow {
    pub(crate) section: &'static str,
    /// `tangent`: P and dP/dF; `projected`: P and the nearest semidefinite matrix to dP/dF.
    pub(crate) work: &'static str,
    pub(crate) material: &'static str,
    pub(crate) precision: &'static str,
    pub(crate) method: &'static str,
    pub(crate) setting: String,
    /// Least and median of the repeats.
    pub(crate) ns_per_element: f64,
    pub(crate) median_ns_per_element: f64,
    /// The larger of ‖X − X*‖/(‖X*‖ + sens) of P and of the matrix; `null` for what is not finite.
    #[serde(serialize_with = "finite::serialize", deserialize_with = "finite::or_infinite")]
    pub(crate) worst_error: f64,
    #[serde(serialize_with = "finite::serialize", deserialize_with = "finite::or_infinite")]
    pub(crate) median_error: f64,
    pub(crate) family: String,
    /// Number of reference cases.
    pub(crate) cases: usize,
    /// Whether it takes any ψ(λ1, λ2, λ3).
    pub(crate) is_general: bool,
    /// Whether no other method for any ψ(λ) is both faster and more accurate in the worst case.
    pub(crate) is_on_front: bool,
}

/// A way to step a body through a scene.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct StepRow {
    pub(crate) scene: &'static str,
    /// What is varied: `h`, `one iteration` (the integrator), `tolerance`, `newton`, `filter`, `solver`,
    /// `precision`, or nothing: `reference`.
    pub(crate) axis: &'static str,
    pub(crate) setting: String,
    /// Time step, s.
    pub(crate) h: f64,
    /// Wall time of all steps, s.
    #[serde(with = "finite")]
    pub(crate) seconds: f64,
    pub(crate) steps: usize,
    pub(crate) newton_iterations: usize,
    pub(crate) linear_iterations: usize,
    /// Largest distance of a node from the reference trajectory at the instants compared, body heights.
    #[serde(with = "finite")]
    pub(crate) error: f64,
    /// The same after the last of them.
    #[serde(with = "finite")]
    pub(crate) final_error: f64,
    /// The largest distance from the motion with the same time step whose steps are solved as far as rounding
    /// allows.
    #[serde(with = "finite")]
    pub(crate) algebraic_error: f64,
    /// Of a free body: the largest change of the total energy relative to it,
    #[serde(with = "finite")]
    pub(crate) largest_energy_error: f64,
    /// its change from begin to end,
    #[serde(with = "finite")]
    pub(crate) energy_drift: f64,
    /// of the momentum relative to Σ m |v|,
    #[serde(with = "finite")]
    pub(crate) linear_momentum_drift: f64,
    /// and of the angular momentum relative to it.
    #[serde(with = "finite")]
    pub(crate) angular_momentum_drift: f64,
    /// Why it did not come to the end.
    pub(crate) failure: Option<String>,
}

/// A free body over time, with the time step of the scene.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct HistoryRow {
    pub(crate) scene: &'static str,
    pub(crate) setting: String,
    pub(crate) instants: Vec<HistoryInstant>,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(crate) struct HistoryInstant {
    /// s.
    pub(crate) time: f64,
    /// Relative to that before the first step.
    #[serde(with = "finite")]
    pub(crate) energy: f64,
    /// Of the vector, relative to its length before the first step.
    #[serde(with = "finite")]
    pub(crate) angular_momentum_error: f64,
}

/// A frame of a scene whose steps of time follow from their error.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(crate) struct AdaptiveRow {
    /// Body heights per second.
    pub(crate) tolerance: f64,
    /// At the end of the frame, s.
    pub(crate) time: f64,
    /// Length of the shortest step, s; each is made as two halves.
    pub(crate) shortest: f64,
    pub(crate) taken: usize,
    pub(crate) refused: usize,
    /// Steps that were the shortest there are, and their error still too large.
    pub(crate) unresolved: usize,
    /// Estimate, body heights per second.
    pub(crate) error: f64,
    /// Of all attempts.
    pub(crate) newton_iterations: usize,
}

/// A step of a box.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct GrowthRow {
    pub(crate) solver: &'static str,
    pub(crate) threads: usize,
    pub(crate) elements: usize,
    pub(crate) unknowns: usize,
    /// `null` where it was stopped.
    #[serde(with = "finite")]
    pub(crate) seconds_per_step: f64,
    #[serde(with = "finite")]
    pub(crate) peak_bytes: f64,
    #[serde(with = "finite")]
    pub(crate) newton_iterations: f64,
    #[serde(with = "finite")]
    pub(crate) linear_iterations: f64,
    /// Why it was stopped.
    pub(crate) stopped: Option<String>,
}

/// `null` for what is not finite. Read again, it is NaN: nothing to show; but for errors, which are then as
/// large as can be.
mod finite {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        number.is_finite().then_some(*number).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
    }

    pub(super) fn or_infinite<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}
