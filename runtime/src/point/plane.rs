//! Plane strain and plane stress: 2×2 deformation gradients, with consistent tangents.
//!
//! A membrane, a sheet or a slice of a long body is computed in its plane. The stretch λ3 normal to the plane
//! is held in *plane strain*, λ3 = 1, and free in *plane stress*, P33 = 0. Here the free stretch is solved
//! for, to rounding, and eliminated from the tangent, which is then the exact derivative of the in-plane
//! stress.
//!
//! ```
//! use piola::point::Filter;
//! use piola::point::plane::{plane_strain, plane_stress};
//!
//! /// Rubber.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ bulk: f64) -> f64 {
//!     mu / 2.0 * (I1b - 3.0) + bulk / 2.0 * (J - 1.0).powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // Nearly incompressible: the bulk modulus is a million times the shear modulus.
//! let (mu, bulk) = (1.0, 1e6);
//! let rubber = Rubber::new(mu, bulk)?;
//! let F: [[f64; 2]; 2] = [[2.0, 0.0], [0.0, 1.0]];
//! let sheet = plane_stress(&rubber, &F, Filter::None);
//! assert!(sheet.status.is_clean());
//! // The volume stays, up to μ/K. On paper P11 = μ (λ1 − 1/(λ1³ λ2²)).
//! assert!((sheet.out_of_plane_stretch - 0.5).abs() < mu / bulk);
//! assert!((sheet.stress[0][0] - mu * (2.0 - 1.0 / 8.0)).abs() < 10.0 * mu / bulk);
//!
//! // A little more stretch changes the stress by the tangent times that.
//! let more = plane_stress(&rubber, &[[2.0 + 1e-6, 0.0], [0.0, 1.0]], Filter::None);
//! let change = sheet.tangent.apply(&[[1e-6, 0.0], [0.0, 0.0]]);
//! assert!((more.stress[0][0] - sheet.stress[0][0] - change[0][0]).abs() < 1e-11);
//!
//! // Held across, the sheet would have to change its volume.
//! assert!(plane_strain(&rubber, &F, Filter::None).stress[0][0] > 0.9 * bulk);
//! # Ok(())
//! # }
//! ```
//!
//! # Derivation
//!
//! The normal of the plane is a principal direction of F = diag(F̃, λ3) with the 2×2 matrix F̃, and so the
//! stretches of F are those of F̃ = U diag(λ1, λ2) Vᵀ and λ3, each belonging to its axis. With derivatives of
//! ψ(λ1, λ2, λ3) by the stretches of the axes, and dF̂ = Uᵀ dF̃ V, by `point/tangent.rs`
//!
//! ```text
//! P̃ = U diag(ψ1, ψ2) Vᵀ,     P33 = ψ3
//! dP̂11 = ψ11 dF̂11 + ψ12 dF̂22 + ψ13 dλ3
//! dP̂22 = ψ12 dF̂11 + ψ22 dF̂22 + ψ23 dλ3
//! dP33 = ψ13 dF̂11 + ψ23 dF̂22 + ψ33 dλ3
//! dP̂12 + dP̂21 = D⁻ (dF̂12 + dF̂21),     dP̂12 − dP̂21 = D⁺ (dF̂12 − dF̂21)
//! ```
//!
//! **Plane strain** is dλ3 = 0. **Plane stress** is ψ3 = 0, one equation for λ3, which no longer contains U
//! and V, and stays satisfied:
//!
//! ```text
//! dλ3 = −(ψ13 dF̂11 + ψ23 dF̂22)/ψ33
//! dP̂ii = Σj (ψij − ψi3 ψj3/ψ33) dF̂jj,     i, j = 1, 2.
//! ```
//!
//! This is static condensation of the component 33 of dP/dF; the shears do not enter. The condensed tangent
//! is the second derivative of the smallest energy that λ3 can give, and therefore symmetric. Its eigenvalues
//! are flip, twist and the two of the condensed 2×2 matrix, so that a filter is as simple as in space: it
//! acts on the condensed tangent, which a membrane assembles.
//!
//! # What floating point does here
//!
//! The free stretch is found to a few u, as `release.rs` describes, for any ratio of the moduli. The rest of
//! ψ3 is subtracted from the stress to first order, ψi − ψi3/ψ33 ψ3, so that an error of λ3 in its last
//! digit, which a bulk modulus of 10⁶ μ would turn into 10⁶ u μ, does not reach the stress. In the condensed
//! tangent ψij − ψi3 ψj3/ψ33 cancels where the solid is nearly incompressible: it errs by a few u times the
//! largest ψij, the bulk modulus.
//!
//! Out-of-plane stretches are positive for either sign of det F̃. The material decides whether a deformation
//! inverted in the plane is refused. A point whose free stretch has no equilibrium, because its energy pulls
//! or presses at every stretch or because the only equilibria are unstable, is `refused`, with
//! [`PlanePoint::no_equilibrium`] as the reason.
//!
//! This module is independent of any particular material and of meshes.

