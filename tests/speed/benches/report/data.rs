//! Measurements of the report, as in `report.json`.

use serde::Serialize;

/// All results of the report. A value that is not finite is `null` in JSON.
#[derive(Serialize)]
pub(crate) struct Report {
    pub(crate) machine: String,
    /// Instructions of the lanes.
    pub(crate) back_end: String,
    /// Commit of the sources, if they are a Git checkout.
    pub(crate) commit: Option<String>,
    pub(crate) rows: Vec<PointRow>,
    pub(crate) steps: Vec<StepRow>,
    pub(crate) growth: Vec<GrowthRow>,
}

/// A method at a family of deformation gradients.
#[derive(Clone, Serialize)]
pub(crate) struct PointRow {
    /// `tangent`: P and dP/dF; `projected`: P and the nearest semidefinite matrix to dP/dF.
    pub(crate) work: &'static str,
    pub(crate) material: &'static str,
    pub(crate) precision: &'static str,
    pub(crate) method: &'static str,
    pub(crate) setting: String,
    /// The least of the repeats.
    pub(crate) ns_per_element: f64,
    /// The larger of ‖X − X*‖/(‖X*‖ + sens) of P and of the matrix.
    pub(crate) worst_error: f64,
    pub(crate) median_error: f64,
    pub(crate) family: String,
    /// Number of reference cases.
    pub(crate) cases: usize,
    /// True if it takes any ψ(λ1, λ2, λ3).
    pub(crate) is_general: bool,
    /// True if no other method for any ψ(λ) is both faster and more accurate in the worst case.
    pub(crate) is_on_front: bool,
}

/// A way to step a body through a motion.
#[derive(Default, Serialize)]
pub(crate) struct StepRow {
    pub(crate) setting: &'static str,
    /// Time step, s.
    pub(crate) h: f64,
    /// Wall time of all steps, s.
    pub(crate) seconds: f64,
    pub(crate) steps: usize,
    pub(crate) newton_iterations: usize,
    pub(crate) linear_iterations: usize,
    /// Largest distance of a node from the reference after any frame, body heights.
    pub(crate) error: f64,
    /// Largest distance of a node from the reference after the last frame, body heights.
    pub(crate) final_error: f64,
}

/// A step or an equilibrium of a box.
#[derive(Default, Serialize)]
pub(crate) struct GrowthRow {
    pub(crate) way: &'static str,
    pub(crate) threads: usize,
    pub(crate) elements: usize,
    /// The least of the steps.
    pub(crate) seconds: f64,
    pub(crate) peak_bytes: usize,
    pub(crate) newton_iterations: usize,
    pub(crate) linear_iterations: usize,
}
