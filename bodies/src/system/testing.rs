//! Materials and meshes for the tests of bodies, since this crate contains no particular material.

use piola::__private::random::Random;
#[cfg(feature = "faer")]
use piola::batch::Batch;
#[cfg(feature = "faer")]
use piola::point::Filter;

use crate::hand_written::{NeoHookean, RotatedLinear, SaintVenantKirchhoff, Scaled};
use crate::mesh::{TetMesh, tetrahedral_box};
#[cfg(feature = "faer")]
use crate::system::Body;

// The hand-written energies have moduli of about 1 Pa; these are as stiff as rubber foam.
pub(crate) fn kirchhoff() -> Scaled<SaintVenantKirchhoff> {
    scaled(3.0e4, SaintVenantKirchhoff)
}

pub(crate) fn rotated() -> Scaled<RotatedLinear> {
    scaled(3.0e4, RotatedLinear)
}

pub(crate) fn neo_hookean() -> Scaled<NeoHookean> {
    scaled(3.0e3, NeoHookean)
}

/// [`neo_hookean`] as a function of I1 and J, moduli in Pa.
#[piola::material(domain(J > 0.0))]
pub(crate) fn ByInvariants([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

pub(crate) fn by_invariants() -> ByInvariants {
    ByInvariants::new(3.0e3, 4.5e3).expect("positive moduli")
}

pub(crate) fn scaled<M>(factor: f64, material: M) -> Scaled<M> {
    Scaled { factor, material }
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
#[cfg(feature = "faer")]
pub(crate) fn stiffness_product(
    body: &Body,
    positions: &[[f64; 3]],
    filter: Filter,
    x: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let mut product = vec![[0.0; 3]; x.len()];
    for (number, element) in body.elements().iter().enumerate() {
        let deformation = element.deformation_gradient(positions);
        let (mut gradient, mut stiffness) = ([0.0; 12], [0.0; 144]);
        Batch::new(body.material(number))
            .with_filter(filter)
            .stiffnesses(
                deformation.as_flattened(),
                &element.shape.components(),
                &mut gradient,
                &mut stiffness,
            )
            .expect("one element");
        for row in 0..12 {
            let sum = (0..12).map(|k| stiffness[12 * row + k] * x[element.nodes[k / 3]][k % 3]).sum::<f64>();
            product[element.nodes[row / 3]][row % 3] += sum;
        }
    }
    product
}
