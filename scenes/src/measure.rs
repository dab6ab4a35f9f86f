//! Volumes, stretches and distances of a body from rest.
//!
//! \[Horn87\] Horn, *Closed-form solution of absolute orientation using unit quaternions*, 1987.

use std::collections::HashSet;

use nalgebra::{Matrix3, Matrix4, Quaternion, UnitQuaternion, Vector3};
use piola_bodies::mesh::TetMesh;

/// Bound of det F of a flat tetrahedron: coordinates of a few edge lengths give it an error of some thousand
/// roundings at most.
const FLAT: f64 = 1e-12;

type Point = Vector3<f64>;

/// The smallest det F of all tetrahedra.
#[must_use]
pub fn min_det_f(rest: &[[f64; 3]], positions: &[[f64; 3]], tets: &[[usize; 4]]) -> f64 {
    dets(rest, positions, tets).fold(f64::INFINITY, f64::min)
}

/// Number of tetrahedra that are inside out: det F < 0, by more than the rounding errors of a flat one.
#[must_use]
pub fn inverted(rest: &[[f64; 3]], positions: &[[f64; 3]], tets: &[[usize; 4]]) -> usize {
    dets(rest, positions, tets).filter(|&det| det < -FLAT).count()
}

/// det F of each tetrahedron: its volume as a share of that at rest.
fn dets(rest: &[[f64; 3]], positions: &[[f64; 3]], tets: &[[usize; 4]]) -> impl Iterator<Item = f64> {
    tets.iter().map(|tet| volume(positions, tet) / volume(rest, tet))
}

/// The volume of a tetrahedron, m³; negative if it is inside out.
fn volume(nodes: &[[f64; 3]], tet: &[usize; 4]) -> f64 {
    let [a, b, c, d] = tet.map(|node| Point::from(nodes[node]));
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

/// The edges of tetrahedra, each once.
#[must_use]
pub fn edges(tets: &[[usize; 4]]) -> Vec<[usize; 2]> {
    let mut seen = HashSet::new();
    let all = tets.iter().flat_map(|&[a, b, c, d]| [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]);
    all.map(|[one, other]| [one.min(other), one.max(other)]).filter(|&edge| seen.insert(edge)).collect()
}

/// The mean length, m, of the edges of tetrahedra; 0 if there are none.
#[must_use]
pub fn mean_edge_length(nodes: &[[f64; 3]], tets: &[[usize; 4]]) -> f64 {
    let edges = edges(tets);
    let total: f64 = edges.iter().map(|edge| distance(nodes[edge[0]], nodes[edge[1]])).sum();
    total / edges.len().max(1) as f64
}

/// Share of a gauge length that its nodes must span: over a shorter one, errors of the solver would look like
/// a stretch.
const LEAST_SPAN: f64 = 0.01;

/// Mean stretch along y of the part of a body that lies at rest between two heights, m: the slope of the
/// straight line that fits its nodes' heights best. `None` if the nodes there are at one height, or if there
/// are none.
#[must_use]
pub fn upright_stretch(rest: &[[f64; 3]], positions: &[[f64; 3]], [low, high]: [f64; 2]) -> Option<f64> {
    let between = || rest.iter().zip(positions).filter(|(rest, _)| low <= rest[1] && rest[1] <= high);
    let ends = between().fold([high, low], |[low, high], (rest, _)| [low.min(rest[1]), high.max(rest[1])]);
    if ends[1] - ends[0] < LEAST_SPAN * (high - low) {
        return None;
    }
    let count = between().count() as f64;
    let mean = between().fold([0.0; 2], |[x, y], (rest, now)| [x + rest[1] / count, y + now[1] / count]);
    let moments = between().fold([0.0; 2], |[xx, xy], (rest, now)| {
        let (x, y) = (rest[1] - mean[0], now[1] - mean[1]);
        [xx + x * x, xy + x * y]
    });
    Some(moments[1] / moments[0])
}

/// The largest distance of a point from where it is at rest, m.
#[must_use]
pub fn max_distance(rest: &[[f64; 3]], positions: &[[f64; 3]]) -> f64 {
    rest.iter().zip(positions).map(|(&rest, &position)| distance(position, rest)).fold(0.0, f64::max)
}

/// The largest distance of a node from rest in body heights, after the best rigid motion if fewer than three
/// nodes are pinned.
#[must_use]
pub fn distance_from_rest(mesh: &TetMesh, positions: &[[f64; 3]], pinned: usize) -> f64 {
    let distance = if pinned < 3 {
        max_distance(&mesh.positions, &aligned(&mesh.positions, positions))
    } else {
        max_distance(&mesh.positions, positions)
    };
    distance / mesh.bounds().size()[1]
}

/// The mean distance between points of the same index, m; 0 if one side has none.
#[must_use]
pub fn mean_distance(before: &[[f64; 3]], after: &[[f64; 3]]) -> f64 {
    let distances = before.iter().zip(after).map(|(&one, &other)| distance(one, other));
    distances.sum::<f64>() / before.len().max(1) as f64
}

fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    (Point::from(one) - Point::from(other)).norm()
}

