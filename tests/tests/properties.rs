//! What holds for every isotropic energy at every deformation of moderate condition: each property for the
//! whole catalogue, refusing and extended, at random deformations.
//!
//! Bounds. A stress is computed to 30 u (‖P‖ + ‖dP/dF‖ ‖F‖), which the reference cases establish for every
//! material. A property that compares two stresses may use twice that, and a few u more for the products that
//! set it up: C = 64. Sums of nine products and eigenvalues of 9×9 matrices are good to less than C u of the
//! norms that enter.

#![expect(non_snake_case, reason = "F, P, Q, U, V as in the literature")]

use nalgebra::SMatrix;
use piola::__private::random::Random;
use piola::Real;
use piola::material::Response;
use piola::point::{Filter, Matrix3, Point};
use piola_tests::compiled::{evaluate, evaluate_energy, evaluate_stress};
use piola_tests::energies::{ENERGIES, Judged, Subject};
use piola_tests::soundness::{check, check_single_accuracy};
use rayon::prelude::*;

const C: f64 = 64.0;
const UNIT: f64 = f64::UNIT_ROUNDOFF;

/// A deformation gradient F = U diag(λ) Vᵀ with its factors, another rotation, and an increment of F.
#[derive(Clone, Debug)]
struct Sample {
    U: Matrix3<f64>,
    stretches: [f64; 3],
    V: Matrix3<f64>,
    rotation: Matrix3<f64>,
    increment: Matrix3<f64>,
}

impl Sample {
    /// Stretches of 0.3 … 2, some equal, some inverted, some at rest.
    fn draw(random: &mut Random) -> Self {
        let mut stretches: [f64; 3] = std::array::from_fn(|_| random.uniform(0.3, 2.0));
        match random.below(7) {
            0 => stretches[1] = stretches[0],
            1 => stretches = [stretches[0]; 3],
            2 => stretches = std::array::from_fn(|_| random.uniform(0.999, 1.001)),
            _ => {}
        }
        stretches.sort_by(|a, b| b.total_cmp(a));
        if random.uniform(0.0, 1.0) < 0.3 {
            stretches[2] = -stretches[2];
        }
        let [U, V, rotation] = std::array::from_fn(|_| random.rotation());
        Self { U, stretches, V, rotation, increment: random.matrix() }
    }

    fn F(&self) -> Matrix3<f64> {
        self.in_frames(self.stretches)
    }

    /// U diag(x) Vᵀ.
    fn in_frames(&self, x: [f64; 3]) -> Matrix3<f64> {
        matrix(|i, j| (0..3).map(|k| self.U[i][k] * x[k] * self.V[j][k]).sum())
    }
}

/// A property; its error says by how much it does not hold.
type Property = fn(&Subject, &Sample) -> Result<(), String>;

/// Number of deformations.
const SAMPLES: usize = 384;

