//! The stiffnesses of all elements, block by block, on their way into a matrix: see [assembly](super::assemble).

use super::Body;
use super::assemble::Tangents;
use super::element::{Element, Group, Stiffness, Survey, pair};
use super::fill::{NodePairs, fill};
use super::pattern::Pattern;
use crate::batch::Energy;
use crate::batch::element::TILE;
use crate::point::Filter;

/// The filtered stiffness of each element, 720 bytes, where they were evaluated last: zero before that.
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

    /// Adds K d to `total` for a displacement d that is zero at most nodes.
    pub(crate) fn add_product(&self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for (element, stiffness) in body.elements().iter().zip(self.of_elements()) {
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
        group: &mut Group,
        material: &dyn Energy<f64>,
        elements: &[Element],
        filter: Filter,
    ) -> Survey {
        group.evaluate_stiffnesses(material, elements, filter, tile)
    }
}
