use piola::__private::random::Random;
use piola::point::Filter;

use super::*;
use crate::system::Cholesky;
use crate::system::assemble::Elastic;
use crate::system::element::tests::to_matrix;
use crate::system::testing::{beam, kirchhoff, shake};
use crate::system::{Body, ElasticResponse};

/// The stiffness of a beam shaken by up to this amplitude.
fn stiffness(body: &Body, amplitude: f64) -> NodalStiffness {
    let positions = shake(&mut Random::new(1), body.rest(), amplitude);
    let mut stiffness = NodalStiffness::of_body(body).expect("small");
    let mut gradient = vec![[0.0; 3]; positions.len()];
    let mut response = ElasticResponse::new(body);
    response.energy(body, &positions).expect("lengths");
    let survey = response.stiffness_here(body, Filter::None, &mut gradient, &mut stiffness);
    assert!(survey.expect("lengths").is_clean());
    stiffness
}

/// The whole matrix, both triangles of it.
fn dense(matrix: &LowerTriangle) -> Vec<Vec<f64>> {
    let unknowns = 3 * matrix.free_nodes().len();
    let mut dense = vec![vec![0.0; unknowns]; unknowns];
    for column in 0..unknowns {
        for at in matrix.column_starts()[column]..matrix.column_starts()[column + 1] {
            let row = matrix.row_indices()[at];
            dense[row][column] = matrix.values()[at];
            dense[column][row] = matrix.values()[at];
        }
    }
    dense
}

/// The matrix of a shaken beam with two pinned nodes: dense by plain scattering, sparse by gathering.
#[test]
fn gathering_gives_what_scattering_gives() {
    let body = Body::new(&beam(30), kirchhoff(), 1000.0).expect("a body");
    let mut matrix = LowerTriangle::new(&stiffness(&body, 0.0), &Pins::at([5, 17])).expect("small");
    matrix.fill(&stiffness(&body, 0.01), |node| node as f64).expect("the same mesh");

    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &shake(&mut Random::new(1), body.rest(), 0.01));
    let mut kept = NodalStiffness::new(&body, &[], true).expect("small");
    kept.linearise(&body, &mut elastic, Filter::None);
    let unknowns = 3 * (body.rest().len() - 2);
    assert_eq!(matrix.free_nodes().len(), body.rest().len() - 2);
    let mut expected = vec![vec![0.0; unknowns]; unknowns];
    for (element, stiffness) in kept.of_elements(&body) {
        let of_element = to_matrix(stiffness);
        let free = element.nodes.map(|node| matrix.free_nodes().iter().position(|&other| other == node));
        for row in 0..12 {
            for column in 0..12 {
                if let (Some(i), Some(j)) = (free[row / 3], free[column / 3]) {
                    expected[3 * i + row % 3][3 * j + column % 3] += of_element[row][column];
                }
            }
        }
    }
    for (unknown, row) in expected.iter_mut().enumerate() {
        row[unknown] += matrix.free_nodes()[unknown / 3] as f64;
    }
    let found = dense(&matrix);
    for row in 0..unknowns {
        for column in 0..=row {
            // The same sums, to the bit.
            let (found, expected) = (found[row][column], expected[row][column]);
            assert_eq!(found, expected, "entry {row}, {column}");
        }
    }
    let starts = matrix.column_starts().iter().zip(&matrix.column_starts()[1..]);
    let rows_of = starts.map(|(&start, &end)| &matrix.row_indices()[start..end]);
    for (column, rows) in rows_of.enumerate() {
        assert!(rows[0] == column && rows.is_sorted_by(|a, b| a < b), "column {column}");
    }
}

