//! A run in numbers.

use std::fmt;
use std::io::{self, Write};

use serde::Serialize;

/// How far each time step is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Newton {
    /// One iteration with line search, whatever residual it leaves.
    #[default]
    Single,
    /// Until the residual is small.
    Full,
}

/// What came of a run. In JSON the keys are the names of the fields.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Name of the material.
    pub material: String,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of vertices of the embedded surface.
    pub surface_vertices: usize,
    /// Number of time steps; frame 0, before the first of them, is not counted.
    pub frames: usize,
    /// Time step, s.
    pub dt: f64,
    /// Newton iterations per step, on average.
    pub newton_iterations_mean: f64,
    /// The smallest determinant of a deformation gradient in any frame.
    pub min_det_f: f64,
    /// The largest distance of a node from its rest position in the final frame, in body heights. After the best rigid
    /// motion where fewer than three nodes are pinned.
    pub max_distance_from_rest: f64,
    /// Elastic energy of the final frame, J.
    pub energy: f64,
    /// Median time of a step in the solver, ms.
    pub ms_per_step_median: f64,
    /// Steps per second of solver time.
    pub steps_per_second: f64,
    /// How far each step was solved.
    pub newton: Newton,
    /// Whether the body is back: `max_distance_from_rest` ≤ [`Summary::RECOVERED`].
    pub recovered: bool,
}

impl Summary {
    /// A body is back where no node is farther from its place than this share of its height.
    pub const RECOVERED: f64 = 1e-3;

    /// Writes the summary as JSON.
    ///
    /// # Errors
    /// Where `target` cannot be written to.
    pub fn write_json(&self, target: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *target, self)?;
        target.write_all(b"\n")
    }
}

impl fmt::Display for Summary {
    /// Some lines for a reader.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Self { ref scene, ref material, tets, nodes, frames, dt, .. } = self;
        writeln!(f, "{scene}: {tets} tetrahedra, {nodes} nodes, {material}")?;
        writeln!(
            f,
            "  {frames} steps of {dt:.4} s, {:.1} a second ({:.2} ms each, {:.2} Newton iterations)",
            self.steps_per_second, self.ms_per_step_median, self.newton_iterations_mean
        )?;
        writeln!(f, "  smallest det F  {:.4}", self.min_det_f)?;
        writeln!(f, "  elastic energy  {:.3e} J at the end", self.energy)?;
        write!(
            f,
            "  {}: at the end the farthest node is {:.2e} body heights from rest",
            if self.recovered { "recovered" } else { "not recovered" },
            self.max_distance_from_rest
        )
    }
}
