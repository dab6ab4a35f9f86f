//! Surfaces that follow the tetrahedra they lie in.

use std::fmt;

use super::io::Surface;
use super::tet::{Bounds, MeshError, RestShape, TetMesh, cross, dot, norm, subtract};

/// Surface bound to a mesh: each vertex is an affine combination of the nodes of one tetrahedron.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    anchors: Vec<Anchor>,
}

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

impl Embedding {
    /// Binds each vertex to the tetrahedron that contains it at rest, or else to the nearest one.
    ///
    /// A vertex outside the mesh moves by extrapolation; `tolerance`, m, is its largest distance from the
    /// nearest tetrahedron.
    ///
    /// # Errors
    /// [`EmbedError::Outside`] for a vertex farther outside, [`EmbedError::Mesh`] if the mesh is not a body
    /// ([`TetMesh::rest_shapes`]).
    pub fn new(mesh: &TetMesh, surface: &Surface, tolerance: f64) -> Result<Self, EmbedError> {
        let shapes = mesh.rest_shapes()?;
        let cage = Cage { mesh, shapes: &shapes };
        let grid = Grid::new(mesh, tolerance);
        let anchors = surface.positions.iter().enumerate().map(|(vertex, &x)| {
            match cage.nearest(grid.candidates(x), x) {
                Some((tet, distance)) if distance <= tolerance => {
                    Ok(Anchor { nodes: mesh.tets[tet], weights: cage.weights(tet, x) })
                }
                _ => {
                    let distance =
                        cage.nearest(0..mesh.tets.len(), x).map_or(f64::INFINITY, |(_, distance)| distance);
                    Err(EmbedError::Outside { vertex: vertex + 1, distance, tolerance })
                }
            }
        });
        Ok(Self { anchors: anchors.collect::<Result<_, _>>()? })
    }

    /// Anchors of the vertices, in their order.
    #[must_use]
    pub fn anchors(&self) -> &[Anchor] {
        &self.anchors
    }

    /// Writes the positions of the vertices when the nodes are at `positions`.
    ///
    /// # Panics
    /// If there are fewer positions than nodes, or `out` does not hold one entry for each vertex.
    pub fn deform(&self, positions: &[[f64; 3]], out: &mut [[f64; 3]]) {
        assert_eq!(out.len(), self.anchors.len(), "one position for each vertex of the embedded surface");
        for (anchor, x) in self.anchors.iter().zip(out) {
            *x = anchor.position(positions);
        }
    }
}

/// Reason why a surface cannot be embedded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EmbedError {
    /// A vertex is too far from every tetrahedron.
    Outside {
        /// The vertex, from 1 as in an OBJ file.
        vertex: usize,
        /// Its distance from the nearest tetrahedron, m.
        distance: f64,
        /// Largest allowed distance, m.
        tolerance: f64,
    },
    /// The mesh is not a body.
    Mesh(MeshError),
}

impl fmt::Display for EmbedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside { vertex, distance, tolerance } => write!(
                f,
                "surface vertex {vertex} lies {distance:.3e} m outside the tetrahedral mesh; at most {tolerance:.3e} m is allowed"
            ),
            Self::Mesh(error) => error.fmt(f),
        }
    }
}

crate::chained::wraps!(EmbedError { Mesh(MeshError) });

/// The tetrahedra at rest.
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

    /// The first tetrahedron that contains a point, at distance 0, or else the nearest one.
    fn nearest(&self, tets: impl Iterator<Item = usize>, x: [f64; 3]) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        for tet in tets {
            let weights = self.weights(tet, x);
            if weights.iter().all(|&weight| weight >= 0.0) {
                return Some((tet, 0.0));
            }
            let corners = self.mesh.tets[tet].map(|node| self.mesh.positions[node]);
            // Seen from an outside point the nearest face is one whose opposite weight is negative.
            let distance = (0..4)
                .filter(|&k| weights[k] < 0.0)
                .map(|k| {
                    distance_to_triangle(
                        x,
                        [corners[(k + 1) % 4], corners[(k + 2) % 4], corners[(k + 3) % 4]],
                    )
                })
                .fold(f64::INFINITY, f64::min);
            if best.is_none_or(|(_, smallest)| distance < smallest) {
                best = Some((tet, distance));
            }
        }
        best
    }
}

/// Distance from a point to a triangle: to its plane where the foot of the perpendicular is inside, else to
/// an edge.
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

/// For each cell of a regular grid, the tetrahedra whose boxes, widened by the tolerance, touch it.
///
/// The tetrahedra within the tolerance of a point are then all in the list of its cell.
struct Grid {
    bounds: Bounds,
    cells: [usize; 3],
    /// Start of the list of each cell in `tets`, and end of the last.
    starts: Vec<usize>,
    tets: Vec<usize>,
}

