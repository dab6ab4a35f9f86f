//! The split into shape and volume against P, dP/dF and slopes.

use super::differences::{check_slope, flat};
use super::*;
use crate::hand_written::ExtendedNeoHookean;
use crate::point::split::{Split, split, split_at};

/// Deformations with volume, far apart, equal, nearly equal; the last two inverted.
const SHAPES: [[f64; 3]; 7] = [
    [1.7, 1.1, 0.6],
    [1.3, 1.3, 0.8],
    [1.0, 1.0, 1.0],
    [1.2, 1.2 - 1e-9, 0.8],
    [1.0 + 1e-7, 1.0, 1.0 - 1e-13],
    [1.2, 0.9, -0.5],
    [0.6, 0.5, -0.3],
];

fn everywhere(
    check: impl Fn(&dyn Fn(&Matrix3<f64>, Option<f64>) -> (Split<f64>, Point<f64>), &Matrix3<f64>),
) {
    fn of(
        material: &impl Material,
        shapes: &[[f64; 3]],
        check: &impl Fn(&dyn Fn(&Matrix3<f64>, Option<f64>) -> (Split<f64>, Point<f64>), &Matrix3<f64>),
    ) {
        let mut random = Random::new(101);
        for _ in 0..10 {
            for &stretches in shapes {
                let F = with_stretches(&mut random, stretches);
                let at = |F: &Matrix3<f64>, theta: Option<f64>| {
                    let split = match theta {
                        Some(theta) => split_at(material, F, theta),
                        None => split(material, F),
                    };
                    (split, evaluate(material, F, Filter::None))
                };
                check(&at, &F);
            }
        }
    }
    of(&NeoHookean, &SHAPES[..5], &check);
    of(&SaintVenantKirchhoff, &SHAPES, &check);
    of(&RotatedLinear, &SHAPES, &check);
    of(&ExtendedNeoHookean { epsilon: 0.2 }, &SHAPES, &check);
}

fn contract(A: &Matrix3<f64>, B: &Matrix3<f64>) -> f64 {
    flat(A).iter().zip(flat(B)).map(|(a, b)| a * b).sum()
}

fn volume(split: &Split<f64>) -> f64 {
    split.decomposition.stretches.iter().product()
}

#[test]
fn the_parts_add_up_to_stress_and_tangent() {
    everywhere(|at, F| {
        let (split, point) = at(F, None);
        assert!(split.status.is_clean());
        let dP_dF = point.tangent.to_matrix();
        let J = volume(&split);
        let [l1, .., l3] = point.stretches;
        // Every part is at most M (λ1/λ3)²; some fifty roundings and two decompositions' frames.
        let limit = 200.0 * f64::EPSILON * norm(dP_dF.iter().flatten()).max(5.0) * (l1 / l3).powi(2);

        let tau = product(&point.stress, &transposed(F));
        let p = (tau[0][0] + tau[1][1] + tau[2][2]) / (3.0 * J);
        assert!((split.mean_stress - p).abs() <= limit / J.abs(), "p at {F:?}");
        assert!(
            contract(&split.stress(), F).abs() <= limit
                && contract(&split.coupling(), F).abs() <= limit / J.abs()
        );
        let deviator =
            std::array::from_fn(|i| std::array::from_fn(|j| tau[i][j] / J - if i == j { p } else { 0.0 }));
        assert!(difference(&split.deviator(), &deviator) <= limit / J.abs(), "deviator at {F:?}");

        let (P, tangent) = split.with_pressure(split.mean_stress);
        assert!(difference(&P, &point.stress) <= limit, "P at {F:?}");
        let (cof, C) = (flat(&split.cofactor()), flat(&split.coupling()));
        let at_fixed_volume = tangent.to_matrix();
        let sum: [[f64; 9]; 9] = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let dyads = C[row] * cof[column] + cof[row] * C[column];
                at_fixed_volume[row][column] + dyads + split.bulk * cof[row] * cof[column]
            })
        });
        let error = difference(&sum, &dP_dF);
        assert!(error <= limit, "dP/dF: {error:e} above {limit:e} at {F:?}");
        // With its own volume an F-bar point is a point.
        assert!(difference(&split.f_bar().stress, &point.stress) <= limit, "Pᶠ at {F:?}");
    });
}

