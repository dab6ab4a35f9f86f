//! Stresses are the slopes of energies and contractions those of stresses, by fenris' own central
//! differences, for every energy of the catalogue.

#![expect(non_snake_case, reason = "F, H, P as in the literature")]

use fenris::nalgebra::{DMatrix, DMatrixViewMut, DVector, DVectorView, Matrix3, Vector3};
use fenris_optimize::calculus::{approximate_gradient_fd, approximate_jacobian_fd};
use fenris_solid::HyperelasticMaterial;
use piola::__private::random::Random;
use piola::Inversion;
use piola::interpreter::Interpreted;
use piola::point::Filter;
use piola_declare::Energy;
use piola_fenris::PiolaMaterial;
use piola_materials::DECLARATIONS;

/// Step of the differences, about ∛u: what they leave out, h² ∂³ψ, is some 10⁻¹⁰ of a modulus, and so is
/// rounding of energies, u ψ/h, for moderate strains.
const STEP: f64 = 1e-5;

/// Share of the largest entry of dP/dF by which slopes may differ: a hundred times both errors, for third
/// derivatives may be larger than second ones.
const TOLERANCE: f64 = 1e-8;

/// Every energy of the catalogue, with its typical parameters.
fn materials() -> impl Iterator<Item = (&'static str, PiolaMaterial<Interpreted>)> {
    DECLARATIONS.iter().map(|declaration| {
        let energy = Energy::from_rust(declaration.source).expect("a declaration of the catalogue");
        let material = energy.material(&energy.typical(), Inversion::Refuse).expect("typical parameters");
        (declaration.name, PiolaMaterial { material, filter: Filter::None })
    })
}

/// Transposed displacement gradients, strains and rotations of a tenth.
fn displacements() -> impl Iterator<Item = Matrix3<f64>> {
    let mut random = Random::new(7);
    (0..8).map(move |_| Matrix3::from_fn(|_, _| random.uniform(-0.1, 0.1)))
}

fn square(flat: DVectorView<'_, f64>) -> Matrix3<f64> {
    Matrix3::from_column_slice(flat.as_slice())
}

#[test]
fn stresses_and_contractions_of_the_catalogue_are_slopes() {
    for (name, rubber) in materials() {
        for u_grad in displacements() {
            let F = u_grad.transpose() + Matrix3::identity();
            let mut flat = DVector::from_column_slice(F.as_slice());

            let P = rubber.compute_stress_tensor(&F, &None);
            let energy = |F: DVectorView<'_, f64>| rubber.compute_energy_density(&square(F), &None);
            let slopes = square(approximate_gradient_fd(energy, &mut flat, STEP).as_view());
            let stress = |F: DVectorView<'_, f64>, mut P: fenris::nalgebra::DVectorViewMut<'_, f64>| {
                P.copy_from_slice(rubber.compute_stress_tensor(&square(F), &None).as_slice());
            };
            let tangent = approximate_jacobian_fd(9, stress, &mut flat, STEP);
            let tolerance = TOLERANCE * tangent.amax();
            assert!((P - slopes).amax() <= tolerance, "{name} at {F}: {P} and {slopes}");

            let (a, b) = (Vector3::new(-3.0, 4.0, -5.0), Vector3::new(-5.0, 2.0, 1.0));
            let found = rubber.compute_stress_contraction(&F, &a, &b, &None);
            // Entry (i, k) of a matrix of nalgebra is number i + 3k.
            let expected = Matrix3::from_fn(|i, j| {
                let terms = (0..9).map(|km| (km / 3, km % 3));
                terms.map(|(k, m)| a[k] * tangent[(i + 3 * k, j + 3 * m)] * b[m]).sum::<f64>()
            });
            let tolerance = a.norm() * b.norm() * tolerance;
            assert!((found - expected).amax() <= tolerance, "{name} at {F}: {found} and {expected}");
        }
    }
}

/// From displacements come the values from F: their difference is the rounding of F, times the slope.
#[test]
fn values_from_displacements_are_those_from_deformation_gradients() {
    for (name, rubber) in materials() {
        let rest: f64 = rubber.compute_energy_density(&Matrix3::identity(), &None);
        for u_grad in displacements() {
            let F = u_grad.transpose() + Matrix3::identity();
            let P = rubber.compute_stress_tensor(&F, &None);
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let tangents = axes.map(|a| axes.map(|b| rubber.compute_stress_contraction(&F, &a, &b, &None)));
            let largest = tangents.as_flattened().iter().fold(0.0, |largest, part| part.amax().max(largest));
            let tolerance = 100.0 * f64::EPSILON * largest;
            let difference = (rubber.compute_stress_tensor_du(&u_grad, &None) - P).amax();
            assert!(difference <= tolerance, "{name}: stresses differ by {difference:e}");
            let energy: f64 = rubber.compute_energy_density(&F, &None) - rest;
            let found: f64 = rubber.compute_energy_density_du(&u_grad, &None);
            let difference = (found - energy).abs();
            // Where an energy is not zero at rest, its digits end with those of its value there.
            let tolerance = tolerance + 100.0 * f64::EPSILON * rest.abs();
            assert!(difference <= tolerance, "{name}: energies differ by {difference:e}");
        }
    }
}

#[test]
fn many_contractions_are_those_of_each_pair_and_are_added() {
    let (_, rubber) = materials().next().expect("an energy");
    let mut random = Random::new(8);
    let [a, b] = [(); 2].map(|()| DVector::from_fn(12, |_, _| random.uniform(-1.0, 1.0)));
    for u_grad in displacements() {
        let F = u_grad.transpose() + Matrix3::identity();
        let mut outputs = [(); 2].map(|()| DMatrix::repeat(12, 12, 3.0));
        let [from_F, from_displacement] = outputs.each_mut().map(DMatrixViewMut::from);
        rubber.accumulate_stress_contractions_into(from_F, 2.0, &F, a.as_view(), b.as_view(), &None);
        let (first, second) = (a.as_view(), b.as_view());
        rubber.accumulate_stress_contractions_du_into(from_displacement, 2.0, &u_grad, first, second, &None);
        assert_eq!(outputs[0], outputs[1]);
        for J in 0..4 {
            for I in 0..=J {
                let [a, b] = [(&a, I), (&b, J)].map(|(all, n)| all.fixed_rows::<3>(3 * n).into_owned());
                let pair = rubber.compute_stress_contraction(&F, &a, &b, &None) * 2.0;
                let found = outputs[0].fixed_view::<3, 3>(3 * I, 3 * J).into_owned();
                // The factor 2 is exact; the sum with 3 rounds.
                assert_eq!(found, pair.add_scalar(3.0));
            }
        }
    }
}
