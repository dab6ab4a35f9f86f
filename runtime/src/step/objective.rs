//! The function that a step of implicit Euler minimises, or a stage of another integrator.
//!
//! With M the lumped masses, h the time step, xₙ, vₙ the state before the step, and D the quadratic form of
//! its [damping](super::damping), α M or β K:
//!
//! ```text
//! E(x) = ½‖x − xₙ − h vₙ‖²_M / h² + 1/(2h) ‖x − xₙ‖²_D + Ψ(x) − Σ m g·x + Σ ½ k ‖p(x) − t‖²
//! ```
//!
//! Where its gradient vanishes, M (v − vₙ)/h = −∇Ψ(x) − D v + M g − (springs) with v = (x − xₙ)/h: implicit
//! Euler, damping included. All but Ψ is quadratic, so that along a line it needs one slope and one curvature
//! and no subtraction of close energies. Positions enter as displacements from xₙ.
//!
//! With h = ∞ inertia and damping are zero by the arithmetic of infinity, and what is left is statics.

use crate::lanes::Real;
use crate::mesh::Anchor;
use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::linear::symmetric_blocks::SymmetricBlocks;
use crate::system::pattern::Pattern;

use super::damping::Viscosity;
use super::line_search::{Change, Line};

/// Spring of rest length zero from a point of the body to a point in space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Spring {
    /// Point of the body.
    pub anchor: Anchor,
    /// Point in space, m.
    pub target: [f64; 3],
    /// Stiffness k, N/m: the energy is ½ k |point − target|².
    pub stiffness: f64,
}

impl Spring {
    /// Attaches a spring to a node.
    #[must_use]
    pub fn on_node(node: usize, target: [f64; 3], stiffness: f64) -> Self {
        Self { anchor: Anchor { nodes: [node; 4], weights: [1.0, 0.0, 0.0, 0.0] }, target, stiffness }
    }

    /// Energy ½ k |point − target|², J, when the nodes are at `positions`.
    ///
    /// # Panics
    /// If there is no position of a node of the anchor.
    #[must_use]
    pub fn energy(&self, positions: &[[f64; 3]]) -> f64 {
        let point = self.anchor.position(positions);
        (0..3).map(|c| 0.5 * self.stiffness * (point[c] - self.target[c]).powi(2)).sum()
    }

    /// The nodes with a nonzero weight.
    pub(crate) fn weights(&self) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        self.anchor
            .nodes
            .iter()
            .copied()
            .zip(self.anchor.weights.iter().copied())
            .filter(|(_, weight)| *weight != 0.0)
    }
}

/// The quadratic part of the objective.
#[derive(Clone, Copy)]
pub(crate) struct Quadratic<'a> {
    pub(crate) masses: &'a [f64],
    /// xₙ.
    pub(crate) start: &'a [[f64; 3]],
    /// vₙ.
    pub(crate) velocities: &'a [[f64; 3]],
    /// h, s.
    pub(crate) dt: f64,
    /// α of mass-proportional damping, 1/s.
    pub(crate) damping: f64,
    /// Diagonal that a unit of regularisation adds for each mass, 1/s².
    pub(crate) regularisation: f64,
    /// Diagonal that is always added for each mass to the second derivatives, not to the objective, 1/s².
    pub(crate) guard: f64,
    /// g, m/s².
    pub(crate) gravity: [f64; 3],
    pub(crate) springs: &'a [Spring],
}

impl Quadratic<'_> {
    /// Second derivative in each coordinate of a node, without springs: m (1/h² + α/h).
    fn diagonal(&self, node: usize) -> f64 {
        self.masses[node] * (1.0 / self.dt + self.damping) / self.dt
    }

    /// Second derivative in each coordinate of a node, with the guard against drift.
    pub(crate) fn guarded_diagonal(&self, node: usize) -> f64 {
        self.diagonal(node) + self.masses[node] * self.guard
    }

    /// Displacement from `x` to where a node would be without forces, xₙ + h vₙ.
    pub(crate) fn free_motion(&self, node: usize, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| (self.start[node][c] - x[c]) + self.dt * self.velocities[node][c])
    }

    /// Diagonal shift of a node; multiples of it are added until the Hessian is positive definite.
    pub(crate) fn regularisation(&self, node: usize) -> f64 {
        self.masses[node] * self.regularisation
    }

    /// Adds the gradient at `x`.
    fn add_gradient(&self, x: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for node in 0..x.len() {
            for c in 0..3 {
                let v = (x[node][c] - self.start[node][c]) / self.dt;
                let acceleration = (v - self.velocities[node][c]) / self.dt;
                total[node][c] += self.masses[node] * (acceleration + self.damping * v - self.gravity[c]);
            }
        }
        for spring in self.springs {
            let point = spring.anchor.position(x);
            for (node, weight) in spring.weights() {
                for c in 0..3 {
                    total[node][c] += spring.stiffness * weight * (point[c] - spring.target[c]);
                }
            }
        }
    }

    /// Adds the product of the second derivatives with a displacement.
    pub(crate) fn add_product(&self, d: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for node in 0..d.len() {
            for c in 0..3 {
                total[node][c] += self.guarded_diagonal(node) * d[node][c];
            }
        }
        for spring in self.springs {
            let point = spring.anchor.position(d);
            for (node, weight) in spring.weights() {
                for c in 0..3 {
                    total[node][c] += spring.stiffness * weight * point[c];
                }
            }
        }
    }

    /// Adds the springs' second derivatives to the entries of a matrix.
    pub(crate) fn add_springs(&self, pattern: &Pattern, values: &mut [f64]) {
        for spring in self.springs {
            let free =
                spring.weights().filter_map(|(node, weight)| Some((pattern.free_of_node()[node]?, weight)));
            for (row, row_weight) in free.clone() {
                for (column, column_weight) in free.clone().filter(|&(column, _)| column <= row) {
                    // The nodes of a spring belong to one element: the simulation has made sure that the
                    // block exists.
                    if let Some(block) = pattern.block(row, column) {
                        for c in 0..3 {
                            let entry = pattern.scalar(column, block, c, c);
                            values[entry] += spring.stiffness * row_weight * column_weight;
                        }
                    }
                }
            }
        }
    }

    /// Adds the second derivatives to a matrix of a row and a column for each node.
    pub(crate) fn add_to(&self, matrix: &mut SymmetricBlocks<f64, 3>) {
        let pattern = matrix.pattern().clone();
        for node in 0..self.masses.len() {
            let block = &mut matrix.blocks_mut()[pattern.diagonal(node)];
            for c in 0..3 {
                block[c][c] += self.guarded_diagonal(node);
            }
        }
        for spring in self.springs {
            for (row, row_weight) in spring.weights() {
                for (column, column_weight) in spring.weights().filter(|&(column, _)| column <= row) {
                    // The nodes of a spring belong to one element: the simulation has made sure that the
                    // block exists, but for pinned ones, which do not move.
                    if let Some((block, _)) = pattern.block(row, column) {
                        for c in 0..3 {
                            matrix.blocks_mut()[block][c][c] += spring.stiffness * row_weight * column_weight;
                        }
                    }
                }
            }
        }
    }

    /// Curvature dᵀ H d.
    fn curvature(&self, d: &[[f64; 3]]) -> f64 {
        let square = |x: [f64; 3]| x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        let inertia: f64 = d.iter().enumerate().map(|(node, &d)| self.diagonal(node) * square(d)).sum();
        inertia
            + self
                .springs
                .iter()
                .map(|spring| spring.stiffness * square(spring.anchor.position(d)))
                .sum::<f64>()
    }
}

