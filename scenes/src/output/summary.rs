//! Results of a run.

use std::fmt;
use std::ops::AddAssign;

use serde::{Deserialize, Serialize};

use piola::__private::message::number;
use piola_bodies::step::Integrator;

use crate::material::Parameters;

/// Accuracy to which each time step is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Newton {
    /// One iteration with line search, regardless of the residual that it leaves.
    #[default]
    Single,
    /// Iterations until the residual is small.
    Full,
}

/// Counts of the time steps of the frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepCounts {
    /// Number of steps taken.
    pub taken: usize,
    /// Number of steps that were too long for the tolerance, or failed, and were made again in halves.
    pub refused: usize,
    /// Number of steps taken at the shortest length although their error was above the tolerance.
    pub unresolved: usize,
}

impl AddAssign for StepCounts {
    fn add_assign(&mut self, more: Self) {
        self.taken += more.taken;
        self.refused += more.refused;
        self.unresolved += more.unresolved;
    }
}

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// All steps have been made.
    Finished,
    /// A signal has ended the run before its last step.
    Interrupted,
    /// A step has failed, or a file could not be written.
    Failed,
}

/// Stretch and stress of an upright specimen in a testing machine.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TensileReading {
    /// Stretch between the marks; `None` if nodes lie at fewer than two heights there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stretch: Option<f64>,
    /// Upward force of the springs that pull at it, over its mean cross-section at rest, Pa.
    pub nominal_stress: f64,
    /// Stress of the material at that stretch with free sides, Pa; `None` if it has none, or if the body is
    /// of several materials.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uniaxial_stress: Option<f64>,
}

impl TensileReading {
    /// The missing measurement, with the reason.
    #[must_use]
    pub fn missing(&self) -> Option<&'static str> {
        match (self.uniaxial_stress, self.stretch) {
            (Some(_), _) => None,
            (None, None) => Some(
                "no stretch was measured: between the marks, nodes lie at fewer than two heights, so refine the mesh \
                 there",
            ),
            (None, Some(_)) => Some("there is no uniaxial tension of one material at that stretch"),
        }
    }
}

impl fmt::Display for TensileReading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stretch, nominal_stress, uniaxial_stress } = self;
        if let Some(stretch) = stretch {
            write!(f, "stretch {stretch:.3} at a ")?;
        }
        write!(f, "nominal stress of {nominal_stress:.4e} Pa; ")?;
        match uniaxial_stress {
            Some(stress) => write!(f, "uniaxial tension of the material gives {stress:.4e} Pa"),
            None => f.write_str(self.missing().unwrap_or_default()),
        }
    }
}

/// Kind of the equilibrium of a body that has not recovered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FinalPlace {
    /// Rest shape: it was not given the time.
    Rest,
    /// Minimum of its energy elsewhere.
    StableElsewhere,
    /// Saddle: some small motion would reduce the energy, though the forces vanish.
    Saddle,
    /// Equilibrium elsewhere, in which some motion needs no energy within rounding errors.
    UndecidedElsewhere,
    /// No equilibrium yet: forces are not in balance.
    NotAtRest,
}

impl fmt::Display for FinalPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rest => "not at rest yet; statics takes it back",
            Self::StableElsewhere => "stable equilibrium elsewhere",
            Self::Saddle => "saddle",
            Self::UndecidedElsewhere => "equilibrium elsewhere, stable or not within rounding",
            Self::NotAtRest => "not at rest yet, nor brought there by statics",
        })
    }
}

/// Equilibrium of a body that has not recovered, found by statics from the final frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FinalState {
    /// Kind of the equilibrium.
    pub place: FinalPlace,
    /// [`Summary::max_distance_from_rest`] in equilibrium.
    pub max_distance_from_rest: f64,
    /// Norm of the forces on free nodes, N.
    pub residual: f64,
    /// `residual` as a share of the largest force of an element on a node.
    pub relative_residual: f64,
    /// True if no element bears stress beyond rounding.
    pub stress_free: bool,
    /// Number of elements that are inside out.
    pub inverted: usize,
    /// The smallest λ2 + λ3 of an element.
    pub smallest_sum: f64,
}

impl fmt::Display for FinalState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "  {}, {:.2e} body heights from rest", self.place, self.max_distance_from_rest)?;
        match self.stress_free {
            true => write!(f, "    no stress, residual {:.1e} N; ", self.residual)?,
            false => write!(
                f,
                "    residual {:.1e} N, {:.1e} of the largest force; ",
                self.residual, self.relative_residual
            )?,
        }
        write!(f, "{} elements inside out, smallest λ2 + λ3 {:.2e}", self.inverted, self.smallest_sum)
    }
}

/// Size, mass, pins and materials of a body before its first step, to be compared with what was meant, and
/// warnings.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Overview {
    /// Number of tetrahedra.
    pub tets: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of nodes that are held.
    pub held: usize,
    /// Lengths at rest along x, y and z, m.
    pub size: [f64; 3],
    /// Volume at rest, m³.
    pub volume: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Gravity along x, y and z, m/s².
    pub gravity: [f64; 3],
    /// Each material in words: parameters, density, groups of the mesh, moduli at rest.
    pub materials: Vec<String>,
    /// Properties of body, materials and scene that may be unintended; in a summary also measurements that
    /// are missing.
    pub warnings: Vec<String>,
}

