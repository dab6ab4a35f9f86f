//! Measures of stress and tangent against their definitions in F, P and dP/dF, written out over indices.

use super::*;
use crate::convert::{from_nalgebra, to_nalgebra};
use crate::hand_written::ExtendedNeoHookean;
use crate::material::Material;
use crate::point::measures::Measure::{self, Cauchy, GreenNaghdi, Jaumann, Kirchhoff, SecondPiola};
use crate::point::measures::voigt::{self, INDEX, Matrix6, ORDER};

const MU: f64 = 1.0;
const LAMBDA: f64 = 1.5;

/// Deformations whose stretches are far apart, equal, and nearly equal, two of them inverted.
const MODERATE: [[f64; 3]; 7] = [
    [1.7, 1.1, 0.6],
    [1.3, 1.3, 0.8],
    [1.0, 1.0, 1.0],
    [1.2, 1.2 - 1e-9, 0.8],
    [1.0 + 1e-7, 1.0, 1.0 - 1e-13],
    [1.2, 0.9, -0.5],
    [0.5, 0.5, -0.2],
];

/// Squashed, drawn out to a thread, and close to the pole where two stretches are opposite.
const EXTREME: [[f64; 3]; 3] = [[3.0, 0.5, 0.01], [1.0, 0.02, 0.02 - 1e-12], [1.1, 0.6, -0.6 + 1e-6]];

/// Error of a stress in units of u M times the stretches that a test names.
///
/// The decomposition is exact for an F that differs by 20 u λ1, and three principal values up to M have the
/// norm √3 M; the definition rounds a few times in addition.
const STRESS: f64 = 40.0;

/// The same of a tangent: four factors from U or V, which are orthogonal to 20 u, and sums of 9 and 81
/// products.
const TANGENT: f64 = 100.0;

/// The same of a tangent known on paper: half a dozen roundings for each principal component, ten for the
/// sums of them, and the deviation of a frame from orthogonality, a few u.
const ISOTROPY: f64 = 20.0;

/// Stress and tangent of a measure, in double precision.
fn measured<R: Real + Into<f64>>(
    measure: Measure,
    svd: &Svd<R>,
    blocks: &Blocks<R>,
) -> (Matrix3<f64>, Matrix6<f64>) {
    let stress = voigt::to_stress(&measure.stress(svd, blocks.gradient));
    let wide = stress.map(|row| row.map(Into::into));
    (wide, measure.tangent(svd, blocks).map(|row| row.map(Into::into)))
}

/// All numbers of a point and of its measures, for comparisons bit by bit.
pub(super) fn every_number<R: Real>(point: &Point<R>) -> Vec<R> {
    let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
    let mut numbers = [point.stress.as_flattened(), &point.stretches].concat();
    numbers.extend_from_slice(point.tangent.to_matrix().as_flattened());
    for measure in Measure::ALL {
        numbers.extend(measure.stress(&svd, blocks.gradient));
        numbers.extend_from_slice(measure.tangent(&svd, blocks).as_flattened());
    }
    numbers
}

/// A point in double precision, and its measures in precision R from the same decomposition and blocks.
///
/// So the measures are judged and not the decomposition, whose error they would magnify.
struct Sample {
    F: Matrix3<f64>,
    point: Point<f64>,
    /// In the order of [`Measure::ALL`].
    measures: [(Matrix3<f64>, Matrix6<f64>); 5],
    /// u of R times the largest of |ψij|, |ψi/λi|, |D⁻| and |D⁺|.
    uM: f64,
    /// λ1.
    largest: f64,
    /// |λ3|.
    smallest: f64,
    /// λ1 λ2 λ3: the determinant of F would cancel.
    J: f64,
}

impl Sample {
    fn new<R: Real + Into<f64>>(material: &impl Material, F: Matrix3<f64>) -> Self {
        let point = evaluate(material, &F, Filter::None);
        let Svd { U, stretches, V } = point.decomposition();
        let Blocks { gradient, hessian, flip, twist } = point.tangent.blocks;
        let narrow = |A: Matrix3<f64>| A.map(|row| row.map(R::splat));
        let svd = Svd { U: narrow(U), stretches: stretches.map(R::splat), V: narrow(V) };
        let blocks = convert(&point.tangent.blocks, R::splat);
        let quotients = gradient.into_iter().zip(stretches).map(|(g, l)| g / l);
        let all = hessian.into_iter().chain(flip).chain(twist).chain(quotients);
        Self {
            F,
            point,
            measures: Measure::ALL.map(|measure| measured(measure, &svd, &blocks)),
            uM: R::UNIT_ROUNDOFF * all.fold(0.0, |largest: f64, x| largest.max(x.abs())),
            largest: stretches[0],
            smallest: stretches[2].abs(),
            J: stretches[0] * stretches[1] * stretches[2],
        }
    }

