//! Linear tetrahedra of a mesh: their nodes, and their edges from the positions of the nodes.

use crate::NoSuchNode;
use crate::kernels::sink::Lines;
use crate::lanes::Scalar;

/// Nodes of linear tetrahedra, four of each, checked once for many calls.
#[derive(Clone, Copy, Debug)]
pub struct Tetrahedra<'a> {
    /// Number of nodes of the mesh.
    pub(super) nodes: usize,
    /// The four nodes of each.
    pub(super) corners: &'a [[usize; 4]],
}

impl<'a> Tetrahedra<'a> {
    /// Tetrahedra that join nodes numbered from 0 to `nodes` − 1.
    ///
    /// # Errors
    /// [`NoSuchNode`] for the first node that does not exist.
    pub fn new(nodes: usize, corners: &'a [[usize; 4]]) -> Result<Self, NoSuchNode> {
        match corners.as_flattened().iter().position(|&node| node >= nodes) {
            Some(at) => Err(NoSuchNode { element: Some(at / 4), node: corners.as_flattened()[at], nodes }),
            None => Ok(Self { nodes, corners }),
        }
    }

    /// Stores Ds of the tetrahedra from `start` on, one in each lane; past the last one edges of length 1
    /// along the axes.
    pub(super) fn set_edges<E: Scalar>(
        &self,
        start: usize,
        count: usize,
        positions: &[[E; 3]],
        edges: &mut Lines<E, 9>,
    ) {
        let [zero, one] = [0.0, 1.0].map(E::splat);
        for lane in 0..count {
            let [x0, x1, x2, x3] = match self.corners.get(start + lane) {
                Some(corners) => corners.map(|node| positions[node]),
                None => [[zero; 3], [one, zero, zero], [zero, one, zero], [zero, zero, one]],
            };
            set_edges(edges, lane, [x0, x1, x2, x3]);
        }
    }
}

/// Stores Ds: row a, column k is coordinate a of corner k + 1 less that of corner 0.
#[inline]
pub(super) fn set_edges<E: Scalar>(edges: &mut Lines<E, 9>, lane: usize, [x0, x1, x2, x3]: [[E; 3]; 4]) {
    for a in 0..3 {
        edges.set(lane, 3 * a, x1[a] - x0[a]);
        edges.set(lane, 3 * a + 1, x2[a] - x0[a]);
        edges.set(lane, 3 * a + 2, x3[a] - x0[a]);
    }
}
