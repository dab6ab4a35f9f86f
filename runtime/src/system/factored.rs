//! The stiffness of a body in factors, never summed, and its products.
//!
//! A [`StiffnessOperator`](super::operator::StiffnessOperator), whose module explains the products,
//! multiplies with these factors. Shapes at rest are not kept here: where energies are evaluated anyway,
//! [`Elastic`](super::assemble::Elastic) linearises with the decompositions that these have made.
//!
//! This module knows no pins and no masses.

use rayon::prelude::*;

use super::assemble::Tangents;
use super::body::Body;
use super::element::{ElementGroup, Tetrahedron};
use crate::batch::TileMaterial;
use crate::batch::element::TILE;
use crate::batch::operator::StiffnessFactors;
use crate::batch::rest::RestShapes;
use crate::lanes::Backend;
use crate::point::Filter;
use crate::status::Status;

/// Tiles that one thread takes without a further division: enough to pay for handing them over.
pub(super) const TILES: usize = 4;

/// Nodes that one thread takes without a further division.
const NODES: usize = 256;

/// The stiffness of a body, N/m, one part in each tile of elements: zero at first.
#[derive(Clone, Debug)]
pub(crate) struct FactoredStiffness {
    tiles: Vec<Tile>,
    /// Start of the contributions to each node, and the end of the last.
    starts: Vec<usize>,
    contributions: Vec<TileSum>,
}

/// Elements of one material and their part of the product made last.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    factors: StiffnessFactors,
    /// The nodes of its elements, each once.
    nodes: Vec<usize>,
    /// The places of each element's corners among them.
    corners: Vec<[u8; 4]>,
    /// The sum over its elements for each of the nodes.
    sums: Vec<[f64; 3]>,
}

/// A tile's sum for a node.
#[derive(Clone, Copy, Debug)]
struct TileSum {
    tile: u32,
    place: u8,
}

impl FactoredStiffness {
    pub(crate) fn new(body: &Body) -> Self {
        let tiles: Vec<Tile> = body
            .groups()
            .map(|(_, elements)| Tile::new(body.number_in_part(elements.start), &body.elements()[elements]))
            .collect();
        let nodes = body.rest().len();
        let mut starts = vec![0; nodes + 1];
        for &node in tiles.iter().flat_map(|tile| &tile.nodes) {
            starts[node + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut contributions = vec![TileSum { tile: 0, place: 0 }; starts[nodes]];
        for (number, tile) in tiles.iter().enumerate() {
            for (place, &node) in tile.nodes.iter().enumerate() {
                contributions[next[node]] = TileSum { tile: number as u32, place: place as u8 };
                next[node] += 1;
            }
        }
        Self { tiles, starts, contributions }
    }

    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// Computes K x, one vector for each node.
    pub(crate) fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) {
        self.make_products(x);
        self.sum(product, |total, sum| *total = sum);
    }

    /// The 3×3 blocks of K on its diagonal, one for each node.
    pub(crate) fn diagonal_blocks(&mut self, blocks: &mut [[[f64; 3]; 3]]) {
        for c in 0..3 {
            self.for_each_tile(|tile, columns| tile.factors.diagonal_columns(c, columns));
            self.sum(blocks, |block, column| {
                for a in 0..3 {
                    block[a][c] = column[a];
                }
            });
        }
    }

    fn make_products(&mut self, x: &[[f64; 3]]) {
        self.for_each_tile(|Tile { factors, nodes, corners, .. }, products| {
            factors.multiply(at_corners(nodes, corners, x), products);
        });
    }

    /// Makes the vectors at the corners of each tile's elements, and sums them at its nodes.
    fn for_each_tile(&mut self, make: impl Fn(&Tile, &mut [f64]) + Sync) {
        self.tiles.par_iter_mut().with_min_len(TILES).for_each(|tile| {
            let mut products = [[[0.0; 3]; 4]; TILE];
            let products = &mut products[..tile.corners.len()];
            make(tile, products.as_flattened_mut().as_flattened_mut());
            tile.sums.fill([0.0; 3]);
            for (corners, products) in tile.corners.iter().zip(products) {
                for (&place, product) in corners.iter().zip(products) {
                    let sum = &mut tile.sums[usize::from(place)];
                    for a in 0..3 {
                        sum[a] += product[a];
                    }
                }
            }
        });
    }

    /// Hands each node's sum over the tiles around it to `put`.
    fn sum<T: Send>(&self, totals: &mut [T], put: impl Fn(&mut T, [f64; 3]) + Sync) {
        totals.par_iter_mut().with_min_len(NODES).enumerate().for_each(|(node, total)| {
            let mut sum = [0.0; 3];
            for &TileSum { tile, place } in &self.contributions[self.starts[node]..self.starts[node + 1]] {
                let part = self.tiles[tile as usize].sums[usize::from(place)];
                for a in 0..3 {
                    sum[a] += part[a];
                }
            }
            put(total, sum);
        });
    }
}

impl Tile {
    fn new(start: usize, elements: &[Tetrahedron]) -> Self {
        let mut nodes: Vec<usize> = Vec::new();
        // A full tile has at most 4·64 corners: places fit.
        let mut place_of = |node: usize| {
            let place = nodes.iter().position(|&other| other == node).unwrap_or(nodes.len());
            if place == nodes.len() {
                nodes.push(node);
            }
            place as u8
        };
        let corners: Vec<[u8; 4]> = elements.iter().map(|element| element.nodes.map(&mut place_of)).collect();
        Self {
            factors: StiffnessFactors::new(Backend::best(), start, elements.len()),
            sums: vec![[0.0; 3]; nodes.len()],
            nodes,
            corners,
        }
    }

    /// Takes the filtered stiffnesses at the positions of the nodes.
    pub(super) fn linearise(
        &mut self,
        rest: &RestShapes,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        positions: &[[f64; 3]],
    ) -> Status<u64> {
        let Self { factors, nodes, corners, .. } = self;
        factors.linearise(rest, material, filter, at_corners(nodes, corners, positions))
    }
}

/// Vectors at the corners of each element, from those at the nodes of a body.
fn at_corners(nodes: &[usize], corners: &[[u8; 4]], x: &[[f64; 3]]) -> impl Iterator<Item = [[f64; 3]; 4]> {
    let at = move |place: u8| x[nodes[usize::from(place)]];
    // Four calls: a closure in an array's `map` is not inlined here, and takes as long as the products.
    corners.iter().map(move |&[a, b, c, d]| [at(a), at(b), at(c), at(d)])
}

impl Tangents for FactoredStiffness {
    type Tile = Tile;

    fn tiles(&mut self) -> &mut [Tile] {
        &mut self.tiles
    }

    fn evaluate(
        tile: &mut Tile,
        group: &mut ElementGroup,
        material: &dyn TileMaterial<f64>,
        elements: &[Tetrahedron],
        filter: Filter,
    ) -> Status<u64> {
        group.evaluate_factors(material, elements, filter, &mut tile.factors)
    }
}
