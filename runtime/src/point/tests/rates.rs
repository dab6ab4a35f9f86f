//! Green–Naghdi rate, Kirchhoff tangent, principal stresses and the order of Abaqus, against definitions.

use super::differences::{check_slope, flat};
use super::*;
use crate::hand_written::ExtendedNeoHookean;
use crate::point::measures::{
    Measure, abaqus, cauchy, green_naghdi_tangent, jaumann_tangent, kirchhoff, kirchhoff_tangent,
    material_tangent, principal_cauchy, second_piola, spatial_tangent, voigt, von_mises,
};

const SHAPES: [[f64; 3]; 6] = [
    [1.7, 1.1, 0.6],
    [1.3, 1.3, 0.8],
    [1.0, 1.0, 1.0],
    [1.2, 1.2 - 1e-9, 0.8],
    [1.2, 0.9, -0.5],
    [0.5, 0.5, -0.2],
];

fn everywhere(check: impl Fn(&dyn Fn(&Matrix3<f64>) -> Point<f64>, &Matrix3<f64>)) {
    fn of(
        material: &impl Material,
        shapes: &[[f64; 3]],
        check: &impl Fn(&dyn Fn(&Matrix3<f64>) -> Point<f64>, &Matrix3<f64>),
    ) {
        let mut random = Random::new(111);
        for _ in 0..10 {
            for &stretches in shapes {
                let F = with_stretches(&mut random, stretches);
                check(&|F: &Matrix3<f64>| evaluate(material, F, Filter::None), &F);
            }
        }
    }
    of(&NeoHookean, &SHAPES[..4], &check);
    of(&SaintVenantKirchhoff, &SHAPES, &check);
    of(&RotatedLinear, &SHAPES, &check);
    of(&ExtendedNeoHookean { epsilon: 0.3 }, &SHAPES, &check);
}

/// Rᵀ τ R with the rotation R = U Vᵀ.
fn turned_back(point: &Point<f64>) -> Matrix3<f64> {
    let svd = point.decomposition();
    kirchhoff(&Svd { U: svd.V, ..svd }, point.tangent.blocks.gradient)
}

fn volume(point: &Point<f64>) -> f64 {
    point.stretches.iter().product()
}

#[test]
fn the_Green_Naghdi_tangent_is_the_slope_of_the_stress_turned_back() {
    everywhere(|at, F| {
        let mut random = Random::new((F[0][0].to_bits() >> 20) ^ 112);
        let point = at(F);
        let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
        let L = random.matrix().map(|row| row.map(|x| 0.3 * x));
        let strain = voigt::from_strain(&L);
        let c = green_naghdi_tangent(&svd, blocks);
        let J = volume(&point);
        let rate =
            voigt::to_stress(&c.map(|row| J * row.iter().zip(strain).map(|(c, e)| c * e).sum::<f64>()));
        let R = product(&svd.U, &transposed(&svd.V));
        let expected = product(&transposed(&R), &product(&rate, &R));
        let along = |h: f64| flat(&turned_back(&at(&moved(F, h, &product(&L, F)))));
        let rounding = 200.0 * f64::EPSILON * (norm(c.iter().flatten()) * J.abs()).max(10.0);
        check_slope(along, flat(&expected), rounding, &format!("Rᵀ τ R at {F:?}"));
    });
}

/// A measure by its name is the function of that name, bit by bit.
#[test]
fn measures_by_name_are_the_functions() {
    everywhere(|at, F| {
        let point = at(F);
        let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
        for measure in Measure::ALL {
            let (stress, tangent) = match measure {
                Measure::SecondPiola => (second_piola(&svd, blocks.gradient), material_tangent(&svd, blocks)),
                Measure::Kirchhoff => (kirchhoff(&svd, blocks.gradient), kirchhoff_tangent(&svd, blocks)),
                Measure::Cauchy => (cauchy(&svd, blocks.gradient), spatial_tangent(&svd, blocks)),
                Measure::Jaumann => (cauchy(&svd, blocks.gradient), jaumann_tangent(&svd, blocks)),
                Measure::GreenNaghdi => (cauchy(&svd, blocks.gradient), green_naghdi_tangent(&svd, blocks)),
            };
            assert_eq!(measure.stress(&svd, blocks.gradient), voigt::from_stress(&stress), "{measure:?}");
            assert_eq!(measure.tangent(&svd, blocks), tangent, "{measure:?}");
        }
    });
}

#[test]
fn the_rates_differ_by_their_spins() {
    everywhere(|at, F| {
        let point = at(F);
        let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
        let J = volume(&point);
        let [l1, .., l3] = point.stretches;
        let (c, jc) = (spatial_tangent(&svd, blocks), kirchhoff_tangent(&svd, blocks));
        let M = norm(point.tangent.to_matrix().iter().flatten()).max(1.0);
        let error = difference(&jc, &c.map(|row| row.map(|x| J * x)));
        // A division and a multiplication for each component.
        assert!(error <= 20.0 * f64::EPSILON * M * l1 * l1, "J c: {error:e} at {F:?}");
        // At equal stretches Green–Naghdi's and Jaumann's rates agree.
        if l1 - l3 == 0.0 {
            let found = difference(&green_naghdi_tangent(&svd, blocks), &jaumann_tangent(&svd, blocks));
            assert!(found <= 20.0 * f64::EPSILON * M, "{found:e}");
        }
    });
}

