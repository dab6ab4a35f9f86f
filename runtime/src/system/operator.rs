//! The stiffness of a body as an operator: K x without a matrix, for conjugate gradients and their kin.
//!
//! An element keeps the thirty numbers that its stiffness is made of, frames and filtered blocks, and multiplies by them with
//! a quarter of the operations that its entries take to make; nothing is assembled, nor factored. Products are made in
//! two stages, as in assembly, and have the same bits for any number of threads:
//!
//! 1. *Elements.* Tiles of elements multiply in parallel, each element into a place of its own.
//! 2. *Nodes.* Each node has a list of the elements around it, made once and sorted; nodes are summed in parallel, each by
//!    one thread in the order of its list.
//!
//! This module knows no pins and no masses: it is for the solver to leave out the rows and columns of pinned nodes, and to
//! add what is diagonal.

use std::ops::Range;

use rayon::prelude::*;

use super::Body;
use crate::batch::operator::StiffnessTile;
use crate::batch::{LengthError, Survey};
use crate::lanes::Backend;
use crate::point::Filter;

/// Tiles that one thread takes without a further division: enough to pay for handing them over.
const TILES: usize = 4;

/// Nodes likewise.
const NODES: usize = 256;

/// The filtered stiffness K of a body, N/m, where it was linearised last: zero before that.
///
/// ```
/// use piola::material;
/// use piola::mesh::TetMesh;
/// use piola::point::Filter;
/// use piola::system::{Body, StiffnessOperator};
///
/// /// Rubber.
/// #[material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = TetMesh::new(corners, vec![[0, 1, 2, 3]]);
/// let body = Body::new(&mesh, Rubber::new(1e6, 4e6)?, 1000.0)?;
/// let mut stiffness = StiffnessOperator::new(&body);
/// assert!(stiffness.linearise(&body, body.rest(), Filter::Clamp)?.is_clean());
///
/// // One corner moves along x by 1 mm, uniaxial strain: force = (λ + 2μ) · strain · area, over the volume of 1/6 m³.
/// let mut displacement = [[0.0; 3]; 4];
/// displacement[1][0] = 1e-3;
/// let mut product = [[0.0; 3]; 4];
/// stiffness.multiply(&displacement, &mut product)?;
/// assert!((product[1][0] - 6e6 * 1e-3 / 6.0).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct StiffnessOperator {
    tiles: Vec<Tile>,
    elements: usize,
    /// Where the contributions to each node start, and where the last ends.
    starts: Vec<usize>,
    contributions: Vec<Contribution>,
}

/// Elements of one material and their part of the product made last.
#[derive(Clone, Debug)]
struct Tile {
    stiffness: StiffnessTile,
    nodes: Vec<[usize; 4]>,
    elements: Range<usize>,
    survey: Survey,
    /// One vector for each corner of each element.
    products: Vec<[[f64; 3]; 4]>,
}

/// A corner of an element.
#[derive(Clone, Copy, Debug)]
struct Contribution {
    tile: u32,
    lane: u8,
    corner: u8,
}

