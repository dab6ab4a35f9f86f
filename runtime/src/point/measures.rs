//! Stress measures and tangents of engineering codes: S and dS/dE, τ, σ and the spatial tangents.
//!
//! A code that has its own elements rarely uses P and dP/dF. A total Lagrangian one needs the second
//! Piola–Kirchhoff stress S = F⁻¹P and the material tangent dS/dE, an updated one the Cauchy stress σ and a
//! spatial tangent. They are computed here from the results of a point, its decomposition F = U diag(λ) Vᵀ
//! and the [`Blocks`] of its energy: F is never inverted, and no tensor pushed forward by four sums. Tangents
//! are 6×6, in the notation of [`voigt`].
//!
//! ```
//! use piola::point::measures::{Measure, voigt};
//! use piola::point::{Filter, evaluate};
//!
//! /// Rubber.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let (mu, lambda) = (1e6, 4e6);
//! let rubber = Rubber::new(mu, lambda)?;
//! // Simple shear by 0.5 leaves the volume: J = 1.
//! let F: [[f64; 3]; 3] = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let point = evaluate(&rubber, &F, Filter::None);
//! let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
//! let check = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9 * lambda);
//!
//! // On paper σ = (μ (FFᵀ − I) + λ ln J I)/J.
//! let stress = Measure::Cauchy.stress(&svd, blocks.gradient);
//! for (found, expected) in stress.into_iter().zip([0.25 * mu, 0.0, 0.0, 0.0, 0.0, 0.5 * mu]) {
//!     check(found, expected);
//! }
//!
//! // On paper c is Hooke's law with λ/J and (μ − λ ln J)/J.
//! let c = Measure::Cauchy.tangent(&svd, blocks);
//! check(c[0][0], lambda + 2.0 * mu);
//! check(c[0][1], lambda);
//! check(c[5][5], mu);
//! // DDSDDE of Abaqus has half of σ11 + σ22 in addition.
//! check(Measure::Jaumann.tangent(&svd, blocks)[5][5], mu + 0.125 * mu);
//!
//! // A little more shear, dF = 10⁻⁶ e1 ⊗ e2, is dE = (Fᵀ dF + dFᵀ F)/2 and changes S by dS/dE times that.
//! let more = [[1.0, 0.5 + 1e-6, 0.0], F[1], F[2]];
//! let S = |F| {
//!     let point = evaluate(&rubber, F, Filter::None);
//!     Measure::SecondPiola.stress(&point.decomposition(), point.tangent.blocks.gradient)
//! };
//! let dE = voigt::from_strain(&[[0.0, 0.5e-6, 0.0], [0.5e-6, 0.5e-6, 0.0], [0.0; 3]]);
//! let dS_dE = Measure::SecondPiola.tangent(&svd, blocks);
//! for (row, (after, before)) in dS_dE.iter().zip(S(&more).into_iter().zip(S(&F))) {
//!     let change: f64 = row.iter().zip(dE).map(|(C, e)| C * e).sum();
//!     assert!((after - before - change).abs() < 1e-11 * lambda);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # What each of them is
//!
//! With J = det F, the Green strain E = (FᵀF − I)/2, and L = dF F⁻¹ = ε + ω, its symmetric and antisymmetric
//! parts:
//!
//! ```text
//! S = F⁻¹P = ∂ψ/∂E            dS = dS/dE : dE
//! τ = P Fᵀ = F S Fᵀ           dτ − L τ − τ Lᵀ = J c : ε
//! σ = τ/J                     dτ − ω τ + τ ω  = J c° : ε
//! ```
//!
//! All of them are symmetric and in Pa. The *spatial tangent* c is the push-forward of dS/dE, by deformed
//! volume:
//!
//! ```text
//! c_ijkl = 1/J F_ip F_jq F_kr F_ls (dS/dE)_pqrs
//! ```
//!
//! It belongs to the Lie derivative of τ, which is J times the Truesdell rate of σ. To the Jaumann rate of τ
//! belongs
//!
//! ```text
//! c°_ijkl = c_ijkl + ½ (δik σjl + δil σjk + δjk σil + δjl σik)
//! ```
//!
//! because the left sides above differ by ε τ + τ ε. This is what Abaqus/Standard expects of a user material
//! under the name DDSDDE, in an order that [`voigt`] states. (The Jaumann rate of σ itself belongs to
//! c° − σ ⊗ I, which is not symmetric.) The *Green–Naghdi rate*, of shells and of Abaqus/Explicit, turns with
//! the rotation R = U Vᵀ of the polar decomposition instead, Ω = dR Rᵀ, so that Rᵀ τ R changes by it alone:
//!
//! ```text
//! dτ − Ω τ + τ Ω = J c★ : ε.
//! ```
//!
//! # In the principal frames
//!
//! `point/tangent.rs` derives how F and P change there: with dF̂ = Uᵀ dF V, the Hessian ψij takes
//! the diagonal entries of dF̂ to those of Uᵀ dP V, and a, b do it for each pair. S is Vᵀ S V = diag(si) with
//! si = ψi/λi, and dE is, with Λ = diag(λ),
//!
//! ```text
//! dÊ = Vᵀ dE V = (Λ dF̂ + dF̂ᵀ Λ)/2:      dÊii = λi dF̂ii,      2 dÊij = λi dF̂ij + λj dF̂ji.
//! ```
//!
//! From P = F S comes Uᵀ dP V = dF̂ diag(s) + Λ dŜ, where dŜ = Vᵀ dS V.
//!
//! **The diagonal.** Σj ψij dF̂jj = si dF̂ii + λi dŜii, therefore
//!
//! ```text
//! dŜii = Σj (ψij − δij si)/(λi λj) dÊjj.
//! ```
//!
//! **A pair.** a dF̂ij + b dF̂ji = sj dF̂ij + λi dŜij. By definition a = (D⁻ + D⁺)/2 and b = (D⁻ − D⁺)/2
//! satisfy ψj = a λj − b λi, hence a − sj = b λi/λj, and
//!
//! ```text
//! dŜij = b/(λi λj) (λi dF̂ij + λj dF̂ji) = b/(λi λj) 2 dÊij.
//! ```
//!
//! Textbooks give this modulus as (si − sj)/(λi² − λj²), with a limit for equal stretches \[Hol00\]. It is
//! the same number, but here without the gap, since flip and twist come without one.
//!
//! **Together.** Pushing forward multiplies by one stretch for each index and replaces V by U; most of the
//! division by J = λi λj λk then cancels. For i, j, k all different:
//!
//! ```text
//!            stress       iiii                     iijj           ijij                             frame
//! S, dS/dE   ψi/λi        (ψii − ψi/λi)/λi²        ψij/(λi λj)    bij/(λi λj)                      V
//! σ, c       ψi/(λj λk)   (λi ψii − ψi)/(λj λk)    ψij/λk         bij/λk                           U
//! σ, c°      ψi/(λj λk)   (λi ψii + ψi)/(λj λk)    ψij/λk         aij (λi/λj + λj/λi)/(2 λk)       U
//! σ, c★      ψi/(λj λk)   (λi ψii + ψi)/(λj λk)    ψij/λk         aij/λk                           U
//! τ, J c     λi ψi        λi (λi ψii − ψi)         λi λj ψij      bij λi λj                        U
//! ```
//!
//! Components that the symmetries don't give are zero. The shear of c° is bij/λk + (σi + σj)/2.
//!
//! **Green and Naghdi.** With Ωᵁ and Θ of `point/tangent.rs`, dR = U (Ωᵁ + Θ) Vᵀ, and
//! (λi + λj)(Ωᵁij + Θij) = dF̂ij − dF̂ji. From dF̂ij = (εij + ωij) λj then follows
//!
//! ```text
//! Ωij = ωij + εij (λj − λi)/(λi + λj)
//! ```
//!
//! and the two rates differ in the shears alone, by (Ω − ω) τ − τ (Ω − ω) = (τj − τi)(λj − λi)/(λi + λj) εij.
//! Since τi − τj = a (λi² − λj²),
//!
//! ```text
//! 2 J c★ijij = a (λi² + λj²) − a (λi − λj)² = 2 a λi λj.
//! ```
//!
//! No sum and no difference of stretches is left, although R itself jumps where two are opposite.
//!
//! # What floating point does here
//!
//! Stresses and tangents are exactly symmetric: each number is computed once. Nothing cancels in a stress,
//! however near or far apart the stretches are. In the tangents ψii ∓ ψi/λi and D⁻ ± D⁺ may cancel; of either
//! remains an error of a few u M, where M is the largest magnitude among ψij, ψi/λi, D⁻ and D⁺. Divided as in
//! the table and rotated into space, it is at most a few u M/λ3² in dS/dE, and a few u M λ1²/|J| in c and c°.
//!
//! Near rest a stress has an error of u ‖dP/dF‖, like every result computed from F. If that matters, τ = P +
//! P Hᵀ keeps the digits of a stress that comes from the
//! [`DisplacementGradient`](super::DisplacementGradient).
//!
//! **Singular F.** All measures except for τ are divided by stretches. If λ3 = 0, or a product of stretches
//! leaves the range, the results are those of the division, including infinity and NaN; the status of the
//! point does not cover them. If F is inverted, J is negative, and σ, c and c° are τ and its tangents divided
//! by that.
//!
//! **Filters.** The tangents are derivatives if the blocks are unfiltered:
//! [`Filter::None`](super::Filter::None). A filter breaks the relation ψj = a λj − b λi. A filtered dP/dF is
//! no longer the sum of a part with S and one that E alone decides, and it does not belong to any dS/dE. From
//! filtered blocks come symmetric matrices that are not derivatives and need not be semidefinite; a
//! semidefinite element stiffness is made of the filtered dP/dF instead.
//!
//! This module is independent of any particular material and of meshes.
//!
//! \[Hol00\] Holzapfel, *Nonlinear Solid Mechanics*, 2000.

