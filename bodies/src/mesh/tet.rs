//! Mesh of linear tetrahedra and its shape at rest.
//!
//! Orientation: det [x1−x0, x2−x0, x3−x0] > 0. Lengths in metres, indices from 0.

use piola::__private::message::{names, quoted};
use piola::NoSuchNode;
use piola::batch::REST;
use thiserror::Error;

use super::elements::ElementCounts;

/// Tetrahedral mesh at rest, in f64.
///
/// ```
/// use piola_bodies::mesh::TetMesh;
///
/// let corner = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]];
/// let mesh = TetMesh::new(corner, vec![[0, 1, 2, 3]]);
/// assert_eq!(mesh.rest_shapes()?[0].volume, 5.0);
/// # Ok::<(), piola_bodies::mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetMesh {
    /// Rest position of each node, m.
    pub positions: Vec<[f64; 3]>,
    /// The four nodes of each tetrahedron, in the order of a positive volume.
    pub tets: Vec<[usize; 4]>,
    /// Tag of each tetrahedron in its file. If empty, tetrahedra are numbered from 1.
    pub tags: Vec<usize>,
    /// Named parts.
    pub groups: Vec<Group>,
    /// Number of nodes that a reader has dropped because no tetrahedron uses them; 0 for a mesh that no
    /// reader has made.
    pub dropped_nodes: usize,
    /// Number of tetrahedra of which [`TetMesh::turn_tets`] has swapped two nodes, as readers do.
    pub turned_tets: usize,
    /// Volume elements of the file that are not in the mesh because they are not linear tetrahedra; empty
    /// unless [`ReadError::only_tetrahedra`](super::ReadError::only_tetrahedra) has left some out.
    pub left_out: ElementCounts,
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

