//! Tetrahedral meshes from TetGen's pairs of files, `.node` and `.ele`.
//!
//! \[Si15\] Si, *TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator*, 2015; formats in the manual,
//! "File formats".

use std::path::Path;

use super::msh::File;
use super::text::{Cursor, Problem, ReadError, read};
use crate::mesh::TetMesh;
use crate::mesh::elements::{ElementCounts, TETRAHEDRON_10};

/// Reads the tetrahedra of a `.ele` file and their nodes from the `.node` file next to it; `path` may be
/// either.
///
/// Nodes may be numbered in any way. The format guarantees no orientation: tetrahedra with a negative volume
/// are turned and counted in [`TetMesh::turned_tets`]. The first attribute of a tetrahedron, the number of
/// its region, makes a group of dimension 3, and the boundary marker of a node, unless it is 0, one of
/// dimension 2; both are called by their numbers. Nodes that belong to no tetrahedron are dropped and
/// counted in [`TetMesh::dropped_nodes`].
///
/// # Errors
/// [`ReadError`], which names the line if it is malformed, if there is no tetrahedron, or if tetrahedra are
/// of second order.
pub fn read_tetgen(path: impl AsRef<Path>) -> Result<TetMesh, ReadError> {
    let nodes = read(&path.as_ref().with_extension("node"), parse_nodes)?;
    read(&path.as_ref().with_extension("ele"), |text| parse_tets(text, nodes))
}

/// `count 3 attributes markers`, then for each node `number x y z attribute … marker`.
fn parse_nodes(text: &str) -> Result<File, Problem> {
    let mut cursor = Cursor::new(text, Some('#'));
    let mut line = cursor.next("the number of nodes")?;
    let count = line.number("the number of nodes")?;
    let dimension: usize = line.number("the dimension")?;
    if dimension != 3 {
        return Err(line.problem(format!("nodes have {dimension} coordinates; they must have 3")));
    }
    let attributes: usize = line.number_if_any("the number of attributes")?.unwrap_or(0);
    let markers: usize = line.number_if_any("the number of boundary markers")?.unwrap_or(0);
    let mut file = File::default();
    for node in 0..count {
        let mut line = cursor.next("a node")?;
        file.add_node(&mut line, "the number of the node")?;
        for _ in 0..attributes {
            line.number::<f64>("an attribute of the node")?;
        }
        let marker: i64 = if markers > 0 { line.number("the boundary marker of the node")? } else { 0 };
        if marker != 0 {
            file.groups.entry((2, marker)).or_default().nodes.push(node);
        }
    }
    Ok(file)
}