#[test]
fn principal_stresses_are_those_of_the_stress() {
    everywhere(|at, F| {
        let point = at(F);
        let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
        let sigma = cauchy(&svd, blocks.gradient);
        let principal = principal_cauchy(&svd, blocks.gradient);
        let [s1, s2, s3] = principal.values;
        assert!(s1 >= s2 && s2 >= s3);
        let Q = principal.directions;
        // Rotations to 20 u, and three products.
        let limit = 100.0 * f64::EPSILON * norm(&principal.values);
        for k in 0..3 {
            for i in 0..3 {
                let image: f64 = (0..3).map(|j| sigma[i][j] * Q[j][k]).sum();
                assert!((image - principal.values[k] * Q[i][k]).abs() <= limit, "{principal:?} at {F:?}");
            }
        }
        let det = Q[0][0] * (Q[1][1] * Q[2][2] - Q[1][2] * Q[2][1])
            - Q[0][1] * (Q[1][0] * Q[2][2] - Q[1][2] * Q[2][0])
            + Q[0][2] * (Q[1][0] * Q[2][1] - Q[1][1] * Q[2][0]);
        assert!((det - 1.0).abs() < 100.0 * f64::EPSILON);
        let squares = (s1 - s2).powi(2) + (s2 - s3).powi(2) + (s3 - s1).powi(2);
        let error = (von_mises(&svd, blocks) - (0.5 * squares).sqrt()).abs();
        let M = norm(point.tangent.to_matrix().iter().flatten()) * svd.stretches[0].powi(2) / volume(&point);
        assert!(error <= 20.0 * f64::EPSILON * M.abs().max(1.0), "{error:e} at {F:?}");
    });
}

#[test]
fn stresses_out_of_the_order_of_the_stretches_are_sorted() {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let svd = Svd { U: identity, stretches: [1.0, 1.0, 1.0], V: identity };
    for gradient in [[3.0, 2.0, 1.0], [1.0, 2.0, 3.0], [2.0, 3.0, 1.0], [1.0, 3.0, 2.0], [2.0, 1.0, 3.0]] {
        let principal = principal_cauchy(&svd, gradient);
        assert_eq!(principal.values, [3.0, 2.0, 1.0]);
        for k in 0..3 {
            let axis = (0..3).find(|&i| principal.directions[i][k] != 0.0).expect("a direction");
            assert_eq!(gradient[axis], principal.values[k]);
        }
    }
}

#[test]
fn a_pressure_takes_no_digits_from_von_Mises() {
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
    let strain = 2f64.powi(-10);
    let F = [[1.25 + strain, 0.0, 0.0], [0.0, 1.25, 0.0], [0.0, 0.0, 1.25]];
    let point = evaluate(&material, &F, Filter::None);
    // σ1 − σ2 = μ (λ1² − λ2²)/J, and both other differences are that or zero.
    let expected = strain * (2.5 + strain) / volume(&point);
    let found = von_mises(&point.decomposition(), &point.tangent.blocks);
    // The pressure of 1e9 would leave an error of 1e9 u; what it leaves is multiplied by the strain.
    let error = (found - expected).abs();
    assert!(error <= 20.0 * f64::EPSILON * 1e9 * strain, "{error:e}");
}

#[test]
fn Abaqus_gets_stress_and_tangent_in_its_order() {
    everywhere(|at, F| {
        let point = at(F);
        let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
        let (sigma, c) = (cauchy(&svd, blocks.gradient), jaumann_tangent(&svd, blocks));
        let (stress, ddsdde) = (abaqus::umat_stress(&sigma), abaqus::umat_tangent(&c));
        for (I, (i, j)) in abaqus::ABAQUS_ORDER.into_iter().enumerate() {
            assert_eq!(stress[I], sigma[i][j]);
            for (K, (k, l)) in abaqus::ABAQUS_ORDER.into_iter().enumerate() {
                assert_eq!(ddsdde[I][K], c[voigt::INDEX[i][j]][voigt::INDEX[k][l]]);
            }
        }
        let plane = abaqus::plane_stress_ddsdde(&ddsdde);
        for i in 0..3 {
            for j in 0..3 {
                assert_eq!(plane[i][j], plane[j][i]);
            }
        }
    });
}

#[test]
fn a_user_material_has_a_stress_and_its_status() {
    let F = [[1.0, 0.5, 0.0], [0.0, 1.2, 0.0], [0.1, 0.0, 1.0]];
    let point = evaluate(&NeoHookean, &F, Filter::None);
    let (svd, blocks) = (point.decomposition(), point.tangent.blocks);
    let umat = abaqus::respond(&NeoHookean, &F);
    assert_eq!(umat.stress, abaqus::umat_stress(&cauchy(&svd, blocks.gradient)));
    assert_eq!(umat.energy, evaluate_energy(&NeoHookean, &F).0);
    assert!(umat.status.is_clean());
    // Along turned axes: σ = R σ′ Rᵀ.
    let corotated = abaqus::respond_corotated(&NeoHookean, &F);
    let [s11, s22, s33, s12, s13, s23] = corotated.stress;
    let R = product(&svd.U, &transposed(&svd.V));
    let back = product(&R, &product(&[[s11, s12, s13], [s12, s22, s23], [s13, s23, s33]], &transposed(&R)));
    assert!(difference(&back, &cauchy(&svd, blocks.gradient)) <= 100.0 * f64::EPSILON * norm(&umat.stress));
    let inverted = [[1.0f64, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
    assert!(abaqus::respond(&NeoHookean, &inverted).status.refused);
    // A volume that vanishes leaves no Cauchy stress.
    assert!(abaqus::respond(&SaintVenantKirchhoff, &[[0.0f64; 3]; 3]).status.nonfinite);
}
