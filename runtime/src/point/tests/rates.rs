//! Green–Naghdi rate and Kirchhoff tangent, against definitions.

use super::differences::{check_slope, flat};
use super::*;
use crate::hand_written::ExtendedNeoHookean;
use crate::point::measures::{
    Measure, cauchy, green_naghdi_tangent, jaumann_tangent, kirchhoff, kirchhoff_tangent, material_tangent,
    second_piola, spatial_tangent, voigt,
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
