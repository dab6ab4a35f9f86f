#![expect(non_snake_case, reason = "K x as in the literature")]

use super::*;
use crate::batch::TileMaterial;
use crate::random::Random;
use crate::system::Pins;
use crate::system::assemble::Elastic;
use crate::system::element::determinant;
use crate::system::pattern::Pattern;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::testing::{BY_INVARIANTS, KIRCHHOFF, NEO_HOOKEAN, ROTATED, beam, shake};

const FILTERS: [Filter; 3] = [Filter::None, Filter::Clamp, Filter::Absolute];

/// The assembled matrix as rows of 3×3 blocks, node by node.
fn assembled(body: &Body, positions: &[[f64; 3]], filter: Filter) -> Vec<Vec<[[f64; 3]; 3]>> {
    let nodes = positions.len();
    let pattern = Pattern::new(nodes, body.elements(), &Pins::none()).expect("small");
    let mut elastic = Elastic::new(body);
    elastic.evaluate(body, positions);
    let mut stiffnesses = ElementStiffnesses::new(body);
    elastic.linearise(body, filter, &mut stiffnesses);
    let mut values = vec![0.0; pattern.entries().row_idx().len()];
    stiffnesses.fill(&pattern, |_| 0.0, &mut values);
    let mut matrix = vec![vec![[[0.0; 3]; 3]; nodes]; nodes];
    let entries = pattern.entries();
    for column in 0..pattern.unknowns() {
        for entry in entries.col_range(column) {
            let row = entries.row_idx()[entry];
            let (i, j) = (pattern.node_of_free()[row / 3], pattern.node_of_free()[column / 3]);
            matrix[i][j][row % 3][column % 3] = values[entry];
            matrix[j][i][column % 3][row % 3] = values[entry];
        }
    }
    matrix
}

fn random_vectors(random: &mut Random, count: usize) -> Vec<[f64; 3]> {
    (0..count).map(|_| [0; 3].map(|_| random.uniform(-1.0, 1.0))).collect()
}

fn dot(x: &[[f64; 3]], y: &[[f64; 3]]) -> f64 {
    x.as_flattened().iter().zip(y.as_flattened()).map(|(x, y)| x * y).sum()
}

/// Compares an operator with the assembled matrix of a beam whose nodes are moved by up to `amplitude`.
#[track_caller]
fn check_against_matrix(material: impl TileMaterial<f64> + 'static, amplitude: f64) {
    let mesh = beam(20);
    let body = Body::new(&mesh, material, 1000.0).expect("a body");
    let mut random = Random::new(7);
    let positions = shake(&mut random, &mesh.positions, amplitude);
    let nodes = positions.len();
    let (x, y) = (random_vectors(&mut random, nodes), random_vectors(&mut random, nodes));
    let mut operator = StiffnessOperator::new(&body);
    let (mut Kx, mut Ky) = (vec![[f64::NAN; 3]; nodes], vec![[f64::NAN; 3]; nodes]);
    let mut diagonal = vec![[[f64::NAN; 3]; 3]; nodes];
    for filter in FILTERS {
        let survey = operator.linearise(&body, &positions, filter).expect("as many nodes");
        assert!(survey.is_clean(), "{survey:?}");
        operator.multiply(&x, &mut Kx).expect("as many nodes");
        operator.multiply(&y, &mut Ky).expect("as many nodes");
        operator.diagonal_blocks(&mut diagonal).expect("as many nodes");

        let matrix = assembled(&body, &positions, filter);
        let entries = matrix.iter().flatten().flatten().flatten();
        let largest = entries.fold(0.0f64, |largest, entry| largest.max(entry.abs()));
        // Some thirty roundings of each of the two dozen elements around a node, in both ways to compute.
        let tolerance = 1000.0 * f64::EPSILON * largest;
        for i in 0..nodes {
            for a in 0..3 {
                let expected: f64 =
                    (0..nodes).map(|j| (0..3).map(|c| matrix[i][j][a][c] * x[j][c]).sum::<f64>()).sum();
                assert!((Kx[i][a] - expected).abs() <= tolerance, "{} for {expected}, {filter:?}", Kx[i][a]);
                for c in 0..3 {
                    let (found, expected) = (diagonal[i][a][c], matrix[i][i][a][c]);
                    assert!((found - expected).abs() <= tolerance, "{found} for {expected}, {filter:?}");
                }
            }
        }
        // Errors of the products average out in the sums over the nodes.
        assert!((dot(&x, &Ky) - dot(&y, &Kx)).abs() <= tolerance * (nodes as f64).sqrt(), "{filter:?}");
    }
}