#![expect(non_snake_case, reason = "Q, and F, S, E, U, V as in the essay above")]

use super::Matrix3;
use super::matrix::{dot, three};
use super::svd::Svd;
use crate::lanes::Real;
use crate::material::{Blocks, PAIRS};

pub mod voigt;

use voigt::{Matrix6, ORDER, Principal};

/// Measure of stress with a tangent that belongs to it.
///
/// Spatial tangents are by deformed volume. They map ε, the symmetric part of dF F⁻¹ as
/// [`voigt::from_strain`] stores it, to the change of τ, divided by J, as seen by an observer that moves with
/// the body in the way of their rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// The second Piola–Kirchhoff stress S = F⁻¹P = V diag(ψi/λi) Vᵀ and the material tangent dS/dE, which
    /// maps an increment of E.
    SecondPiola,
    /// The Kirchhoff stress τ = P Fᵀ = U diag(λi ψi) Uᵀ and the tangent J c of its Lie derivative. Contains
    /// no division: finite even if F is singular.
    Kirchhoff,
    /// The Cauchy stress σ = τ/J = U diag(ψi/(λj λk)) Uᵀ and the spatial tangent c of its Truesdell rate,
    /// which is dS/dE pushed forward: the observer deforms with the body.
    Cauchy,
    /// The Cauchy stress σ and c°, of the Jaumann rate of τ: the observer turns with the body. DDSDDE of
    /// Abaqus, in the order that [`voigt`] states.
    Jaumann,
    /// The Cauchy stress σ and c★, of the Green–Naghdi rate of τ: the observer turns with the rotation R of
    /// the polar decomposition.
    GreenNaghdi,
}