/// The objective, with memory for its elastic part.
pub(crate) struct Objective<'a> {
    pub(crate) body: &'a Body,
    pub(crate) elastic: &'a mut Elastic,
    pub(crate) quadratic: Quadratic<'a>,
    /// Stiffness-proportional damping, where there is any.
    pub(crate) viscosity: Option<&'a Viscosity>,
}

impl Objective<'_> {
    /// Evaluates the energies at `x`, where gradients and second derivatives are taken after that.
    pub(crate) fn evaluate(&mut self, x: &[[f64; 3]]) -> Evaluated {
        self.elastic.evaluate(self.body, x)
    }

    /// The gradient at `x`, after the elastic gradients or stiffnesses have been evaluated there.
    pub(crate) fn gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        self.quadratic_gradient(x, gradient);
        self.elastic.add_gradient(self.body, gradient);
    }

    /// The gradient of all but the elastic energy.
    fn quadratic_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        gradient.fill([0.0; 3]);
        self.quadratic.add_gradient(x, gradient);
        if let Some(viscosity) = self.viscosity {
            let start = self.quadratic.start;
            let displacement = |node: usize| std::array::from_fn(|c| x[node][c] - start[node][c]);
            viscosity.add_product(self.body, displacement, gradient);
        }
    }

    /// Curvature dᵀ H d of all but the elastic energy.
    pub(crate) fn quadratic_curvature(&self, d: &[[f64; 3]]) -> f64 {
        let viscosity = self.viscosity.map_or(0.0, |viscosity| viscosity.curvature(self.body, d));
        self.quadratic.curvature(d) + viscosity
    }

    /// The objective along `x + step d`, which leaves the point tried last in `trial`. The base of its
    /// differences is `x`, where the energies must have been evaluated last.
    pub(crate) fn along<'b>(
        &'b mut self,
        x: &'b [[f64; 3]],
        direction: &'b [[f64; 3]],
        trial: &'b mut [[f64; 3]],
        gradient: &'b mut [[f64; 3]],
    ) -> impl Line + 'b
    where
        Self: 'b,
    {
        self.elastic.set_base();
        self.quadratic_gradient(x, gradient);
        let slope = product(gradient, direction);
        let curvature = self.quadratic_curvature(direction);
        Along { objective: self, x, direction, trial, gradient, slope, curvature }
    }
}

/// The objective along a line.
struct Along<'a, 'b> {
    objective: &'a mut Objective<'b>,
    x: &'a [[f64; 3]],
    direction: &'a [[f64; 3]],
    trial: &'a mut [[f64; 3]],
    gradient: &'a mut [[f64; 3]],
    /// First and second derivative of the quadratic part.
    slope: f64,
    curvature: f64,
}

impl Line for Along<'_, '_> {
    fn change(&mut self, step: f64) -> Option<Change> {
        for node in 0..self.x.len() {
            for c in 0..3 {
                self.trial[node][c] = self.x[node][c] + step * self.direction[node][c];
            }
        }
        if !self.objective.evaluate(self.trial).survey.is_clean() {
            return None;
        }
        let (linear, quadratic) = (step * self.slope, 0.5 * step * step * self.curvature);
        let elastic = &self.objective.elastic;
        // Slope and curvature are sums of products; 4u allows for the cancellation within the slope.
        let noise = 4.0 * f64::UNIT_ROUNDOFF * (linear.abs() + quadratic)
            + elastic.difference_noise(self.objective.body);
        Some(Change { difference: linear + quadratic + elastic.difference(), noise })
    }

    fn slope(&mut self) -> f64 {
        self.objective.elastic.evaluate_gradients(self.objective.body);
        self.objective.gradient(self.trial, self.gradient);
        product(self.gradient, self.direction)
    }
}

/// Inner product Σ a·b over the nodes.
pub(crate) fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sum()
}
