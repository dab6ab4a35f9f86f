//! Surfaces that follow the tetrahedra they lie in.

use piola::__private::message::number;
use thiserror::Error;

use super::io::Surface;
use super::tet::{Bounds, RestShape, TetMesh, cross, dot, norm, subtract};

mod tree;

/// Point that moves with a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Anchor {
    /// Nodes of the tetrahedron.
    pub nodes: [usize; 4],
    /// Barycentric coordinates; they add up to 1, and some are negative for a point outside.
    pub weights: [f64; 4],
}

impl Anchor {
    /// Position of the point when the nodes are at `positions`, one for each node of the mesh.
    ///
    /// # Panics
    /// If there is no position of one of its nodes.
    #[must_use]
    pub fn position(&self, positions: &[[f64; 3]]) -> [f64; 3] {
        let mut x = [0.0; 3];
        for (&node, &weight) in self.nodes.iter().zip(&self.weights) {
            for c in 0..3 {
                x[c] += weight * positions[node][c];
            }
        }
        x
    }
}

/// Binds each vertex of a surface to the tetrahedron that contains it at rest, or else to the nearest one.
/// The anchors have the order of the vertices.
///
/// A vertex outside the mesh moves by extrapolation; `tolerance`, m, is its largest distance from the nearest
/// tetrahedron, possibly infinite. Among several tetrahedra that contain a vertex, or are equally near, the
/// first in the mesh is used.
///
/// # Errors
/// [`EmbedError`] for a vertex farther outside, for a position that is not finite, if the tolerance is
/// negative or NaN, or if the mesh is not a body ([`TetMesh::rest_shapes`]).
pub fn embed(mesh: &TetMesh, surface: &Surface, tolerance: f64) -> Result<Vec<Anchor>, EmbedError> {
    if tolerance.is_nan() || tolerance < 0.0 {
        let tolerance = number(tolerance);
        return Err(EmbedError(format!(
            "the largest distance of a surface vertex from the mesh is {tolerance} m; it must not be negative"
        )));
    }
    let shapes = mesh.rest_shapes().map_err(|error| EmbedError(error.to_string()))?;
    let cage = Cage { mesh, shapes: &shapes };
    let boxes = (0..mesh.tets.len()).map(|tet| Bounds::around(&cage.corners(tet)));
    let tree = tree::Tree::new(boxes.collect());
    let anchors = surface.positions.iter().enumerate().map(|(index, &x)| {
        let vertex = index + 1;
        if !x.iter().all(|c| c.is_finite()) {
            let problem = format!("surface vertex {vertex} has a coordinate that is not finite");
            return Err(EmbedError(problem));
        }
        match tree.nearest(x, |tet| cage.distance(tet, x)) {
            Some((distance, tet)) if distance.unwrap_or(0.0) <= tolerance => {
                Ok(Anchor { nodes: mesh.tets[tet], weights: cage.weights(tet, x) })
            }
            nearest => {
                let distance = nearest.map_or(f64::INFINITY, |(distance, _)| distance.unwrap_or(0.0));
                Err(EmbedError(format!(
                    "surface vertex {vertex} lies {distance:.3e} m outside the tetrahedral mesh; at most \
                     {tolerance:.3e} m is allowed"
                )))
            }
        }
    });
    anchors.collect()
}

/// Reason why a surface cannot be embedded, in words. Vertices are counted from 1, as in an OBJ file.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct EmbedError(String);

struct Cage<'a> {
    mesh: &'a TetMesh,
    shapes: &'a [RestShape],
}

impl Cage<'_> {
    /// Barycentric coordinates of a point.
    fn weights(&self, tet: usize, x: [f64; 3]) -> [f64; 4] {
        let from_origin = subtract(x, self.mesh.positions[self.mesh.tets[tet][0]]);
        let [a, b, c] = self.shapes[tet].inverse.map(|row| dot(row, from_origin));
        [1.0 - a - b - c, a, b, c]
    }

    fn corners(&self, tet: usize) -> [[f64; 3]; 4] {
        self.mesh.tets[tet].map(|node| self.mesh.positions[node])
    }

    /// Distance of a point from a tetrahedron; `None` for one that contains it.
    fn distance(&self, tet: usize, x: [f64; 3]) -> Option<f64> {
        let weights = self.weights(tet, x);
        if weights.iter().all(|&weight| weight >= 0.0) {
            return None;
        }
        let corners = self.corners(tet);
        let face = |k: usize| [1, 2, 3].map(|next| corners[(k + next) % 4]);
        // Seen from an outside point the nearest face is one whose opposite weight is negative.
        let seen = (0..4).filter(|&k| weights[k] < 0.0);
        Some(seen.map(|k| distance_to_triangle(x, face(k))).fold(f64::INFINITY, f64::min))
    }
}

/// Distance from a point to a triangle: to its plane if the foot of the perpendicular is inside, else to an
/// edge.
fn distance_to_triangle(x: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let normal = cross(subtract(b, a), subtract(c, a));
    let inside = [[a, b], [b, c], [c, a]]
        .iter()
        .all(|&[from, to]| dot(cross(subtract(to, from), subtract(x, from)), normal) >= 0.0);
    if inside {
        return (dot(subtract(x, a), normal) / norm(normal)).abs();
    }
    let to_edge = |[from, to]: [[f64; 3]; 2]| {
        let (edge, to_x) = (subtract(to, from), subtract(x, from));
        let t = (dot(to_x, edge) / dot(edge, edge)).clamp(0.0, 1.0);
        norm(subtract(to_x, edge.map(|component| t * component)))
    };
    to_edge([a, b]).min(to_edge([b, c])).min(to_edge([c, a]))
}