impl Grid {
    fn new(mesh: &TetMesh, tolerance: f64) -> Self {
        let widened = |bounds: Bounds| Bounds {
            min: bounds.min.map(|x| x - tolerance),
            max: bounds.max.map(|x| x + tolerance),
        };
        let bounds = widened(mesh.bounds());
        // About two cells per tetrahedron, cubic where the body is not flat.
        let size = bounds.size();
        let side = (size[0] * size[1] * size[2] / (2.0 * mesh.tets.len() as f64)).cbrt();
        let cells =
            size.map(|length| if side > 0.0 { (length / side).ceil().clamp(1.0, 128.0) as usize } else { 1 });
        let mut grid =
            Self { bounds, cells, starts: vec![0; cells.iter().product::<usize>() + 1], tets: Vec::new() };

        let mut lists = vec![Vec::new(); grid.starts.len() - 1];
        for (tet, nodes) in mesh.tets.iter().enumerate() {
            let reach = widened(Bounds::around(&nodes.map(|node| mesh.positions[node])));
            let (low, high) = (grid.coordinates(reach.min), grid.coordinates(reach.max));
            for i in low[0]..=high[0] {
                for j in low[1]..=high[1] {
                    for k in low[2]..=high[2] {
                        lists[grid.index([i, j, k])].push(tet);
                    }
                }
            }
        }
        for (cell, list) in lists.iter().enumerate() {
            grid.tets.extend(list);
            grid.starts[cell + 1] = grid.tets.len();
        }
        grid
    }

    fn candidates(&self, x: [f64; 3]) -> impl Iterator<Item = usize> + '_ {
        let list = if self.bounds.contains(x) {
            let cell = self.index(self.coordinates(x));
            self.starts[cell]..self.starts[cell + 1]
        } else {
            0..0
        };
        self.tets[list].iter().copied()
    }

    /// The cell of a point, which rounding may have put just outside. Monotone in each coordinate, so that a
    /// point between two others never falls outside the cells between theirs.
    fn coordinates(&self, x: [f64; 3]) -> [usize; 3] {
        let size = self.bounds.size();
        std::array::from_fn(|c| {
            let along = (x[c] - self.bounds.min[c]) / size[c] * self.cells[c] as f64;
            (along.max(0.0) as usize).min(self.cells[c] - 1)
        })
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.cells[1] + j) * self.cells[2] + k
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tetrahedral_box;
    use crate::random::Random;

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
        let embedding = Embedding::new(&mesh, &surface, 0.1).expect("all within the tolerance");
        let map = |x: [f64; 3]| [2.0 * x[0] + 1.0, x[1] - x[0], 3.0 * x[2] + 0.5 * x[1]];
        let moved: Vec<_> = mesh.positions.iter().map(|&x| map(x)).collect();
        let mut out = vec![[0.0; 3]; 4];
        embedding.deform(&moved, &mut out);
        for (x, y) in surface.positions.iter().zip(&out) {
            // Eight roundings of numbers below 4.
            assert!(norm(subtract(map(*x), *y)) <= 32.0 * f64::EPSILON);
        }
    }

    #[test]
    fn a_vertex_too_far_outside_is_named_with_its_distance() {
        let surface = points(&[[0.1, 0.1, 0.1], [0.2, 0.2, -0.5]]);
        let error = Embedding::new(&corner(), &surface, 0.1).expect_err("half a metre outside");
        assert_eq!(
            error.to_string(),
            "surface vertex 2 lies 5.000e-1 m outside the tetrahedral mesh; at most 1.000e-1 m is allowed"
        );
        let error =
            Embedding::new(&corner(), &points(&[[3.0, 0.0, 0.0]]), 0.1).expect_err("two metres outside");
        assert!(matches!(error, EmbedError::Outside { vertex: 1, distance, .. } if distance == 2.0));
        let error = Embedding::new(&corner(), &points(&[[f64::NAN; 3]]), 0.1).expect_err("nowhere");
        assert!(matches!(error, EmbedError::Outside { vertex: 1, .. }));
    }

    /// Positions at rest come back, and the grid finds the same tetrahedra as a search through all of them,
    /// inside the mesh and around it.
    #[test]
    fn a_grid_finds_what_a_full_search_finds() {
        let mut random = Random::new(3);
        let (cell, tolerance) = (0.1, 0.05);
        let mut mesh = tetrahedral_box([7, 4, 5], [0.7, 0.4, 0.5]).expect("a box");
        for x in mesh.positions.as_flattened_mut() {
            *x += random.uniform(-0.1 * cell, 0.1 * cell);
        }
        let shapes = mesh.rest_shapes().expect("a body");
        let cage = Cage { mesh: &mesh, shapes: &shapes };
        let point = |random: &mut Random| [0.7, 0.4, 0.5].map(|side| random.uniform(-0.03, side + 0.03));
        let surface = points(&(0..1000).map(|_| point(&mut random)).collect::<Vec<_>>());
        let embedding = Embedding::new(&mesh, &surface, tolerance).expect("within the tolerance");
        let mut out = vec![[0.0; 3]; surface.positions.len()];
        embedding.deform(&mesh.positions, &mut out);
        let mut outside = 0;
        for (vertex, (x, y)) in surface.positions.iter().zip(&out).enumerate() {
            assert!(norm(subtract(*x, *y)) <= 100.0 * f64::EPSILON, "vertex {vertex}");
            let (tet, distance) = cage.nearest(0..mesh.tets.len(), *x).expect("a tetrahedron");
            assert_eq!(embedding.anchors()[vertex].nodes, mesh.tets[tet], "vertex {vertex}");
            outside += usize::from(distance > 0.0);
        }
        assert!((100..900).contains(&outside), "both kinds are tried: {outside} are outside");
    }
}