#[test]
fn a_factor_solves_the_system_it_was_made_from() {
    let body = Body::new(&beam(10), kirchhoff(), 1000.0).expect("a body");
    let stiffness = stiffness(&body, 0.0);
    let mut matrix = LowerTriangle::new(&stiffness, &Pins::at([0, 1, 2, 3])).expect("small");
    let mut cholesky = Cholesky::new(matrix.column_starts(), matrix.row_indices()).expect("small");
    let mut random = Random::new(2);
    for diagonal in [1.0e3, 1.0e6] {
        matrix.fill(&stiffness, |_| diagonal).expect("the same mesh");
        cholesky.factor(matrix.values()).expect("positive definite");
        let exact: Vec<f64> = (0..3 * matrix.free_nodes().len()).map(|_| random.uniform(-1.0, 1.0)).collect();
        let mut b: Vec<f64> =
            dense(&matrix).iter().map(|row| row.iter().zip(&exact).map(|(a, x)| a * x).sum()).collect();
        let mut product = vec![f64::NAN; b.len()];
        matrix.multiply(&exact, &mut product).expect("lengths");
        let largest = b.iter().fold(0.0, |largest: f64, b| largest.max(b.abs()));
        // Sums of some fifty terms, in different orders, which cancel.
        assert!(product.iter().zip(&b).all(|(product, b)| (product - b).abs() <= 1e-13 * largest));
        cholesky.solve(&mut b);
        for (found, expected) in b.iter().zip(&exact) {
            // Condition about 10⁴ (stiffness of ten cells over the shift), times n u.
            assert!((found - expected).abs() <= 1e-9, "{found} for {expected}");
        }
    }
    matrix.fill(&stiffness, |_| -1.0e9).expect("the same mesh");
    assert!(matrix.diagonal().all(|entry| entry < 0.0));
    let error = cholesky.factor(matrix.values()).expect_err("negative");
    assert!(
        error.to_string().starts_with("the matrix is not positive definite (pivot of column "),
        "{error}"
    );
}

/// Blocks of either order of nodes and on the diagonal, and of a pinned node; then a node is held.
#[test]
fn blocks_are_added_to_both_triangles_and_held_nodes_stand_alone() {
    let body = Body::new(&beam(2), kirchhoff(), 1000.0).expect("a body");
    let stiffness = stiffness(&body, 0.01);
    let mut matrix = LowerTriangle::new(&stiffness, &Pins::at([3])).expect("small");
    matrix.fill(&stiffness, |_| 0.0).expect("the same mesh");
    let before = dense(&matrix);
    let block = [[1.0, 2.0, 4.0], [8.0, 16.0, 32.0], [64.0, 128.0, 256.0]];
    let symmetric = [[1.0, 2.0, 4.0], [2.0, 16.0, 32.0], [4.0, 32.0, 256.0]];
    // Nodes 0 and 11 share no element.
    for (row, column, block) in
        [(4, 5, &block), (7, 6, &block), (5, 5, &symmetric), (3, 5, &block), (0, 11, &block)]
    {
        matrix.add_block(row, column, block);
    }
    let after = dense(&matrix);
    let at = |node: usize| 3 * matrix.free_nodes().iter().position(|&other| other == node).expect("free");
    let mut expected = before;
    for (row, column, block) in [(4, 5, &block), (7, 6, &block), (5, 5, &symmetric)] {
        for r in 0..3 {
            for c in 0..3 {
                let (i, j) = (at(row) + r, at(column) + c);
                expected[i][j] += block[r][c];
                if row != column {
                    expected[j][i] += block[r][c];
                }
            }
        }
    }
    assert_eq!(after, expected);

    let held = at(5) / 3;
    let is_held: Vec<bool> = (0..matrix.free_nodes().len()).map(|free| free == held).collect();
    matrix.hold(&is_held);
    for (i, row) in dense(&matrix).iter().enumerate() {
        for (j, &entry) in row.iter().enumerate() {
            let unit = if i == j { 1.0 } else { 0.0 };
            let is_apart = i / 3 == held || j / 3 == held;
            assert_eq!(entry, if is_apart { unit } else { expected[i][j] });
        }
    }
}

#[test]
fn what_does_not_fit_is_an_error() {
    let [small, large] = [1, 2].map(|cells| {
        let body = Body::new(&beam(cells), kirchhoff(), 1000.0).expect("a body");
        NodalStiffness::of_body(&body).expect("small")
    });
    let error = LowerTriangle::new(&small, &Pins::at([9])).expect_err("eight nodes");
    assert_eq!(error, LinearError::NoSuchNode(NoSuchNode { element: None, node: 9, nodes: 8 }));
    assert_eq!(error.to_string(), "there is no node 9: the 8 nodes are numbered from 0");
    let mut matrix = LowerTriangle::new(&small, &Pins::none()).expect("small");
    let error = LinearError::Length { slice: "stiffness", found: large.len(), expected: small.len() };
    assert_eq!(matrix.fill(&large, |_| 0.0), Err(error));
    let mut product = [0.0; 24];
    assert!(matrix.multiply(&[1.0; 23], &mut product).is_err());
    assert!(matrix.multiply(&[1.0; 24], &mut product[1..]).is_err());
}
