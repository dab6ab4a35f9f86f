//! Stiffnesses of all elements, block by block, as the input of [assembly](super::assemble).

use std::ops::Range;

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
    pub(crate) fn new(body: &Body) -> Self {
        Self { tiles: vec![[[[[0.0; 3]; 3]; 10]; TILE]; body.groups().count()] }
    }

    pub(crate) fn tiles_mut(&mut self) -> &mut [[StiffnessBlocks; TILE]] {
        &mut self.tiles
    }

    /// Each element of the body with its stiffness.
    pub(super) fn of_elements<'a>(
        &'a self,
        body: &'a Body,
    ) -> impl Iterator<Item = (&'a Tetrahedron, &'a StiffnessBlocks)> {
        let tiles = body.groups().zip(&self.tiles);
        tiles.flat_map(|((_, elements), tile)| body.elements()[elements].iter().zip(tile))
    }

    /// Adds a factor times the stiffnesses of some tiles to others.
    pub(crate) fn add_tiles_to(&self, factor: f64, tiles: Range<usize>, to: &mut [[StiffnessBlocks; TILE]]) {
        let blocks = to.as_flattened_mut().as_flattened_mut().iter_mut();
        for (to, block) in blocks.zip(self.tiles[tiles].as_flattened().as_flattened()) {
            for a in 0..3 {
                for c in 0..3 {
                    to[a][c] += factor * block[a][c];
                }
            }
        }
    }

    /// Adds a factor times K d to `total` for the displacement d of each node. Nodes with d = 0 cost little.
    pub(crate) fn add_product(
        &self,
        body: &Body,
        factor: f64,
        displacement: impl Fn(usize) -> [f64; 3],
        total: &mut [[f64; 3]],
    ) {
        for (element, stiffness) in self.of_elements(body) {
            for (j, &from) in element.nodes.iter().enumerate() {
                let d = displacement(from);
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
                            total[to][a] += factor * (entry * d[c]);
                        }
                    }
                }
            }
        }
    }

    /// dᵀ K d.
    pub(crate) fn quadratic_form(&self, body: &Body, d: &[[f64; 3]]) -> f64 {
        let mut sum = 0.0;
        for (element, stiffness) in self.of_elements(body) {
            for (i, &row) in element.nodes.iter().enumerate() {
                for (j, &column) in element.nodes[..=i].iter().enumerate() {
                    let twice = if i == j { 1.0 } else { 2.0 };
                    let block = &stiffness[pair(i, j)];
                    for a in 0..3 {
                        for c in 0..3 {
                            sum += twice * (d[row][a] * (block[a][c] * d[column][c]));
                        }
                    }
                }
            }
        }
        sum
    }
}
