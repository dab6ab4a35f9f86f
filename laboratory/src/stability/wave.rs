//! The slowest plane wave through a homogeneously deformed solid, in closed form: nothing is searched.
//!
//! A small wave with the front's unit normal N in the rest shape and the unit polarisation m has dF = m ⊗ N,
//! and travels with the speed c that the *acoustic modulus* gives, ρ0 c² = (m ⊗ N) : dP/dF (m ⊗ N), ρ0 the
//! density at rest. Strong ellipticity, which is convexity along rank-one directions, requires that it be
//! positive for all m and N. Where it is not, a front stands still or grows: the deformation localises in
//! bands.
//!
//! # From two unit vectors to a triangle
//!
//! Between the principal frames dP/dF is the map of [`piola::point::Tangent`]: the Hessian ψij on the
//! diagonal entries of dF, and for each pair a on dFij and dFji and b between them. With pi = mi Ni, xij = mi
//! Nj,
//!
//! ```text
//! E(m, N) = Σi ψii pi² + Σ_i<j [ 2 ψij pi pj + aij (xij² + xji²) + 2 bij xij xji ],     xij xji = pi pj.
//! ```
//!
//! Which N is best for given p? The sum xij² + xji² = pi² Nj²/Ni² + pj² Ni²/Nj² is at least 2 |pi pj|, and it
//! is that for all pairs at once if Ni² = |pi|/Σ|p|. So for aij ≥ 0
//!
//! ```text
//! E(m, N) ≥ Σ_ij Mij |pi| |pj|,    Mii = ψii,   Mij = aij + εi εj (ψij + bij),   εi the sign of pi,       (1)
//! ```
//!
//! and strong ellipticity is that aij > 0 for the three pairs, and that the four matrices M, one for each
//! choice of signs up to a common one, are positive for all non-negative |p| ≠ 0: *strictly copositive*. This
//! is the theorem of \[SS83\]; for two stretches it is that of \[KS77\]; \[Dac01\] has it in any dimension.
//!
//! We look for the margin, and for the wave that has it. As m and N are unit vectors,
//!
//! ```text
//! 1 = |m|² |N|² = Σi pi² + Σ_i<j (xij² + xji²),
//! ```
//!
//! so that E − θ is the same form with ψii − θ in place of ψii and aij − θ in place of aij: by the theorem E
//! ≥ θ for all waves if and only if aij ≥ θ for all pairs and M − θ (1 1 1)ᵀ(1 1 1) is copositive for all
//! signs, that is
//!
//! ```text
//! min E = min { a12, a13, a23,  min over the signs and over s1 + s2 + s3 = 1, s ≥ 0, of Σ Mij si sj }.     (2)
//! ```
//!
//! The first three belong to m = ei, N = ej, the shear waves along principal axes: Baker and Ericksen's
//! condition. The others belong to mi = εi √si, Ni = √si. So a slowest wave moves the material either along
//! its own normal, reflected in principal planes, or along one principal axis while it travels along another.
//!
//! # The triangle
//!
//! A quadratic form over a triangle is least in a corner, inside an edge, or inside: one point for each of
//! its 3 + 3 + 1 faces, by a division or a system of two equations. Each is kept if it lies inside its face,
//! and the form evaluated there. The result therefore belongs to a true wave; rounding moves it along the
//! form, where that is flat.
//!
//! \[SS83\] Simpson, Spector, *On copositive matrices and strong ellipticity for isotropic elastic
//! materials*, Arch. Rational Mech. Anal. 84, 1983.
//! \[KS77\] Knowles, Sternberg, *On the failure of ellipticity of the equations for finite elastostatic plane
//! strain*, Arch. Rational Mech. Anal. 63, 1977.
//! \[Dac01\] Dacorogna, *Necessary and sufficient conditions for strong ellipticity of isotropic functions in
//! any dimension*, Discrete Contin. Dyn. Syst. B 1, 2001.
//!
//! This module depends on the derivatives at a point only, neither on a material nor on the place of the
//! point.

