//! Energy and stress from the displacement gradient H = F − I, for bodies that hardly deform.
//!
//! # What is lost in F, and how it is kept
//!
//! Vibrations and stiff parts have strains of 10⁻⁶ and less. F = I + H then spends its digits on the
//! identity: u is the error of H in a diagonal entry, and a stress that is linear in H comes out with an
//! error of u ‖dP/dF‖ instead of u ‖P‖. No care taken after that brings the digits back, so the way from H to
//! P must not pass F.
//!
//! **Strain.** The identity cancels in the Green strain on paper, not in floating point:
//!
//! ```text
//! 2E = FᵀF − I = H + Hᵀ + HᵀH
//! ```
//!
//! Each entry of the sum H + Hᵀ has one rounding, relative to itself. HᵀH is of second order: it cancels
//! against H + Hᵀ where H is mostly rotation, by an angle θ say, and then leaves an error of u θ² where u θ =
//! u ‖H‖ is what rounding H itself would do.
//!
//! **Stretches.** FᵀF = V diag(λ²) Vᵀ, so the eigenvectors of 2E are the principal directions V, and its
//! eigenvalues qi = λi² − 1 give the principal Biot strains without subtracting:
//!
//! ```text
//! si = λi − 1 = (λi² − 1)/(λi + 1) = qi / (1 + √(1 + qi))
//! ```
//!
//! The eigenvector that lies apart from the others is found first, then one rotation the other two: V and q
//! are the exact ones of a matrix that differs from 2E by a few u ‖E‖.
//!
//! **Stress.** [`Material::gradient_at_strains`](crate::Material::gradient_at_strains)
//! gives ψi from the si. U need not be known, since U diag(λ) =
//! F V:
//!
//! ```text
//! P = U diag(ψi) Vᵀ = F V diag(ψi/λi) Vᵀ = S + H S,     S = V diag(ψi/λi) Vᵀ
//! ```
//!
//! with the second Piola stress S, which is proportional to the strain, and once more no identity added to H.
//! The signs and the order of the columns of V drop out of S. The quotients need λi > 0, away from zero: this
//! is for ‖H‖ < ½, where λ3 > ½ and λi is the positive root. Beyond, F has lost nothing worth keeping.
//!
//! **Energy.** ψ is of second order in the strain, while its terms are of first order and cancel: at a strain
//! of 10⁻⁸ no digit of ψ(F) is left. The work of the stress on the straight way from rest has no such terms:
//!
//! ```text
//! ψ(s) − ψ(0) = ∫₀¹ Σ si ψi(t s) dt
//! ```
//!
//! Two panels of Gauss's rule with eight points are exact to rounding where ψi is analytic at stretches from
//! ½ to 3/2: on t from ½ to 1, with the nearest singularity at t = 2, the error falls by (5 + √24)² = 98 for
//! each point, and 98⁻⁸ is 10⁻¹⁶. An energy that ends at a smaller strain than ½ keeps fewer digits as it
//! comes near that end.
//!
//! **Error.** A few u (‖P‖ + ‖dP/dF‖ ‖H‖), with a material whose ψi are accurate relative to the strains,
//! however small these are: no square of a strain can underflow where it matters. (The tangent needs none of
//! this; it changes by its own rounding when F does.)
//!
//! This module is independent of any particular material.

#![expect(non_snake_case, reason = "H, F, E, V, S, P as in the essay above")]

use super::deflation::{deflate, rotation};
use super::matrix::{column, dot, multiply_symmetric, multiply_transposed};
use super::{
    EnergyPoint, Evaluate, Filter, Matrix3, Point, StressPoint, energy_is_finite, evaluate, evaluate_energy,
    evaluate_stress, stress_is_finite,
};
use crate::lanes::{Mask, Real};
use crate::material::{PAIRS, Response};
use crate::status::Status;

