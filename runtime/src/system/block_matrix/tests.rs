#![expect(non_snake_case, reason = "F as in the literature")]

use super::*;
use crate::batch::{Batch, REST};
use crate::point::Filter;
use crate::random::Random;
use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::testing::{KIRCHHOFF, beam, shake};

/// The numbers of each point in a layout, filled up to whole lines with identities.
fn lay(layout: Layout, numbers: usize, points: &[Vec<f64>]) -> Vec<f64> {
    let count = points.len().next_multiple_of(f64::LINE);
    let mut slice = vec![0.0; numbers * if layout == Layout::Lines { count } else { points.len() }];
    for p in 0..slice.len() / numbers {
        for k in 0..numbers {
            let filling = if k < 9 && k % 4 == 0 { 1.0 } else { 0.0 };
            slice[layout.index::<f64>(p, numbers, k)] = points.get(p).map_or(filling, |point| point[k]);
        }
    }
    slice
}

/// The entries of a shaken and pinned beam, assembled from a batch of this layout.
fn assembled(layout: Layout, packed: bool) -> Vec<f64> {
    // 126 elements: the last line is not full.
    let mesh = beam(21);
    let body = Body::new(&mesh, KIRCHHOFF, 1000.0).expect("a body");
    let positions = shake(&mut Random::new(5), &mesh.positions, 0.02);
    let F: Vec<Vec<f64>> = (body.elements().iter())
        .map(|element| element.deformation_gradient(&positions).as_flattened().to_vec())
        .collect();
    let rest: Vec<Vec<f64>> = (body.elements().iter())
        .map(|element| [element.shape.inverse.as_flattened(), &[element.shape.volume]].concat())
        .collect();
    let (F, rest) = (lay(layout, 9, &F), lay(layout, REST, &rest));
    let points = F.len() / 9;
    let batch = Batch::new(&KIRCHHOFF).with_filter(Filter::Clamp).with_layout(layout).with_threads(true);
    let mut gradients = vec![0.0; 12 * points];
    let mut matrix = BlockMatrix::new(positions.len(), &mesh.tets, &Pins::at([5, 17])).expect("small");
    if packed {
        let mut stiffnesses = vec![0.0; 78 * points];
        batch.packed_stiffnesses(&F, &rest, &mut gradients, &mut stiffnesses).expect("lengths fit");
        matrix.assemble_packed(&stiffnesses, layout, |node| node as f64).expect("lengths fit");
    } else {
        let mut stiffnesses = vec![0.0; 144 * points];
        batch.stiffnesses(&F, &rest, &mut gradients, &mut stiffnesses).expect("lengths fit");
        matrix.assemble(&stiffnesses, layout, |node| node as f64).expect("lengths fit");
    }
    matrix.values
}

#[test]
fn a_batch_makes_the_matrix_that_a_body_makes() {
    let mesh = beam(21);
    let body = Body::new(&mesh, KIRCHHOFF, 1000.0).expect("a body");
    let pattern = Pattern::new(mesh.positions.len(), body.elements(), &Pins::at([5, 17])).expect("small");
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &shake(&mut Random::new(5), &mesh.positions, 0.02));
    let mut stiffnesses = ElementStiffnesses::new(&body);
    elastic.linearise(&body, Filter::Clamp, &mut stiffnesses);
    let mut expected = vec![0.0; pattern.entries().row_idx().len()];
    stiffnesses.fill(&pattern, |node| node as f64, &mut expected);
    let largest = expected.iter().fold(0.0f64, |largest, entry| largest.max(entry.abs()));

    let found = assembled(Layout::Points, false);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        // F comes without fused operations here: its rounding, as large as that of what is made of it.
        assert!((found - expected).abs() <= 1000.0 * f64::EPSILON * largest, "{found} for {expected}");
    }
}

