//! Helpers shared by the tests of the baselines, and the test of methods for particular energies.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::point::{Filter, Matrix3, evaluate, svd};
use piola::{Material, Real};
use piola_materials::{NeoHookean, RotatedLinear, StVenantKirchhoff};

use crate::{direct, invariants, polar};

/// All stretches well apart, 1.4, 1.2 and 0.7, with rotations on both sides.
pub(crate) const SHEARED: Matrix3<f64> = [[1.3, 0.2, -0.1], [0.0, 0.8, 0.3], [0.4, -0.2, 1.1]];

/// The rest state.
pub(crate) const IDENTITY: Matrix3<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Matrix in another format.
pub(crate) fn convert<R: Real>(matrix: &Matrix3<f64>) -> Matrix3<R> {
    matrix.map(|row| row.map(R::splat))
}

/// P and dP/dF by this library.
pub(crate) fn exact<R: Real>(
    material: &impl Material,
    deformation: &Matrix3<R>,
) -> (Matrix3<R>, [[R; 9]; 9]) {
    let point = evaluate(material, deformation, Filter::None);
    (point.stress, point.tangent.to_matrix())
}

/// ‖found − expected‖ / ‖expected‖, Frobenius norms.
pub(crate) fn error<R: Real + Into<f64>, const N: usize>(found: &[[R; N]; N], expected: &[[R; N]; N]) -> f64 {
    distance(found, expected) / norm(expected)
}

/// ‖ΔP‖ and ‖ΔdP/dF‖ of a method in a format, in units of u ‖dP/dF‖, as at rest P is zero and known to
/// rounding of the moduli.
pub(crate) fn errors_of<R: Real + Into<f64>>(
    method: impl Fn(&Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]),
    material: &impl Material,
    deformation: &Matrix3<f64>,
) -> [f64; 2] {
    let deformation = convert::<R>(deformation);
    let (stress, tangent) = method(&deformation);
    let (exact_stress, exact_tangent) = exact(material, &deformation);
    let distances = [distance(&stress, &exact_stress), distance(&tangent, &exact_tangent)];
    distances.map(|distance| distance / norm(&exact_tangent) / R::UNIT_ROUNDOFF)
}

fn distance<R: Real + Into<f64>, const N: usize>(a: &[[R; N]; N], b: &[[R; N]; N]) -> f64 {
    let squares = a.as_flattened().iter().zip(b.as_flattened()).map(|(&x, &y)| (x.into() - y.into()).powi(2));
    squares.sum::<f64>().sqrt()
}

fn norm<R: Real + Into<f64>, const N: usize>(matrix: &[[R; N]; N]) -> f64 {
    distance(matrix, &[[R::splat(0.0); N]; N])
}

#[test]
fn particular_energies_are_those_of_the_catalogue() {
    compare::<f64>();
    compare::<f32>();
}

fn compare<R: Real + Into<f64>>() {
    let material = StVenantKirchhoff::new(1.0, 1.5).expect("admissible parameters");
    agree::<R>(&material, |F| invariants::evaluate(&material, &svd(F)));
    agree::<R>(&material, |F| direct::evaluate(&material, F));
    let material = NeoHookean::new(1.0, 1.5).expect("admissible parameters");
    agree::<R>(&material, |F| invariants::evaluate(&material, &svd(F)));
    agree::<R>(&material, |F| direct::evaluate(&material, F));
    let material = RotatedLinear::new(1.0, 1.5).expect("admissible parameters");
    agree::<R>(&material, |F| polar::evaluate(&material, F));
}

/// No gap between stretches is special, and their squares stay below ten: each entry is a sum of a few
/// products of numbers that are as well known as the stretches, to a few roundings of each step of an
/// iteration.
#[track_caller]
fn agree<R: Real + Into<f64>>(
    material: &impl Material,
    method: impl Fn(&Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]),
) {
    for F in [SHEARED, [[2.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, -0.5, 0.0]], IDENTITY] {
        let found = errors_of::<R>(&method, material, &F);
        assert!(found.iter().all(|&error| error <= 100.0), "{F:?}: {found:?}");
    }
}
