use piola::__private::random::Random;
use piola::batch::Batch;
use piola::batch::element::MAX_STIFFNESS_RATIO;

use super::*;
use crate::system::Body;
use crate::system::testing::{beam, by_invariants, kirchhoff, neo_hookean, rotated, shake};

/// A tetrahedron of a beam with its nodes moved at random.
fn sample(seed: u64, amplitude: f64) -> (Tetrahedron, Vec<[f64; 3]>) {
    let mesh = beam(2);
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    let element = body.elements()[(seed % 12) as usize];
    (element, shake(&mut Random::new(seed), &mesh.positions, amplitude))
}

/// Gradient of an element, N.
type Gradient = [[f64; 3]; 4];

fn derivatives(
    material: &dyn TileMaterial<f64>,
    element: &Tetrahedron,
    positions: &[[f64; 3]],
    filter: Filter,
) -> (Gradient, [[f64; 12]; 12], Survey) {
    let ([gradient, with_stiffness], stiffness, survey) = declared(material, element, positions, filter);
    assert_eq!(gradient, with_stiffness, "the gradient is the same with and without a stiffness");
    (gradient, stiffness, survey)
}

/// The gradient, alone and with the stiffness: for a declared energy these are two programs, which differ by
/// rounding.
fn declared(
    material: &dyn TileMaterial<f64>,
    element: &Tetrahedron,
    positions: &[[f64; 3]],
    filter: Filter,
) -> ([Gradient; 2], [[f64; 12]; 12], Survey) {
    let mut group = evaluated(material, &[*element], positions);
    let mut stiffness = [[[[0.0; 3]; 3]; 10]];
    group.evaluate_stiffnesses(material, &[*element], filter, &mut stiffness);
    let (with_stiffness, survey) = (group.gradients[0], group.evaluated.survey);
    group.evaluate_gradients(material, &[*element]);
    ([group.gradients[0], with_stiffness], to_matrix(&stiffness[0]), survey)
}

/// A group after the evaluation of its energies.
fn evaluated(
    material: &dyn TileMaterial<f64>,
    elements: &[Tetrahedron],
    positions: &[[f64; 3]],
) -> ElementGroup {
    let mut group = ElementGroup::new(0, 0, elements);
    group.evaluate(material, elements, positions);
    group
}

/// The whole matrix; unknown 3i+a is coordinate a of node i.
pub(crate) fn to_matrix(stiffness: &StiffnessBlocks) -> [[f64; 12]; 12] {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let (i, a, j, c) = (row / 3, row % 3, column / 3, column % 3);
            if i >= j { stiffness[pair(i, j)][a][c] } else { stiffness[pair(j, i)][c][a] }
        })
    })
}

/// Elements have the results of a batch at their deformation gradients, which the test `batch` of `piola`
/// compares with points and dense algebra. Those by invariants have the results of a decomposition.
#[test]
fn elements_have_the_results_of_a_batch() {
    let (even, pole) = (kirchhoff(), rotated());
    let (by_invariants, by_stretches) = (by_invariants(), neo_hookean());
    // Up to twice the size of an element: many of these are inverted.
    let subjects: [(f64, &dyn TileMaterial<f64>, &dyn TileMaterial<f64>); 3] =
        [(0.2, &even, &even), (0.2, &pole, &pole), (0.08, &by_invariants, &by_stretches)];
    for (large, material, exact) in subjects {
        let mut refused = 0;
        for seed in 0..40 {
            let (element, positions) = sample(seed, if seed % 2 == 0 { 0.02 } else { large });
            let group = evaluated(material, &[element], &positions);
            let F = group.deformation_gradient(0);
            assert_eq!(group.evaluated.min_det, determinant(&F));
            // Sums of three products of up to 5.
            check_close(F.as_flattened(), element.deformation_gradient(&positions).as_flattened(), 0.3);
            let (batch, rest) = (Batch::new(exact), element.shape.components());
            let mut energy = [0.0];
            let expected = batch.energies(F.as_flattened(), &mut energy).expect("one point");
            assert_eq!(group.evaluated.survey.refused, expected.refused);
            if expected.refused == 1 {
                refused += 1;
                continue;
            }
            for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
                let (mut gradient, mut full) = ([0.0; 12], [0.0; 144]);
                let batch = batch.with_filter(filter);
                let expected = batch.stiffnesses(F.as_flattened(), &rest, &mut gradient, &mut full);
                let (gradients, stiffness, found) = declared(material, &element, &positions, filter);
                assert_eq!(Ok(found), expected);
                let scale = full.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                // Edges of 0.1 m.
                check_close(&group.energies[..1], &[energy[0] * element.shape.volume], 0.01 * scale);
                gradients.iter().for_each(|found| check_close(found.as_flattened(), &gradient, 0.1 * scale));
                check_close(stiffness.as_flattened(), &full, scale);
            }
        }
        assert!(refused < 30 && (large > 0.1 || refused > 0), "{refused} of 40 are inside out");
    }
}

/// Some thirty roundings of sums that are ten times their largest entry.
#[track_caller]
fn check_close(found: &[f64], expected: &[f64], scale: f64) {
    for (x, exact) in found.iter().zip(expected) {
        assert!((x - exact).abs() <= 300.0 * f64::EPSILON * scale, "{x}, not {exact}");
    }
}

