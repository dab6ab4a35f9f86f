use super::*;
use crate::random::Random;
use crate::system::Pins;
use crate::system::element::tests::to_matrix;
use crate::system::linear::Cholesky;
use crate::system::pattern::Pattern;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::testing::{KIRCHHOFF, beam, shake};
use faer::sparse::SparseColMatRef;

/// The matrix of a shaken beam with two pinned nodes: dense by plain scattering, sparse by gathering.
#[test]
fn gathering_gives_what_scattering_gives() {
    let mesh = beam(30);
    let body = Body::new(&mesh, KIRCHHOFF, 1000.0).expect("a body");
    let pins = Pins::at([5, 17]);
    let pattern = Pattern::new(mesh.positions.len(), body.elements(), &pins).expect("small");
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &shake(&mut Random::new(1), &mesh.positions, 0.01));
    let mut stiffnesses = ElementStiffnesses::new(&body);
    elastic.linearise(&body, Filter::None, &mut stiffnesses);
    let mut values = vec![f64::NAN; pattern.entries().row_idx().len()];
    stiffnesses.fill(&pattern, |node| node as f64, &mut values);

    let unknowns = pattern.unknowns();
    assert_eq!(unknowns, 3 * (mesh.positions.len() - 2));
    let mut dense = vec![vec![0.0; unknowns]; unknowns];
    for (element, stiffness) in body.elements().iter().zip(stiffnesses.of_elements()) {
        let matrix = to_matrix(stiffness);
        let free = element.nodes.map(|node| pattern.free_of_node()[node]);
        for row in 0..12 {
            for column in 0..12 {
                if let (Some(i), Some(j)) = (free[row / 3], free[column / 3]) {
                    dense[3 * i + row % 3][3 * j + column % 3] += matrix[row][column];
                }
            }
        }
    }
    for (unknown, row) in dense.iter_mut().enumerate() {
        row[unknown] += pattern.node_of_free()[unknown / 3] as f64;
    }
    let sparse = SparseColMatRef::new(pattern.entries(), &values[..]).to_dense();
    for row in 0..unknowns {
        for column in 0..=row {
            // The same sums, but for the place of the diagonal in their order.
            let (found, expected) = (sparse[(row, column)], dense[row][column]);
            assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "entry {row}, {column}");
        }
        for column in row + 1..unknowns {
            assert_eq!(sparse[(row, column)], 0.0, "the upper triangle is not stored");
        }
    }
}

#[test]
fn a_factor_solves_the_system_it_was_made_from() {
    let mesh = beam(10);
    let body = Body::new(&mesh, KIRCHHOFF, 1000.0).expect("a body");
    let pattern =
        Pattern::new(mesh.positions.len(), body.elements(), &Pins::at([0, 1, 2, 3])).expect("small");
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &mesh.positions);
    let mut stiffnesses = ElementStiffnesses::new(&body);
    elastic.linearise(&body, Filter::None, &mut stiffnesses);
    let mut values = vec![0.0; pattern.entries().row_idx().len()];
    let mut cholesky = Cholesky::new(pattern.column_starts(), pattern.row_indices()).expect("small");
    let mut random = Random::new(2);
    for diagonal in [1.0e3, 1.0e6] {
        stiffnesses.fill(&pattern, |_| diagonal, &mut values);
        let matrix = SparseColMatRef::new(pattern.entries(), &values[..]);
        cholesky.factor(&values).expect("positive definite");
        let exact: Vec<f64> = (0..pattern.unknowns()).map(|_| random.uniform(-1.0, 1.0)).collect();
        let lower = matrix.to_dense();
        let entry = |i: usize, j: usize| if i >= j { lower[(i, j)] } else { lower[(j, i)] };
        let mut b: Vec<f64> =
            (0..exact.len()).map(|i| (0..exact.len()).map(|j| entry(i, j) * exact[j]).sum()).collect();
        cholesky.solve(&mut b).expect("a factor");
        for (found, expected) in b.iter().zip(&exact) {
            // Condition about 10⁴ (stiffness of ten cells over the shift), times n u.
            assert!((found - expected).abs() <= 1e-9, "{found} for {expected}");
        }
    }
    stiffnesses.fill(&pattern, |_| -1.0e9, &mut values);
    let error = cholesky.factor(&values).expect_err("negative");
    assert!(
        error.to_string().starts_with("the matrix is not positive definite (pivot of column "),
        "{error}"
    );
}