#[cfg(test)]
mod tests {
    use piola::__private::random::Random;

    use super::*;
    use crate::mesh::tetrahedral_box;

    fn corner() -> TetMesh {
        TetMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], vec![[0, 1, 2, 3]])
    }

    fn points(positions: &[[f64; 3]]) -> Surface {
        Surface { positions: positions.to_vec(), triangles: Vec::new() }
    }

    #[test]
    fn a_vertex_follows_an_affine_map() {
        let mesh = corner();
        let surface = points(&[[0.25, 0.25, 0.25], [0.0, 0.0, 0.0], [0.5, 0.5, 0.01], [-0.05, 0.2, 0.2]]);
        let anchors = embed(&mesh, &surface, 0.1).expect("all within the tolerance");
        let map = |x: [f64; 3]| [2.0 * x[0] + 1.0, x[1] - x[0], 3.0 * x[2] + 0.5 * x[1]];
        let moved: Vec<_> = mesh.positions.iter().map(|&x| map(x)).collect();
        assert_eq!(anchors.len(), 4);
        for (x, anchor) in surface.positions.iter().zip(anchors) {
            // Eight roundings of numbers below 4.
            assert!(norm(subtract(map(*x), anchor.position(&moved))) <= 32.0 * f64::EPSILON);
        }
    }

    #[test]
    fn a_vertex_too_far_outside_is_named_with_its_distance() {
        let surface = points(&[[0.1, 0.1, 0.1], [0.2, 0.2, -0.5]]);
        let error = embed(&corner(), &surface, 0.1).expect_err("half a metre outside");
        assert_eq!(
            error.to_string(),
            "surface vertex 2 lies 5.000e-1 m outside the tetrahedral mesh; at most 1.000e-1 m is allowed"
        );
        let error = embed(&corner(), &points(&[[3.0, 0.0, 0.0]]), 0.1).expect_err("two metres outside");
        assert!(error.to_string().starts_with("surface vertex 1 lies 2.000e0 m outside"), "{error}");
        for nowhere in [f64::NAN, f64::INFINITY] {
            let error = embed(&corner(), &points(&[[nowhere; 3]]), 0.1).expect_err("nowhere");
            assert_eq!(error.to_string(), "surface vertex 1 has a coordinate that is not finite");
        }
    }

    #[test]
    fn a_tolerance_is_any_distance_and_nothing_else() {
        let far = points(&[[3.0, 0.0, 0.0], [-1e100, 0.0, 0.0]]);
        for wide in [1e100, f64::MAX, f64::INFINITY] {
            assert!(embed(&corner(), &far, wide).is_ok(), "{wide:e}");
        }
        assert!(embed(&corner(), &points(&[[0.0, 0.5, 0.5]]), 0.0).is_ok());
        for wrong in [-1e-300, f64::NEG_INFINITY, f64::NAN] {
            let error = embed(&corner(), &far, wrong).expect_err("no distance");
            assert!(error.to_string().ends_with("it must not be negative"), "{error}");
        }
    }

    /// The first tetrahedron that contains a point, or else the nearest one, by looking at all of them.
    fn nearest(cage: &Cage<'_>, x: [f64; 3]) -> (usize, f64) {
        let all = (0..cage.mesh.tets.len()).map(|tet| (tet, cage.distance(tet, x).unwrap_or(-1.0)));
        all.min_by(|one, other| one.1.total_cmp(&other.1)).expect("a tetrahedron")
    }

    /// Positions at rest come back, and the tree finds the same tetrahedra as a search through all of them,
    /// inside the mesh, at its nodes and around it, with a tetrahedron far away or without.
    #[test]
    fn a_tree_finds_what_a_full_search_finds() {
        let mut random = Random::new(3);
        let (cell, tolerance) = (0.1, 0.05);
        let mut mesh = tetrahedral_box([7, 4, 5], [0.7, 0.4, 0.5]).expect("a box");
        for x in mesh.positions.as_flattened_mut() {
            *x += random.uniform(-0.1 * cell, 0.1 * cell);
        }
        let nodes = mesh.positions.clone();
        let point = |random: &mut Random| [0.7, 0.4, 0.5].map(|side| random.uniform(-0.03, side + 0.03));
        let random_points: Vec<_> = (0..1000).map(|_| point(&mut random)).collect();
        let surface = points(&[random_points, nodes].concat());
        check_embedding(&mesh, &surface, tolerance);

        mesh.tets.push([0, 1, 2, 3].map(|k| mesh.positions.len() + k));
        mesh.positions.extend(corner().positions.iter().map(|x| [x[0] + 1e7, x[1], x[2]]));
        check_embedding(&mesh, &surface, tolerance);
    }

    #[track_caller]
    fn check_embedding(mesh: &TetMesh, surface: &Surface, tolerance: f64) {
        let shapes = mesh.rest_shapes().expect("a body");
        let cage = Cage { mesh, shapes: &shapes };
        let anchors = embed(mesh, surface, tolerance).expect("within the tolerance");
        assert_eq!(anchors.len(), surface.positions.len());
        let mut outside = 0;
        for (vertex, (x, anchor)) in surface.positions.iter().zip(anchors).enumerate() {
            let y = anchor.position(&mesh.positions);
            assert!(norm(subtract(*x, y)) <= 100.0 * f64::EPSILON, "vertex {vertex}");
            let (tet, distance) = nearest(&cage, *x);
            assert_eq!(anchor.nodes, mesh.tets[tet], "vertex {vertex}");
            outside += usize::from(distance > 0.0);
        }
        assert!((100..900).contains(&outside), "both kinds are tried: {outside} are outside");
    }
}