#![expect(non_snake_case, reason = "F, P, U, V as in the essay above")]

use super::project::{Filter, filtered};
use super::stretches_in_range;
use crate::lanes::Real;
use crate::material::{Blocks, Response};
use crate::quotient::pole_floor;
use crate::status::Status;

mod axes;

mod release;
mod svd;
mod tangent;

use axes::Axes;

use release::{Side, Unreleased, release};
use svd::PlaneSvd;
pub(super) use svd::plane_svd;
pub use tangent::PlaneTangent;

/// A 2×2 matrix as its rows: entry (i, j) is `m[i][j]`.
pub type Matrix2<R> = [[R; 2]; 2];

/// Stress and tangent in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePoint<R> {
    /// The stretches in the plane, λ1 ≥ |λ2|; λ2 has the sign of det F.
    pub stretches: [R; 2],
    /// The stretch λ3 > 0 normal to the plane: 1 in plane strain.
    pub out_of_plane_stretch: R,
    /// dλ3/dF, entry by entry: zero in plane strain.
    pub out_of_plane_slope: Matrix2<R>,
    /// The stress P33 normal to the plane, Pa: zero in plane stress.
    pub out_of_plane_stress: R,
    /// Energy density ψ, J/m³ of rest volume.
    pub energy: R,
    /// The principal stresses ψ1, ψ2 in the plane, Pa.
    pub gradient: [R; 2],
    /// First Piola stress P in the plane, Pa.
    pub stress: Matrix2<R>,
    /// dP/dF in the plane, filtered as requested, Pa.
    pub tangent: PlaneTangent<R>,
    /// Status of the results: valid or not, and filtered or not.
    pub status: Status,
    /// True if the point is refused because no stretch normal to the plane makes the stress vanish.
    pub no_equilibrium: bool,
}

/// Deformation gradient in space, diag(F, λ3), at which [`evaluate`](super::evaluate) gives the same point.
#[must_use]
pub fn in_space<R: Real>(F: &Matrix2<R>, out_of_plane_stretch: R) -> super::Matrix3<R> {
    let zero = R::splat(0.0);
    let [[a, b], [c, d]] = *F;
    [[a, b, zero], [c, d, zero], [zero, zero, out_of_plane_stretch]]
}

/// Stress and tangent in plane strain: λ3 = 1.
///
/// The status is that of [`evaluate`](super::evaluate) at diag(F, 1).
#[must_use]
pub fn plane_strain<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix2<R>,
    filter: Filter,
) -> PlanePoint<R> {
    respond(material, &plane_svd(F), R::splat(1.0), false, filter)
}