#[test]
fn compensation_keeps_what_a_plain_sum_loses() {
    let sum: Compensated = [1.0, 1e100, 1.0, -1e100].into_iter().collect();
    assert_eq!(sum.value(), 2.0);
}

#[test]
fn groups_hold_elements_of_one_material() {
    let mut mesh = beam(4);
    let group = |name: &str, tets: Range<usize>| crate::mesh::Group {
        name: name.to_owned(),
        dimension: 3,
        nodes: Vec::new(),
        tets: tets.collect(),
    };
    mesh.groups = vec![group("left", 0..7), group("middle", 7..9)];
    let part = |group: Option<&str>, density| crate::system::Part {
        group: group.map(str::to_owned),
        material: Box::new(KIRCHHOFF),
        density,
    };
    let parts = vec![part(Some("middle"), 1.0), part(Some("left"), 2.0), part(None, 4.0)];
    let body = Body::from_parts(&mesh, parts).expect("a body");
    let tags: Vec<usize> = body.elements().iter().map(|element| element.tag).collect();
    assert_eq!(tags[..3], [8, 9, 1]);
    let ranges: Vec<_> = body.groups().map(|(_, range)| range).collect();
    assert_eq!(ranges, [0..2, 2..9, 9..24]);
    let long = Body::new(&beam(30), KIRCHHOFF, 1.0).expect("a body");
    let ranges: Vec<_> = long.groups().map(|(_, range)| range).collect();
    assert_eq!(ranges, [0..64, 64..128, 128..180]);
    // A sixth of a cell for each tetrahedron.
    let total: f64 = body.masses().iter().sum();
    let expected = (2.0 * 1.0 + 7.0 * 2.0 + 15.0 * 4.0) * 1e-3 / 6.0;
    assert!((total - expected).abs() <= 64.0 * f64::EPSILON * expected);
}

#[test]
fn parts_that_do_not_fit_are_errors() {
    let mut mesh = beam(1);
    let group = |name: &str, tets: &[usize]| crate::mesh::Group {
        name: name.to_owned(),
        dimension: 3,
        nodes: Vec::new(),
        tets: tets.to_vec(),
    };
    mesh.groups = vec![group("skin", &[0, 1]), group("bone", &[1, 2])];
    let part = |name: &str, density| crate::system::Part {
        group: Some(name.to_owned()),
        material: Box::new(KIRCHHOFF),
        density,
    };
    let message = |parts| Body::from_parts(&mesh, parts).expect_err("bad parts").to_string();
    assert_eq!(message(vec![part("skin", 1.0)]), "element 3 has no material: it belongs to no part");
    assert_eq!(
        message(vec![part("skin", 1.0), part("bone", 1.0)]),
        "element 2 has two materials: it belongs to two parts"
    );
    assert_eq!(
        message(vec![part("hair", 1.0)]),
        "there is no group `hair` of tetrahedra; there are: skin, bone"
    );
    let error = Body::new(&mesh, KIRCHHOFF, 0.0).expect_err("no mass");
    assert_eq!(error.to_string(), "the density is 0 kg/m³; it must be positive and finite");
    for (density, word) in [(1e-308, "underflows"), (1e308, "overflows")] {
        let mut large = mesh.clone();
        large
            .positions
            .as_flattened_mut()
            .iter_mut()
            .for_each(|x| *x *= if density > 1.0 { 1e3 } else { 1.0 });
        let message = Body::new(&large, KIRCHHOFF, density).expect_err("masses out of range").to_string();
        assert!(message.starts_with("the mass of node 0 (from 0)") && message.contains(word), "{message}");
    }
}
