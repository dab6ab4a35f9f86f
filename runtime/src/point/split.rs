//! The split into change of volume and change of shape: mean stress, distortional stress, and the tangents
//! between them that mixed elements need.
//!
//! Elements of nearly incompressible solids take the volume ratio from elsewhere than from F at the point: as
//! an unknown or a mean over the element θ (Q1P0, u–p, three fields \[STP85\]), or as J at the centre (F-bar
//! \[SPPO96\]). The energy of such a point is
//!
//! ```text
//! ψ̃(F, θ) = ψ(F̃),     F̃ = (θ/J)^⅓ F,     J = det F,
//! ```
//!
//! with the shape of F and the volume θ. For θ = J it is ψ(F). A [`Split`] has all its derivatives:
//!
//! ```text
//! p = ∂ψ̃/∂θ            mean stress, Pa, positive in tension; for θ = J it is tr σ/3
//! A = ∂ψ̃/∂F            distortional stress, A : F = 0
//! ∂p/∂θ                bulk modulus
//! C = ∂p/∂F            coupling, C : F = 0; zero for energies that are sums W(F̄) + U(J)
//! ∂A/∂F                distortional tangent at fixed θ
//! ```
//!
//! ```
//! use piola::point::split::split;
//! use piola::point::{Filter, evaluate};
//!
//! /// Rubber whose energy is a sum of distortional and volumetric parts.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ bulk: f64) -> f64 {
//!     mu / 2.0 * (I1b - 3.0) + bulk / 2.0 * (J - 1.0).powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let (mu, bulk) = (1.0, 1e3);
//! let rubber = Rubber::new(mu, bulk)?;
//! let F: [[f64; 3]; 3] = [[1.1, 0.2, 0.0], [0.0, 1.0, 0.1], [0.0, 0.0, 1.0]];
//! let parts = split(&rubber, &F);
//! // On paper p = K (J − 1), and its slope is K.
//! assert!((parts.mean_stress - bulk * 0.1).abs() < 1e-12 * bulk);
//! assert!((parts.bulk - bulk).abs() < 1e-12 * bulk);
//! assert!(parts.coupling().as_flattened().iter().all(|c| c.abs() < 1e-12 * bulk));
//! // A + p cof F is P.
//! let P = evaluate(&rubber, &F, Filter::None).stress;
//! let (stress, _) = parts.with_pressure(parts.mean_stress);
//! assert!((stress[0][1] - P[0][1]).abs() < 1e-12 * bulk);
//! # Ok(())
//! # }
//! ```
//!
//! # What elements make of them
//!
//! **A pressure of its own.** From the energy ψ̃(F, θ) + p̂ (J − θ) of three fields come the stress
//! A + p̂ cof F and its derivative ∂A/∂F + p̂ ∂cof F/∂F at fixed θ and p̂: [`Split::with_pressure`]. For
//! Q1P0, θ is the mean of J over the element, p̂ that of p; the equations of θ and p̂ need p, ∂p/∂θ and C.
//! For u–p elements of a decoupled energy take θ = J, and p̂ from its own field.
//!
//! **F-bar.** With θ = J0, the volume ratio at the centre of the element, the Cauchy stress is σ(F̃), and its
//! nodal forces are those of a first Piola stress by the rest volume of the point
//!
//! ```text
//! Pᶠ = J σ(F̃) F⁻ᵀ = (J/θ) A + p cof F.
//! ```
//!
//! It is no derivative of an energy, and its tangent not symmetric: [`Split::f_bar`] has ∂Pᶠ/∂F and ∂Pᶠ/∂θ.
//!
//! **Together.** dP/dF is ∂A/∂F + C ⊗ cof F + cof F ⊗ C + ∂p/∂θ cof F ⊗ cof F + p ∂cof F/∂F, where θ = J.
//!
//! # Derivation
//!
//! At fixed θ, ψ̃ is an isotropic energy of F like any other, and has [`Blocks`] of its own, from which the
//! [tangent](super::tangent) is assembled, filtered or put into other measures. They follow from those of ψ
//! at λ̃i = s λi, s = (θ/J)^⅓, on the scale ei = ln λi, where the split is a projection,
//! ẽ = e − ⅓ Σe + ⅓ ln θ. With τ̃i = λ̃i ψi and Hij = ∂²ψ/∂ei∂ej = λ̃i λ̃j ψij + δij τ̃i, and means over the
//! directions m = ⅓ Σ τ̃i, hi = ⅓ Σj Hij, h = ⅓ Σ hi:
//!
//! ```text
//! ∂ψ̃/∂ln θ = m             p = m/θ
//! ∂ψ̃/∂ei = τ̃i − m          Ai = (τ̃i − m)/λi
//! ∂²ψ̃/∂(ln θ)² = h         ∂p/∂θ = (h − m)/θ²
//! ∂²ψ̃/∂ei∂ln θ = hi − h    Ci = (hi − h)/(θ λi)
//! ∂²ψ̃/∂ei∂ej = Gij         Gij = Hij − hi − hj + h
//!                          ∂Ai/∂λj = (Gij − δij (τ̃i − m))/(λi λj)
//! ```
//!
//! A pair's numbers a and b satisfy ψi = a λi − b λj and ψj = a λj − b λi. For Ai and Aj they are
//!
//! ```text
//! a′ = (τ̃i − τ̃j)/(λi² − λj²) = s² a,     b′ = s² b + m/(λi λj),
//! ```
//!
//! so that flips are s² D⁻ + m/(λi λj) and twists s² D⁺ − m/(λi λj): nothing is divided by a gap. J itself is
//! an energy with the gradient λj λk, the mixed derivatives λk, flips −λk and twists λk.
//!
//! # What floating point does here
//!
//! τ̃i − m is ⅓ Σj (τ̃i − τ̃j), and τ̃i − τ̃j = a (λ̃i − λ̃j)(λ̃i + λ̃j): beside a large pressure, A keeps
//! the digits that the pressure would cancel. Gij, hi − h and flips and twists do cancel there: they err by a
//! few u times the bulk modulus and the pressure.
//!
//! Volumes are positive here, or negative both: where θ/J is not positive, the point is `refused`. Where F is
//! singular, results are what division gives, and `nonfinite`.
//!
//! This module knows no particular material and no element.
//!
//! \[STP85\] Simo, Taylor, Pister, *Variational and projection methods for the volume constraint in finite
//! deformation elasto-plasticity*, 1985. \[SPPO96\] de Souza Neto, Perić, Dutko, Owen, *Design of simple low
//! order finite elements for large strain analysis of nearly incompressible solids*, 1996.