/// Stress and tangent in plane stress: λ3 is such that P33 = 0.
///
/// `refused` if the energy is not defined for any λ3, or no λ3 makes the normal stress vanish; see
/// [`PlanePoint::no_equilibrium`]. Results are NaN then.
#[must_use]
pub fn plane_stress<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix2<R>,
    filter: Filter,
) -> PlanePoint<R> {
    let svd = plane_svd(F);
    let [l1, l2] = svd.stretches;
    let is_finite = l1.is_finite() & l2.is_finite();
    if !is_finite {
        return meaningless(&svd, Status { nonfinite: true, ..Status::clean() }, false);
    }
    let side = |stretch: R| {
        let blocks = defined_at(material, [l1, l2, stretch])?;
        let [.., across] = blocks.gradient;
        let [_, _, slope, _, mixed1, mixed2] = blocks.hessian;
        let terms = [across, stretch * slope, l1 * mixed1, l2 * mixed2];
        let magnitude = terms.into_iter().fold(R::splat(0.0), |sum, term| sum + term.abs());
        Some(Side { stress: across, slope, magnitude })
    };
    match release(side, R::splat(1.0) / (l1 * l2.abs())) {
        Ok(stretch) => respond(material, &svd, stretch, true, filter),
        Err(reason) => {
            let refused = Status { refused: true, ..Status::clean() };
            meaningless(&svd, refused, reason == Unreleased::NoEquilibrium)
        }
    }
}

/// The derivatives of the energy by the stretches of the axes, where these are in its domain, and finite.
fn defined_at<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    stretches: [R; 3],
) -> Option<Blocks<R>> {
    let axes = Axes::new(stretches);
    if !(stretches_in_range(axes.sorted) & material.admits(axes.sorted)) {
        return None;
    }
    let blocks = axes.blocks(material);
    let numbers = blocks.gradient.into_iter().chain(blocks.hessian);
    numbers.fold(true, |finite, number| finite & number.is_finite()).then_some(blocks)
}

/// The point with all stretches known, of which that out of the plane is free of stress or held.
fn respond<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    svd: &PlaneSvd<R>,
    across: R,
    is_free: bool,
    filter: Filter,
) -> PlanePoint<R> {
    let (zero, PlaneSvd { U, stretches, V }) = (R::splat(0.0), *svd);
    let [l1, l2] = stretches;
    let axes = Axes::new([l1, l2, across]);
    let blocks = axes.blocks(material);
    let ([mut g1, mut g2, mut g3], [h11, h22, h33, h12, h13, h23]) = (blocks.gradient, blocks.hessian);
    let (mut hessian, mut ratios) = ([h11, h22, h12], [zero; 2]);
    if is_free {
        ratios = [h13 / h33, h23 / h33];
        hessian = [h11 - ratios[0] * h13, h22 - ratios[1] * h23, h12 - ratios[0] * h23];
        (g1, g2, g3) = (g1 - ratios[0] * g3, g2 - ratios[1] * g3, zero);
    }
    let energy = material.energy(axes.sorted);
    let has_pole = material.has_pole() && (l1 + l2).abs().less(pole_floor(axes.sorted));
    let unfiltered = PlaneTangent { U, V, hessian, flip: blocks.flip[0], twist: blocks.twist[0] };
    let (tangent, is_filtered) = unfiltered.project(filter);
    let is_finite = stretches_in_range(axes.sorted)
        & unfiltered.stays_finite()
        & [g1, g2, g3, energy].into_iter().chain(ratios).all(|number| (number + number).is_finite());
    let refused = !material.admits(axes.sorted);
    PlanePoint {
        stretches,
        out_of_plane_stretch: across,
        out_of_plane_slope: tangent::in_the_world(&U, [[-ratios[0], zero], [zero, -ratios[1]]], &V),
        out_of_plane_stress: g3,
        energy,
        gradient: [g1, g2],
        stress: tangent::in_the_world(&U, [[g1, zero], [zero, g2]], &V),
        tangent,
        status: Status { refused, bounded: has_pole, nonfinite: !is_finite, filtered: is_filtered },
        no_equilibrium: false,
    }
}

/// A point without results.
fn meaningless<R: Real<Mask = bool>>(
    svd: &PlaneSvd<R>,
    status: Status,
    no_equilibrium: bool,
) -> PlanePoint<R> {
    let nan = R::splat(f64::NAN);
    PlanePoint {
        stretches: svd.stretches,
        out_of_plane_stretch: nan,
        out_of_plane_slope: [[nan; 2]; 2],
        out_of_plane_stress: nan,
        energy: nan,
        gradient: [nan; 2],
        stress: [[nan; 2]; 2],
        tangent: PlaneTangent { U: svd.U, V: svd.V, hessian: [nan; 3], flip: nan, twist: nan },
        status,
        no_equilibrium,
    }
}
