use piola::__private::random::Random;
use piola::point::Filter;

use super::*;
use crate::mesh::tetrahedral_box;
use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::linear::conjugate_gradients::{ConjugateGradients, End, Iteration};
use crate::system::nodal_stiffness::NodalStiffness;
use crate::system::testing::{kirchhoff, shake};

/// Stiffness of a cube with a number of cells along an edge, with nodes at `deform` of their rest positions;
/// also the free nodes, and all positions.
fn cube(
    cells: usize,
    filter: Filter,
    deform: impl Fn([f64; 3]) -> [f64; 3],
) -> (NodalStiffness, Vec<bool>, Vec<[f64; 3]>) {
    let mesh = tetrahedral_box([cells; 3], [1.0; 3]).expect("a box");
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    let positions: Vec<_> = mesh.positions.iter().map(|&x| deform(x)).collect();
    let mut elastic = Elastic::new(&body);
    elastic.evaluate(&body, &positions);
    let mut stiffness = NodalStiffness::of_body(&body).expect("small");
    stiffness.linearise(&body, &mut elastic, filter);
    (stiffness, mesh.positions.iter().map(|x| x[0] > 1e-9).collect(), positions)
}

type Levels = Multigrid<Undivided, <Undivided as Division>::Last>;

/// Solves a system with a random right side that is zero at pinned nodes.
fn solve(stiffness: &NodalStiffness, multigrid: &Levels, is_free: &[bool], tolerance: f64) -> Iteration {
    let mut random = Random::new(5);
    let free = |is_free: &bool| [0; 3].map(|_| f64::from(*is_free) * random.uniform(-1.0, 1.0));
    let mut b: Vec<[f64; 3]> = is_free.iter().map(free).collect();
    let (mut matrix, mut multigrid) = (stiffness.matrix().clone(), multigrid.clone());
    let apply = |x: &[f64], product: &mut [f64]| {
        let product = product.as_chunks_mut().0;
        matrix.multiply(x.as_chunks().0, product);
        for (product, is_free) in product.iter_mut().zip(is_free) {
            if !is_free {
                *product = [0.0; 3];
            }
        }
    };
    let precondition =
        |r: &[f64], z: &mut [f64]| multigrid.solve(&mut Undivided, r.as_chunks().0, z.as_chunks_mut().0);
    let mut memory = ConjugateGradients::new(3 * b.len());
    memory.solve(apply, precondition, b.as_flattened_mut(), tolerance, 300)
}

fn set_up(stiffness: &NodalStiffness, is_free: &[bool], positions: &[[f64; 3]]) -> Levels {
    let diagonals = diagonals(stiffness.matrix(), &mut Undivided);
    Multigrid::new(stiffness.matrix(), &diagonals, is_free, positions, &mut Undivided)
        .expect("a matrix of finite entries")
}

#[test]
fn iterations_hardly_grow_with_the_body() {
    let iterations = |cells: usize| {
        let (stiffness, is_free, positions) = cube(cells, Filter::Clamp, |x| x);
        let multigrid = set_up(&stiffness, &is_free, &positions);
        let Iteration { iterations, end } = solve(&stiffness, &multigrid, &is_free, 1e-8);
        assert_eq!(end, End::Converged);
        iterations
    };
    let (few, many) = (iterations(5), iterations(15));
    // Block-Jacobi preconditioning needs 90 and 300 iterations.
    assert!(few <= 30 && many as f64 <= 1.5 * few as f64, "{few} iterations, then {many}");
}

/// Levels of a body at rest are less accurate, but useful, after the body has been bent and rotated.
#[test]
fn old_levels_serve_another_matrix() {
    let turn = |[x, y, z]: [f64; 3]| {
        let angle = 0.5 * x;
        [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos(), 1.1 * z]
    };
    let (stiffness, is_free, positions) = cube(8, Filter::Clamp, |x| x);
    let mut multigrid = set_up(&stiffness, &is_free, &positions);
    let (bent, is_free, positions) = cube(8, Filter::Clamp, turn);
    let fresh = solve(&bent, &set_up(&bent, &is_free, &positions), &is_free, 1e-6);
    let diagonals = diagonals(bent.matrix(), &mut Undivided);
    multigrid.take(&mut Undivided, bent.matrix(), &diagonals, &is_free);
    let old = solve(&bent, &multigrid, &is_free, 1e-6);
    assert_eq!((fresh.end, old.end), (End::Converged, End::Converged));
    assert!(old.iterations <= 5 * fresh.iterations, "{fresh:?}, {old:?}");
}

#[test]
fn the_cycle_is_symmetric_and_positive_whatever_the_matrix() {
    // A compressed body has directions of negative curvature.
    let squeezed = |[x, y, z]: [f64; 3]| [0.4 * x, y, z];
    for (filter, deform) in [(Filter::Clamp, (|x| x) as fn([f64; 3]) -> [f64; 3]), (Filter::None, squeezed)] {
        let (stiffness, is_free, positions) = cube(6, filter, deform);
        let positions = shake(&mut Random::new(1), &positions, 1e-3);
        let mut multigrid = set_up(&stiffness, &is_free, &positions);
        let mut random = Random::new(2);
        let mut vector = || -> Vec<[f64; 3]> {
            is_free.iter().map(|free| [0; 3].map(|_| f64::from(*free) * random.uniform(-1.0, 1.0))).collect()
        };
        let dot = |a: &[[f64; 3]], b: &[[f64; 3]]| -> f64 {
            a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
        };
        for _ in 0..5 {
            let (x, y) = (vector(), vector());
            let (mut of_x, mut of_y) = (x.clone(), y.clone());
            multigrid.solve(&mut Undivided, &x, &mut of_x);
            multigrid.solve(&mut Undivided, &y, &mut of_y);
            let scale = (dot(&x, &of_x) * dot(&y, &of_y)).sqrt();
            assert!(scale > 0.0, "not positive");
            // Rounding error of f32 times the condition.
            assert!((dot(&x, &of_y) - dot(&y, &of_x)).abs() <= 1e-3 * scale, "not symmetric");
            assert!(
                of_x.iter().zip(&is_free).all(|(x, is_free)| *is_free || *x == [0.0; 3]),
                "a pinned node moves"
            );
        }
    }
}

#[test]
fn matrices_without_anything_to_aggregate_are_no_exception() {
    let (stiffness, _, positions) = cube(1, Filter::Clamp, |x| x);
    // One free node, without a free neighbour, and no free node.
    for free in [Some(3), None] {
        let is_free: Vec<bool> = (0..positions.len()).map(|node| Some(node) == free).collect();
        let multigrid = set_up(&stiffness, &is_free, &positions);
        assert_eq!(solve(&stiffness, &multigrid, &is_free, 1e-6).end, End::Converged);
    }
    // Without pins the matrix is singular; systems with right sides in its range are solved.
    let all = vec![true; positions.len()];
    let mut multigrid = set_up(&stiffness, &all, &positions);
    let mut z = vec![[f64::NAN; 3]; positions.len()];
    multigrid.solve(&mut Undivided, &vec![[1.0, -1.0, 0.5]; positions.len()], &mut z);
    assert!(z.as_flattened().iter().all(|z| z.is_finite()), "{z:?}");
}