#![expect(non_snake_case, reason = "M as in the essay above")]

use piola::material::{Blocks, PAIRS};

/// A plane wave of small amplitude, seen from the principal frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// m: unit vector along which the material moves, in the principal frame of the deformed shape.
    pub polarisation: [f64; 3],
    /// N: unit normal of the front, in the principal frame of the rest shape.
    pub normal: [f64; 3],
    /// ρ0 c² = (m ⊗ N) : dP/dF (m ⊗ N), Pa.
    pub modulus: f64,
}

/// Signs of p up to a common one.
const SIGNS: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];

/// The wave of the least modulus: eq. 2 of the [essay](self).
#[must_use]
pub fn slowest(blocks: &Blocks<f64>) -> Wave {
    let mut least = axial(blocks, 0);
    let mut meet = |wave: Wave| {
        if wave.modulus < least.modulus {
            least = wave;
        }
    };
    (1..PAIRS.len()).for_each(|pair| meet(axial(blocks, pair)));
    for signs in SIGNS {
        let M = reflected(blocks, signs);
        for shares in faces(&M) {
            let normal = shares.map(f64::sqrt);
            let polarisation = std::array::from_fn(|i| signs[i] * normal[i]);
            meet(Wave { polarisation, normal, modulus: form(&M, shares) });
        }
    }
    least
}

/// The shear wave m = ei, N = ej of a pair, which has the modulus aij.
fn axial(blocks: &Blocks<f64>, pair: usize) -> Wave {
    let (i, j) = PAIRS[pair];
    let axis = |k: usize| std::array::from_fn(|l| f64::from(u8::from(k == l)));
    Wave { polarisation: axis(i), normal: axis(j), modulus: blocks.pair_block(pair).0 }
}

/// M of eq. 1.
fn reflected(blocks: &Blocks<f64>, signs: [f64; 3]) -> [[f64; 3]; 3] {
    let mut M = [[0.0; 3]; 3];
    for i in 0..3 {
        M[i][i] = blocks.hessian[i];
    }
    for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
        let (a, b) = blocks.pair_block(pair);
        M[i][j] = a + signs[i] * signs[j] * (blocks.hessian[3 + pair] + b);
        M[j][i] = M[i][j];
    }
    M
}

/// The shares at which Σ Mij si sj can be least over s1 + s2 + s3 = 1, s ≥ 0: in the corners, and where it is
/// stationary inside an edge or inside the triangle.
fn faces(M: &[[f64; 3]; 3]) -> impl Iterator<Item = [f64; 3]> {
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let edges = PAIRS.map(|(i, j)| {
        // (Mii + Mjj − 2 Mij) si = Mjj − Mij
        let (to_i, to_j) = (M[j][j] - M[i][j], M[i][i] - M[i][j]);
        let mut shares = [0.0; 3];
        shares[i] = to_i / (to_i + to_j);
        shares[j] = to_j / (to_i + to_j);
        shares
    });
    // All Σj Mij sj are equal: s is the vector product of two differences of rows, divided by its sum.
    let [r1, r2, r3] = *M;
    let normal = cross(difference(r1, r3), difference(r2, r3));
    let sum: f64 = normal.iter().sum();
    let inside = normal.map(|share| share / sum);
    // If `sum` is 0 the shares are NaN or −∞, and the comparison drops them.
    corners.into_iter().chain(edges).chain([inside]).filter(|shares| shares.iter().all(|share| *share >= 0.0))
}

/// Σ Mij si sj.
fn form(M: &[[f64; 3]; 3], s: [f64; 3]) -> f64 {
    (0..3).map(|i| s[i] * (0..3).map(|j| M[i][j] * s[j]).sum::<f64>()).sum()
}

fn difference(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| x[k] - y[k])
}

fn cross([x1, x2, x3]: [f64; 3], [y1, y2, y3]: [f64; 3]) -> [f64; 3] {
    [x2 * y3 - x3 * y2, x3 * y1 - x1 * y3, x1 * y2 - x2 * y1]
}