#[cfg(test)]
impl Group {
    pub(crate) fn of(name: &str, dimension: usize, nodes: &[usize], tets: &[usize]) -> Self {
        Self { name: name.to_owned(), dimension, nodes: nodes.to_vec(), tets: tets.to_vec() }
    }
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

impl RestShape {
    /// Dm⁻¹ row by row and the volume, as in the argument `rest` of
    /// [`Batch::stiffnesses`](piola::batch::Batch::stiffnesses).
    #[must_use]
    pub fn components(&self) -> [f64; REST] {
        let [a, b, c] = self.inverse;
        [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], self.volume]
    }
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
        self.tags.get(tet).copied().unwrap_or(tet.saturating_add(1))
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
    /// [`MeshError`] if there is no tetrahedron, one is there twice, a node is missing, not finite or unused
    /// ([`TetMesh::without_unused_nodes`]), or a volume is not positive. Negative ones, which
    /// [`TetMesh::turn_tets`] makes positive, are all named. A volume below the rounding error of its own
    /// determinant counts as zero: its sign would be noise.
    pub fn rest_shapes(&self) -> Result<Vec<RestShape>, MeshError> {
        if self.tets.is_empty() {
            return Err(MeshError("the mesh has no tetrahedra".to_owned()));
        }
        if let Some(node) = self.positions.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            return Err(MeshError(format!("the position of node {node} (from 0) is not finite")));
        }
        let (numbers, count) = (self.tets.as_flattened(), self.positions.len());
        if let Some(place) = numbers.iter().position(|&node| node >= count) {
            let missing =
                NoSuchNode { element: Some(self.tag(place / 4)), node: numbers[place], nodes: count };
            let is_from_one = !numbers.contains(&0) && numbers.iter().max() == Some(&count);
            let advice = if is_from_one { "; here they are from 1: subtract 1 from each" } else { "" };
            return Err(MeshError(format!("{missing}{advice}")));
        }
        if let Some(node) = self.are_used().iter().position(|is_used| !is_used) {
            return Err(MeshError(format!(
                "node {node} (from 0) belongs to no tetrahedron and would have no mass; leave such nodes out"
            )));
        }
        let mut shapes = Vec::with_capacity(self.tets.len());
        let mut reversed = Vec::new();
        for (tet, nodes) in self.tets.iter().enumerate() {
            match rest_shape(self.tag(tet), nodes.map(|node| self.positions[node]))? {
                Some(shape) => shapes.push(shape),
                None => reversed.push(self.tag(tet).to_string()),
            }
        }
        if !reversed.is_empty() {
            let (count, tets) = (reversed.len(), self.tets.len());
            return Err(MeshError(format!(
                "{count} of {tets} elements have their nodes in the order of a negative volume: {}; `turn_tets` swaps \
                 two nodes of each",
                names(reversed)
            )));
        }
        if let Some([one, other]) = self.repeated().map(|tets| tets.map(|tet| self.tag(tet))) {
            return Err(MeshError(format!(
                "elements {one} and {other} join the same four nodes, which would count their volume twice; \
                 remove one of them"
            )));
        }
        Ok(shapes)
    }

    /// First two tetrahedra that join the same four nodes, in any order.
    fn repeated(&self) -> Option<[usize; 2]> {
        let sorted = |(tet, nodes): (usize, &[usize; 4])| {
            let mut nodes = *nodes;
            nodes.sort_unstable();
            (nodes, tet)
        };
        let mut sorted: Vec<_> = self.tets.iter().enumerate().map(sorted).collect();
        sorted.sort_unstable();
        let twice = sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        twice.map(|pair| [pair[0].1, pair[1].1]).min()
    }

    /// True for each node that belongs to a tetrahedron.
    fn are_used(&self) -> Vec<bool> {
        let mut are_used = vec![false; self.positions.len()];
        for &node in self.tets.as_flattened() {
            if let Some(is_used) = are_used.get_mut(node) {
                *is_used = true;
            }
        }
        are_used
    }

    /// Number of tetrahedra of each connected component, the largest first: a body in one piece has one.
    ///
    /// Components share no node and move independently, even where their surfaces coincide: such nodes have
    /// to be merged in the mesh generator.
    ///
    /// ```
    /// use piola_bodies::mesh::TetMesh;
    ///
    /// let corner = |at: f64| [[at; 3], [at + 1.0, at, at], [at, at + 1.0, at], [at, at, at + 1.0]];
    /// let apart = TetMesh::new([corner(0.0), corner(8.0)].concat(), vec![[0, 1, 2, 3], [4, 5, 6, 7]]);
    /// assert_eq!(apart.connected_components(), [1, 1]);
    /// ```
    #[must_use]
    pub fn connected_components(&self) -> Vec<usize> {
        let nodes = self.tets.as_flattened().iter().max().map_or(0, |node| node.saturating_add(1));
        // Each node points to another of its component, the first one to itself.
        let mut first: Vec<usize> = (0..nodes.min(self.positions.len())).collect();
        let root = |first: &mut [usize], mut node: usize| {
            while first[node] != node {
                first[node] = first[first[node]];
                node = first[node];
            }
            node
        };
        let is_whole = |tet: &&[usize; 4]| tet.iter().all(|&node| node < self.positions.len());
        for tet in self.tets.iter().filter(is_whole) {
            for pair in tet.windows(2) {
                let (one, other) = (root(&mut first, pair[0]), root(&mut first, pair[1]));
                first[one.max(other)] = one.min(other);
            }
        }
        let mut tets = vec![0; first.len()];
        for tet in self.tets.iter().filter(is_whole) {
            tets[root(&mut first, tet[0])] += 1;
        }
        tets.retain(|&tets| tets > 0);
        tets.sort_unstable_by(|one, other| other.cmp(one));
        tets
    }

    /// Swaps two nodes of each tetrahedron with a negative volume, and adds their number to
    /// [`TetMesh::turned_tets`]: the order of nodes is a convention of the program that wrote them.
    ///
    /// Flat tetrahedra, and those with a node that does not exist, remain as they are.
    ///
    /// ```
    /// use piola_bodies::mesh::TetMesh;
    ///
    /// let corner = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]];
    /// let mesh = TetMesh::new(corner, vec![[0, 2, 1, 3]]).turn_tets();
    /// assert_eq!((mesh.turned_tets, mesh.rest_shapes()?[0].volume), (1, 5.0));
    /// # Ok::<(), piola_bodies::mesh::MeshError>(())
    /// ```
    #[must_use]
    pub fn turn_tets(mut self) -> Self {
        for tet in &mut self.tets {
            let corners = tet.map(|node| self.positions.get(node).copied());
            if let [Some(x0), Some(x1), Some(x2), Some(x3)] = corners
                && matches!(rest_shape(0, [x0, x1, x2, x3]), Ok(None))
            {
                tet.swap(1, 2);
                self.turned_tets += 1;
            }
        }
        self
    }

    /// Removes nodes that belong to no tetrahedron, from groups too, and sorts the nodes of groups.
    ///
    /// Such nodes have neither mass nor stiffness, and a mesh that has one is not a body. Later nodes get
    /// smaller numbers.
    #[must_use]
    pub fn without_unused_nodes(self) -> Self {
        let are_used = self.are_used();
        let mut renumbered = vec![None; are_used.len()];
        let mut positions = Vec::with_capacity(are_used.len());
        for (node, position) in self.positions.into_iter().enumerate().filter(|&(node, _)| are_used[node]) {
            renumbered[node] = Some(positions.len());
            positions.push(position);
        }
        let number = |node: usize| renumbered.get(node).copied().flatten();
        let groups = self.groups.into_iter().map(|group| {
            let mut nodes: Vec<usize> = group.nodes.into_iter().filter_map(number).collect();
            nodes.sort_unstable();
            nodes.dedup();
            Group { nodes, ..group }
        });
        let groups = groups.collect();
        // A node that does not exist remains one, for the error to come.
        let tets = self.tets.iter().map(|tet| tet.map(|node| number(node).unwrap_or(node))).collect();
        let dropped_nodes = self.dropped_nodes + are_used.len() - positions.len();
        Self { positions, tets, groups, dropped_nodes, ..self }
    }
}