#[test]
fn all_are_slopes_of_the_energy_at_shape_and_volume() {
    everywhere(|at, F| {
        let mut random = Random::new((F[0][0].to_bits() >> 20) ^ 102);
        let dF = random.matrix().map(|row| row.map(|x| 0.2 * x));
        let theta = volume(&at(F, None).0) * random.uniform(0.8, 1.25);
        let split = at(F, Some(theta)).0;
        assert!(split.status.is_clean());
        let along = |h: f64| at(&moved(F, h, &dF), Some(theta)).0;
        // A unit of h changes θ by a fifth of itself.
        let width = 0.2 * theta;
        let wider = |h: f64| at(F, Some(theta + h * width)).0;
        let what = |which: &str| format!("{which} at {F:?} along {dF:?}, θ = {theta}");
        let size = norm(split.tangent().to_matrix().iter().flatten()) + split.bulk.abs() + 10.0;
        let rounding = 200.0 * f64::EPSILON * size;
        let times = |A: &Matrix3<f64>| contract(A, &dF);

        check_slope(|h| [along(h).energy], [times(&split.stress())], rounding, &what("A"));
        check_slope(|h| [wider(h).energy], [split.mean_stress * width], rounding, &what("p"));
        check_slope(|h| [wider(h).mean_stress], [split.bulk * width], rounding, &what("∂p/∂θ"));
        check_slope(|h| [along(h).mean_stress], [times(&split.coupling())], rounding, &what("∂p/∂F"));
        let C = flat(&split.coupling()).map(|c| c * width);
        check_slope(|h| flat(&wider(h).stress()), C, rounding, &what("∂A/∂θ"));
        let dA = flat(&split.tangent().apply(&dF));
        check_slope(|h| flat(&along(h).stress()), dA, rounding, &what("∂A/∂F"));
        let (_, tangent) = split.with_pressure(0.7);
        let dA = flat(&tangent.apply(&dF));
        check_slope(|h| flat(&along(h).with_pressure(0.7).0), dA, rounding, &what("A + p cof F"));

        let f_bar = split.f_bar();
        let dP = f_bar.tangent.map(|row| row.iter().zip(flat(&dF)).map(|(t, f)| t * f).sum());
        check_slope(|h| flat(&along(h).f_bar().stress), dP, rounding, &what("∂Pᶠ/∂F"));
        let slope = flat(&f_bar.slope).map(|x| x * width);
        check_slope(|h| flat(&wider(h).f_bar().stress), slope, rounding, &what("∂Pᶠ/∂θ"));
    });
}

#[test]
fn the_stress_of_an_F_bar_point_is_the_cauchy_stress_of_its_shape() {
    everywhere(|at, F| {
        let J = volume(&at(F, None).0);
        let theta = 1.1 * J;
        let scale = (theta / J).cbrt();
        let scaled = F.map(|row| row.map(|x| scale * x));
        // σ(F̃) = P̃ F̃ᵀ/θ, and Pᶠ Fᵀ = J σ.
        let tau = product(&at(&scaled, None).1.stress, &transposed(&scaled));
        let found = product(&at(F, Some(theta)).0.f_bar().stress, &transposed(F));
        let expected = tau.map(|row| row.map(|x| x / scale.powi(3)));
        assert!(difference(&found, &expected) <= 1000.0 * f64::EPSILON * 10.0, "{F:?}");
    });
}

#[test]
fn a_pressure_takes_no_digits_from_the_distortion() {
    /// μ/2 (I1 − 3) − μ (J − 1) + K/2 (J − 1)².
    #[crate::material(domain(J > 0.0))]
    fn Polynomial(
        [l1, l2, l3]: [f64; 3],
        /** Pa. */
        mu: f64,
        /** Pa. */
        bulk: f64,
    ) -> f64 {
        mu / 2.0 * (I1 - 3.0) - mu * (J - 1.0) + bulk / 2.0 * (J - 1.0).powi(2)
    }
    let material = Polynomial::new(1.0, 1e9).expect("parameters");
    let strain = 1e-3;
    let l = [1.1 + strain, 1.1, 1.1 - strain];
    let F: Matrix3<f64> = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { l[i] } else { 0.0 }));
    // A1 λ1 = λ1² − Σλ²/3, μ being 1. The pressure is 3e8, and the strain is what rounding leaves of it.
    let expected = l[0] * l[0] - (l[0] * l[0] + l[1] * l[1] + l[2] * l[2]) / 3.0;
    let found = split(&material, &F).stress()[0][0] * l[0];
    let pressure = 1e9 * (l[0] * l[1] * l[2] - 1.0);
    assert!((found - expected).abs() <= 20.0 * f64::EPSILON * pressure * strain, "{found:e} {expected:e}");
}

#[test]
fn what_has_no_shape_says_so() {
    let identity = [[1.0f64, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert!(split_at(&SaintVenantKirchhoff, &identity, -1.0).status.refused);
    assert!(split(&NeoHookean, &[[1.0f64, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).status.refused);
    assert!(!split(&SaintVenantKirchhoff, &[[0.0f64; 3]; 3]).status.is_clean());
    assert!(split(&SaintVenantKirchhoff, &[[f64::NAN; 3]; 3]).status.nonfinite);
    assert!(split_at(&SaintVenantKirchhoff, &identity, f64::NAN).status.nonfinite);
}
