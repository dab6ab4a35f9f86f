//! Springs from a body to points in space.

use crate::mesh::Anchor;

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
    pub(super) fn weights(&self) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let Anchor { nodes, weights } = &self.anchor;
        nodes.iter().copied().zip(weights.iter().copied()).filter(|(_, weight)| *weight != 0.0)
    }
}