#![expect(non_snake_case, reason = "A, C, F, G, H, J, P, U, V as in the essay above")]

use super::matrix::{three, to_world};
use super::svd::Svd;
use super::tangent::Tangent;
use super::{Matrix3, decompose, energy_is_finite, entries_are_finite, stress};
use crate::lanes::Real;
use crate::material::{Blocks, PAIRS, Response};
use crate::status::Status;

/// Derivatives of the energy ψ̃(F, θ) of a body with the shape of F and the volume ratio θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<R: Real> {
    /// The decomposition of F, not of F̃.
    pub decomposition: Svd<R>,
    /// The volume ratio θ.
    pub volume: R,
    /// Energy density ψ̃, J/m³ of rest volume.
    pub energy: R,
    /// Mean stress p = ∂ψ̃/∂θ, Pa: minus the pressure.
    pub mean_stress: R,
    /// Bulk modulus ∂p/∂θ, Pa.
    pub bulk: R,
    /// Coupling ∂p/∂λi in the principal frames, Pa.
    pub principal_coupling: [R; 3],
    /// Derivatives of ψ̃ by the stretches of F at fixed θ, Pa.
    pub blocks: Blocks<R>,
    /// Whether the results mean something.
    pub status: Status<R::Mask>,
}

/// Split at F with its own volume: θ = det F.
#[inline(always)]
#[must_use]
pub fn split<R: Real>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>) -> Split<R> {
    let svd = decompose(material, F);
    let [l1, l2, l3] = svd.stretches;
    of_shape(material, svd, R::splat(1.0), l1 * l2 * l3)
}

/// Split at the shape of F with the volume ratio θ.
#[inline(always)]
#[must_use]
pub fn split_at<R: Real>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>, volume: R) -> Split<R> {
    let svd = decompose(material, F);
    let [l1, l2, l3] = svd.stretches;
    of_shape(material, svd, (volume / (l1 * l2 * l3)).cbrt(), volume)
}

