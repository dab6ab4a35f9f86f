//! Rigid motions that pins, springs and gravity leave to a body.

use crate::step::simulation::Simulation;

/// Share of the body's size above which a motion moves a held point too far.
const HELD: f64 = 1e-6;

/// Share of its parts below which a motion counts as zero: a turn of a body in one line or point about it.
const NO_MOTION: f64 = 1e-9;

/// Motions of the free nodes that deform nothing and change no energy, three entries for each node,
/// orthonormal: those rigid motions that leave pinned nodes and the ends of springs in place. Gravity lets
/// bodies turn about its own direction only.
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
    // Components of a point's motion by translations along the axes, and by turns about them.
    let six = |x: [f64; 3]| -> [[f64; 6]; 3] {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|c| (x[c] - centre[c]) / size);
        [[1.0, 0.0, 0.0, 0.0, z, -y], [0.0, 1.0, 0.0, -z, 0.0, x], [0.0, 0.0, 1.0, y, -x, 0.0]]
    };
    let mut left: Vec<[f64; 6]> = (0..6).map(|k| std::array::from_fn(|c| f64::from(c == k))).collect();
    let pinned = simulation.pinned().iter().map(|&node| positions[node]);
    let sprung = simulation.springs().iter().filter(|spring| spring.stiffness > 0.0);
    for point in pinned.chain(sprung.map(|spring| spring.anchor.position(positions))) {
        six(point).iter().for_each(|component| forbid(&mut left, component));
    }
    // Gravity resists a turn that is not about its direction.
    let [x, y, z] = simulation.settings().gravity;
    let length = x.hypot(y).hypot(z);
    if length > 0.0 {
        let [x, y, z] = [x, y, z].map(|g| g / length);
        // The three components of a turn across gravity, of which two are independent.
        for across in [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]] {
            forbid(&mut left, &[0.0, 0.0, 0.0, across[0], across[1], across[2]]);
        }
    }
    let mut motions: Vec<Vec<f64>> = Vec::new();
    for weights in left {
        let at = |&node: &usize| six(positions[node]).map(|component| dot(&component, &weights));
        let mut motion: Vec<f64> = free.iter().flat_map(at).collect();
        // Twice: the second time removes the rounding errors of the first.
        for other in motions.iter().chain(&motions) {
            let share = dot(other, &motion);
            motion.iter_mut().zip(other).for_each(|(entry, part)| *entry -= share * part);
        }
        let length = dot(&motion, &motion).sqrt();
        if length > NO_MOTION * (free.len() as f64).sqrt() {
            motion.iter_mut().for_each(|x| *x /= length);
            motions.push(motion);
        }
    }
    motions
}

/// Reduces an orthonormal basis of motions to those with a zero component: Householder's reflection turns the
/// basis such that the first motion has the whole component, and the first is left out.
fn forbid(basis: &mut Vec<[f64; 6]>, component: &[f64; 6]) {
    let shares: Vec<f64> = basis.iter().map(|motion| dot(motion, component)).collect();
    let length = dot(&shares, &shares).sqrt();
    if length <= HELD {
        return;
    }
    let mut normal = shares;
    normal[0] += length.copysign(normal[0]);
    let square = dot(&normal, &normal);
    let sum: [f64; 6] = std::array::from_fn(|c| basis.iter().zip(&normal).map(|(m, n)| m[c] * n).sum());
    for (motion, n) in basis.iter_mut().zip(&normal) {
        (0..6).for_each(|c| motion[c] -= 2.0 * n / square * sum[c]);
    }
    basis.remove(0);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
