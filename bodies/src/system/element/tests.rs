use piola::__private::random::Random;
use piola::batch::Batch;
use piola::batch::element::{MAX_STIFFNESS_RATIO, survey};

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

fn energy(material: &dyn TileMaterial<f64>, element: &Tetrahedron, positions: &[[f64; 3]]) -> f64 {
    let mut group = ElementGroup::new(0, &[*element]);
    group.evaluate(material, &[*element], positions);
    group.energies[0]
}

fn derivatives(
    material: &dyn TileMaterial<f64>,
    element: &Tetrahedron,
    positions: &[[f64; 3]],
    filter: Filter,
) -> ([[f64; 3]; 4], [[f64; 12]; 12], Survey) {
    let mut group = ElementGroup::new(0, &[*element]);
    group.evaluate(material, &[*element], positions);
    let mut stiffness = [[[[0.0; 3]; 3]; 10]];
    let status = group.evaluate_stiffnesses(material, &[*element], filter, &mut stiffness);
    let with_stiffness = group.gradients[0];
    group.evaluate_gradients(material, &[*element]);
    assert_eq!(group.gradients[0], with_stiffness, "the gradient is the same with and without a stiffness");
    (group.gradients[0], to_matrix(&stiffness[0]), survey(status, 0))
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

/// The reference is a batch, whose outputs `runtime/tests/batch` compares with points: with a decomposition
/// and by invariants, for elements as they are and inverted ones.
#[test]
fn a_group_gives_what_a_batch_gives() {
    let (mut clean, mut filtered) = (0, 0);
    for seed in 0..40 {
        let (element, positions) = sample(seed, if seed % 2 == 0 { 0.02 } else { 0.2 });
        for material in [&kirchhoff() as &dyn TileMaterial<f64>, &rotated(), &neo_hookean(), &by_invariants()]
        {
            let mut group = ElementGroup::new(0, &[element]);
            let (status, _) = group.evaluate(material, &[element], &positions);
            let F = group.deformation_gradient(0);
            for (found, expected) in
                F.iter().flatten().zip(element.deformation_gradient(&positions).iter().flatten())
            {
                // Differences of positions up to 1 over edges of 0.1 m.
                assert!((found - expected).abs() <= 100.0 * f64::EPSILON, "{found}, not {expected}");
            }
            let mut energy = [0.0];
            let exact = Batch::new(material).energies(F.as_flattened(), &mut energy).expect("one element");
            assert_eq!(survey(status, 0).refused, exact.refused);
            if exact.refused > 0 {
                continue;
            }
            assert!(survey(status, 0).is_clean() && exact.is_clean());
            clean += 1;
            let rest = element.shape.components();
            for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
                let (gradient, stiffness, found) = derivatives(material, &element, &positions, filter);
                let (mut exact_gradient, mut exact) = ([0.0; 12], [0.0; 144]);
                let counts = Batch::new(material)
                    .with_filter(filter)
                    .stiffnesses(F.as_flattened(), &rest, &mut exact_gradient, &mut exact)
                    .expect("one element");
                assert_eq!(found, counts);
                filtered += counts.filtered;
                let scale = exact.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                // Some thirty roundings of sums that are ten times their largest entry; edges of 0.1 m.
                let close =
                    |x: f64, exact: f64, scale: f64| (x - exact).abs() <= 300.0 * f64::EPSILON * scale;
                assert!(close(group.energies[0], energy[0] * element.shape.volume, 0.01 * scale));
                let gradients = gradient.as_flattened().iter().zip(&exact_gradient);
                assert!(gradients.into_iter().all(|(x, exact)| close(*x, *exact, 0.1 * scale)));
                let stiffnesses = stiffness.as_flattened().iter().zip(&exact);
                assert!(stiffnesses.into_iter().all(|(x, exact)| close(*x, *exact, scale)));
            }
        }
    }
    assert!((100..160).contains(&clean) && filtered > 0, "{clean} clean, {filtered} filtered");
}

/// Elements for which the invariants cannot be used make the whole tile decompose, and their digits are kept.
#[test]
fn an_element_out_of_range_is_decomposed() {
    let (element, positions) = sample(0, 0.02);
    let mut elements = [element; 3];
    // Stretches of 1e60 have no invariants in range.
    elements[1].shape.inverse = element.shape.inverse.map(|row| row.map(|x| x * 1e60));
    let mut group = ElementGroup::new(0, &elements);
    let (status, _) = group.evaluate(&by_invariants(), &elements, &positions);
    let alone = energy(&by_invariants(), &element, &positions);
    assert!(survey(status, 0).is_clean(), "{status:?}");
    assert!(
        (group.energies[0] - alone).abs() <= 1e-12 * alone.abs() && group.energies[0] == group.energies[2]
    );
    assert!(group.energies[1].is_finite() && group.energies[1] > alone);
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
fn an_affine_map_is_the_deformation_of_every_element() {
    let mesh = beam(3);
    let F = [[1.1, 0.2, -0.1], [0.0, 0.8, 0.3], [0.1, -0.2, 1.2]];
    let map = |x: &[f64; 3]| -> [f64; 3] {
        std::array::from_fn(|a| F[a][0] * x[0] + F[a][1] * x[1] + F[a][2] * x[2] + 0.7)
    };
    let positions: Vec<_> = mesh.positions.iter().map(map).collect();
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    for element in body.elements() {
        let found = element.deformation_gradient(&positions);
        for (found, expected) in found.as_flattened().iter().zip(F.as_flattened()) {
            // Differences of positions up to 2 over edges of 0.1 m.
            assert!((found - expected).abs() <= 100.0 * f64::EPSILON);
        }
    }
}

#[test]
fn an_element_with_nan_positions_is_not_finite() {
    let (element, mut positions) = sample(3, 0.0);
    positions[element.nodes[1]][2] = f64::NAN;
    let (status, _) = ElementGroup::new(0, &[element]).evaluate(&kirchhoff(), &[element], &positions);
    assert_eq!(survey(status, 7), Survey { nonfinite: 1, first: Some(7), ..Survey::default() });
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
        let mut group = ElementGroup::new(0, &[element]);
        let (status, _) = group.evaluate(&kirchhoff(), &[element], &positions);
        assert!(survey(status, 0).is_clean(), "{status:?}");
        let status =
            group.evaluate_stiffnesses(&kirchhoff(), &[element], Filter::None, &mut [[[[0.0; 3]; 3]; 10]]);
        let found = survey(status, 0);
        assert_eq!((found.nonfinite, found.is_clean()), (expected, expected == 0));
    };
    check(1.0, 0);
    check(1e160, 1);
}
