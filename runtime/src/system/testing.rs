//! Materials and meshes for the tests of bodies, written by hand: the runtime knows no particular material.

use crate::lanes::Real;
use crate::material::{Blocks, Material, PAIRS};
use crate::mesh::TetMesh;

/// Saint Venant–Kirchhoff: ψ = λ/2 (tr E)² + μ tr E² with E = (F ᵀF − I)/2.
pub(crate) struct Kirchhoff {
    pub(crate) mu: f64,
    pub(crate) lambda: f64,
}

impl Material for Kirchhoff {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        let (mu, lambda, half) = (R::splat(self.mu), R::splat(self.lambda), R::splat(0.5));
        let e = stretches.map(|x| half * (x * x - R::splat(1.0)));
        let trace = e[0] + e[1] + e[2];
        half * lambda * trace * trace + mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2])
    }

    fn gradient<R: Real>(&self, stretches: [R; 3]) -> [R; 3] {
        self.blocks(stretches).gradient
    }

    fn blocks<R: Real>(&self, x: [R; 3]) -> Blocks<R> {
        let (mu, lambda, half, one) =
            (R::splat(self.mu), R::splat(self.lambda), R::splat(0.5), R::splat(1.0));
        let squares = x.map(|x| x * x);
        let trace = half * (squares[0] + squares[1] + squares[2] - R::splat(3.0));
        // ψi = xi q(xi²) with q = λ tr E + μ (xi² − 1).
        let diagonal =
            [0, 1, 2].map(|i| lambda * trace + mu * (R::splat(3.0) * squares[i] - one) + lambda * squares[i]);
        let mixed = PAIRS.map(|(i, j)| lambda * x[i] * x[j]);
        let common = lambda * trace - mu;
        Blocks {
            gradient: [0, 1, 2].map(|i| x[i] * (lambda * trace + mu * (squares[i] - one))),
            hessian: [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]],
            flip: PAIRS.map(|(i, j)| common + mu * (squares[i] + x[i] * x[j] + squares[j])),
            twist: PAIRS.map(|(i, j)| common + mu * (squares[i] - x[i] * x[j] + squares[j])),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        stretches[0].is_finite()
    }

    fn has_pole(&self) -> bool {
        false
    }

    fn ends_at_zero_volume(&self) -> bool {
        false
    }
}

/// Rotated linear elasticity: ψ = μ Σ (λi − 1)² + λ/2 (Σ λi − 3)².
pub(crate) struct RotatedLinear {
    pub(crate) mu: f64,
    pub(crate) lambda: f64,
}

impl Material for RotatedLinear {
    fn energy<R: Real>(&self, x: [R; 3]) -> R {
        let (mu, lambda, one) = (R::splat(self.mu), R::splat(self.lambda), R::splat(1.0));
        let e = x.map(|x| x - one);
        let trace = e[0] + e[1] + e[2];
        mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) + R::splat(0.5) * lambda * trace * trace
    }

    fn gradient<R: Real>(&self, x: [R; 3]) -> [R; 3] {
        let (mu, lambda, one) = (R::splat(2.0 * self.mu), R::splat(self.lambda), R::splat(1.0));
        let trace = (x[0] - one) + (x[1] - one) + (x[2] - one);
        x.map(|x| mu * (x - one) + lambda * trace)
    }

    fn blocks<R: Real>(&self, x: [R; 3]) -> Blocks<R> {
        let (mu, lambda) = (R::splat(2.0 * self.mu), R::splat(self.lambda));
        let gradient = self.gradient(x);
        let floor = crate::quotient::pole_floor(x);
        Blocks {
            gradient,
            hessian: [mu + lambda, mu + lambda, mu + lambda, lambda, lambda, lambda],
            flip: [mu; 3],
            twist: PAIRS.map(|(i, j)| (gradient[i] + gradient[j]) / (x[i] + x[j]).max(floor)),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        stretches[0].is_finite()
    }

    fn has_pole(&self) -> bool {
        true
    }

    fn ends_at_zero_volume(&self) -> bool {
        false
    }
}

/// Neo-Hookean elasticity, which refuses J ≤ 0: ψ = μ/2 (I1 − 3) − μ ln J + λ/2 ln² J.
pub(crate) struct NeoHookean {
    pub(crate) mu: f64,
    pub(crate) lambda: f64,
}

impl Material for NeoHookean {
    fn energy<R: Real>(&self, x: [R; 3]) -> R {
        let log = (x[0] * x[1] * x[2]).ln();
        let squares = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        let (mu, lambda) = (R::splat(self.mu), R::splat(self.lambda / 2.0));
        R::splat(self.mu / 2.0) * (squares - R::splat(3.0)) - mu * log + lambda * log * log
    }

    fn gradient<R: Real>(&self, x: [R; 3]) -> [R; 3] {
        self.blocks(x).gradient
    }

    fn blocks<R: Real>(&self, x: [R; 3]) -> Blocks<R> {
        let (mu, lambda) = (R::splat(self.mu), R::splat(self.lambda));
        let pressure = mu - lambda * (x[0] * x[1] * x[2]).ln();
        let diagonal = x.map(|x| mu + (pressure + lambda) / (x * x));
        let mixed = PAIRS.map(|(i, j)| lambda / (x[i] * x[j]));
        Blocks {
            gradient: x.map(|x| mu * x - pressure / x),
            hessian: [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]],
            flip: PAIRS.map(|(i, j)| mu + pressure / (x[i] * x[j])),
            twist: PAIRS.map(|(i, j)| mu - pressure / (x[i] * x[j])),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        R::splat(0.0).less(stretches[2])
    }

    fn has_pole(&self) -> bool {
        false
    }

    fn ends_at_zero_volume(&self) -> bool {
        true
    }
}

pub(crate) const KIRCHHOFF: Kirchhoff = Kirchhoff { mu: 3.0e4, lambda: 5.0e4 };
pub(crate) const ROTATED: RotatedLinear = RotatedLinear { mu: 3.0e4, lambda: 5.0e4 };

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

/// Numbers between −1 and 1 from a fixed seed: splitmix64 [Steele, Lea, Flood 2014].
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    }

    /// Positions moved by up to `amplitude` in each coordinate.
    pub(crate) fn shake(&mut self, positions: &[[f64; 3]], amplitude: f64) -> Vec<[f64; 3]> {
        positions.iter().map(|x| x.map(|c| c + amplitude * self.next())).collect()
    }
}
