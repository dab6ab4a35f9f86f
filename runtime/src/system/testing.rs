//! Materials and meshes for the tests of bodies: the runtime knows no particular material.

use crate::hand_written::{NeoHookean, NeoHookeanByInvariants, RotatedLinear, SaintVenantKirchhoff};
pub(crate) use crate::material::Scaled;
use crate::mesh::{TetMesh, tetrahedral_box};
use crate::random::Random;

// The hand-written energies have moduli of about 1 Pa; these are as stiff as rubber foam.
pub(crate) const KIRCHHOFF: Scaled<SaintVenantKirchhoff> =
    Scaled { material: SaintVenantKirchhoff, factor: 3.0e4 };
pub(crate) const ROTATED: Scaled<RotatedLinear> = Scaled { material: RotatedLinear, factor: 3.0e4 };
pub(crate) const NEO_HOOKEAN: Scaled<NeoHookean> = Scaled { material: NeoHookean, factor: 3.0e3 };

pub(crate) const BY_INVARIANTS: Scaled<NeoHookeanByInvariants> =
    Scaled { material: NeoHookeanByInvariants, factor: 3.0e3 };

/// A beam of `cells` cubes along x with sides of 0.1 m, each cut into six tetrahedra around a diagonal.
pub(crate) fn beam(cells: usize) -> TetMesh {
    tetrahedral_box([cells, 1, 1], [0.1 * cells as f64, 0.1, 0.1]).expect("a beam")
}

/// Positions moved by up to `amplitude` in each coordinate.
pub(crate) fn shake(random: &mut Random, positions: &[[f64; 3]], amplitude: f64) -> Vec<[f64; 3]> {
    positions.iter().map(|x| x.map(|c| c + random.uniform(-amplitude, amplitude))).collect()
}