/// Elements for which the invariants cannot be used make the whole tile decompose, and their digits are kept.
#[test]
fn an_element_out_of_range_is_decomposed() {
    let (element, positions) = sample(0, 0.02);
    let mut elements = [element; 3];
    // Stretches of 1e60 have no invariants in range.
    elements[1].shape.inverse = element.shape.inverse.map(|row| row.map(|x| x * 1e60));
    let group = evaluated(&by_invariants(), &elements, &positions);
    let alone = evaluated(&by_invariants(), &[element], &positions).energies[0];
    assert!(group.evaluated.survey.is_clean(), "{:?}", group.evaluated);
    assert!(
        (group.energies[0] - alone).abs() <= 1e-12 * alone.abs() && group.energies[0] == group.energies[2]
    );
    assert!(group.energies[1].is_finite() && group.energies[1] > alone);
}

#[test]
fn filtered_stiffnesses_are_exactly_symmetric_semidefinite_and_know_no_translation() {
    let mut filtered = 0;
    for (seed, filter) in (0..12).flat_map(|seed| [(seed, Filter::Clamp), (seed, Filter::Absolute)]) {
        let (element, positions) = sample(seed, 0.1);
        let (gradient, stiffness, survey) = derivatives(&kirchhoff(), &element, &positions, filter);
        filtered += survey.filtered;
        let scale = stiffness.iter().flatten().fold(0.0f64, |largest, entry| largest.max(entry.abs()));
        for row in 0..12 {
            for column in 0..12 {
                assert_eq!(stiffness[row][column], stiffness[column][row]);
            }
            for c in 0..3 {
                let sum: f64 = (0..4).map(|node| stiffness[row][3 * node + c]).sum();
                // Six additions of numbers up to `scale`.
                assert!(sum.abs() <= 16.0 * f64::EPSILON * scale);
            }
        }
        for c in 0..3 {
            let (sum, size) = gradient.iter().fold((0.0, 0.0), |(s, a), g| (s + g[c], a + g[c].abs()));
            assert!(f64::abs(sum) <= 4.0 * f64::EPSILON * size);
        }
        let eigenvalues = nalgebra::SMatrix::<f64, 12, 12>::from(stiffness).symmetric_eigenvalues();
        // Backward error of a symmetric eigensolver: a small multiple of n u ‖K‖.
        assert!(eigenvalues.min() >= -24.0 * f64::EPSILON * eigenvalues.max(), "{eigenvalues}");
    }
    assert!(filtered > 0, "some of these elements are compressed so much that the filter has work");
}

/// Stretched tenfold along one axis and collapsed to a line: λ(λ1 − 3) > 2μ, and the twist is N/(λ2 + λ3)
/// with N > 0.
#[test]
fn a_convex_kink_is_cut_to_what_a_factorisation_resolves() {
    let (element, positions) = sample(0, 0.0);
    let collapsed =
        |width: f64| positions.iter().map(|x| [10.0 * x[0], width * x[1], width * x[2]]).collect();
    let largest = |positions: Vec<[f64; 3]>| {
        let (_, stiffness, survey) = derivatives(&rotated(), &element, &positions, Filter::Clamp);
        let largest = stiffness.as_flattened().iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(largest.is_finite());
        (largest, survey.bounded)
    };
    let (ordinary, none) = largest(collapsed(0.1));
    assert_eq!(none, 0);
    for width in [0.0, 1e-12] {
        let (kink, bounded) = largest(collapsed(width));
        assert_eq!(bounded, 1, "width {width:e}");
        // The rest of the tangent is of the size of the ordinary one; ten allows for what differs.
        assert!(kink <= 10.0 * MAX_STIFFNESS_RATIO * ordinary, "{kink:e} for {ordinary:e}");
    }
}

#[test]
fn an_affine_map_is_the_deformation_gradient_of_every_element() {
    let mesh = beam(3);
    let F = [[1.1, 0.2, -0.1], [0.0, 0.8, 0.3], [0.1, -0.2, 1.2]];
    let map = |x: &[f64; 3]| -> [f64; 3] {
        std::array::from_fn(|a| F[a][0] * x[0] + F[a][1] * x[1] + F[a][2] * x[2] + 0.7)
    };
    let positions: Vec<_> = mesh.positions.iter().map(map).collect();
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    for element in body.elements() {
        let found = element.deformation_gradient(&positions);
        for a in 0..3 {
            for b in 0..3 {
                // Differences of positions up to 2 over edges of 0.1 m.
                assert!((found[a][b] - F[a][b]).abs() <= 100.0 * f64::EPSILON);
            }
        }
    }
}

#[test]
fn an_element_with_nan_positions_is_not_finite() {
    let (element, mut positions) = sample(3, 0.0);
    positions[element.nodes[1]][2] = f64::NAN;
    let mut group = ElementGroup::new(0, 7, &[element]);
    group.evaluate(&kirchhoff(), &[element], &positions);
    assert_eq!(group.evaluated.survey, Survey { nonfinite: 1, first: Some(7), ..Survey::default() });
}

#[test]
fn forces_and_stiffnesses_that_overflow_are_not_finite() {
    let (element, positions) = sample(3, 0.0);
    // A stiffness goes with Dm⁻²: rest edges shrunk to 1e-160 m at the same F and the same volume leave the
    // energy as it is.
    let check = |size: f64, expected: usize| {
        let mut element = element;
        element.shape.inverse = element.shape.inverse.map(|row| row.map(|x| x * size));
        let positions: Vec<_> = positions.iter().map(|x| x.map(|x| x / size)).collect();
        let mut group = evaluated(&kirchhoff(), &[element], &positions);
        assert!(group.evaluated.survey.is_clean(), "{:?}", group.evaluated);
        group.evaluate_stiffnesses(&kirchhoff(), &[element], Filter::None, &mut [[[[0.0; 3]; 3]; 10]]);
        let found = group.evaluated.survey;
        assert_eq!((found.nonfinite, found.is_clean()), (expected, expected == 0));
    };
    check(1.0, 0);
    check(1e160, 1);
}
