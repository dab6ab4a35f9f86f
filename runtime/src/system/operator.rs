//! The stiffness of a body as an operator: K x without a matrix, for conjugate gradients and similar methods.
//!
//! An element keeps the thirty entries of its frames and filtered blocks, and multiplies by them with a
//! quarter of the operations that its entries take to make; nothing is assembled, nor factored. Products are
//! made in two stages, as in assembly, and have the same bits for any number of threads:
//!
//! 1. *Elements.* Tiles of 64 elements multiply in parallel, and each sums its elements one after the other
//!    at the nodes they share: where neighbours are near in the numbering there are half as many as elements,
//!    so that little is left to pass through memory.
//! 2. *Nodes.* Each node has a list of the tiles around it, made once and sorted; nodes are summed in
//!    parallel, each by one thread in the order of its list.
//!
//! This module knows no pins and no masses: the solver leaves out the rows and columns of pinned nodes, and
//! adds diagonal terms.

use std::ops::Range;

use rayon::prelude::*;

use super::assemble::Tangents;
use super::body::Body;
use super::factored::{FactoredStiffness, TILES};
use crate::batch::LengthError;
use crate::batch::rest::RestShapes;
use crate::point::Filter;
use crate::status::Survey;

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
/// // One corner moves along x by 1 mm, uniaxial strain: force = (λ + 2μ) · strain · area, the area being
/// // the volume of 1/6 m³ over the edge of 1 m.
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
    factored: FactoredStiffness,
    /// One for each tile of `factored`.
    tiles: Vec<Tile>,
    elements: usize,
}

/// Elements of one material, and the survey of their last linearisation.
#[derive(Clone, Debug)]
struct Tile {
    rest: RestShapes,
    elements: Range<usize>,
    survey: Survey,
}

impl StiffnessOperator {
    /// Allocates all the memory that later calls need: about 400 bytes for each element.
    #[must_use]
    pub fn new(body: &Body) -> Self {
        let tile = |elements: Range<usize>| Tile {
            rest: RestShapes::new(body.elements()[elements.clone()].iter().map(|element| element.shape)),
            elements,
            survey: Survey::default(),
        };
        let tiles = body.groups().map(|(_, elements)| tile(elements)).collect();
        Self { factored: FactoredStiffness::new(body), tiles, elements: body.elements().len() }
    }

    /// Takes the stiffness at these positions, m, with the filter on dP/dF of each element, of the body it
    /// was made for.
    ///
    /// The survey counts elements in the order of [`Body::elements`]. Products are meaningless at the nodes
    /// of an element that it reports as refused or not finite.
    ///
    /// # Errors
    /// [`LengthError`] if there are not as many positions or elements as the body had.
    pub fn linearise(
        &mut self,
        body: &Body,
        positions: &[[f64; 3]],
        filter: Filter,
    ) -> Result<Survey, LengthError> {
        self.check("positions", positions.len(), 3)?;
        let (found, points) = (body.elements().len(), self.elements);
        if found != points {
            return Err(LengthError { slice: "elements", found, components: 1, points, group: 1 });
        }
        let tiles = self.tiles.par_iter_mut().zip(self.factored.tiles()).with_min_len(TILES);
        tiles.for_each(|(tile, stiffness)| {
            let material = body.material(tile.elements.start);
            let marks = stiffness.linearise(&tile.rest, material, filter, positions);
            tile.survey = Survey::of(marks, tile.elements.start);
        });
        Ok(self.tiles.iter().map(|tile| tile.survey).sum())
    }

    /// Computes K x, N, for a displacement x of each node, m.
    ///
    /// # Errors
    /// [`LengthError`] if `x` or `product` does not hold one vector for each node.
    pub fn multiply(&mut self, x: &[[f64; 3]], product: &mut [[f64; 3]]) -> Result<(), LengthError> {
        self.check("x", x.len(), 3)?;
        self.check("product", product.len(), 3)?;
        self.factored.multiply(x, product);
        Ok(())
    }

    /// Computes the 3×3 blocks on the diagonal of K, N/m, one for each node, which block-Jacobi
    /// preconditioning inverts. Symmetric up to rounding.
    ///
    /// # Errors
    /// [`LengthError`] if `blocks` does not hold one for each node.
    pub fn diagonal_blocks(&mut self, blocks: &mut [[[f64; 3]; 3]]) -> Result<(), LengthError> {
        self.check("blocks", blocks.len(), 9)?;
        self.factored.diagonal_blocks(blocks);
        Ok(())
    }

    /// Checks that a slice holds one item for each node, of `numbers` entries each.
    fn check(&self, slice: &'static str, found: usize, numbers: usize) -> Result<(), LengthError> {
        let points = self.factored.nodes();
        if found == points {
            return Ok(());
        }
        Err(LengthError { slice, found: numbers * found, components: numbers, points, group: 1 })
    }
}

#[cfg(test)]
mod tests;