    fn stress(&self, measure: Measure) -> &Matrix3<f64> {
        &self.measures[measure as usize].0
    }

    fn tangent(&self, measure: Measure) -> &Matrix6<f64> {
        &self.measures[measure as usize].1
    }
}

/// Runs a check on samples of all materials, wherever each is defined, in both precisions.
fn everywhere(check: impl Fn(&Sample)) {
    fn of<R: Real + Into<f64>>(material: &impl Material, check: impl Fn(&Sample)) {
        let mut random = Random::new(71);
        for _ in 0..20 {
            for stretches in MODERATE.into_iter().chain(EXTREME) {
                if material.admits(stretches) {
                    check(&Sample::new::<R>(material, with_stretches(&mut random, stretches)));
                }
            }
        }
    }
    fn both(material: &impl Material, check: impl Fn(&Sample)) {
        of::<f64>(material, &check);
        of::<f32>(material, &check);
    }
    both(&SaintVenantKirchhoff, &check);
    both(&NeoHookean, &check);
    both(&RotatedLinear, &check);
    both(&ExtendedNeoHookean { epsilon: 0.3 }, &check);
}

#[track_caller]
fn check<const N: usize>(
    found: &[[f64; N]; N],
    expected: &[[f64; N]; N],
    limit: f64,
    what: &str,
    F: &Matrix3<f64>,
) {
    let error = difference(found, expected);
    assert!(error <= limit, "{what}: error {error:e}, expected at most {limit:e} at {F:?}");
}

fn delta(i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j))
}

/// The 6×6 matrix of a tensor given by its components.
fn tangent_of(component: impl Fn([usize; 4]) -> f64) -> Matrix6<f64> {
    ORDER.map(|(i, j)| ORDER.map(|(k, l)| component([i, j, k, l])))
}

fn component(C: &Matrix6<f64>, [i, j, k, l]: [usize; 4]) -> f64 {
    C[INDEX[i][j]][INDEX[k][l]]
}

/// f summed over two indices.
fn sum(f: impl Fn(usize, usize) -> f64) -> f64 {
    (0..9).map(|n| f(n / 3, n % 3)).sum()
}

/// A tangent applied to a symmetric strain.
fn times(C: &Matrix6<f64>, strain: &Matrix3<f64>) -> Matrix3<f64> {
    let strain = voigt::from_strain(strain);
    voigt::to_stress(&C.map(|row| row.iter().zip(strain).map(|(c, e)| c * e).sum()))
}

/// The symmetric part.
fn symmetric(A: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (A[i][j] + A[j][i])))
}

/// dP = dF S + F (dS/dE : sym Fᵀ dF), index by index.
fn geometric_and_material(F: &Matrix3<f64>, S: &Matrix3<f64>, dS_dE: &Matrix6<f64>) -> [[f64; 9]; 9] {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let ([i, q], [k, s]) = ([row / 3, row % 3], [column / 3, column % 3]);
            delta(i, k) * S[q][s] + sum(|p, r| F[i][p] * F[k][r] * component(dS_dE, [p, q, r, s]))
        })
    })
}

/// S = F⁻¹ P, which with its tangent gives dP/dF back; τ = P Fᵀ, σ = τ/J and their tangents, which are dP/dF
/// less the turning stress.
#[test]
fn measures_are_those_of_their_definitions() {
    everywhere(|sample| {
        let Sample { F, point, uM, largest, smallest, J, measures } = sample;
        let (P, dP_dF) = (&point.stress, point.tangent.to_matrix());
        let S = to_nalgebra(F).lu().solve(&to_nalgebra(P)).expect("F has volume");
        check(sample.stress(SecondPiola), &from_nalgebra(&S), STRESS * uM * largest / smallest, "S", F);
        let found = geometric_and_material(F, sample.stress(SecondPiola), sample.tangent(SecondPiola));
        check(&found, &dP_dF, TANGENT * uM * (largest / smallest).powi(2), "dP/dF", F);

        let tau = product(P, &transposed(F));
        let sigma = tau.map(|row| row.map(|x| x / J));
        check(sample.stress(Kirchhoff), &tau, STRESS * uM * largest * largest, "τ", F);
        check(sample.stress(Cauchy), &sigma, STRESS * uM * largest * largest / J.abs(), "σ", F);
        // The product rule for τ = P Fᵀ along dF = L F: F F dP/dF = J c + δ τ.
        let c = |[i, j, k, l]: [usize; 4]| {
            sum(|q, s| F[j][q] * F[l][s] * dP_dF[3 * i + q][3 * k + s]) / J - delta(i, k) * sigma[j][l]
        };
        let limit = TANGENT * uM * largest * largest / J.abs();
        check(sample.tangent(Cauchy), &tangent_of(c), limit, "c", F);
        check(sample.tangent(Kirchhoff), &tangent_of(|place| J * c(place)), limit * J.abs(), "J c", F);
        let c_jaumann = tangent_of(|[i, j, k, l]| {
            let turning = delta(i, k) * sigma[j][l]
                + delta(i, l) * sigma[j][k]
                + delta(j, k) * sigma[i][l]
                + delta(j, l) * sigma[i][k];
            c([i, j, k, l]) + 0.5 * turning
        });
        check(sample.tangent(Jaumann), &c_jaumann, limit, "c°", F);

        // All tangents are symmetric to the bit.
        for (_, C) in measures {
            assert!((0..36).all(|n| C[n / 6][n % 6].to_bits() == C[n % 6][n / 6].to_bits()), "{C:?}");
        }
    });
}