#[test]
fn bits_depend_neither_on_form_nor_layout_nor_threads() {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let expected = pool(1).install(|| assembled(Layout::Points, false));
    for threads in 1..=3 {
        for layout in [Layout::Points, Layout::Lines] {
            for packed in [false, true] {
                let found = pool(threads).install(|| assembled(layout, packed));
                let equal = found.iter().zip(&expected).all(|(a, b)| a.to_bits() == b.to_bits());
                assert!(equal, "{threads} threads, {layout:?}, packed: {packed}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_an_error() {
    let error = BlockMatrix::new(4, &[[0, 1, 2, 4]], &Pins::none()).unwrap_err();
    assert_eq!(error.to_string(), "there is no node 4: the 4 nodes are numbered from 0");
    let error = BlockMatrix::new(4, &[[0, 1, 2, 3]], &Pins::at([7])).unwrap_err();
    assert_eq!(error, LinearError::NoSuchNode { node: 7, nodes: 4 });
    let error = BlockMatrix::new(4, &[[0, 1, 2, 3], [3, 2, 1, 3]], &Pins::none()).unwrap_err();
    assert_eq!(error, LinearError::RepeatedNode { element: 1, node: 3 });
    for nodes in [usize::MAX, usize::MAX / 2, usize::MAX / 64] {
        let error = BlockMatrix::new(nodes, &[[0, 1, 2, 3]], &Pins::none()).unwrap_err();
        assert_eq!(error, LinearError::OutOfMemory, "{nodes} nodes");
    }

    let mut matrix = BlockMatrix::new(4, &[[0, 1, 2, 3]], &Pins::none()).expect("small");
    let error = matrix.assemble(&[0.0; 78], Layout::Points, |_| 0.0).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`stiffnesses` has 78 entries; 1 points of 144 entries each would make 144"
    );
    let error = matrix.assemble_packed(&[0.0; 78], Layout::Lines, |_| 0.0).unwrap_err();
    assert_eq!((error.points, error.group), (8, 8));
}

/// A node of no tetrahedron, before, among and after the others, and none at all.
#[test]
fn nodes_of_no_tetrahedron_have_the_diagonal_to_themselves() -> Result<(), Box<dyn std::error::Error>> {
    for (nodes, tets) in [(5, &[[0, 1, 2, 3]][..]), (5, &[[0, 1, 3, 4]]), (5, &[[1, 2, 3, 4]]), (3, &[])] {
        let mut matrix = BlockMatrix::new(nodes, tets, &Pins::none())?;
        let pattern = matrix.pattern().clone();
        let mut cholesky = crate::system::Cholesky::new(pattern.column_starts(), pattern.row_indices())?;
        // Each tetrahedron as a unit matrix, so that one that it joins has 1 on the diagonal.
        let stiffness: Vec<f64> = (0..144).map(|k| if k % 13 == 0 { 1.0 } else { 0.0 }).collect();
        let stiffnesses = stiffness.repeat(tets.len());

        matrix.assemble(&stiffnesses, Layout::Points, |_| 0.0)?;
        let error = cholesky.factor(matrix.values()).unwrap_err();
        let LinearError::NotPositive { column } = error else { panic!("{error}") };
        let lonely = pattern.node_of_free()[column / 3];
        assert!(!tets.as_flattened().contains(&lonely), "node {lonely} of {tets:?}");

        matrix.assemble(&stiffnesses, Layout::Points, |node| 1.0 + node as f64)?;
        cholesky.factor(matrix.values())?;
        let mut x: Vec<f64> = vec![1.0; pattern.unknowns()];
        cholesky.solve(&mut x)?;
        for (free, &node) in pattern.node_of_free().iter().enumerate() {
            let of_tet = if tets.as_flattened().contains(&node) { 1.0 } else { 0.0 };
            // A quotient, as its root twice: three roundings.
            let expected = 1.0 / (1.0 + node as f64 + of_tet);
            assert!((x[3 * free] - expected).abs() <= 4.0 * f64::EPSILON, "node {node} of {tets:?}");
        }
        let pinned = BlockMatrix::new(nodes, tets, &Pins::at([lonely]))?;
        assert_eq!(pinned.pattern().unknowns(), pattern.unknowns() - 3);
    }
    Ok(())
}
