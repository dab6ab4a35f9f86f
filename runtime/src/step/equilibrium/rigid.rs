//! The rigid motions that are left to a body.

use nalgebra::{Matrix6, SymmetricEigen};

use crate::step::Simulation;
use crate::system::linear::lanczos::{add, dot, norm};

/// A held point forbids a motion that moves it by more than this share of the body's size.
const HELD: f64 = 1e-6;

/// A motion that is no more than this share of its parts is none: that of a body in one line or point.
const NO_MOTION: f64 = 1e-9;

/// Motions of the free nodes that deform nothing and change no energy, three entries for each node, orthonormal in the inner
/// product of the masses: those of the six that leave pinned nodes and pulled points alone. Gravity lets bodies turn about its
/// own direction only.
pub(super) fn motions(simulation: &Simulation, free: &[usize]) -> Vec<Vec<f64>> {
    let positions = simulation.positions();
    let centre: [f64; 3] =
        std::array::from_fn(|c| positions.iter().map(|x| x[c]).sum::<f64>() / positions.len().max(1) as f64);
    let size = positions
        .iter()
        .flatten()
        .zip(centre.iter().cycle())
        .fold(0.0, |size: f64, (x, c)| size.max((x - c).abs()));
    let size = if size > 0.0 { size } else { 1.0 };
    let gravity = simulation.settings().gravity;
    // Translations along the axes, and turns about them, at a point.
    let six = |x: [f64; 3]| -> [[f64; 3]; 6] {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|c| (x[c] - centre[c]) / size);
        let turns = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], turns[0], turns[1], turns[2]]
    };
    let mut constraints = Matrix6::zeros();
    let pinned = simulation.pinned().iter().map(|&node| positions[node]);
    let pulled = simulation.pulls().iter().filter(|pull| pull.stiffness > 0.0);
    for point in pinned.chain(pulled.map(|pull| pull.anchor.position(positions))) {
        let six = six(point);
        constraints += Matrix6::from_fn(|i, j| (0..3).map(|c| six[i][c] * six[j][c]).sum::<f64>());
    }
    // A turn that gravity resists is one that is not about its direction.
    let weight = gravity.iter().map(|g| g * g).sum::<f64>();
    if weight > 0.0 {
        let across = |i: usize, j: usize| f64::from(i == j) - gravity[i] * gravity[j] / weight;
        constraints
            .fixed_view_mut::<3, 3>(3, 3)
            .iter_mut()
            .enumerate()
            .for_each(|(k, entry)| *entry += across(k % 3, k / 3));
    }
    let eigen = SymmetricEigen::new(constraints);
    let masses: Vec<f64> = free.iter().flat_map(|&node| [simulation.body().masses()[node]; 3]).collect();
    let mut motions: Vec<Vec<f64>> = Vec::new();
    for (value, weights) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if value.abs() > HELD * HELD {
            continue;
        }
        let at = |&node: &usize| {
            let six = six(positions[node]);
            std::array::from_fn::<f64, 3, _>(|c| (0..6).map(|k| weights[k] * six[k][c]).sum())
        };
        let mut motion: Vec<f64> = free.iter().flat_map(at).collect();
        for other in motions.iter().chain(&motions) {
            add(-dot(&masses, other, &motion), other, &mut motion);
        }
        let length = norm(&masses, &motion);
        if length > NO_MOTION * masses.iter().sum::<f64>().sqrt() {
            motion.iter_mut().for_each(|x| *x /= length);
            motions.push(motion);
        }
    }
    motions
}
