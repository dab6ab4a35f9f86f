//! Batches of every format, back end and layout against the points of scalars, and against themselves in
//! other places. Not among the unit tests, which do not compile the kernels in `f32`.
#![cfg(feature = "batch")]
#![expect(non_snake_case, reason = "F, P, dP_dF as in the literature")]

use nalgebra::SMatrix;
use piola::__private::random::Random;
use piola::batch::{Batch, Kernels, Layout, REST, TileMaterial};
use piola::lanes::{Backend, Real, Scalar};
use piola::point::measures::Measure;
use piola::point::{Filter, Matrix3, Point, evaluate, evaluate_energy};
use piola::{Inversion, Material, Status, StatusCell, Survey, material};

#[allow(dead_code, reason = "each crate that includes this file needs some of it")]
#[path = "../../src/hand_written.rs"]
mod hand_written;
mod quadrature;
mod tetrahedra;

use hand_written::{ExtendedNeoHookean, NeoHookean, RotatedLinear, SaintVenantKirchhoff};

const FILTERS: [Filter; 3] = [Filter::None, Filter::Clamp, Filter::Absolute];

/// Of invariants, by Σ (λ² − 1)²; moduli in Pa, as below.
#[material]
fn GreenSquares([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 4.0 * sum(|l| (l * l - 1.0).powi(2)) + lambda / 8.0 * (I1 - 3.0).powi(2)
}

/// Of I1 and J.
#[material(domain(J > 0.0))]
fn Logarithmic([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// Of all three.
#[material(domain(J > 0.0), extend)]
fn Isochoric([l1, l2, l3]: [f64; 3], c1: f64, c2: f64, kappa: f64) -> f64 {
    c1 * (I1b - 3.0) + c2 * (I2b - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Rest shapes and deformation gradients of elements, inverted and collapsed ones among them.
struct Sample<E> {
    F: Vec<[E; 9]>,
    rest: Vec<[E; REST]>,
}

impl<E: Kernels> Sample<E> {
    fn new(count: usize) -> Self {
        let mut random = Random::new(2011);
        let mut nine = |scale: f64, identity: f64| -> [E; 9] {
            let matrix = random.matrix();
            std::array::from_fn(|k| {
                E::splat(scale * matrix[k / 3][k % 3] + if k % 4 == 0 { identity } else { 0.0 })
            })
        };
        let F = (0..count)
            .map(|p| match p % 8 {
                0 => nine(0.0, 1.0),
                1 => nine(0.0, 0.0),
                2 => nine(1e-6, 1.0),
                3 => nine(1.0, -0.5),
                _ => nine(0.5, 1.0),
            })
            .collect();
        let rest = (0..count)
            .map(|p| {
                let shape = nine(0.3, 1.0);
                std::array::from_fn(|k| if k < 9 { shape[k] } else { E::splat(0.5 + 0.01 * p as f64) })
            })
            .collect();
        Self { F, rest }
    }
}

/// As a slice of a layout.
fn lay<E: Kernels, const N: usize>(layout: Layout, points: &[[E; N]]) -> Vec<E> {
    let mut slice = vec![E::splat(0.0); N * points.len()];
    for (p, numbers) in points.iter().enumerate() {
        for (k, number) in numbers.iter().enumerate() {
            slice[layout.index::<E>(p, N, k)] = *number;
        }
    }
    slice
}

/// Components of a point in each output of a batch: ψ, P, P with dP/dF, dP/dF, the gradient and the stiffness
/// of an element, τ, and the tangent of its Lie derivative, which no division makes infinite.
const COMPONENTS: [usize; 8] = [1, 9, 9, 81, 12, 144, 6, 36];

/// Everything that a batch gives.
struct All<E> {
    surveys: [Survey; 5],
    outputs: [Vec<E>; 8],
    /// The statuses of each point in the calls for stresses and for tangents.
    statuses: Vec<[Status; 2]>,
}

fn all<E: Kernels>(batch: &Batch<'_, E>, layout: Layout, sample: &Sample<E>) -> All<E> {
    let batch = batch.with_layout(layout);
    let (F, rest) = (lay(layout, &sample.F), lay(layout, &sample.rest));
    let mut outputs = COMPONENTS.map(|components| vec![E::splat(0.0); components * sample.F.len()]);
    let [energies, P, beside, full, gradients, stiffnesses, tau, tau_tangents] = &mut outputs;
    let cells = [(); 2].map(|()| sample.F.iter().map(|_| StatusCell::default()).collect::<Vec<_>>());
    let surveys = [
        batch.energies(&F, energies),
        batch.with_statuses(&cells[0]).stresses(&F, P),
        batch.with_statuses(&cells[1]).tangents(&F, beside, full),
        batch.stiffnesses(&F, &rest, gradients, stiffnesses),
        batch.measured_tangents(Measure::Kirchhoff, &F, tau, tau_tangents),
    ];
    let surveys = surveys.map(|survey| survey.expect("lengths fit"));
    let statuses = (0..sample.F.len()).map(|p| [0, 1].map(|call| cells[call][p].get())).collect();
    All { surveys, outputs, statuses }
}

/// Worst of |found − expected| relative to u times a scale.
#[derive(Default)]
struct Worst(f64);

impl Worst {
    fn see<E: Kernels>(&mut self, found: E, expected: impl Into<f64>, scale: f64) {
        let (found, expected): (f64, f64) = (found.into(), expected.into());
        let error = (found - expected).abs() / (<E as Real>::UNIT_ROUNDOFF * scale.max(f64::MIN_POSITIVE));
        if error > self.0 || error.is_nan() {
            self.0 = error;
        }
    }
}

fn norm<E: Kernels>(numbers: impl IntoIterator<Item = E>) -> f64 {
    numbers.into_iter().map(|x| Into::<f64>::into(x).powi(2)).sum::<f64>().sqrt()
}

/// Compares a batch with scalar points and dense algebra on them.
///
/// Both sides have a few u of backward error in F, so P differs by u ‖dP/dF‖ ‖F‖ and dP/dF by u times its own
/// slope, for which its norm over the smallest distance between singular values of what matters stands: the
/// sample has nothing near a pole but the points of `skip`.
#[track_caller]
fn check_against_points<E: Kernels, M: Material>(material: &M, skip: impl Fn(usize) -> bool) {
    let sample = Sample::<E>::new(200);
    for backend in Backend::available() {
        for filter in FILTERS {
            let batch = Batch::new(material).with_filter(filter).with_backend(backend);
            let found = all(&batch, Layout::Points, &sample);
            let mut worst = Worst::default();
            let mut refused = 0;
            for (p, F) in sample.F.iter().enumerate() {
                let F: Matrix3<E> = std::array::from_fn(|i| std::array::from_fn(|j| F[3 * i + j]));
                let point = evaluate(material, &F, filter);
                let are_refused = found.statuses[p].map(|status| status.refused);
                assert_eq!(are_refused, [point.status.refused; 2], "{backend}: {F:?}");
                refused += usize::from(point.status.refused);
                if skip(p) || point.status.refused {
                    continue;
                }
                check_point(&mut worst, &found, &sample, p, material, &F, &point);
            }
            assert_eq!(found.surveys.map(|survey| survey.refused), [refused; 5], "{backend}");
            // Twice the 20 u of a decomposition, times what a material makes of it.
            assert!(worst.0 <= 400.0, "{backend}, {filter:?}: {} u", worst.0);
        }
    }
}

fn check_point<E: Kernels>(
    worst: &mut Worst,
    found: &All<E>,
    sample: &Sample<E>,
    p: usize,
    material: &impl Material,
    F: &Matrix3<E>,
    point: &Point<E>,
) {
    let [energies, P, beside, full, gradients, stiffnesses, ..] = &found.outputs;
    let dP_dF = point.tangent.to_matrix();
    let size = norm(F.iter().flatten().copied()).max(1.0);
    let unfiltered = evaluate(material, F, Filter::None).tangent.to_matrix();
    let stiff = norm(unfiltered.into_iter().flatten());
    let stress = stiff * size;
    worst.see(energies[p], evaluate_energy(material, F).energy, stress * size);
    for k in 0..9 {
        worst.see(P[9 * p + k], point.stress[k / 3][k % 3], stress);
        worst.see(beside[9 * p + k], point.stress[k / 3][k % 3], stress);
        for l in 0..9 {
            worst.see(full[81 * p + 9 * k + l], dP_dF[k][l], stiff * size * size);
            assert!(full[81 * p + 9 * k + l] == full[81 * p + 9 * l + k]);
        }
    }
    // Column 3n+a is ∂F/∂x_na: Dm⁻¹ in row a, with minus the sum for node 0.
    let rest: [f64; REST] = sample.rest[p].map(Into::into);
    let G = SMatrix::<f64, 9, 12>::from_fn(|row, column| {
        let shape = |n: usize| rest[3 * n + row % 3];
        match (column % 3 == row / 3, column / 3) {
            (false, _) => 0.0,
            (true, 0) => -(shape(0) + shape(1) + shape(2)),
            (true, n) => shape(n - 1),
        }
    });
    let shape = norm(sample.rest[p][..9].iter().copied()).max(1.0) * 2.0;
    let P = SMatrix::<f64, 9, 1>::from_fn(|k, _| point.stress[k / 3][k % 3].into());
    let force = rest[9] * G.transpose() * P;
    let stiffness = rest[9] * G.transpose() * SMatrix::<f64, 9, 9>::from_fn(|k, l| dP_dF[k][l].into()) * G;
    for row in 0..12 {
        worst.see(gradients[12 * p + row], force[row], shape * stress);
        for column in 0..12 {
            let mine = stiffnesses[144 * p + 12 * row + column];
            worst.see(mine, stiffness[(row, column)], shape * shape * stiff * size * size);
            assert!(mine == stiffnesses[144 * p + 12 * column + row]);
        }
    }
}

#[test]
fn every_output_is_that_of_the_points() {
    check_against_points::<f64, _>(&SaintVenantKirchhoff, |_| false);
    #[cfg(feature = "f32")]
    check_against_points::<f32, _>(&SaintVenantKirchhoff, |_| false);
    check_against_points::<f64, _>(&NeoHookean, |p| matches!(p % 8, 1 | 3));
    check_against_points::<f64, _>(&ExtendedNeoHookean { epsilon: 0.4 }, |p| matches!(p % 8, 1 | 3));
    check_against_points::<f64, _>(&RotatedLinear, |p| matches!(p % 8, 1 | 3));
}

/// Tiles of points of which the invariants serve all, most, or those well inside a domain.
#[test]
fn every_output_by_invariants_is_that_of_the_points() {
    let green = GreenSquares::new(1.0, 1.5).expect("admissible");
    check_against_points::<f64, _>(&green, |_| false);
    #[cfg(feature = "f32")]
    check_against_points::<f32, _>(&green, |_| false);
    check_against_points::<f64, _>(&Logarithmic::new(1.0, 1.5).expect("admissible"), |_| false);
    let isochoric = Isochoric::new(0.4, 0.1, 2.0).expect("admissible");
    // Of J^(−2/3) and its kin, nearly flat elements have few digits.
    check_against_points::<f64, _>(&isochoric, |p| p % 8 == 3);
    let extended = isochoric.with_inversion(Inversion::Extend { epsilon: 0.4 }).expect("restores");
    check_against_points::<f64, _>(&extended, |p| matches!(p % 8, 1 | 3));
}

/// The bits of every number, in any layout of the batch.
fn bits<E: Kernels>(layout: Layout, all: &All<E>, count: usize) -> Vec<u64> {
    let mut bits = Vec::new();
    for p in 0..count {
        for (output, components) in all.outputs.iter().zip(COMPONENTS) {
            let numbers = (0..components).map(|k| output[layout.index::<E>(p, components, k)]);
            bits.extend(numbers.map(|number| Into::<f64>::into(number).to_bits()));
        }
    }
    bits
}

fn check_bits<E: Kernels>(energy: &dyn TileMaterial<E>, filter: Filter) {
    // Enough tiles for threads to share, in both layouts, the last one not full.
    const COUNT: usize = 64 * 20 + 16;
    let sample = Sample::<E>::new(COUNT);
    let two_threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool of threads");
    for backend in Backend::available() {
        let batch = Batch::new(energy).with_filter(filter).with_backend(backend);
        let points = all(&batch, Layout::Points, &sample);
        let expected = bits(Layout::Points, &points, COUNT);
        for (layout, variant) in [
            (Layout::Lines, batch),
            (Layout::Points, batch.with_threads(true)),
            (Layout::Lines, batch.with_threads(true)),
        ] {
            let found = two_threads.install(|| all(&variant, layout, &sample));
            assert_eq!((&found.surveys, &found.statuses), (&points.surveys, &points.statuses), "{backend}");
            assert!(bits(layout, &found, COUNT) == expected, "{backend}, {layout:?}");
        }
        // Another place in the tile, other neighbours, another number of points.
        let shifted = Sample { F: sample.F[37..300].to_vec(), rest: sample.rest[37..300].to_vec() };
        let found = bits(Layout::Points, &all(&batch, Layout::Points, &shifted), 263);
        let per_point = expected.len() / COUNT;
        assert!(found == expected[37 * per_point..300 * per_point], "{backend}, shifted");
    }
}

#[test]
fn bits_do_not_depend_on_place_neighbours_layout_or_threads() {
    check_bits::<f64>(&RotatedLinear, Filter::Clamp);
    #[cfg(feature = "f32")]
    check_bits::<f32>(&RotatedLinear, Filter::Clamp);
    check_bits::<f64>(&ExtendedNeoHookean { epsilon: 0.4 }, Filter::Clamp);
    #[cfg(feature = "f32")]
    check_bits::<f32>(&ExtendedNeoHookean { epsilon: 0.4 }, Filter::Clamp);
    // Some points of a tile by invariants, the others by a decomposition.
    let isochoric = Isochoric::new(0.4, 0.1, 2.0).expect("admissible");
    let extended = isochoric.with_inversion(Inversion::Extend { epsilon: 0.4 }).expect("restores");
    check_bits::<f64>(&extended, Filter::None);
    #[cfg(feature = "f32")]
    check_bits::<f32>(&extended, Filter::None);
}

/// F by columns is Fᵀ by rows, and so is every result of an isotropic solid.
#[test]
fn matrices_by_columns_give_matrices_by_columns() {
    let turn = |k: usize| 3 * (k % 3) + k / 3;
    let Sample { F, .. } = Sample::<f64>::new(100);
    let [by_rows, by_columns] = [|k| k, turn].map(|place: fn(usize) -> usize| {
        let F: Vec<f64> = F.iter().flat_map(|F| (0..9).map(|k| F[place(k)]).collect::<Vec<_>>()).collect();
        let (mut energies, mut P, mut dP_dF) = (vec![0.0; 100], vec![0.0; 900], vec![0.0; 8100]);
        let batch = Batch::new(&SaintVenantKirchhoff).with_filter(Filter::Clamp);
        let survey = batch.energies_and_tangents(&F, &mut energies, &mut P, &mut dP_dF);
        assert!(survey.expect("lengths fit").is_clean());
        let entries = |k: usize, n: usize| 81 * k + 9 * place(n / 9) + place(n % 9);
        let mut all = energies;
        all.extend((0..900).map(|k| P[k / 9 * 9 + place(k % 9)]));
        all.extend((0..8100).map(|k| dP_dF[entries(k / 81, k % 81)]));
        all
    });
    // Entries of F are of the order of 1, and so are the moduli: each value is a few roundings off.
    let largest = by_rows.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    for (rows, columns) in by_rows.iter().zip(&by_columns) {
        assert!((rows - columns).abs() <= 200.0 * f64::EPSILON * largest, "{rows} and {columns}");
    }
}

#[test]
fn a_survey_counts_and_names_the_first() {
    let mut F = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0].repeat(130);
    F[9 * 100] = -1.0;
    F[9 * 101] = f64::NAN;
    F[9 * 129] = f64::INFINITY;
    for backend in Backend::available() {
        let batch = Batch::new(&NeoHookean).with_backend(backend);
        let (mut P, mut dP_dF, mut energies) = (vec![0.0; 9 * 130], vec![0.0; 81 * 130], vec![0.0; 130]);
        for survey in [batch.energies(&F, &mut energies), batch.tangents(&F, &mut P, &mut dP_dF)] {
            let survey = survey.expect("lengths fit");
            // The logarithm of a negative number is not finite, and what is not a number is in no domain.
            assert_eq!((survey.refused, survey.nonfinite, survey.first), (3, 3, Some(100)), "{backend}");
            assert!(!survey.is_clean());
        }
    }
}

#[test]
fn lengths_that_do_not_fit_are_errors() {
    let batch = Batch::<f64>::new(&SaintVenantKirchhoff);
    let error = batch.stresses(&[1.0; 18], &mut [0.0; 17]).unwrap_err();
    assert_eq!(error.to_string(), "`P` has 17 entries; 2 points of 9 entries each would make 18");
    let error = batch.stresses(&[1.0; 17], &mut [0.0; 9]).unwrap_err();
    assert_eq!(error.slice, "F");
    let lines = batch.with_layout(Layout::Lines);
    let error = lines.stresses(&[1.0; 18], &mut [0.0; 18]).unwrap_err();
    assert!(error.to_string().ends_with("the layout in lines requires a multiple of 8 points"), "{error}");
    assert_eq!(batch.stresses(&[], &mut []), Ok(Survey::default()));
}

#[test]
fn lines_are_as_long_as_a_cache_line() {
    assert_eq!((<f64 as Scalar>::LINE, <f32 as Scalar>::LINE), (8, 16));
    assert_eq!(Layout::Lines.index::<f64>(11, 9, 2), (9 + 2) * 8 + 3);
    assert_eq!(Layout::Points.index::<f64>(11, 9, 2), 101);
}
