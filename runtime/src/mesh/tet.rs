//! Mesh of linear tetrahedra and its shape at rest.
//!
//! Orientation: det [x1−x0, x2−x0, x3−x0] > 0. Lengths in metres, indices from 0.

use std::fmt;

/// Tetrahedral mesh at rest, in f64.
///
/// ```
/// use piola::mesh::TetMesh;
///
/// let corner = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]];
/// let mesh = TetMesh::new(corner, vec![[0, 1, 2, 3]]);
/// assert_eq!(mesh.rest_shapes()?[0].volume, 5.0);
/// # Ok::<(), piola::mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    /// Rest position of each node, m.
    pub positions: Vec<[f64; 3]>,
    /// The four nodes of each tetrahedron, positively oriented.
    pub tets: Vec<[usize; 4]>,
    /// Tag of each tetrahedron in its file. If empty, tetrahedra are numbered from 1.
    pub tags: Vec<usize>,
    /// Named parts.
    pub groups: Vec<Group>,
}

/// Named part of a mesh, such as a physical group of Gmsh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Name; the number of a physical group without a name.
    pub name: String,
    /// 0 for points, 1 for curves, 2 for surfaces, 3 for volumes.
    pub dimension: usize,
    /// Nodes of all elements of the group, ascending.
    pub nodes: Vec<usize>,
    /// Tetrahedra of the group, ascending; empty unless the dimension is 3.
    pub tets: Vec<usize>,
}

/// Shape of a tetrahedron at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestShape {
    /// Inverse edge matrix Dm⁻¹, 1/m, where the columns of Dm are x1−x0, x2−x0, x3−x0: its row i is the
    /// gradient of the barycentric coordinate of node i+1.
    pub inverse: [[f64; 3]; 3],
    /// Volume, m³.
    pub volume: f64,
}

/// Box with sides along the axes, its boundary included.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Bounds {
    /// Lowest coordinates, m.
    pub min: [f64; 3],
    /// Highest coordinates, m.
    pub max: [f64; 3],
}

impl TetMesh {
    /// A mesh without groups, its tetrahedra numbered from 1.
    #[must_use]
    pub fn new(positions: Vec<[f64; 3]>, tets: Vec<[usize; 4]>) -> Self {
        Self { positions, tets, ..Self::default() }
    }

    /// Tag of a tetrahedron: from `tags`, or its index plus 1.
    #[must_use]
    pub fn tag(&self, tet: usize) -> usize {
        self.tags.get(tet).copied().unwrap_or(tet + 1)
    }

    /// Finds a group by its name.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups.iter().find(|group| group.name == name)
    }

    /// The smallest box around all nodes; an empty box around none.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::around(&self.positions)
    }

    /// Computes the shape at rest of each tetrahedron.
    ///
    /// # Errors
    /// [`MeshError`] if there is no tetrahedron, a node is missing, unused or not finite, or a volume is not
    /// positive. A volume below the rounding error of its own determinant counts as zero: its sign would be
    /// noise.
    pub fn rest_shapes(&self) -> Result<Vec<RestShape>, MeshError> {
        if self.tets.is_empty() {
            return Err(MeshError::Empty);
        }
        if let Some(node) = self.positions.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            return Err(MeshError::NotFinite { node });
        }
        let mut used = vec![false; self.positions.len()];
        let mut shapes = Vec::with_capacity(self.tets.len());
        for (tet, nodes) in self.tets.iter().enumerate() {
            for &node in nodes {
                *used.get_mut(node).ok_or(MeshError::NoSuchNode {
                    element: self.tag(tet),
                    node,
                    nodes: self.positions.len(),
                })? = true;
            }
            shapes.push(
                rest_shape(nodes.map(|node| self.positions[node]))
                    .map_err(|volume| MeshError::NonPositiveVolume { element: self.tag(tet), volume })?,
            );
        }
        match used.iter().position(|used| !used) {
            Some(node) => Err(MeshError::UnusedNode { node }),
            None => Ok(shapes),
        }
    }

    /// Removes the nodes of no tetrahedron, from groups too, and sorts the nodes of groups.
    pub(super) fn without_unused_nodes(self) -> Self {
        let mut renumbered = vec![None; self.positions.len()];
        self.tets.iter().flatten().for_each(|&node| renumbered[node] = Some(0));
        let mut positions = Vec::new();
        for (number, position) in renumbered.iter_mut().zip(self.positions) {
            if let Some(number) = number {
                *number = positions.len();
                positions.push(position);
            }
        }
        let groups = self.groups.into_iter().map(|group| {
            let mut nodes: Vec<usize> = group.nodes.into_iter().filter_map(|node| renumbered[node]).collect();
            nodes.sort_unstable();
            nodes.dedup();
            Group { nodes, ..group }
        });
        // Every node of a tetrahedron is in use, so that the default is never taken.
        let tets = self.tets.iter().map(|tet| tet.map(|node| renumbered[node].unwrap_or_default())).collect();
        Self { positions, tets, groups: groups.collect(), ..self }
    }
}

/// Lumped mass of each node, kg: a quarter of the mass of each tetrahedron around it.
///
/// `densities`, kg/m³, and `shapes` hold one entry per tetrahedron.
#[must_use]
pub fn lumped_masses(mesh: &TetMesh, shapes: &[RestShape], densities: &[f64]) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.positions.len()];
    for ((nodes, shape), density) in mesh.tets.iter().zip(shapes).zip(densities) {
        for &node in nodes {
            masses[node] += density * shape.volume / 4.0;
        }
    }
    masses
}

