//! Stiffness of a body as a matrix of one 3×3 block for each pair of nodes that share an element.
//!
//! Assembled in waves: the stiffnesses of some thousand elements, 720 bytes each, are evaluated into a
//! buffer that stays in the cache, and each chunk of the matrix gathers its part of them in a fixed order
//! (see [assembly](super::assemble)) before the next wave. So nothing but the matrix grows with the body,
//! and the sums have the same bits for any number of threads. Factorisations, which take more memory anyway,
//! keep the stiffnesses of all elements for products with a displacement of few nodes.
//!
//! Pinned nodes have rows too, so that their motion enters the right side; this module is independent of
//! pins.

use std::fmt;
use std::sync::Arc;

use piola::batch::element::TILE;
use piola::point::Filter;

use super::assemble::Elastic;
use super::body::Body;
use super::element::{Evaluated, StiffnessBlocks, Tetrahedron, pair};
use super::graph::Graph;
use super::linear::symmetric_blocks::{Pattern, SymmetricBlocks};
use super::linear::{LinearError, fits};
use super::memory::filled;
use crate::mesh::Bounds;

/// Tiles of a wave: 2.9 MB of stiffnesses.
const WAVE: usize = 64;

/// Stiffness of a body as one 3×3 block for each node and each pair of nodes that share an element, N/m;
/// pinned nodes have rows too. Zero at first, and filled by
/// [`ElasticResponse::stiffness_here`](super::ElasticResponse::stiffness_here).
///
/// [`NodalStiffness::blocks`] are triplets for a sparse matrix in any format;
/// [`LowerTriangle`](super::LowerTriangle) holds the entries for a factorisation. Takes some 250 bytes for
/// each element, and a buffer of up to 3 MB.
#[derive(Clone)]
pub struct NodalStiffness {
    shape: Arc<Shape>,
    matrix: SymmetricBlocks<f64, 3>,
    /// Filtered stiffnesses, 720 bytes each, of the elements of a wave or of the whole body.
    tiles: Vec<[StiffnessBlocks; TILE]>,
    /// True if the tiles are those of the whole body.
    keeps_elements: bool,
}

/// Properties of the mesh.
struct Shape {
    elements: usize,
    /// Number of tiles of these elements.
    tiles: usize,
    /// The element blocks that each chunk of the matrix gathers.
    gather: Vec<Gather>,
}

/// The element blocks that add up to a chunk of the matrix, for each wave that has any, with its number.
type Gather = Vec<(usize, Vec<Contribution>)>;

/// A block of an element, and the block of a chunk that it is added to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Contribution {
    block: u32,
    /// Index of the element in its wave.
    element: u16,
    pair: u8,
    transposed: bool,
}

impl fmt::Debug for NodalStiffness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pattern = self.matrix.pattern();
        write!(f, "NodalStiffness {{ nodes: {}, blocks: {} }}", pattern.rows(), pattern.len())
    }
}

impl NodalStiffness {
    /// A matrix of zeros for the elements of a body.
    ///
    /// # Errors
    /// [`LinearError::OutOfMemory`].
    pub fn of_body(body: &Body) -> Result<Self, LinearError> {
        Self::new(body, &[], false)
    }

    /// Adds to the three entries on the diagonal of a node, N/m; nothing if there is no such node.
    #[doc(hidden)]
    pub fn add_to_diagonal(&mut self, node: usize, stiffness: f64) {
        if node < self.matrix.pattern().rows() {
            let at = self.matrix.pattern().diagonal(node);
            let block = &mut self.matrix.blocks_mut()[at];
            (0..3).for_each(|c| block[c][c] += stiffness);
        }
    }

    /// Replaces `product`, N, by the product with a displacement of each node, m.
    ///
    /// # Errors
    /// [`LinearError::Length`] unless both have one vector for each node.
    pub fn multiply(
        &mut self,
        displacement: &[[f64; 3]],
        product: &mut [[f64; 3]],
    ) -> Result<(), LinearError> {
        let nodes = self.matrix.pattern().rows();
        fits("displacement", displacement.len(), nodes)?;
        fits("product", product.len(), nodes)?;
        self.matrix.multiply(displacement, product);
        Ok(())
    }

    /// Number of blocks that [`NodalStiffness::blocks`] returns.
    pub(super) fn len(&self) -> usize {
        self.matrix.pattern().len()
    }