#[track_caller]
fn for_every_energy(property: Property) {
    let mut random = Random::new(384);
    let samples: Vec<_> = (0..SAMPLES).map(|_| Sample::draw(&mut random)).collect();
    let failures: Vec<_> =
        ENERGIES.par_iter().flat_map_iter(|energy| failures(property, energy, &samples)).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// The first failure of an energy for each of its inversions.
fn failures(property: Property, energy: &Judged, samples: &[Sample]) -> Vec<String> {
    let of_inversion = |inversion| {
        let subject = energy.subject(&energy.typical(), inversion).expect("typical parameters");
        samples.iter().find_map(|sample| {
            let error = property(&subject, sample).err()?;
            Some(format!("{} {inversion:?}: {error} at {sample:?}", energy.name))
        })
    };
    energy.inversions(0.4).filter_map(of_inversion).collect()
}

fn matrix(entry: impl Fn(usize, usize) -> f64) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn product(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    matrix(|i, j| (0..3).map(|k| a[i][k] * b[k][j]).sum())
}

fn norm<const N: usize>(a: &[[f64; N]; N]) -> f64 {
    a.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

fn distance(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    norm(&matrix(|i, j| a[i][j] - b[i][j]))
}

fn at_most(what: &str, value: f64, bound: f64) -> Result<(), String> {
    // Written so that NaN fails.
    if value <= bound { Ok(()) } else { Err(format!("{what} is {value:e}, more than {bound:e}")) }
}

/// The point at F, where it is admissible and not at a pole.
fn evaluate_inside(material: &dyn Response<f64>, F: &Matrix3<f64>, filter: Filter) -> Option<Point<f64>> {
    let point = evaluate(material, F, filter);
    (!(point.status.refused || point.status.bounded)).then_some(point)
}

/// ‖P‖ + ‖dP/dF‖ ‖F‖: what an error of the stress is relative to.
fn scale(point: &Point<f64>, F: &Matrix3<f64>) -> f64 {
    norm(&point.stress) + norm(&point.tangent.to_matrix()) * norm(F)
}

/// P of a turned F is the turned P.
fn turned(
    what: &str,
    subject: &Subject,
    sample: &Sample,
    turn: fn(&Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
) -> Result<(), String> {
    let material: &dyn Response<f64> = &*subject.double;
    let F = sample.F();
    let Some(point) = evaluate_inside(material, &F, Filter::None) else { return Ok(()) };
    let found = evaluate_stress(material, &turn(&F, &sample.rotation)).stress;
    let expected = turn(&point.stress, &sample.rotation);
    at_most(what, distance(&found, &expected), C * UNIT * scale(&point, &F))
}

#[test]
fn a_rotation_of_space_rotates_the_stress() {
    for_every_energy(|subject, sample| {
        turned("‖P(QF) − Q P(F)‖", subject, sample, |F, Q| product(Q, F))
    });
}

#[test]
fn a_rotation_of_the_rest_shape_rotates_the_stress() {
    for_every_energy(|subject, sample| turned("‖P(FQ) − P(F) Q‖", subject, sample, product));
}

fn principal_frames(subject: &Subject, sample: &Sample) -> Result<(), String> {
    let material: &dyn Response<f64> = &*subject.double;
    let F = sample.F();
    let Some(point) = evaluate_inside(material, &F, Filter::None) else { return Ok(()) };
    let expected = sample.in_frames(material.gradient(sample.stretches));
    at_most("‖P − U diag(ψi) Vᵀ‖", distance(&point.stress, &expected), C * UNIT * scale(&point, &F))?;
    let energy = evaluate_energy(material, &F).energy;
    let expected = material.energy(sample.stretches);
    // At rest the terms of an energy are of the size of its stiffness and cancel.
    let terms = expected.abs() + norm(&point.stress) * norm(&F) + material.blocks([1.0; 3]).hessian[0];
    at_most("|ψ(F) − ψ(λ)|", (energy - expected).abs(), C * UNIT * terms)
}

#[test]
fn stress_and_energy_are_those_of_the_stretches() {
    for_every_energy(principal_frames);
}

fn products(subject: &Subject, sample: &Sample) -> Result<(), String> {
    let material: &dyn Response<f64> = &*subject.double;
    for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
        let Some(point) = evaluate_inside(material, &sample.F(), filter) else { return Ok(()) };
        let tangent = point.tangent.to_matrix();
        if (0..81).any(|entry| tangent[entry / 9][entry % 9] != tangent[entry % 9][entry / 9]) {
            return Err(format!("{filter:?}: dP/dF is not symmetric"));
        }
        let applied = point.tangent.apply(&sample.increment);
        let expected =
            matrix(|i, j| (0..9).map(|k| tangent[3 * i + j][k] * sample.increment[k / 3][k % 3]).sum());
        let bound = C * UNIT * norm(&tangent) * norm(&sample.increment);
        at_most("‖apply(dF) − (dP/dF) dF‖", distance(&applied, &expected), bound)?;
    }
    Ok(())
}

#[test]
fn a_tangent_is_symmetric_and_its_product_that_of_its_matrix() {
    for_every_energy(products);
}

fn filters(subject: &Subject, sample: &Sample) -> Result<(), String> {
    let material: &dyn Response<f64> = &*subject.double;
    let tangent = |filter| {
        let point = evaluate_inside(material, &sample.F(), filter)?;
        let rows = point.tangent.to_matrix();
        Some(SMatrix::<f64, 9, 9>::from_fn(|i, j| rows[i][j]))
    };
    let (Some(none), Some(clamp), Some(absolute)) =
        (tangent(Filter::None), tangent(Filter::Clamp), tangent(Filter::Absolute))
    else {
        return Ok(());
    };
    let noise = C * UNIT * none.norm();
    let negative = |matrix: SMatrix<f64, 9, 9>| -matrix.symmetric_eigenvalues().min();
    at_most("−smallest eigenvalue of the clamped tangent", negative(clamp), noise)?;
    at_most("−smallest eigenvalue of absolute − clamped", negative(absolute - clamp), noise)?;
    at_most("−smallest eigenvalue of clamped − unfiltered", negative(clamp - none), noise)?;
    // Where nothing is negative, nothing is changed; else clamped is half way to absolute.
    at_most("‖none + absolute − 2 clamped‖", (none + absolute - 2.0 * clamp).norm(), noise)
}

#[test]
fn filters_are_semidefinite_and_ordered() {
    for_every_energy(filters);
}

fn single_precision(subject: &Subject, sample: &Sample) -> Result<(), String> {
    let F = sample.F().map(|row| row.map(|x| x as f32));
    check_single_accuracy(subject, &F).map_err(|fault| fault.to_string())
}

#[test]
fn single_precision_is_close_to_double() {
    for_every_energy(single_precision);
}

fn infection(subject: &Subject, sample: &Sample) -> Result<(), String> {
    for entry in 0..9 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut F = sample.F();
            F[entry / 3][entry % 3] = value;
            check(&*subject.double as &dyn Response<f64>, &F).map_err(|fault| format!("{fault}: {F:?}"))?;
            check(&*subject.single, &F.map(|row| row.map(|x| x as f32)))
                .map_err(|fault| fault.to_string())?;
        }
    }
    Ok(())
}

#[test]
fn what_is_not_finite_is_said_to_be() {
    for_every_energy(infection);
}