impl fmt::Display for Overview {
    /// Formats the overview as some lines of text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tets, nodes, held, materials, .. } = self;
        let ([x, y, z], [_, gravity, _]) = (self.size.map(short), self.gravity.map(short));
        let (volume, mass) = (short(self.volume), short(self.mass));
        writeln!(f, "{tets} tetrahedra, {nodes} nodes, {held} of them held")?;
        writeln!(f, "  {x} m along x, {y} m along y, {z} m along z; {volume} m³, {mass} kg")?;
        write!(f, "  gravity {gravity} m/s² along y, which points upwards")?;
        materials.iter().try_for_each(|material| write!(f, "\n  {material}"))
    }
}

/// Results of a run. In JSON the keys are the names of the fields, also of those of [`Overview`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Name of the material of the tetrahedra without one of their own.
    pub material: String,
    /// Parameters of the material by name, in SI units.
    pub parameters: Parameters,
    /// Shear modulus of the material at rest, Pa.
    pub shear_modulus: f64,
    /// Bulk modulus of the material at rest, Pa.
    pub bulk_modulus: f64,
    /// Poisson's ratio of the material at rest; `None` if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson: Option<f64>,
    /// The body before its first step, and all warnings.
    #[serde(flatten)]
    pub body: Overview,
    /// Number of vertices of the embedded surface.
    pub surface_vertices: usize,
    /// Number of time steps made; frame 0, before the first of them, is not counted.
    pub frames: usize,
    /// Number of time steps requested.
    pub frames_wanted: usize,
    /// End of the run.
    pub ended: Ended,
    /// Reasons why something is missing: a step that failed, a file that could not be written, an equilibrium
    /// that could not be examined.
    pub failures: Vec<String>,
    /// Time step, s.
    pub dt: f64,
    /// Newton iterations per step, on average.
    pub newton_iterations_mean: f64,
    /// Number of tetrahedra that are inside out before the first step: det F < 0.
    pub inverted_at_start: usize,
    /// The smallest determinant of a deformation gradient in any frame.
    pub min_det_f: f64,
    /// The largest distance of a node from its rest position in the final frame, in body heights; after the
    /// best rigid motion if fewer than three nodes are pinned.
    pub max_distance_from_rest: f64,
    /// Elastic energy of the final frame, J.
    pub energy: f64,
    /// Median time of a step in the solver, ms; since the last interruption, `None` without a step.
    pub ms_per_step_median: Option<f64>,
    /// Steps per second of solver time; since the last interruption, `None` without a step.
    pub steps_per_second: Option<f64>,
    /// Method by which steps advanced in time.
    pub integrator: Integrator,
    /// Largest error of the motion that was allowed for time steps, body heights per second; `None` for one
    /// step in each frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Counts of the time steps of the frames.
    pub steps: StepCounts,
    /// Accuracy to which each step was solved.
    pub newton: Newton,
    /// True if the body has recovered: `max_distance_from_rest` ≤ [`Summary::RECOVERED`]. `None` if the scene
    /// neither displaces nor releases it.
    pub recovered: Option<bool>,
    /// Stretch and stress at the end of a tensile test; `None` for other scenes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reading: Option<TensileReading>,
    /// Equilibrium of a body that is not at rest at the end of all steps and is not released later; `None`
    /// for others.
    pub final_state: Option<FinalState>,
}

impl Summary {
    /// Largest distance of a node from its place, as a share of the body's height, at which a body has
    /// recovered.
    pub const RECOVERED: f64 = 1e-3;
}

/// A value in five digits.
pub(crate) fn short(value: f64) -> String {
    let digits = format!("{value:.4e}");
    digits.parse().map_or(digits, number)
}

impl fmt::Display for Summary {
    /// Formats the results as some lines of text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Self { ref scene, inverted_at_start, frames, dt, .. } = self;
        write!(f, "{scene}: {frames} steps of {} s", short(dt))?;
        if let (Some(steps), Some(ms)) = (self.steps_per_second, self.ms_per_step_median) {
            let iterations = self.newton_iterations_mean;
            write!(f, ", {steps:.1} a second ({ms:.2} ms each, {iterations:.2} Newton iterations)")?;
        }
        match self.ended {
            Ended::Finished => writeln!(f)?,
            Ended::Interrupted => writeln!(f, "; interrupted, {} were to be made", self.frames_wanted)?,
            Ended::Failed => writeln!(f, "; failed, {} were to be made", self.frames_wanted)?,
        }
        if inverted_at_start > 0 {
            writeln!(f, "  {inverted_at_start} tetrahedra start inside out")?;
        }
        if let Some(tolerance) = self.tolerance {
            let StepCounts { taken, refused, unresolved } = self.steps;
            write!(
                f,
                "  made in {taken} steps of time, for errors below {} body heights a second; {refused} were \
                 too long",
                short(tolerance)
            )?;
            match unresolved {
                0 => writeln!(f)?,
                _ => writeln!(f, ", and {unresolved} of the shortest err by more")?,
            }
        }
        writeln!(f, "  smallest det F  {}", short(self.min_det_f))?;
        writeln!(f, "  elastic energy  {:.3e} J at the end", self.energy)?;
        if let Some(reading) = self.reading {
            writeln!(f, "  {reading}")?;
        }
        write!(
            f,
            "  {}at the end the farthest node is {:.2e} body heights from rest",
            self.recovered.map_or("", |recovered| if recovered { "recovered: " } else { "not recovered: " }),
            self.max_distance_from_rest
        )?;
        self.final_state.map_or(Ok(()), |state| write!(f, "\n{state}"))
    }
}