/// The derivatives at F̃ = s F, whose volume ratio is θ.
#[inline(always)]
fn of_shape<R: Real>(material: &(impl Response<R> + ?Sized), svd: Svd<R>, s: R, theta: R) -> Split<R> {
    let third = R::splat(1.0 / 3.0);
    let l = svd.stretches;
    let scaled = three!(i => s * l[i]);
    let (energy, at_scaled) = material.energy_and_blocks(scaled);
    let Blocks { gradient, hessian, flip, twist } = at_scaled;

    let tau = three!(i => scaled[i] * gradient[i]);
    let m = third * (tau[0] + tau[1] + tau[2]);
    // τi − τj of the pairs, without the pressure.
    let [t12, t13, t23] = three!(pair => {
        let (i, j) = PAIRS[pair];
        at_scaled.pair_block(pair).0 * (scaled[i] - scaled[j]) * (scaled[i] + scaled[j])
    });
    let distortional = [third * (t12 + t13), third * (t23 - t12), third * (-t13 - t23)];

    let H = three!(i => (scaled[i] * scaled[i]).mul_add(hessian[i], tau[i]));
    let [h12, h13, h23] = three!(pair => {
        let (i, j) = PAIRS[pair];
        scaled[i] * scaled[j] * hessian[3 + pair]
    });
    let means = [third * (H[0] + h12 + h13), third * (h12 + H[1] + h23), third * (h13 + h23 + H[2])];
    let mean = third * (means[0] + means[1] + means[2]);
    let G = three!(i => (H[i] - means[i]) + (mean - means[i]));
    let mixed = [h12, h13, h23];
    let products = three!(pair => {
        let (i, j) = PAIRS[pair];
        l[i] * l[j]
    });
    let [g12, g13, g23] = three!(pair => {
        let (i, j) = PAIRS[pair];
        ((mixed[pair] - means[i]) + (mean - means[j])) / products[pair]
    });
    let [g11, g22, g33] = three!(i => (G[i] - distortional[i]) / (l[i] * l[i]));
    let squared = s * s;
    let blocks = Blocks {
        gradient: three!(i => distortional[i] / l[i]),
        hessian: [g11, g22, g33, g12, g13, g23],
        flip: three!(pair => squared.mul_add(flip[pair], m / products[pair])),
        twist: three!(pair => squared.mul_add(twist[pair], -(m / products[pair]))),
    };
    let mean_stress = m / theta;
    let bulk = (mean - m) / (theta * theta);
    let principal_coupling = three!(i => (means[i] - mean) / (theta * l[i]));

    let numbers = [
        [mean_stress, bulk, energy],
        principal_coupling,
        blocks.gradient,
        [g11, g22, g33],
        [g12, g13, g23],
        blocks.flip,
        blocks.twist,
    ];
    let mut is_finite = energy_is_finite(l, energy) & energy_is_finite(scaled, energy);
    for [x, y, z] in numbers {
        is_finite = is_finite & entries_are_finite(&[[x, y, z]; 3]);
    }
    let refused = !(material.admits(scaled) & R::splat(0.0).less(s));
    let status = Status { refused, nonfinite: !is_finite, ..Status::clean() };
    Split { decomposition: svd, volume: theta, energy, mean_stress, bulk, principal_coupling, blocks, status }
}

impl<R: Real> Split<R> {
    /// The distortional stress A = ∂ψ̃/∂F, Pa.
    #[inline(always)]
    #[must_use]
    pub fn stress(&self) -> Matrix3<R> {
        stress(&self.decomposition, self.blocks.gradient)
    }

    /// The distortional tangent ∂A/∂F at fixed θ.
    #[inline(always)]
    #[must_use]
    pub fn tangent(&self) -> Tangent<R> {
        let Svd { U, V, .. } = self.decomposition;
        Tangent { U, V, blocks: self.blocks }
    }

    /// The coupling C = ∂p/∂F = ∂A/∂θ, Pa.
    #[inline(always)]
    #[must_use]
    pub fn coupling(&self) -> Matrix3<R> {
        stress(&self.decomposition, self.principal_coupling)
    }

    /// The cofactors of F, ∂J/∂F = J F⁻ᵀ: finite also where F is singular.
    #[inline(always)]
    #[must_use]
    pub fn cofactor(&self) -> Matrix3<R> {
        let [l1, l2, l3] = self.decomposition.stretches;
        stress(&self.decomposition, [l2 * l3, l1 * l3, l1 * l2])
    }

