//! Materials and meshes for the tests of bodies: the runtime knows no particular material.

use crate::hand_written::{NeoHookean, RotatedLinear, SaintVenantKirchhoff};
use crate::lanes::Real;
use crate::material::{Blocks, Material};
use crate::mesh::{TetMesh, tetrahedral_box};
use crate::random::Random;

/// An energy in which the hand-written ones, with moduli of about 1 Pa, come as stiff as rubber foam.
pub(crate) struct Scaled<M> {
    pub(crate) material: M,
    pub(crate) factor: f64,
}

impl<M: Material> Material for Scaled<M> {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        R::splat(self.factor) * self.material.energy(stretches)
    }

    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        self.material.gradient(stretches).map(|x| R::splat(self.factor) * x)
    }

    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        let scale = |x: R| R::splat(self.factor) * x;
        let Blocks { gradient, hessian, flip, twist } = self.material.blocks(stretches);
        Blocks {
            gradient: gradient.map(scale),
            hessian: hessian.map(scale),
            flip: flip.map(scale),
            twist: twist.map(scale),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        self.material.admits(stretches)
    }

    fn has_pole(&self) -> bool {
        self.material.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.material.ends_at_zero_volume()
    }
}

pub(crate) const KIRCHHOFF: Scaled<SaintVenantKirchhoff> =
    Scaled { material: SaintVenantKirchhoff, factor: 3.0e4 };
pub(crate) const ROTATED: Scaled<RotatedLinear> = Scaled { material: RotatedLinear, factor: 3.0e4 };
pub(crate) const NEO_HOOKEAN: Scaled<NeoHookean> = Scaled { material: NeoHookean, factor: 3.0e3 };

/// A beam of `cells` cubes along x with sides of 0.1 m, each cut into six tetrahedra around a diagonal.
pub(crate) fn beam(cells: usize) -> TetMesh {
    tetrahedral_box([cells, 1, 1], [0.1 * cells as f64, 0.1, 0.1]).expect("a beam")
}

/// Positions moved by up to `amplitude` in each coordinate.
pub(crate) fn shake(random: &mut Random, positions: &[[f64; 3]], amplitude: f64) -> Vec<[f64; 3]> {
    positions.iter().map(|x| x.map(|c| c + random.uniform(-amplitude, amplitude))).collect()
}