    /// The nodes of each block, row and column, and its entries ∂²E/∂x_row∂x_column, always in the same
    /// order.
    ///
    /// Two different nodes have one block; the block of `column` and `row` is its transpose.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, &[[f64; 3]; 3])> {
        self.matrix.stored()
    }

    /// Finds the places of all blocks, also of pairs of nodes that share no element, and allocates all memory
    /// that is needed; with `keeps_elements`, also for the stiffness of each element.
    pub(crate) fn new(body: &Body, pairs: &[[usize; 2]], keeps_elements: bool) -> Result<Self, LinearError> {
        let nodes = body.rest().len();
        let graph = Graph::of_tets(nodes, body.elements().iter().map(|element| element.nodes), pairs)?;
        let pattern = Arc::new(Pattern::new(graph, along_a_curve(body.rest()))?);
        let matrix = SymmetricBlocks::new(pattern.clone())?;
        let gather = gather(body, &pattern)?;
        let shape = Shape { elements: body.elements().len(), tiles: body.groups().count(), gather };
        let tiles = if keeps_elements { shape.tiles } else { shape.tiles.min(WAVE) };
        let tiles = filled(tiles, [[[[0.0; 3]; 3]; 10]; TILE])?;
        Ok(Self { shape: Arc::new(shape), matrix, tiles, keeps_elements })
    }

    pub(super) fn counts(&self) -> [usize; 3] {
        [self.matrix.pattern().rows(), self.shape.elements, self.shape.tiles]
    }

    /// Each element of the body with its stiffness, if these are kept.
    pub(super) fn of_elements<'a>(
        &'a self,
        body: &'a Body,
    ) -> impl Iterator<Item = (&'a Tetrahedron, &'a StiffnessBlocks)> {
        let tiles = body.groups().zip(&self.tiles);
        tiles.flat_map(|((_, elements), tile)| body.elements()[elements].iter().zip(tile))
    }

    /// Adds K d to `total` for the displacement d of each node. Nodes with d = 0 cost little if the stiffness
    /// of each element is kept.
    pub(crate) fn add_product(&mut self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        if !self.keeps_elements {
            let mut product = vec![[0.0; 3]; total.len()];
            self.matrix.multiply(displacement, &mut product);
            let entries = total.as_flattened_mut().iter_mut().zip(product.as_flattened());
            return entries.for_each(|(total, product)| *total += product);
        }
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

    pub(crate) fn matrix(&self) -> &SymmetricBlocks<f64, 3> {
        &self.matrix
    }

    pub(crate) fn matrix_mut(&mut self) -> &mut SymmetricBlocks<f64, 3> {
        &mut self.matrix
    }

    /// Computes gradients and the filtered stiffness at the last point of evaluation.
    pub(crate) fn linearise(&mut self, body: &Body, elastic: &mut Elastic, filter: Filter) -> Evaluated {
        let Self { shape, matrix, tiles: all, keeps_elements } = self;
        matrix.for_each_chunk(|_, _, blocks| blocks.fill([[0.0; 3]; 3]));
        for (number, first) in (0..shape.tiles).step_by(WAVE).enumerate() {
            let range = first..shape.tiles.min(first + WAVE);
            let start = if *keeps_elements { first } else { 0 };
            let tiles = &mut all[start..start + range.len()];
            elastic.linearise(body, filter, first, tiles);
            let elements = tiles.as_flattened();
            matrix.for_each_chunk(|chunk, _, blocks| {
                let waves = &shape.gather[chunk];
                let Ok(at) = waves.binary_search_by_key(&number, |(wave, _)| *wave) else { return };
                for &Contribution { block, element, pair, transposed } in &waves[at].1 {
                    let part = &elements[usize::from(element)][usize::from(pair)];
                    let block = &mut blocks[block as usize];
                    for r in 0..3 {
                        for c in 0..3 {
                            block[r][c] += if transposed { part[c][r] } else { part[r][c] };
                        }
                    }
                }
            });
        }
        elastic.survey()
    }
}

/// Sorts the blocks of all elements by chunk, wave, block and element.
fn gather(body: &Body, pattern: &Pattern) -> Result<Vec<Gather>, LinearError> {
    let mut all = filled(pattern.chunks(), Gather::new())?;
    for (group, (_, elements)) in body.groups().enumerate() {
        let (wave, tile) = (group / WAVE, group % WAVE);
        for (lane, element) in body.elements()[elements].iter().enumerate() {
            for i in 0..4 {
                for j in 0..=i {
                    // The graph holds each pair of an element's nodes.
                    let Some((block, transposed)) = pattern.block(element.nodes[i], element.nodes[j]) else {
                        continue;
                    };
                    let (chunk, block) = pattern.chunk_of(block);
                    let contribution = Contribution {
                        block: block as u32,
                        element: (tile * TILE + lane) as u16,
                        pair: pair(i, j) as u8,
                        transposed,
                    };
                    match all[chunk].last_mut() {
                        Some((last, of_wave)) if *last == wave => of_wave.push(contribution),
                        _ => all[chunk].push((wave, vec![contribution])),
                    }
                }
            }
        }
    }
    for (_, of_wave) in all.iter_mut().flatten() {
        of_wave.sort_unstable();
        of_wave.shrink_to_fit();
    }
    Ok(all)
}

/// Nodes along a Z-order curve through the body at rest, which keeps neighbours together [Mor66].
///
/// [Mor66] Morton, *A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing*, 1966.
fn along_a_curve(positions: &[[f64; 3]]) -> Vec<u32> {
    let bounds = Bounds::around(positions);
    let (min, size) = (bounds.min, bounds.size().into_iter().fold(0.0, f64::max));
    let unit = if size > 0.0 { f64::from((1_u32 << 20) - 1) / size } else { 0.0 };
    let spread = |x: f64| {
        // Two zeros after each bit.
        let x = x as u64;
        (0..20).fold(0, |code: u64, bit| code | (x >> bit & 1) << (3 * bit))
    };
    let code = |x: &[f64; 3]| (0..3).fold(0, |code, c| code | spread(unit * (x[c] - min[c])) << c);
    let codes: Vec<u64> = positions.iter().map(code).collect();
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&node| (codes[node as usize], node));
    order
}

#[cfg(test)]
mod tests;