    /// The deviator of the Cauchy stress at F̃, Pa: U diag((τ̃i − m)/θ) Uᵀ.
    #[inline(always)]
    #[must_use]
    pub fn deviator(&self) -> Matrix3<R> {
        let Svd { U, stretches, .. } = self.decomposition;
        let [d1, d2, d3] = three!(i => self.blocks.gradient[i] * stretches[i] / self.volume);
        let zero = R::splat(0.0);
        to_world(&U, &[[d1, zero, zero], [zero, d2, zero], [zero, zero, d3]], &U)
    }

    /// The stress A + p̂ cof F, Pa, and its derivative ∂A/∂F + p̂ ∂cof F/∂F at fixed θ and mean stress p̂.
    #[inline(always)]
    #[must_use]
    pub fn with_pressure(&self, mean_stress: R) -> (Matrix3<R>, Tangent<R>) {
        let Svd { U, stretches: l, V } = self.decomposition;
        let of_volume = three!(pair => mean_stress * l[2 - pair]);
        let areas = [l[1] * l[2], l[0] * l[2], l[0] * l[1]];
        let [h11, h22, h33, h12, h13, h23] = self.blocks.hessian;
        let [j12, j13, j23] = of_volume;
        let blocks = Blocks {
            gradient: three!(i => mean_stress.mul_add(areas[i], self.blocks.gradient[i])),
            hessian: [h11, h22, h33, h12 + j12, h13 + j13, h23 + j23],
            flip: three!(pair => self.blocks.flip[pair] - of_volume[pair]),
            twist: three!(pair => self.blocks.twist[pair] + of_volume[pair]),
        };
        (stress(&self.decomposition, blocks.gradient), Tangent { U, V, blocks })
    }

    /// Stress and tangents of an F-bar element, θ being the volume ratio J0 at its centre.
    ///
    /// ```text
    /// ∂Pᶠ/∂F = (J/θ) ∂A/∂F + A ⊗ cof F/θ + cof F ⊗ C + p ∂cof F/∂F
    /// ∂Pᶠ/∂θ = (J/θ) (C − A/θ) + ∂p/∂θ cof F
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn f_bar(&self) -> FBar<R> {
        let [l1, l2, l3] = self.decomposition.stretches;
        let (theta, ratio) = (self.volume, l1 * l2 * l3 / self.volume);
        let (A, C, cof) = (self.stress(), self.coupling(), self.cofactor());
        let p = self.mean_stress;
        let (_, of_volume) = Self { blocks: nothing(), ..*self }.with_pressure(p);
        let (distortion, volume) = (self.tangent().to_matrix(), of_volume.to_matrix());
        let mut tangent = [[R::splat(0.0); 9]; 9];
        for row in 0..9 {
            let (i, j) = (row / 3, row % 3);
            for column in 0..9 {
                let (k, l) = (column / 3, column % 3);
                let dyads = (A[i][j] / theta).mul_add(cof[k][l], cof[i][j] * C[k][l]);
                tangent[row][column] = ratio.mul_add(distortion[row][column], dyads + volume[row][column]);
            }
        }
        FBar {
            stress: three!(i => three!(j => ratio.mul_add(A[i][j], p * cof[i][j]))),
            tangent,
            slope: three!(i => three!(j => {
                ratio.mul_add(C[i][j] - A[i][j] / theta, self.bulk * cof[i][j])
            })),
        }
    }
}

/// Stress and tangents of an F-bar element at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FBar<R> {
    /// Pᶠ = J σ(F̃) F⁻ᵀ, Pa.
    pub stress: Matrix3<R>,
    /// ∂Pᶠ/∂F at fixed θ, Pa, not symmetric: row 3i+j for entry (i, j) of Pᶠ, column 3k+l for (k, l) of F.
    pub tangent: [[R; 9]; 9],
    /// ∂Pᶠ/∂θ at fixed F, Pa.
    pub slope: Matrix3<R>,
}

/// The blocks of an energy that is zero.
#[inline(always)]
fn nothing<R: Real>() -> Blocks<R> {
    let zero = R::splat(0.0);
    Blocks { gradient: [zero; 3], hessian: [zero; 6], flip: [zero; 3], twist: [zero; 3] }
}