/// The positions after the rotation and translation that bring them closest to rest, in the least-squares
/// sense.
///
/// With centred rest points qᵢ and centred positions pᵢ, the rotation that maximises Σ qᵢ·R pᵢ is the unit
/// quaternion that belongs to the largest eigenvalue of a symmetric 4 × 4 matrix [Horn87 §4A]. It is a proper
/// rotation even for flat or reflected points.
#[must_use]
pub fn aligned(rest: &[[f64; 3]], positions: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let centre = |points: &[[f64; 3]]| {
        points.iter().map(|&point| Point::from(point)).sum::<Point>() / points.len().max(1) as f64
    };
    let (rest_centre, centre) = (centre(rest), centre(positions));
    let mut m = Matrix3::zeros();
    for (&q, &p) in rest.iter().zip(positions) {
        m += (Point::from(p) - centre) * (Point::from(q) - rest_centre).transpose();
    }
    let axis = Vector3::new(m.m23 - m.m32, m.m31 - m.m13, m.m12 - m.m21);
    let rest_block = m + m.transpose() - Matrix3::identity() * m.trace();
    let mut n = Matrix4::zeros();
    n.m11 = m.trace();
    n.fixed_view_mut::<1, 3>(0, 1).copy_from(&axis.transpose());
    n.fixed_view_mut::<3, 1>(1, 0).copy_from(&axis);
    n.fixed_view_mut::<3, 3>(1, 1).copy_from(&rest_block);
    let eigen = n.symmetric_eigen();
    let q = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
    positions.iter().map(|&p| (rotation * (Point::from(p) - centre) + rest_centre).into()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 3]; 5] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [1.0, 1.0, 1.0]];
    /// A few dozen roundings of numbers of order 3.
    const TOLERANCE: f64 = 1e-14;

    #[test]
    fn a_rigid_motion_is_no_distance() {
        let turn = UnitQuaternion::from_euler_angles(2.0, -0.7, 1.1);
        let moved = POINTS.map(|p| (turn * Point::from(p) + Point::new(5.0, -1.0, 2.0)).into());
        assert!(max_distance(&POINTS, &moved) > 1.0);
        let distance = max_distance(&POINTS, &aligned(&POINTS, &moved));
        assert!(distance < TOLERANCE, "{distance:e}");
    }

    #[test]
    fn a_reflection_is_not_undone() {
        let reflected = POINTS.map(|[x, y, z]| [x, y, -z]);
        assert!(max_distance(&POINTS, &aligned(&POINTS, &reflected)) > 0.3);
        assert_eq!(min_det_f(&POINTS, &reflected, &[[0, 1, 2, 3]]), -1.0);
    }

    #[test]
    fn edges_are_counted_once_and_volumes_signed() {
        let tets = [[0, 1, 2, 4], [1, 0, 2, 3]];
        // 0–1, 0–2, 0–4, 1–2, 1–4, 2–4 and 0–3, 1–3, 2–3.
        let lengths: [f64; 9] = [1.0, 4.0, 3.0, 5.0, 2.0, 3.0, 9.0, 10.0, 13.0];
        let mean = lengths.iter().map(|square| square.sqrt()).sum::<f64>() / 9.0;
        assert!((mean_edge_length(&POINTS, &tets) - mean).abs() < TOLERANCE);
        assert_eq!(mean_edge_length(&POINTS, &[]), 0.0);
        assert_eq!(volume(&POINTS, &[0, 1, 2, 3]), 1.0);
        let reflected = POINTS.map(|[x, y, z]| [-x, y, z]);
        assert_eq!(inverted(&POINTS, &reflected, &tets), 2);
        assert_eq!(inverted(&POINTS, &POINTS, &tets), 0);
    }

    #[test]
    fn the_stretch_is_that_between_the_heights() {
        let rest = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 3.0, 0.0]];
        let now = rest.map(|[x, y, z]| [x, 5.0 - 3.0 * y, z]);
        assert_eq!(upright_stretch(&rest, &now, [0.5, 2.5]), Some(-3.0));
        assert_eq!(upright_stretch(&rest, &now, [0.5, 1.5]), None, "a single height");
        assert_eq!(upright_stretch(&rest, &now, [1.25, 1.75]), None, "no node");
        // Heights that differ by rounding are one.
        let rounded = [[0.0, 0.1 + 0.2, 0.0], [1.0, 0.3, 0.0], [2.0, 0.3, 0.0]];
        assert_eq!(upright_stretch(&rounded, &rounded, [0.0, 1.0]), None);
    }

    #[test]
    fn a_bent_body_keeps_its_distance() {
        let mut bent = POINTS;
        bent[4][1] += 0.5;
        let distance = max_distance(&POINTS, &aligned(&POINTS, &bent));
        // At least half of the shift remains under any rotation: the other points hold it back.
        assert!((0.2..0.5).contains(&distance), "{distance}");
        assert_eq!(max_distance(&POINTS, &bent), 0.5);
    }
}