/// Displacement gradient H = F − I, dimensionless: the deformation of bodies that hardly deform.
///
/// * The **stress** is accurate to u (‖P‖ + ‖dP/dF‖ ‖H‖) times a small number, whereas the one at F reaches u
///   ‖dP/dF‖.
/// * The **energy** is that above rest, ψ(I + H) − ψ(I). It is accurate to u (|ψ| + ‖P‖ ‖H‖) times a small
///   number, whereas the difference of two energies has an error of u times the largest term of ψ, which does
///   not vanish at rest.
/// * The **tangent** is that at F = I + H. So are stress and energy if ‖H‖ ≥ ½ in the Frobenius norm.
///
/// ```
/// use piola::point::{DisplacementGradient, evaluate_energy, evaluate_stress};
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let rubber = Rubber::new(1e6, 4e6)?;
/// // A strain of 3·10⁻¹⁴ along the first axis. Linear elasticity differs by as much as the strain.
/// let strain = 3e-14;
/// let expected = (2.0 * 1e6 + 4e6) * strain;
/// let H: [[f64; 3]; 3] = [[strain, 0.0, 0.0], [0.0; 3], [0.0; 3]];
/// let near = evaluate_stress(&rubber, DisplacementGradient(&H));
/// assert!(near.status.is_clean() && (near.stress[0][0] - expected).abs() < 1e-13 * expected);
/// let energy = evaluate_energy(&rubber, DisplacementGradient(&H)).energy;
/// assert!((energy - expected * strain / 2.0).abs() < 1e-13 * expected * strain);
///
/// let F = [[1.0 + strain, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert!((evaluate_stress(&rubber, &F).stress[0][0] - expected).abs() > 1e-3 * expected);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplacementGradient<'a, R>(pub &'a Matrix3<R>);

// Both ways are defined for each number of a batch by itself; only the work for a way that none takes is
// skipped, so that a number's result never depends on its neighbours.
impl<R: Real> Evaluate for DisplacementGradient<'_, R> {
    type Real = R;

    #[inline(always)]
    fn energy(self, material: &(impl Response<R> + ?Sized)) -> EnergyPoint<R> {
        let (one, Self(H)) = (R::splat(1.0), self);
        let is_small = is_small(H);
        let far = |F| {
            let EnergyPoint { energy, status } = evaluate_energy(material, F);
            EnergyPoint { energy: energy - material.energy([one; 3]), status }
        };
        if !is_small.any() {
            return far(&plus_identity(H));
        }
        let (strains, _) = principal_strains(H);
        let mut energy = R::splat(0.0);
        for start in [0.0, 0.5] {
            for [x, weight] in GAUSS {
                for t in [start + 0.25 * (1.0 - x), start + 0.25 * (1.0 + x)] {
                    let gradient = material.gradient_at_strains(strains.map(|s| s * R::splat(t)));
                    energy = dot(gradient, strains).mul_add(R::splat(0.25 * weight), energy);
                }
            }
        }
        let refused = !material.admits(strains.map(|s| one + s));
        let nonfinite = !energy_is_finite(strains, energy);
        let near = EnergyPoint { energy, status: Status { refused, nonfinite, ..Status::clean() } };
        if !(!is_small).any() {
            return near;
        }
        let far = far(&plus_identity(H));
        EnergyPoint {
            energy: R::select(is_small, near.energy, far.energy),
            status: (near.status & is_small) | (far.status & !is_small),
        }
    }

    #[inline(always)]
    fn stress(self, material: &(impl Response<R> + ?Sized)) -> StressPoint<R> {
        let Self(H) = self;
        let is_small = is_small(H);
        if !is_small.any() {
            return evaluate_stress(material, &plus_identity(H));
        }
        let near = stress_near_rest(material, H);
        if !(!is_small).any() {
            return near;
        }
        let far = evaluate_stress(material, &plus_identity(H));
        let entry = |i: usize, j: usize| R::select(is_small, near.stress[i][j], far.stress[i][j]);
        StressPoint {
            stress: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))),
            status: (near.status & is_small) | (far.status & !is_small),
        }
    }

    /// The status is the union of those of stress and tangent.
    #[inline(always)]
    fn point(self, material: &(impl Response<R> + ?Sized), filter: Filter) -> Point<R> {
        let point = evaluate(material, &plus_identity(self.0), filter);
        let StressPoint { stress, status } = evaluate_stress(material, self);
        Point { stress, status: point.status | status, ..point }
    }
}