impl Measure {
    /// All measures, in the order above.
    pub const ALL: [Self; 5] =
        [Self::SecondPiola, Self::Kirchhoff, Self::Cauchy, Self::Jaumann, Self::GreenNaghdi];

    /// The six components of the stress, Pa, in the order of [`voigt`], for the gradient ψ1, ψ2, ψ3;
    /// [`voigt::to_stress`] makes a matrix of them.
    #[inline(always)]
    #[must_use]
    pub fn stress<R: Real>(self, svd: &Svd<R>, gradient: [R; 3]) -> [R; 6] {
        let l = svd.stretches;
        let areas = areas(l);
        match self {
            Self::SecondPiola => six_numbers(&svd.V, three!(i => gradient[i] / l[i])),
            Self::Kirchhoff => six_numbers(&svd.U, three!(i => gradient[i] * l[i])),
            _ => six_numbers(&svd.U, three!(i => gradient[i] / areas[i])),
        }
    }

    /// The 6×6 tangent, Pa, for unfiltered blocks; exactly symmetric.
    #[inline(always)]
    #[must_use]
    pub fn tangent<R: Real>(self, svd: &Svd<R>, blocks: &Blocks<R>) -> Matrix6<R> {
        let principal = self.principal(svd.stretches, blocks);
        principal.to_world(if self == Self::SecondPiola { &svd.V } else { &svd.U })
    }

