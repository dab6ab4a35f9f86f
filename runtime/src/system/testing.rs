//! Materials and meshes for the tests of bodies: the runtime knows no particular material.

use crate::hand_written::{NeoHookean, RotatedLinear, SaintVenantKirchhoff};
use crate::lanes::Real;
use crate::material::{Blocks, Material};
use crate::mesh::TetMesh;
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
    let corner = |i: usize, j: usize, k: usize| 4 * i + 2 * j + k;
    let mut positions = Vec::new();
    for i in 0..=cells {
        for (j, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            positions.push([0.1 * i as f64, 0.1 * j as f64, 0.1 * k as f64]);
        }
    }
    let mut tets = Vec::new();
    for i in 0..cells {
        // Kuhn: one tetrahedron for each order in which the three axes are walked; odd orders are turned around.
        for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            let mut at = [i, 0, 0];
            let mut path = [corner(at[0], at[1], at[2]); 4];
            for (step, axis) in axes.into_iter().enumerate() {
                at[axis] += 1;
                path[step + 1] = corner(at[0], at[1], at[2]);
            }
            if (axes[0] + 1) % 3 != axes[1] {
                path.swap(1, 2);
            }
            tets.push(path);
        }
    }
    TetMesh::new(positions, tets)
}

/// Positions moved by up to `amplitude` in each coordinate.
pub(crate) fn shake(random: &mut Random, positions: &[[f64; 3]], amplitude: f64) -> Vec<[f64; 3]> {
    positions.iter().map(|x| x.map(|c| c + random.uniform(-amplitude, amplitude))).collect()
}