/// Positive abscissae and their weights of Gauss's rule with eight points on −1 … 1.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_27],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// True if ‖H‖ < ½.
#[inline(always)]
fn is_small<R: Real>(H: &Matrix3<R>) -> R::Mask {
    let squared = H.iter().flatten().fold(R::splat(0.0), |sum, x| x.mul_add(*x, sum));
    squared.less(R::splat(0.25))
}

/// F = I + H.
#[inline(always)]
fn plus_identity<R: Real>(H: &Matrix3<R>) -> Matrix3<R> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { R::splat(1.0) + H[i][j] } else { H[i][j] }))
}

/// P = S + H S for ‖H‖ < ½; meaningless for larger H.
#[inline(always)]
fn stress_near_rest<R: Real>(material: &(impl Response<R> + ?Sized), H: &Matrix3<R>) -> StressPoint<R> {
    let one = R::splat(1.0);
    let (strains, V) = principal_strains(H);
    let stretches = strains.map(|s| one + s);
    let gradient = material.gradient_at_strains(strains);

    let weights: [R; 3] = std::array::from_fn(|k| gradient[k] / stretches[k]);
    let weighted: Matrix3<R> = V.map(|row| std::array::from_fn(|k| row[k] * weights[k]));
    let S = multiply_transposed(&weighted, &V);
    let P: Matrix3<R> = std::array::from_fn(|i| std::array::from_fn(|j| S[i][j] + dot(H[i], column(&S, j))));

    let refused = !material.admits(stretches);
    let nonfinite = !stress_is_finite(strains, &P);
    StressPoint { stress: P, status: Status { refused, nonfinite, ..Status::clean() } }
}

/// s1 ≥ s2 ≥ s3, exactly in floating point, and the directions V at rest as columns, for ‖H‖ < ½.
#[inline(always)]
fn principal_strains<R: Real>(H: &Matrix3<R>) -> ([R; 3], Matrix3<R>) {
    let one = R::splat(1.0);
    let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let twice_E = entries.map(|(i, j)| (H[i][j] + H[j][i]) + dot(column(H, i), column(H, j)));

    // A power of two, which is exact, keeps squares from underflow.
    let largest = twice_E.into_iter().fold(R::splat(0.0), |largest, x| x.abs().max(largest));
    let (scale, back) = largest.power_of_two_scale();
    let (q, mut V) = eigen(twice_E.map(|x| x * scale));
    let mut strains = q.map(|q| {
        let q = q * back;
        q / (one + (one + q).sqrt())
    });

    // The strains are put in order, not the eigenvalues: rounding after the sort could disturb it.
    for (i, j) in PAIRS {
        let swap = strains[i].less(strains[j]);
        let exchange = |pair: &mut [R; 3]| {
            (pair[i], pair[j]) = (R::select(swap, pair[j], pair[i]), R::select(swap, pair[i], pair[j]));
        };
        exchange(&mut strains);
        V.iter_mut().for_each(exchange);
    }
    (strains, V)
}

/// Eigenvalues, and eigenvectors as the columns of V, of a symmetric matrix of magnitude 1 to 2.
#[inline(always)]
fn eigen<R: Real>(A: [R; 6]) -> ([R; 3], Matrix3<R>) {
    let ([v, p, q], _) = deflate(A);
    let (Av, Ap, Aq) = (multiply_symmetric(A, v), multiply_symmetric(A, p), multiply_symmetric(A, q));
    let (app, apq, aqq) = (dot(p, Ap), dot(p, Aq), dot(q, Aq));
    let (c, s) = rotation(app - aqq, apq + apq);
    let eigenvalues = [
        dot(v, Av),
        c.mul_add(c.mul_add(app, s * apq), s * c.mul_add(apq, s * aqq)),
        c.mul_add(c.mul_add(aqq, -(s * apq)), -(s * c.mul_add(apq, -(s * app)))),
    ];
    let V = std::array::from_fn(|i| [v[i], c.mul_add(p[i], s * q[i]), c.mul_add(q[i], -(s * p[i]))]);
    (eigenvalues, V)
}
