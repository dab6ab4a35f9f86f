//! Stresses and tangents in the order of Abaqus: STRESS and DDSDDE of a user material.
//!
//! Abaqus/Standard stores 11, 22, 33, 12, 13, 23, shears of strains doubled; solids in plane strain and
//! axisymmetric ones have the first four, with 33 out of the plane, and sheets in plane stress 11, 22, 12.
//! STRESS is the Cauchy stress. DDSDDE is the tangent c° of the Jaumann rate of the Kirchhoff stress by
//! deformed volume, [`jaumann_tangent`]; it is symmetric, so that rows and columns need not be exchanged for
//! Fortran. Where the axes turn with the body, in shells, membranes and whatever has an ORIENTATION, and in
//! Abaqus/Explicit, stresses are components along the turned axes, and the tangent is c★ of
//! [`green_naghdi_tangent`]: [`respond_corotated`].
//!
//! ```
//! use piola::point::measures::abaqus;
//!
//! /// Rubber.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let rubber = Rubber::new(1e6, 4e6)?;
//! let F: [[f64; 3]; 3] = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let umat = abaqus::respond(&rubber, &F);
//! assert!(umat.status.is_clean());
//! // σ = μ (FFᵀ − I): shear 12 is number 4, that is, 3 from zero.
//! assert!((umat.stress[3] - 0.5e6).abs() < 1e-3);
//! assert!((umat.ddsdde[3][3] - 1.125e6).abs() < 1e-3);
//! // The same in plane strain.
//! assert_eq!(abaqus::plane_strain_ddsdde(&umat.ddsdde)[3], umat.ddsdde[3][..4]);
//! # Ok(())
//! # }
//! ```
//!
//! This module knows no files and no program, only an order.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use super::voigt::{self, Matrix6};
use super::{cauchy, green_naghdi_tangent, jaumann_tangent};
use crate::lanes::Real;
use crate::material::Response;
use crate::point::{Filter, Matrix3, Svd, evaluate_with_energy};
use crate::status::Status;

/// Row and column, counted from zero, of each of the six numbers: 11, 22, 33, 12, 13, 23.
pub const ABAQUS_ORDER: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Results of a user material at a point, in the order of Abaqus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Umat<R: Real> {
    /// STRESS: the Cauchy stress, Pa.
    pub stress: [R; 6],
    /// DDSDDE, Pa.
    pub ddsdde: Matrix6<R>,
    /// Energy density ψ, J/m³ of rest volume. SSE is by deformed volume: divide by J.
    pub energy: R,
    /// Whether the results mean something; those of a singular F, divided by its volume, do not.
    pub status: Status<R::Mask>,
}

/// Stress and DDSDDE of a solid at F, with the Jaumann rate.
#[must_use]
pub fn respond<R: Real>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>) -> Umat<R> {
    let (energy, point) = evaluate_with_energy(material, F, Filter::None);
    let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
    let tangent = jaumann_tangent(&svd, blocks);
    assembled(&cauchy(&svd, blocks.gradient), &tangent, energy, point.status)
}

/// Stress and DDSDDE of a body whose axes turn with it, with the Green–Naghdi rate.
///
/// Components are those along R ei, with the rotation R of the polar decomposition, as in shells and with an
/// ORIENTATION; the tangent takes ε in these axes to the change of the components of τ, by deformed volume.
/// Since R V = U, the components are those of U diag(σi) Uᵀ with V in the place of U.
#[must_use]
pub fn respond_corotated<R: Real>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>) -> Umat<R> {
    let (energy, point) = evaluate_with_energy(material, F, Filter::None);
    let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
    let turned = Svd { U: svd.V, ..svd };
    let tangent = green_naghdi_tangent(&turned, blocks);
    assembled(&cauchy(&turned, blocks.gradient), &tangent, energy, point.status)
}

fn assembled<R: Real>(
    stress: &Matrix3<R>,
    tangent: &Matrix6<R>,
    energy: R,
    status: Status<R::Mask>,
) -> Umat<R> {
    let (stress, ddsdde) = (umat_stress(stress), umat_tangent(tangent));
    // Infinite or NaN in a sum of products with zero.
    let zero = R::splat(0.0);
    let sum = stress.iter().chain(ddsdde.iter().flatten()).fold(zero, |sum, x| x.mul_add(zero, sum));
    let nonfinite = status.nonfinite | !sum.is_finite();
    Umat { stress, ddsdde, energy, status: Status { nonfinite, ..status } }
}

/// The six numbers of a stress in this order.
#[must_use]
pub fn umat_stress<R: Real>(stress: &Matrix3<R>) -> [R; 6] {
    let [s11, s22, s33, s23, s13, s12] = voigt::from_stress(stress);
    [s11, s22, s33, s12, s13, s23]
}

/// The six numbers of a strain in this order, shears doubled.
#[must_use]
pub fn umat_strain<R: Real>(strain: &Matrix3<R>) -> [R; 6] {
    let [e11, e22, e33, e23, e13, e12] = voigt::from_strain(strain);
    [e11, e22, e33, e12, e13, e23]
}

/// A tangent of [`voigt`] in this order; and the other way round.
#[must_use]
pub fn umat_tangent<R: Real>(tangent: &Matrix6<R>) -> Matrix6<R> {
    const PLACES: [usize; 6] = [0, 1, 2, 5, 4, 3];
    PLACES.map(|row| PLACES.map(|column| tangent[row][column]))
}

/// The 4×4 DDSDDE of plane strain and axial symmetry, 11, 22, 33, 12, from the six numbers of this order.
#[must_use]
pub fn plane_strain_ddsdde<R: Real>(ddsdde: &Matrix6<R>) -> [[R; 4]; 4] {
    std::array::from_fn(|row| std::array::from_fn(|column| ddsdde[row][column]))
}

/// The 3×3 DDSDDE of plane stress, 11, 22, 12, from the six numbers of this order.
///
/// The strain 33 that keeps σ33 zero is eliminated. For the F of a plane whose out-of-plane stretch
/// [`plane_stress`](crate::point::plane::plane_stress) has found:
///
/// ```
/// use piola::point::measures::abaqus;
/// use piola::point::Filter;
/// use piola::point::plane::{in_space, plane_stress};
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // At rest it is Hooke's law of sheets: E/(1 − ν²) with μ = λ, so that ν = 1/4 and E = 5/2.
/// let rubber = Rubber::new(1.0, 1.0)?;
/// let rest: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];
/// let thickness = plane_stress(&rubber, &rest, Filter::None).out_of_plane_stretch;
/// let umat = abaqus::respond(&rubber, &in_space(&rest, thickness));
/// let sheet = abaqus::plane_stress_ddsdde(&umat.ddsdde);
/// assert!((sheet[0][0] - 2.5 / (1.0 - 1.0 / 16.0)).abs() < 1e-14);
/// assert!((sheet[2][2] - 1.0).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn plane_stress_ddsdde<R: Real>(ddsdde: &Matrix6<R>) -> [[R; 3]; 3] {
    const PLACES: [usize; 3] = [0, 1, 3];
    PLACES.map(|row| {
        PLACES.map(|column| {
            // In this order of factors the matrix stays exactly symmetric.
            ddsdde[row][column] - ddsdde[row][2] * ddsdde[2][column] / ddsdde[2][2]
        })
    })
}
