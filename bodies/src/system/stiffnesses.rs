//! Stiffnesses of all elements, block by block, as the input of [assembly](super::assemble).

use piola::batch::element::TILE;

use super::body::Body;
use super::element::{StiffnessBlocks, Tetrahedron, pair};

/// The filtered stiffness of each element, 720 bytes, where they were evaluated last: zero before that.
#[derive(Clone)]
pub(crate) struct ElementStiffnesses {
    /// The stiffnesses of each of [`Body::groups`].
    pub(super) tiles: Vec<[StiffnessBlocks; TILE]>,
}

impl ElementStiffnesses {
    /// Each element of the body with its stiffness.
    pub(super) fn of_elements<'a>(
        &'a self,
        body: &'a Body,
    ) -> impl Iterator<Item = (&'a Tetrahedron, &'a StiffnessBlocks)> {
        let tiles = body.groups().zip(&self.tiles);
        tiles.flat_map(|((_, elements), tile)| body.elements()[elements].iter().zip(tile))
    }

    /// Adds K d to `total` for the displacement d of each node. Nodes with d = 0 cost little.
    pub(crate) fn add_product(&self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for (element, stiffness) in self.of_elements(body) {
            for (j, &from) in element.nodes.iter().enumerate() {
                let d = displacement[from];
                if d == [0.0; 3] {
                    continue;
                }
                for (i, &to) in element.nodes.iter().enumerate() {
                    for a in 0..3 {
                        for c in 0..3 {
                            let entry = match i >= j {
                                true => stiffness[pair(i, j)][a][c],
                                false => stiffness[pair(j, i)][c][a],
                            };
                            total[to][a] += entry * d[c];
                        }
                    }
                }
            }
        }
    }
}