/// `count corners attributes`, then for each tetrahedron `number node … attribute …`.
fn parse_tets(text: &str, mut file: File) -> Result<TetMesh, Problem> {
    let mut cursor = Cursor::new(text, Some('#'));
    let mut line = cursor.next("the number of tetrahedra")?;
    let count = line.number("the number of tetrahedra")?;
    let corners: usize = line.number("the number of nodes of a tetrahedron")?;
    if count == 0 {
        return Err(line.problem("there is no tetrahedron"));
    }
    if corners == 10 {
        let elements = ElementCounts::default().and(TETRAHEDRON_10, count);
        return Err(line.problem(elements.refusal("run TetGen without `-o2`")));
    }
    if corners != 4 {
        return Err(line.problem(format!("tetrahedra have {corners} nodes; they must have 4")));
    }
    let attributes: usize = line.number_if_any("the number of attributes")?.unwrap_or(0);
    for tet in 0..count {
        let mut line = cursor.next("a tetrahedron")?;
        file.tags.push(line.number("the number of the tetrahedron")?);
        let mut node = || file.node(&mut line);
        let corners = [node()?, node()?, node()?, node()?];
        file.tets.push(corners);
        if attributes > 0 {
            // A whole number, written as a real one.
            let region: f64 = line.number("the region of the tetrahedron")?;
            file.put_into_group(region as i64, tet);
        }
    }
    file.into_mesh(cursor.number + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Group;

    /// A stray node, attributes and boundary markers.
    const NODES: &str = "# made by hand\n\
        6 3 1 1\n\
        1  0 0 0  0.5 2\n\
        2  1 0 0  0.5 2 # a corner\n\
        3  0 1 0  0.5 0\n\
        \n\
        4  0 0 1  0.5 -1\n\
        5  1 1 1  0.5 0\n\
        6  8 8 8  0.5 2\n";

    /// The second tetrahedron is in the other order.
    const TETS: &str = "2 4 1\n  1  1 2 3 4  7\n  2  3 2 4 5  -1\n";

    #[test]
    fn nodes_tetrahedra_and_groups_arrive() {
        let mesh = parse_nodes(NODES).and_then(|nodes| parse_tets(TETS, nodes)).expect("good files");
        assert_eq!((mesh.positions.len(), mesh.positions[4]), (5, [1.0; 3]));
        assert_eq!((mesh.dropped_nodes, mesh.turned_tets), (1, 1));
        assert_eq!(
            (mesh.tets.as_slice(), mesh.tags.as_slice()),
            (&[[0, 1, 2, 3], [2, 3, 1, 4]][..], &[1, 2][..])
        );
        assert_eq!(
            mesh.groups,
            [
                Group::of("-1", 2, &[3], &[]),
                Group::of("2", 2, &[0, 1], &[]),
                Group::of("-1", 3, &[1, 2, 3, 4], &[1]),
                Group::of("7", 3, &[0, 1, 2, 3], &[0]),
            ]
        );
        assert!(mesh.rest_shapes().is_ok());
    }

    #[test]
    fn nodes_may_be_counted_from_zero() {
        let nodes = parse_nodes("5 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1").expect("bare nodes");
        let mesh = parse_tets("1 4\n0  0 1 2 3", nodes).expect("bare tetrahedra");
        assert_eq!((mesh.positions.len(), mesh.tets, mesh.groups), (4, vec![[0, 1, 2, 3]], vec![]));
    }

    #[track_caller]
    fn check(piece: &str, replacement: &str, line: usize, problem: &str) {
        assert!(NODES.contains(piece) || TETS.contains(piece));
        let nodes = parse_nodes(&NODES.replacen(piece, replacement, 1));
        let mesh = nodes.and_then(|nodes| parse_tets(&TETS.replacen(piece, replacement, 1), nodes));
        assert_eq!(mesh, Err(Problem { line, text: problem.to_owned() }));
    }

    #[test]
    fn problems_name_the_line() {
        check("6 3 1 1", "6 2 1 1", 2, "nodes have 2 coordinates; they must have 3");
        check("6 3 1 1", "7 3 1 1", 10, "the file ends where a node is expected");
        check("4  0 0 1", "4  0 o 1", 7, "expected the y coordinate, found `o`");
        check("4  0 0 1", "3  0 0 1", 7, "node 3 is given twice");
        check("0.5 -1", "0.5", 7, "the boundary marker of the node is missing");
        check("3 2 4 5", "3 2 4 9", 3, "the element names node 9, which does not exist");
        check("2 4 1\n", "2 5 1\n", 1, "tetrahedra have 5 nodes; they must have 4");
        let second_order = "the volume is made of 2 second-order tetrahedra (10 nodes), and only linear tetrahedra are \
                            read; run TetGen without `-o2`";
        check("2 4 1\n", "2 10 1\n", 1, second_order);
        check("2 4 1\n", "0 4 1\n", 1, "there is no tetrahedron");
        check("  7", "", 2, "the region of the tetrahedron is missing");
    }

    #[test]
    fn either_file_may_be_named_and_both_must_be_there() {
        for name in ["no/such/mesh.ele", "no/such/mesh.node"] {
            let missing = read_tetgen(name).expect_err("no such file");
            assert!(missing.to_string().starts_with("no/such/mesh.node: cannot be read: "), "{missing}");
        }
    }
}