#[test]
fn products_and_diagonal_are_those_of_the_assembled_matrix() {
    check_against_matrix(KIRCHHOFF, 0.01);
    check_against_matrix(NEO_HOOKEAN, 0.005);
    check_against_matrix(BY_INVARIANTS, 0.005);
    check_against_matrix(ROTATED, 0.01);
    // Moved by more than their size: many elements are inverted.
    check_against_matrix(KIRCHHOFF, 0.2);
    check_against_matrix(ROTATED, 0.2);
}

#[test]
fn products_have_the_same_bits_for_any_number_of_threads() {
    // Enough tiles and nodes for three threads to share.
    let mesh = beam(200);
    let body = Body::new(&mesh, KIRCHHOFF, 1000.0).expect("a body");
    let positions = shake(&mut Random::new(3), &mesh.positions, 0.02);
    let x = random_vectors(&mut Random::new(4), positions.len());
    let all = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let mut operator = StiffnessOperator::new(&body);
            let survey = operator.linearise(&body, &positions, Filter::Clamp).expect("as many nodes");
            let mut product = vec![[0.0; 3]; x.len()];
            let mut diagonal = vec![[[0.0; 3]; 3]; x.len()];
            operator.multiply(&x, &mut product).expect("as many nodes");
            operator.diagonal_blocks(&mut diagonal).expect("as many nodes");
            let numbers = product.as_flattened().iter().chain(diagonal.as_flattened().as_flattened());
            (survey, numbers.map(|number| number.to_bits()).collect::<Vec<u64>>())
        })
    };
    let one = all(1);
    assert!(one.0.filtered > 0);
    assert!(one == all(2) && one == all(3));
}

#[test]
fn a_survey_names_the_first_element_outside_the_domain() {
    let mesh = beam(20);
    let body = Body::new(&mesh, NEO_HOOKEAN, 1000.0).expect("a body");
    let mut positions = mesh.positions.clone();
    let mut operator = StiffnessOperator::new(&body);
    // The last node is in the last cell only, of which it turns two or more elements inside out.
    positions[83] = [1.0, 0.0, 0.0];
    let survey = operator.linearise(&body, &positions, Filter::Clamp).expect("as many nodes");
    // Some are flat, in a coordinate plane: a row of F is zero, and so is its determinant.
    let is_inverted = |e: &usize| determinant(&body.elements()[*e].deformation_gradient(&positions)) <= 0.0;
    let inverted: Vec<usize> = (0..120).filter(is_inverted).collect();
    assert!(survey.refused >= 1 && survey.refused == inverted.len());
    assert_eq!(survey.first, inverted.first().copied());
}

#[test]
fn lengths_that_do_not_fit_are_errors() {
    let body = Body::new(&beam(1), KIRCHHOFF, 1000.0).expect("a body");
    let other = Body::new(&beam(2), KIRCHHOFF, 1000.0).expect("a body");
    let mut operator = StiffnessOperator::new(&body);
    let error = operator.multiply(&[[0.0; 3]; 7], &mut [[0.0; 3]; 8]).unwrap_err();
    assert_eq!((error.slice, error.found, error.points), ("x", 21, 8));
    assert_eq!(operator.multiply(&[[0.0; 3]; 8], &mut [[0.0; 3]; 9]).unwrap_err().slice, "product");
    assert_eq!(operator.diagonal_blocks(&mut []).unwrap_err().slice, "blocks");
    assert_eq!(operator.linearise(&body, &[], Filter::None).unwrap_err().slice, "positions");
    assert_eq!(operator.linearise(&other, body.rest(), Filter::None).unwrap_err().slice, "elements");
}