/// Checks that a central difference, (f(h) − f(−h))/2h, tends to `derivative` as h² does, with a floor of
/// `rounding`/h from the rounding of f.
#[track_caller]
fn check_slope<const N: usize>(f: impl Fn(f64) -> [f64; N], derivative: [f64; N], rounding: f64, what: &str) {
    let error = |h: f64| {
        let (ahead, behind) = (f(h), f(-h));
        let errors: [f64; N] = std::array::from_fn(|k| (ahead[k] - behind[k]) / (2.0 * h) - derivative[k]);
        norm(&errors)
    };
    // The third derivative bounds the error at the first step; each step is a quarter of the last one, so
    // 1/16 is due.
    let mut bound = error(2f64.powi(-7));
    for step in 0..8 {
        let h = 2f64.powi(-9 - 2 * step);
        bound /= 12.0;
        let limit = bound.max(rounding / h);
        assert!(error(h) <= limit, "{what}: error {:e} at h = {h:e}, expected at most {limit:e}", error(h));
    }
}

fn flat(A: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|k| A[k / 3][k % 3])
}

/// Rᵀ τ R, with the rotation R of the polar decomposition, changes by c★ alone.
fn check_turned_back(material: &impl Material, stretches: [f64; 3], random: &mut Random) {
    let F = with_stretches(random, stretches);
    let point = evaluate(material, &F, Filter::None);
    let Svd { U, V, .. } = point.decomposition();
    let c = GreenNaghdi.tangent(&point.decomposition(), &point.tangent.blocks);
    let J: f64 = stretches.iter().product();
    let L = random.matrix().map(|row| row.map(|x| 0.3 * x));
    let rate = times(&c, &symmetric(&L)).map(|row| row.map(|x| J * x));
    let R = product(&U, &transposed(&V));
    let expected = product(&transposed(&R), &product(&rate, &R));
    let along = |h: f64| {
        let point = evaluate(material, &moved(&F, h, &product(&L, &F)), Filter::None);
        let svd = point.decomposition();
        let turned = Svd { U: svd.V, ..svd };
        flat(&measured(Kirchhoff, &turned, &point.tangent.blocks).0)
    };
    let rounding = 200.0 * f64::EPSILON * (norm(c.iter().flatten()) * J.abs()).max(10.0);
    check_slope(along, flat(&expected), rounding, &format!("Rᵀ τ R at {F:?}"));
}

#[test]
fn the_Green_Naghdi_tangent_is_the_slope_of_the_stress_turned_back() {
    let mut random = Random::new(72);
    for _ in 0..10 {
        for stretches in MODERATE {
            check_turned_back(&SaintVenantKirchhoff, stretches, &mut random);
            check_turned_back(&RotatedLinear, stretches, &mut random);
            check_turned_back(&ExtendedNeoHookean { epsilon: 0.3 }, stretches, &mut random);
        }
        for stretches in MODERATE.into_iter().filter(|&l| Material::admits(&NeoHookean, l)) {
            check_turned_back(&NeoHookean, stretches, &mut random);
        }
    }
}

/// Hooke's law.
fn isotropic(lambda: f64, mu: f64) -> Matrix6<f64> {
    tangent_of(|[i, j, k, l]| {
        lambda * delta(i, j) * delta(k, l) + mu * (delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k))
    })
}