    /// The tangent in the principal frame: a line of the table above.
    #[inline(always)]
    fn principal<R: Real>(self, l: [R; 3], blocks: &Blocks<R>) -> Principal<R> {
        let Blocks { gradient, hessian, .. } = blocks;
        match self {
            Self::SecondPiola => {
                let products = products(l);
                Principal {
                    diagonal: three!(i => (hessian[i] - gradient[i] / l[i]) / (l[i] * l[i])),
                    mixed: three!(pair => hessian[3 + pair] / products[pair]),
                    shear: three!(pair => blocks.pair_block(pair).1 / products[pair]),
                }
            }
            Self::Kirchhoff => {
                let products = products(l);
                Principal {
                    diagonal: three!(i => l[i] * l[i].mul_add(hessian[i], -gradient[i])),
                    mixed: three!(pair => products[pair] * hessian[3 + pair]),
                    shear: three!(pair => products[pair] * blocks.pair_block(pair).1),
                }
            }
            Self::Cauchy => {
                let areas = areas(l);
                Principal {
                    diagonal: three!(i => l[i].mul_add(hessian[i], -gradient[i]) / areas[i]),
                    mixed: three!(pair => hessian[3 + pair] / l[third(pair)]),
                    shear: three!(pair => blocks.pair_block(pair).1 / l[third(pair)]),
                }
            }
            Self::Jaumann => {
                let areas = areas(l);
                Principal {
                    diagonal: three!(i => l[i].mul_add(hessian[i], gradient[i]) / areas[i]),
                    mixed: three!(pair => hessian[3 + pair] / l[third(pair)]),
                    shear: three!(pair => {
                        let (i, j) = PAIRS[pair];
                        let ratios = R::splat(0.5) * (l[i] / l[j] + l[j] / l[i]);
                        blocks.pair_block(pair).0 * ratios / l[third(pair)]
                    }),
                }
            }
            Self::GreenNaghdi => {
                let areas = areas(l);
                Principal {
                    diagonal: three!(i => l[i].mul_add(hessian[i], gradient[i]) / areas[i]),
                    mixed: three!(pair => hessian[3 + pair] / l[third(pair)]),
                    shear: three!(pair => blocks.pair_block(pair).0 / l[third(pair)]),
                }
            }
        }
    }
}

/// λi λj of the pairs.
#[inline(always)]
fn products<R: Real>([l1, l2, l3]: [R; 3]) -> [R; 3] {
    [l1 * l2, l1 * l3, l2 * l3]
}

/// λj λk, the deformed size of a unit area normal to direction i.
#[inline(always)]
fn areas<R: Real>([l1, l2, l3]: [R; 3]) -> [R; 3] {
    [l2 * l3, l1 * l3, l1 * l2]
}

/// The direction that a pair lacks.
#[inline(always)]
fn third(pair: usize) -> usize {
    2 - pair
}

/// Q diag(d) Qᵀ as six numbers.
#[inline(always)]
fn six_numbers<R: Real>(Q: &Matrix3<R>, d: [R; 3]) -> [R; 6] {
    let mut numbers = [R::splat(0.0); 6];
    for index in 0..6 {
        let (i, j) = ORDER[index];
        numbers[index] = dot(three!(k => Q[i][k] * Q[j][k]), d);
    }
    numbers
}
