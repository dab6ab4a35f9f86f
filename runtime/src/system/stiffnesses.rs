//! The stiffnesses of all elements, block by block, on their way into a matrix: see
//! [assembly](super::assemble).

use std::ops::Range;

use super::assemble::Tangents;
use super::body::Body;
use super::element::{ElementGroup, Stiffness, Tetrahedron, pair};
use super::fill::{NodePairs, fill};
use super::pattern::Pattern;
use crate::batch::TileMaterial;
use crate::batch::element::TILE;
use crate::point::Filter;
use crate::status::Status;

/// The filtered stiffness of each element, 720 bytes, where they were evaluated last: zero before that.
#[derive(Clone)]
pub(crate) struct ElementStiffnesses {
    tiles: Vec<[Stiffness; TILE]>,
    /// The tile of each element and its lane there.
    places: Vec<(u32, u32)>,
}

impl ElementStiffnesses {
    pub(crate) fn new(body: &Body) -> Self {
        let mut places = Vec::with_capacity(body.elements().len());
        let mut tiles = 0;
        for (_, elements) in body.groups() {
            places.extend((0..elements.len() as u32).map(|lane| (tiles, lane)));
            tiles += 1;
        }
        Self { tiles: vec![[[[[0.0; 3]; 3]; 10]; TILE]; tiles as usize], places }
    }

    /// The stiffness of each element of the body.
    pub(super) fn of_elements(&self) -> impl Iterator<Item = &Stiffness> {
        self.places.iter().map(|&(tile, lane)| &self.tiles[tile as usize][lane as usize])
    }

    /// Adds a factor times other stiffnesses of the same body.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        other.add_tiles_to(factor, 0..other.tiles.len(), &mut self.tiles);
    }

    /// Adds a factor times the stiffnesses of some tiles to others.
    pub(crate) fn add_tiles_to(&self, factor: f64, tiles: Range<usize>, to: &mut [[Stiffness; TILE]]) {
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
        for (element, stiffness) in body.elements().iter().zip(self.of_elements()) {
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
        for (element, stiffness) in body.elements().iter().zip(self.of_elements()) {
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

    /// Sums the stiffnesses into the entries of the pattern and adds `diagonal(node)` to the diagonal.
    pub(crate) fn fill(&self, pattern: &Pattern, diagonal: impl Fn(usize) -> f64 + Sync, values: &mut [f64]) {
        fill(pattern, self, &diagonal, values);
    }
}

impl NodePairs for ElementStiffnesses {
    fn block(&self, element: usize, i: usize, j: usize) -> [[f64; 3]; 3] {
        let (tile, lane) = self.places[element];
        self.tiles[tile as usize][lane as usize][pair(i, j)]
    }
}

impl Tangents for ElementStiffnesses {
    type Tile = [Stiffness; TILE];

    fn tiles(&mut self) -> &mut [Self::Tile] {
        &mut self.tiles
    }

    fn evaluate(
        tile: &mut Self::Tile,
        group: &mut ElementGroup,
        material: &dyn TileMaterial<f64>,
        elements: &[Tetrahedron],
        filter: Filter,
    ) -> Status<u64> {
        group.evaluate_stiffnesses(material, elements, filter, tile)
    }
}