#[test]
fn two_energies_have_tangents_by_Hooke() {
    fn of<R: Real + Into<f64>>() {
        let mut random = Random::new(73);
        for stretches in MODERATE.into_iter().chain(EXTREME) {
            let F = with_stretches(&mut random, stretches);
            // S = 2μ E + λ tr E.
            let sample = Sample::new::<R>(&SaintVenantKirchhoff, F);
            let limit = ISOTROPY * sample.uM / (sample.smallest * sample.smallest);
            check(sample.tangent(SecondPiola), &isotropic(LAMBDA, MU), limit, "StVK", &F);
            // From the decomposition on in R: where the stretches are wrong, so are both sides of the
            // division.
            let narrow: Matrix3<R> = F.map(|row| row.map(R::splat));
            let point = evaluate(&SaintVenantKirchhoff, &narrow, Filter::None);
            let (_, dS_dE) = measured(SecondPiola, &point.decomposition(), &point.tangent.blocks);
            check(&dS_dE, &isotropic(LAMBDA, MU), limit, "StVK", &F);
        }
        for stretches in MODERATE.into_iter().chain(EXTREME).filter(|&l| Material::admits(&NeoHookean, l)) {
            let F = with_stretches(&mut random, stretches);
            // τ = μ (FFᵀ − I) + λ ln J I.
            let sample = Sample::new::<R>(&NeoHookean, F);
            let Sample { uM, largest, J, .. } = sample;
            let expected = isotropic(LAMBDA / J, (MU - LAMBDA * J.ln()) / J);
            let limit = ISOTROPY * uM * largest * largest / J;
            check(sample.tangent(Cauchy), &expected, limit, "neo-Hookean", &F);
        }
    }
    of::<f64>();
    of::<f32>();
}

#[test]
fn the_point_decomposes_its_deformation() {
    let mut random = Random::new(74);
    for stretches in STRETCHES {
        let F = with_stretches(&mut random, stretches);
        let found = evaluate(&SaintVenantKirchhoff, &F, Filter::Clamp).decomposition();
        assert_eq!(found, svd(&F));
    }
}

#[test]
fn without_volume_only_the_Kirchhoff_stress_is_finite() {
    for stretches in [[1.1, 0.7, 0.0], [1.1, 0.0, 0.0], [0.0; 3]] {
        let point = evaluate(&RotatedLinear, &diagonal(stretches), Filter::None);
        for measure in Measure::ALL {
            let (stress, tangent) = measured(measure, &point.decomposition(), &point.tangent.blocks);
            let are_finite = [stress.as_flattened(), tangent.as_flattened()]
                .map(|numbers| numbers.iter().all(|x| x.is_finite()));
            assert_eq!(are_finite, [measure == Kirchhoff; 2], "{measure:?} of {stretches:?}");
        }
    }
    let numbers = every_number(&evaluate(&RotatedLinear, &[[f64::NAN; 3]; 3], Filter::None));
    assert!(numbers.into_iter().all(f64::is_nan));
}

/// Statement of the essay on filters: a filtered dP/dF does not belong to any dS/dE, an unfiltered one does.
#[test]
fn a_filtered_tangent_has_no_material_part() {
    let mut random = Random::new(75);
    let F = with_stretches(&mut random, [0.8, 0.7, 0.6]);
    let error = |filter: Filter| {
        let point = evaluate(&SaintVenantKirchhoff, &F, filter);
        let (S, dS_dE) = measured(SecondPiola, &point.decomposition(), &point.tangent.blocks);
        let found = geometric_and_material(&F, &S, &dS_dE);
        difference(&found, &point.tangent.to_matrix()) / norm(found.iter().flatten())
    };
    assert!(error(Filter::None) < 100.0 * f64::EPSILON);
    assert!(error(Filter::Clamp) > 0.1 && error(Filter::Absolute) > 0.1);
}

#[test]
fn six_numbers_are_in_the_order_of_Voigt_with_shears_of_strains_doubled() {
    let A = [[11.0, 12.0, 13.0], [12.0, 22.0, 23.0], [13.0, 23.0, 33.0]];
    let six = [11.0, 22.0, 33.0, 23.0, 13.0, 12.0];
    assert_eq!(voigt::to_stress(&six), A);
    assert_eq!(voigt::from_strain(&A), [11.0, 22.0, 33.0, 46.0, 26.0, 24.0]);
    for i in 0..3 {
        for j in 0..3 {
            assert_eq!(ORDER[INDEX[i][j]], (i.min(j), i.max(j)));
        }
    }
    // Work: 11² + 22² + 33² + 2 (23² + 13² + 12²).
    let work: f64 = six.iter().zip(voigt::from_strain(&A)).map(|(s, e)| s * e).sum();
    assert_eq!(work, sum(|i, j| A[i][j] * A[i][j]));
    let skewed = [[1.0, 3.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(voigt::from_strain(&skewed)[5], 4.0);
}