/// Inverse edge matrix and volume of a tetrahedron, or its volume as an error if that is not positive.
fn rest_shape([x0, x1, x2, x3]: [[f64; 3]; 4]) -> Result<RestShape, f64> {
    let (a, b, c) = (subtract(x1, x0), subtract(x2, x0), subtract(x3, x0));
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, rows[0]);
    // A 3×3 determinant of rounded edges errs by at most 8u times the product of their lengths.
    let noise = 4.0 * f64::EPSILON * norm(a) * norm(b) * norm(c);
    if determinant > noise && determinant.is_finite() {
        Ok(RestShape { inverse: rows.map(|row| row.map(|x| x / determinant)), volume: determinant / 6.0 })
    } else {
        Err(determinant / 6.0)
    }
}

impl Bounds {
    /// The smallest box around these points; for none, an empty one with min = +∞, max = −∞.
    #[must_use]
    pub fn around(points: &[[f64; 3]]) -> Self {
        points.iter().fold(Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] }, |bounds, x| Self {
            min: std::array::from_fn(|c| bounds.min[c].min(x[c])),
            max: std::array::from_fn(|c| bounds.max[c].max(x[c])),
        })
    }

    /// Whether a point lies inside or on the boundary.
    #[must_use]
    pub fn contains(&self, x: [f64; 3]) -> bool {
        (0..3).all(|c| self.min[c] <= x[c] && x[c] <= self.max[c])
    }

    /// Lengths of the sides, m.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        subtract(self.max, self.min)
    }
}

/// Reason why a mesh is not a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// There is no tetrahedron.
    Empty,
    /// A coordinate is infinite or NaN.
    NotFinite {
        /// The node, from 0.
        node: usize,
    },
    /// A tetrahedron names a node that does not exist.
    NoSuchNode {
        /// Tag of the tetrahedron.
        element: usize,
        /// The missing node, from 0.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// A node belongs to no tetrahedron; it would have no mass.
    UnusedNode {
        /// The node, from 0.
        node: usize,
    },
    /// A tetrahedron is flat or inverted at rest.
    NonPositiveVolume {
        /// Tag of the tetrahedron.
        element: usize,
        /// Its signed volume, m³.
        volume: f64,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the mesh has no tetrahedra"),
            Self::NotFinite { node } => write!(f, "the position of node {node} (from 0) is not finite"),
            Self::NoSuchNode { element, node, nodes } => {
                write!(f, "element {element} names node {node} (from 0), but there are {nodes} nodes")
            }
            Self::UnusedNode { node } => write!(f, "node {node} (from 0) belongs to no tetrahedron"),
            Self::NonPositiveVolume { element, volume } => write!(
                f,
                "element {element} has the rest volume {volume:e} m³, which is not positive beyond rounding; \
                 is it flat, or are two of its nodes swapped?"
            ),
        }
    }
}

impl std::error::Error for MeshError {}

pub(crate) fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner() -> TetMesh {
        TetMesh::new(vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]], vec![[0, 1, 2, 3]])
    }

    #[test]
    fn a_corner_has_the_reciprocal_edges_as_inverse() {
        let shapes = corner().rest_shapes().expect("a positive tetrahedron");
        assert_eq!(shapes[0].volume, 5.0);
        assert_eq!(shapes[0].inverse, [[0.5, 0.0, 0.0], [0.0, 1.0 / 3.0, 0.0], [0.0, 0.0, 0.2]]);
    }

    #[test]
    fn masses_add_up_to_density_times_volume() {
        let mesh = corner();
        let shapes = mesh.rest_shapes().expect("a positive tetrahedron");
        let masses = lumped_masses(&mesh, &shapes, &[8.0]);
        assert_eq!(masses, vec![10.0; 4]);
    }

    #[track_caller]
    fn check(change: impl Fn(&mut TetMesh), message: &str) {
        let mut mesh = corner();
        change(&mut mesh);
        assert_eq!(mesh.rest_shapes().expect_err(message).to_string(), message);
    }

    #[test]
    fn errors_name_the_culprit() {
        check(|mesh| mesh.tets.clear(), "the mesh has no tetrahedra");
        check(|mesh| mesh.positions[2][1] = f64::NAN, "the position of node 2 (from 0) is not finite");
        check(|mesh| mesh.tets[0][3] = 9, "element 1 names node 9 (from 0), but there are 4 nodes");
        check(|mesh| mesh.positions.push([1.0; 3]), "node 4 (from 0) belongs to no tetrahedron");
        check(
            |mesh| {
                mesh.tags = vec![17];
                mesh.tets[0] = [0, 2, 1, 3];
            },
            "element 17 has the rest volume -5e0 m³, which is not positive beyond rounding; \
             is it flat, or are two of its nodes swapped?",
        );
    }

    #[test]
    fn a_volume_below_its_rounding_error_counts_as_zero() {
        let mut mesh = corner();
        mesh.positions[3] = [0.1, 0.2, 1e-17];
        assert!(matches!(mesh.rest_shapes(), Err(MeshError::NonPositiveVolume { element: 1, .. })));
    }
}
