//! Stresses are the slopes of energies and contractions those of stresses, by fenris' own central
//! differences, for every energy of the catalogue; and values are those of fenris' own materials.

#![expect(non_snake_case, reason = "F, H, P as in the literature")]

use fenris::nalgebra::{DVector, DVectorView, DVectorViewMut, Matrix3, U3, Vector3};
use fenris_optimize::calculus::{approximate_gradient_fd, approximate_jacobian_fd};
use fenris_solid::HyperelasticMaterial;
use fenris_solid::materials::{LameParameters, NeoHookeanMaterial, StVKMaterial};
use piola::__private::random::Random;
use piola::Inversion;
use piola::interpreter::Interpreted;
use piola::material::MaterialError;
use piola::point::Filter;
use piola_declare::Energy;
use piola_fenris::PiolaMaterial;
use piola_materials::{DECLARATIONS, NeoHookean, StVenantKirchhoff};

/// Step of the differences, about ∛u: what they leave out, h² ∂³ψ, is some 10⁻¹⁰ of a modulus, and so is
/// rounding of energies, u ψ/h, for moderate strains.
const STEP: f64 = 1e-5;

/// Share of the largest entry of dP/dF by which slopes may differ: a hundred times both errors, for third
/// derivatives may be larger than second ones.
const TOLERANCE: f64 = 1e-8;

const LAME: LameParameters<f64> = LameParameters { mu: 3.0, lambda: 7.0 };

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

/// From displacements come the values from F: their difference is the rounding of F, times the slope.
#[test]
fn values_of_the_catalogue_are_slopes_and_those_from_displacements() {
    for (name, rubber) in materials() {
        let rest: f64 = rubber.compute_energy_density(&Matrix3::identity(), &None);
        for u_grad in displacements() {
            let F = u_grad.transpose() + Matrix3::identity();
            let mut flat = DVector::from_column_slice(F.as_slice());

            let P = rubber.compute_stress_tensor(&F, &None);
            let energy = |F: DVectorView<'_, f64>| rubber.compute_energy_density(&square(F), &None);
            let slopes = square(approximate_gradient_fd(energy, &mut flat, STEP).as_view());
            let stress = |F: DVectorView<'_, f64>, mut P: DVectorViewMut<'_, f64>| {
                P.copy_from_slice(rubber.compute_stress_tensor(&square(F), &None).as_slice());
            };
            let tangent = approximate_jacobian_fd(9, stress, &mut flat, STEP);
            let largest = tangent.amax();
            let tolerance = TOLERANCE * largest;
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

            let tolerance = 100.0 * f64::EPSILON * largest;
            let difference = (rubber.compute_stress_tensor_du(&u_grad, &None) - P).amax();
            assert!(difference <= tolerance, "{name}: stresses differ by {difference:e}");
            let change: f64 = rubber.compute_energy_density(&F, &None) - rest;
            let found: f64 = rubber.compute_energy_density_du(&u_grad, &None);
            let difference = (found - change).abs();
            // Where an energy is not zero at rest, its digits end with those of its value there.
            let tolerance = tolerance + 100.0 * f64::EPSILON * rest.abs();
            assert!(difference <= tolerance, "{name}: energies differ by {difference:e}");
        }
    }
}

/// The same energies, stresses and contractions as of fenris' materials, up to rounding.
fn check_values<M, N>(fenris: &M, piola: N)
where
    M: HyperelasticMaterial<f64, U3, Parameters = LameParameters<f64>>,
    N: piola::Material + Copy + 'static,
{
    let piola = PiolaMaterial { material: piola, filter: Filter::None };
    let mut random = Random::new(9);
    for _ in 0..1000 {
        let F = Matrix3::identity() + Matrix3::from_fn(|_, _| random.uniform(-0.3, 0.3));
        let [a, b] = [(); 2].map(|()| Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)));
        let energies = [piola.compute_energy_density(&F, &None), fenris.compute_energy_density(&F, &LAME)];
        let stresses = [piola.compute_stress_tensor(&F, &None), fenris.compute_stress_tensor(&F, &LAME)];
        let contractions = [
            piola.compute_stress_contraction(&F, &a, &b, &None),
            fenris.compute_stress_contraction(&F, &a, &b, &LAME),
        ];
        // Moduli of ten, strains of a third, and det F down to a fifth, by which fenris divides.
        let tolerance = 1e-12;
        assert!((energies[0] - energies[1]).abs() <= tolerance, "{energies:?} at {F}");
        assert!((stresses[0] - stresses[1]).amax() <= tolerance, "{stresses:?} at {F}");
        assert!((contractions[0] - contractions[1]).amax() <= tolerance, "{contractions:?} at {F}");
    }
}

#[test]
fn values_are_those_of_fenris() -> Result<(), MaterialError> {
    check_values(&NeoHookeanMaterial, NeoHookean::new(LAME.mu, LAME.lambda)?);
    check_values(&StVKMaterial, StVenantKirchhoff::new(LAME.mu, LAME.lambda)?);
    Ok(())
}

#[test]
fn outside_the_domain_energies_are_infinite_and_stresses_are_nan() -> Result<(), MaterialError> {
    let rubber = PiolaMaterial { material: NeoHookean::new(LAME.mu, LAME.lambda)?, filter: Filter::None };
    let inverted = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
    assert_eq!(rubber.compute_energy_density(&inverted, &None), f64::INFINITY);
    assert!(rubber.compute_stress_tensor(&inverted, &None).iter().all(|x| x.is_nan()));
    let axis = Vector3::x();
    assert!(rubber.compute_stress_contraction(&inverted, &axis, &axis, &None).iter().all(|x| x.is_nan()));
    Ok(())
}