impl StiffnessOperator {
    /// With memory for all that later calls need: about 500 bytes for each element.
    #[must_use]
    pub fn new(body: &Body) -> Self {
        let tiles: Vec<Tile> = body.groups().map(|(_, elements)| Tile::new(body, elements)).collect();
        let mut starts = vec![0; body.rest().len() + 1];
        for element in body.elements() {
            for node in element.nodes {
                starts[node + 1] += 1;
            }
        }
        for node in 0..body.rest().len() {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut contributions = vec![Contribution { tile: 0, lane: 0, corner: 0 }; 4 * body.elements().len()];
        for (number, tile) in tiles.iter().enumerate() {
            for (lane, nodes) in tile.nodes.iter().enumerate() {
                for (corner, &node) in nodes.iter().enumerate() {
                    contributions[next[node]] =
                        Contribution { tile: number as u32, lane: lane as u8, corner: corner as u8 };
                    next[node] += 1;
                }
            }
        }
        Self { tiles, elements: body.elements().len(), starts, contributions }
    }

    /// Takes the stiffness at these positions, m, with the filter on dP/dF of each element, of the body it was made for.
    ///
    /// The survey counts elements in the order of [`Body::elements`]. Products in which one takes part whose numbers mean
    /// nothing mean nothing either.
    ///
    /// # Errors
    /// Where there are not as many positions or elements as the body had.
    pub fn linearise(
        &mut self,
        body: &Body,
        positions: &[[f64; 3]],
        filter: Filter,
    ) -> Result<Survey, LengthError> {
        self.check("positions", positions.len(), 3)?;
        let (found, points) = (body.elements().len(), self.elements);
        if found != points {
            return Err(LengthError { slice: "elements", found, numbers: 1, points, group: 1 });
        }
        self.tiles.par_iter_mut().with_min_len(TILES).for_each(|tile| {
            let corners = tile.nodes.iter().map(|nodes| nodes.map(|node| positions[node]));
            let material = body.material(tile.elements.start);
            let marks = tile.stiffness.linearise(material, filter, corners);
            tile.survey = Survey::of(&marks, tile.elements.start);
        });
        Ok(self.tiles.iter().fold(Survey::NONE, |sum, tile| sum.and(tile.survey)))
    }

    /// K x, N, for a displacement x of each node, m.
    ///
    /// # Errors
    /// Where there are not as many of one or the other as nodes.
    pub fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), LengthError> {
        self.check("x", x.len(), 3)?;
        self.check("product", product.len(), 3)?;
        self.for_each_tile(|stiffness, nodes, products| {
            stiffness.multiply(nodes.iter().map(|nodes| nodes.map(|node| x[node])), products);
        });
        self.sum(product, |total, sum| *total = sum);
        Ok(())
    }

    /// The 3×3 blocks of K on its diagonal, N/m, one for each node: what block-Jacobi preconditioning inverts. Symmetric to
    /// rounding.
    ///
    /// # Errors
    /// Where there are not as many as nodes.
    pub fn diagonal_blocks(&mut self, blocks: &mut [[[f64; 3]; 3]]) -> Result<(), LengthError> {
        self.check("blocks", blocks.len(), 9)?;
        for c in 0..3 {
            self.for_each_tile(|stiffness, _, columns| stiffness.diagonal_columns(c, columns));
            self.sum(blocks, |block, column| {
                for a in 0..3 {
                    block[a][c] = column[a];
                }
            });
        }
        Ok(())
    }

    /// Lets the elements make their products.
    fn for_each_tile(&mut self, make: impl Fn(&StiffnessTile, &[[usize; 4]], &mut [f64]) + Sync) {
        self.tiles.par_iter_mut().with_min_len(TILES).for_each(|tile| {
            let Tile { stiffness, nodes, products, .. } = tile;
            make(stiffness, nodes, products.as_flattened_mut().as_flattened_mut());
        });
    }

    /// Hands each node's sum over its elements to `put`.
    fn sum<T: Send>(&self, totals: &mut [T], put: impl Fn(&mut T, [f64; 3]) + Sync) {
        totals.par_iter_mut().with_min_len(NODES).enumerate().for_each(|(node, total)| {
            let mut sum = [0.0; 3];
            for contribution in &self.contributions[self.starts[node]..self.starts[node + 1]] {
                let Contribution { tile, lane, corner } = *contribution;
                let part = self.tiles[tile as usize].products[usize::from(lane)][usize::from(corner)];
                for a in 0..3 {
                    sum[a] += part[a];
                }
            }
            put(total, sum);
        });
    }

    /// Whether a slice holds something for each node, of so many numbers.
    fn check(&self, slice: &'static str, found: usize, numbers: usize) -> Result<(), LengthError> {
        let points = self.starts.len() - 1;
        if found == points {
            return Ok(());
        }
        Err(LengthError { slice, found: numbers * found, numbers, points, group: 1 })
    }
}

impl Tile {
    fn new(body: &Body, elements: Range<usize>) -> Self {
        let of_tile = &body.elements()[elements.clone()];
        let shapes = of_tile.iter().map(|element| element.shape);
        Self {
            stiffness: StiffnessTile::new(Backend::best(), shapes),
            nodes: of_tile.iter().map(|element| element.nodes).collect(),
            products: vec![[[0.0; 3]; 4]; elements.len()],
            elements,
            survey: Survey::NONE,
        }
    }
}

#[cfg(test)]
mod tests;
