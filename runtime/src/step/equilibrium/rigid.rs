//! Rigid motions that pins, springs and gravity leave to a body.

use crate::step::simulation::Simulation;
use crate::system::linear::LinearError;
use crate::system::linear::dense::eigen;
use crate::system::linear::lanczos::{add, dot, norm};

/// Share of the body's size above which a motion moves a held point too far.
const HELD: f64 = 1e-6;

/// Share of its parts below which a motion counts as zero: a turn of a body in one line or point about it.
const NO_MOTION: f64 = 1e-9;

/// Motions of the free nodes that deform nothing and change no energy, three entries for each node,
/// orthonormal in the inner product of the masses: those rigid motions that leave pinned nodes and the ends
/// of springs in place. Gravity lets bodies turn about its own direction only.
///
/// # Errors
/// [`LinearError::NoEigenvalues`] for positions out of all bounds.
pub(super) fn motions(simulation: &Simulation, free: &[usize]) -> Result<Vec<Vec<f64>>, LinearError> {
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
    let mut constraints = [[0.0; 6]; 6];
    let pinned = simulation.pinned().iter().map(|&node| positions[node]);
    let sprung = simulation.springs().iter().filter(|spring| spring.stiffness > 0.0);
    for point in pinned.chain(sprung.map(|spring| spring.anchor.position(positions))) {
        let six = six(point);
        for i in 0..6 {
            for j in 0..6 {
                constraints[i][j] += (0..3).map(|c| six[i][c] * six[j][c]).sum::<f64>();
            }
        }
    }
    // Gravity resists a turn that is not about its direction.
    let weight = gravity.iter().map(|g| g * g).sum::<f64>();
    if weight > 0.0 {
        for i in 0..3 {
            for j in 0..3 {
                constraints[3 + i][3 + j] += f64::from(i == j) - gravity[i] * gravity[j] / weight;
            }
        }
    }
    let (values, vectors) = eigen(6, |i, j| constraints[i][j])?;
    let masses: Vec<f64> = free.iter().flat_map(|&node| [simulation.body().masses()[node]; 3]).collect();
    let mut motions: Vec<Vec<f64>> = Vec::new();
    for (value, weights) in values.iter().zip(&vectors) {
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
    Ok(motions)
}
