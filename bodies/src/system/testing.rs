//! Materials and meshes for the tests of bodies, since this crate contains no particular material.

use piola::__private::random::Random;
use piola::batch::{Batch, MatrixForm};
use piola::material;
use piola::point::Filter;

use crate::mesh::{TetMesh, tetrahedral_box};
use crate::system::Body;

/// Saint Venant–Kirchhoff solid: even in every pair of stretches, so that its twist is smooth everywhere.
#[material]
pub(crate) fn SaintVenantKirchhoff(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    lambda: f64,
) -> f64 {
    let squares = (l1 * l1 - 1.0).powi(2) + (l2 * l2 - 1.0).powi(2) + (l3 * l3 - 1.0).powi(2);
    mu / 4.0 * squares + lambda / 8.0 * (I1 - 3.0).powi(2)
}

/// Rotated linear solid: not even, with a pole of the twist where two stretches are opposite.
#[material]
pub(crate) fn RotatedLinear(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    lambda: f64,
) -> f64 {
    let squares = (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2);
    mu * squares + lambda / 2.0 * (l1 + l2 + l3 - 3.0).powi(2)
}

/// Neo-Hookean solid, an energy of I1 and J.
#[material(domain(J > 0.0))]
pub(crate) fn NeoHookean(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// [`NeoHookean`] for alpha = 2, without the use of invariants, since the exponent is a parameter.
#[material(domain(J > 0.0))]
pub(crate) fn Powers(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    lambda: f64,
    /** Exponent. */
    alpha: f64,
) -> f64 {
    2.0 * mu / alpha.powi(2) * (l1.powf(alpha) + l2.powf(alpha) + l3.powf(alpha) - 3.0)
        - 2.0 * mu / alpha * J.ln()
        + lambda / 2.0 * J.ln().powi(2)
}

// As stiff as rubber foam.
pub(crate) fn kirchhoff() -> SaintVenantKirchhoff {
    SaintVenantKirchhoff::new(3.0e4, 4.5e4).expect("finite")
}

pub(crate) fn rotated() -> RotatedLinear {
    RotatedLinear::new(3.0e4, 4.5e4).expect("finite")
}

pub(crate) fn by_invariants() -> NeoHookean {
    NeoHookean::new(3.0e3, 4.5e3).expect("finite")
}

pub(crate) fn neo_hookean() -> Powers {
    Powers::new(3.0e3, 4.5e3, 2.0).expect("finite")
}

/// A beam of `cells` cubes along x with sides of 0.1 m, each cut into six tetrahedra around a diagonal.
pub(crate) fn beam(cells: usize) -> TetMesh {
    tetrahedral_box([cells, 1, 1], [0.1 * cells as f64, 0.1, 0.1]).expect("a beam")
}

/// Positions moved by up to `amplitude` in each coordinate.
pub(crate) fn shake(random: &mut Random, positions: &[[f64; 3]], amplitude: f64) -> Vec<[f64; 3]> {
    positions.iter().map(|x| x.map(|c| c + random.uniform(-amplitude, amplitude))).collect()
}

/// Product of the filtered stiffness at these positions with a displacement of each node, summed element by
/// element: no sum is shared with an assembled matrix.
pub(crate) fn stiffness_product(
    body: &Body,
    positions: &[[f64; 3]],
    filter: Filter,
    x: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let mut product = vec![[0.0; 3]; x.len()];
    for (number, element) in body.elements().iter().enumerate() {
        let deformation = element.deformation_gradient(positions);
        let rest: Vec<f64> =
            element.shape.inverse.as_flattened().iter().copied().chain([element.shape.volume]).collect();
        let (mut gradient, mut stiffness) = ([0.0; 12], [0.0; 144]);
        Batch::new(body.material(number))
            .with_filter(filter)
            .stiffnesses(MatrixForm::Full, deformation.as_flattened(), &rest, &mut gradient, &mut stiffness)
            .expect("one element");
        for row in 0..12 {
            let sum = (0..12).map(|k| stiffness[12 * row + k] * x[element.nodes[k / 3]][k % 3]).sum::<f64>();
            product[element.nodes[row / 3]][row % 3] += sum;
        }
    }
    product
}