/// Inverse edge matrix and volume of a tetrahedron, `None` for a negative volume; `element` is its tag.
fn rest_shape(element: usize, [x0, x1, x2, x3]: [[f64; 3]; 4]) -> Result<Option<RestShape>, MeshError> {
    let edges = [subtract(x1, x0), subtract(x2, x0), subtract(x3, x0)];
    let (rows, determinant, noise) = inverse(edges);
    let volume = determinant / 6.0;
    if determinant > noise && volume.is_normal() && determinant.is_finite() {
        return Ok(Some(RestShape { inverse: rows.map(|row| row.map(|x| x / determinant)), volume }));
    }
    // At the size of one nothing overflows, and what is flat is flat.
    let size = edges.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let (_, unit_determinant, unit_noise) = inverse(edges.map(|edge| edge.map(|x| x / size)));
    if unit_determinant < -unit_noise {
        return Ok(None);
    }
    if size.is_infinite() || unit_determinant > unit_noise {
        let fault = if size > 1.0 { "overflows" } else { "underflows" };
        return Err(MeshError(format!(
            "element {element} is {size:.0e} m large, and its volume {fault}; are the units right?"
        )));
    }
    Err(MeshError(format!(
        "element {element} is flat: its rest volume, {volume:e} m³, is zero within rounding; remove or reshape it in \
         the mesh generator"
    )))
}

/// Rows of the inverse of a matrix of these columns times the determinant, the determinant, and a bound for
/// its rounding error.
fn inverse([a, b, c]: [[f64; 3]; 3]) -> ([[f64; 3]; 3], f64, f64) {
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    // A 3×3 determinant of rounded edges errs by at most 8u times the product of their lengths.
    (rows, dot(a, rows[0]), 4.0 * f64::EPSILON * norm(a) * norm(b) * norm(c))
}

impl Bounds {
    /// The smallest box around these points; for none, an empty one with min = +∞, max = −∞.
    pub(crate) fn around(points: &[[f64; 3]]) -> Self {
        points.iter().fold(Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] }, |bounds, x| Self {
            min: std::array::from_fn(|c| bounds.min[c].min(x[c])),
            max: std::array::from_fn(|c| bounds.max[c].max(x[c])),
        })
    }

    /// True if a point lies inside or on the boundary.
    #[must_use]
    pub fn contains(&self, x: [f64; 3]) -> bool {
        (0..3).all(|c| self.min[c] <= x[c] && x[c] <= self.max[c])
    }

    /// Lengths of the sides, m.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        subtract(self.max, self.min)
    }

    /// Distance of a point, 0 inside.
    pub(super) fn distance(&self, x: [f64; 3]) -> f64 {
        norm(std::array::from_fn(|c| (self.min[c] - x[c]).max(x[c] - self.max[c]).max(0.0)))
    }
}

/// Reason why a mesh is not a body, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct MeshError(String);

/// Message that a mesh has no group of a name; `of` is the kind of the existing groups, if not all count.
pub(crate) fn no_such_group<'a>(name: &str, existing: impl Iterator<Item = &'a Group>, of: &str) -> String {
    let name = quoted(name);
    let mut existing = existing.map(|group| &group.name).peekable();
    match existing.peek() {
        None => format!("there is no group `{name}`: the mesh has no groups{of}"),
        Some(_) => format!("there is no group `{name}`{of}; there are: {}", names(existing)),
    }
}

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
        check(|mesh| mesh.tets[0][3] = 9, "element 1 names node 9: the 4 nodes are numbered from 0");
        check(
            |mesh| mesh.positions.push([1.0; 3]),
            "node 4 (from 0) belongs to no tetrahedron and would have no mass; leave such nodes out",
        );
        check(
            |mesh| mesh.tets[0] = [1, 3, 2, 4],
            "element 1 names node 4: the 4 nodes are numbered from 0; here they are from 1: subtract 1 from each",
        );
        check(
            |mesh| mesh.positions[3][2] = 0.0,
            "element 1 is flat: its rest volume, 0e0 m³, is zero within rounding; remove or reshape it in the mesh \
             generator",
        );
    }

    /// One tetrahedron of a box, and all of them.
    #[test]
    fn reversed_tetrahedra_are_all_named_and_can_be_turned() {
        let mut mesh = crate::mesh::tetrahedral_box([4, 1, 1], [4.0, 1.0, 1.0]).expect("a box");
        mesh.tags = (100..124).collect();
        for (reversed, list) in [(3..4, "103"), (0..24, "118, 119 and 4 more")] {
            let mut wrong = mesh.clone();
            wrong.tets[reversed.clone()].iter_mut().for_each(|tet| tet.swap(1, 2));
            let message = wrong.rest_shapes().expect_err("reversed").to_string();
            let end = format!("{list}; `turn_tets` swaps two nodes of each");
            let start = format!("{} of 24 elements have their nodes in the order of", reversed.len());
            assert!(message.starts_with(&start) && message.ends_with(&end), "{message}");
            assert_eq!(wrong.turn_tets(), TetMesh { turned_tets: reversed.len(), ..mesh.clone() });
        }
    }

    #[test]
    fn a_volume_below_its_rounding_error_counts_as_zero() {
        let mut mesh = corner();
        mesh.positions[3] = [0.1, 0.2, 1e-17];
        let message = mesh.rest_shapes().expect_err("flat").to_string();
        assert!(message.starts_with("element 1 is flat: "), "{message}");
    }

    /// A row of tetrahedra, two of which become the same.
    #[test]
    fn the_same_tetrahedron_twice_is_named_in_every_order_of_its_nodes() {
        let mut mesh = crate::mesh::tetrahedral_box([4, 1, 1], [4.0, 1.0, 1.0]).expect("a box");
        mesh.tags = (100..124).collect();
        for even in [[0, 1, 2, 3], [1, 2, 0, 3], [3, 2, 1, 0], [2, 3, 0, 1]] {
            let mut twice = mesh.clone();
            twice.tets.push(even.map(|k| mesh.tets[7][k]));
            twice.tags.push(3);
            let error = twice.rest_shapes().expect_err("a tetrahedron twice");
            let expected = "elements 107 and 3 join the same four nodes, which would count their volume twice; \
                            remove one of them";
            assert_eq!(error.to_string(), expected);
        }
        assert!(mesh.rest_shapes().is_ok());
    }

    /// A regular and a flat tetrahedron of all sizes: the message names the actual mistake.
    #[test]
    fn sizes_whose_volume_leaves_the_range_are_no_flat_tetrahedra() {
        let scaled = |scale: f64, height: f64| {
            let mut mesh = corner();
            mesh.positions[3][2] *= height;
            mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
            mesh.rest_shapes()
        };
        for exponent in -102..=102 {
            let shapes = scaled(10f64.powi(exponent), 1.0).expect("within the range");
            assert!(shapes[0].inverse.as_flattened().iter().all(|x| x.is_finite()), "1e{exponent}");
        }
        for (scale, word) in
            [(1e-103, "underflows"), (1e-300, "underflows"), (1e103, "overflows"), (1e307, "overflows")]
        {
            let message = scaled(scale, 1.0).expect_err("out of range").to_string();
            let size = 5.0 * scale;
            let expected =
                format!("element 1 is {size:.0e} m large, and its volume {word}; are the units right?");
            assert_eq!(message, expected);
            let message = scaled(scale, 0.0).expect_err("flat").to_string();
            assert!(message.contains("is flat"), "{scale:e}: {message}");
        }
        let mut widest = corner();
        widest.positions[0] = [f64::MIN; 3];
        widest.positions[1] = [f64::MAX; 3];
        let message = widest.rest_shapes().expect_err("an edge overflows").to_string();
        assert!(message.ends_with("its volume overflows; are the units right?"), "{message}");
    }

    #[test]
    fn components_and_unused_nodes_are_counted() {
        let whole = crate::mesh::tetrahedral_box([3, 1, 1], [3.0, 1.0, 1.0]).expect("a box");
        assert_eq!(whole.connected_components(), [18]);
        // The middle cell is missing, and a corner stands far away by itself.
        let mut broken = whole.clone();
        broken.tets.drain(6..12);
        broken.positions.splice(0..0, [[1e7, 0.0, 0.0]]);
        broken.tets.as_flattened_mut().iter_mut().for_each(|node| *node += 1);
        broken.groups = vec![Group { nodes: vec![0, 5], ..Group::default() }];
        assert_eq!(broken.connected_components(), [6, 6]);
        let message = broken.rest_shapes().expect_err("an unused node").to_string();
        assert!(message.starts_with("node 0 (from 0) belongs to no tetrahedron"), "{message}");
        let cleaned = broken.without_unused_nodes();
        assert_eq!((cleaned.bounds(), cleaned.dropped_nodes), (whole.bounds(), 1));
        assert_eq!(cleaned.groups[0].nodes, [4]);
        assert!(cleaned.rest_shapes().is_ok());
        assert!(TetMesh::default().connected_components().is_empty());
    }
}
