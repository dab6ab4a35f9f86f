//! Tetrahedral meshes from Gmsh's MSH files, 4.1 and 2.2, in ASCII.
//!
//! \[MSH\] Gmsh reference manual, "MSH file format" and "MSH file format version 2 (Legacy)".

use std::collections::{BTreeMap, HashMap};
use std::io::BufRead;
use std::path::Path;

use super::text::{Cursor, IN_GMSH, Line, Problem, ReadError, read, read_text};
use crate::mesh::elements::ElementCounts;
use crate::mesh::{Group, TetMesh};
use crate::message::quoted;

mod outline;
mod version2;
mod version4;

pub use outline::{MshItem, MshOutline, MshRun};

/// Command that converts files of other versions, and binary ones.
const CONVERTED: &str = "`gmsh OLD.msh -save -format msh41 -o NEW.msh` of Gmsh 4.1 or later converts it";

/// Sections with names like those of nodes or elements that contain neither: fields on them, and lists of
/// their tags.
const WITHOUT_MESH: [&str; 4] = ["$NodeData", "$ElementData", "$ElementNodeData", "$GhostElements"];

/// Reads the linear tetrahedra of a Gmsh file, MSH 4.1 or 2.2 in ASCII, with its physical groups.
///
/// Nodes may have any tags; those that belong to no tetrahedron are dropped and counted in
/// [`TetMesh::dropped_nodes`]. Points, lines and surface elements count only for the nodes of their groups. A
/// group without a name is called by its number. Rest volumes are checked later, by [`TetMesh::rest_shapes`].
///
/// # Errors
/// [`ReadError::OtherElements`] for a mesh with other volume elements; [`ReadError::only_tetrahedra`] returns
/// its tetrahedra. [`ReadError::Malformed`], which names the line, also if the file is binary, of another
/// version, partitioned, without linear tetrahedra, or has nodes or elements in a section that is not known.
pub fn read_msh(path: impl AsRef<Path>) -> Result<TetMesh, ReadError> {
    let path = path.as_ref();
    read(path, parse).and_then(|mesh| whole(path, mesh))
}

/// Parses the linear tetrahedra of a Gmsh file from text in memory; `name` stands for the file in errors.
///
/// Otherwise like [`read_msh`].
///
/// # Errors
/// [`ReadError::OtherElements`], [`ReadError::Malformed`].
pub fn parse_msh(text: &str, name: impl AsRef<Path>) -> Result<TetMesh, ReadError> {
    let name = name.as_ref();
    read_text(name, text, parse).and_then(|mesh| whole(name, mesh))
}

/// Refuses a mesh if anything is left out of it.
fn whole(path: &Path, mesh: TetMesh) -> Result<TetMesh, ReadError> {
    match mesh.left_out.is_empty() {
        true => Ok(mesh),
        false => Err(ReadError::OtherElements { path: path.to_owned(), mesh: Box::new(mesh) }),
    }
}

fn parse(text: &str) -> Result<TetMesh, Problem> {
    let (mut cursor, mut lists) = (Cursor::new(text), File::default());
    let names = sections(&mut cursor, &mut lists)?;
    lists.into_mesh(&names, cursor.number + 1)
}

/// Names of physical groups by dimension and tag.
type Names = BTreeMap<(usize, i64), String>;

/// Tags of the physical groups of each entity, by its dimension and tag.
type Entities = HashMap<(usize, i64), Vec<i64>>;

/// Receiver of the lists of nodes and elements, which are nearly all of a file: it reads them or records
/// their places.
trait Lists {
    /// Lines `tag x y z` of MSH 2.2.
    fn nodes_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem>;

    /// Lines `tag type number-of-tags physical-group …, node …` of MSH 2.2.
    fn elements_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem>;

    /// A block of MSH 4.1: the tags of nodes, then their positions.
    fn nodes_4<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem>;

    /// Lines `tag node …` of a block of MSH 4.1.
    fn elements_4<R: BufRead>(&mut self, block: &Block, cursor: &mut Cursor<R>) -> Result<(), Problem>;
}

/// Block of elements of MSH 4.1.
struct Block {
    dimension: usize,
    /// Type of the elements, by Gmsh's number.
    kind: usize,
    count: usize,
    /// Tags of the physical groups of all elements of the block.
    groups: Vec<i64>,
}

/// Reads the sections of a file; returns the names of the groups.
fn sections<R: BufRead>(cursor: &mut Cursor<R>, lists: &mut impl Lists) -> Result<Names, Problem> {
    let (mut names, mut entities, mut version) = (Names::new(), Entities::new(), None);
    while let Some(line) = cursor.next_filled()? {
        let section = line.text.trim().to_owned();
        match (section.as_str(), version) {
            ("$MeshFormat", _) => version = Some(format(cursor)?),
            ("$NOD" | "$NOE" | "$ELM", _) => {
                return Err(
                    line.problem(format!("`{section}` is of MSH 1, only 4.1 and 2.2 are read; {CONVERTED}"))
                );
            }
            (_, None) => {
                return Err(line.problem(format!(
                    "expected `$MeshFormat`, found `{}`; is this a Gmsh file?",
                    quoted(&section)
                )));
            }
            ("$PhysicalNames", _) => physical_names(cursor, &mut names)?,
            ("$Nodes" | "$ParametricNodes", Some(Version::Two)) => version2::nodes(cursor, lists)?,
            ("$Elements", Some(Version::Two)) => version2::elements(cursor, lists)?,
            ("$Entities", Some(Version::Four)) => version4::entities(cursor, &mut entities)?,
            ("$Nodes", Some(Version::Four)) => version4::nodes(cursor, lists)?,
            ("$Elements", Some(Version::Four)) => version4::elements(cursor, &entities, lists)?,
            ("$PartitionedEntities", _) => {
                return Err(line.problem(
                    "the mesh is partitioned, only whole ones are read; in Gmsh, `Mesh > Unpartition` joins the parts",
                ));
            }
            _ if section.starts_with('$') && !section.starts_with("$End") => {
                if may_hold_mesh(&section) {
                    return Err(line.problem(format!(
                        "the section `{}` is not known; nodes and elements are read from `$Nodes` and `$Elements`",
                        quoted(&section)
                    )));
                }
                skip_section(cursor, &section[1..])?;
                continue;
            }
            _ => {
                return Err(
                    line.problem(format!("expected the start of a section, found `{}`", quoted(&section)))
                );
            }
        }
        let mut end = cursor.next("the end of the section")?;
        let expected = format!("$End{}", &section[1..]);
        if end.words.next() != Some(&expected) {
            return Err(end.problem(format!("expected `{expected}`, found `{}`", quoted(end.text))));
        }
    }
    Ok(names)
}

/// True for the name of an unknown section that could hold nodes or elements, which must not go unnoticed.
/// Others, such as comments and periodicity, add nothing to the body.
fn may_hold_mesh(section: &str) -> bool {
    let name = section.to_ascii_lowercase();
    (name.contains("node") || name.contains("element")) && !WITHOUT_MESH.contains(&section)
}

/// Version of the format.
#[derive(Clone, Copy)]
enum Version {
    /// 2.2.
    Two,
    /// 4.1.
    Four,
}

/// Nodes and elements of a file.
#[derive(Default)]
struct File {
    positions: Vec<[f64; 3]>,
    /// Index of each node by its tag.
    node_of_tag: HashMap<usize, usize>,
    tets: Vec<[usize; 4]>,
    tags: Vec<usize>,
    /// Volume elements other than linear tetrahedra.
    others: ElementCounts,
    /// Nodes and tetrahedra of physical groups by dimension and tag.
    groups: BTreeMap<(usize, i64), Group>,
}

/// `version is-binary size-of-a-number`
fn format<R: BufRead>(cursor: &mut Cursor<R>) -> Result<Version, Problem> {
    let mut line = cursor.next("the format")?;
    let version = match line.words.next().unwrap_or_default() {
        "2.2" => Version::Two,
        "4.1" => Version::Four,
        other => {
            return Err(line.problem(format!(
                "the format is MSH `{}`, only 4.1 and 2.2 are read; {CONVERTED}",
                quoted(other)
            )));
        }
    };
    match line.number::<usize>("the file type")? {
        0 => Ok(version),
        _ => Err(line.problem(format!("the file is binary, only ASCII is read; {CONVERTED}"))),
    }
}

/// `count`, then `dimension tag "name"` each.
fn physical_names<R: BufRead>(cursor: &mut Cursor<R>, names: &mut Names) -> Result<(), Problem> {
    let count: usize = cursor.next("the number of names")?.number("the number of names")?;
    for _ in 0..count {
        let mut line = cursor.next("a physical name")?;
        let key = (line.number("the dimension of the group")?, line.number("the tag of the group")?);
        let name = line
            .text
            .find('"')
            .zip(line.text.rfind('"'))
            .filter(|(first, last)| first < last)
            .map(|(first, last)| &line.text[first + 1..last])
            .ok_or_else(|| line.problem("expected the name of the group in double quotes"))?;
        names.insert(key, name.to_owned());
    }
    Ok(())
}

/// Lines of the lists, in errors.
const NODE: &str = "a node";
const NODE_TAG: &str = "the tag of a node";
const POSITION: &str = "the position of a node";
const ELEMENT: &str = "an element";

/// Parses the next word as the tag of a node.
fn node_tag(line: &mut Line<'_>) -> Result<usize, Problem> {
    line.number(NODE_TAG)
}

/// Parses the next word as the tag of an element.
fn element_tag(line: &mut Line<'_>) -> Result<usize, Problem> {
    line.number("the tag of the element")
}

/// Parses the remaining four words of an element as the tags of its nodes.
fn corners(line: &mut Line<'_>) -> Result<[usize; 4], Problem> {
    let nodes = [node_tag(line)?, node_tag(line)?, node_tag(line)?, node_tag(line)?];
    match line.words.next() {
        None => Ok(nodes),
        Some(_) => Err(line.problem("the tetrahedron has more than four nodes")),
    }
}

/// Parses the remaining words of an element as the tags of its nodes.
fn node_tags(line: &mut Line<'_>) -> Result<Vec<usize>, Problem> {
    let mut nodes = Vec::new();
    while line.words.clone().next().is_some() {
        nodes.push(node_tag(line)?);
    }
    Ok(nodes)
}

impl Lists for File {
    fn nodes_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        for _ in 0..count {
            let mut line = cursor.next(NODE)?;
            let (tag, position) = version2::node(&mut line)?;
            self.add_node(tag, &line)?;
            self.positions.push(position);
        }
        Ok(())
    }

    fn elements_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        self.read_elements_2(count, cursor)
    }

    fn nodes_4<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        for _ in 0..count {
            let mut line = cursor.next(NODE_TAG)?;
            let tag = node_tag(&mut line)?;
            self.add_node(tag, &line)?;
        }
        for _ in 0..count {
            self.positions.push(cursor.next(POSITION)?.point()?);
        }
        Ok(())
    }

    fn elements_4<R: BufRead>(&mut self, block: &Block, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        self.read_elements_4(block, cursor)
    }
}

impl File {
    /// Adds the tag of a node, whose position comes after those of all nodes before it.
    fn add_node(&mut self, tag: usize, line: &Line<'_>) -> Result<(), Problem> {
        match self.node_of_tag.insert(tag, self.node_of_tag.len()) {
            None => Ok(()),
            Some(_) => Err(line.problem(format!("node {tag} is given twice"))),
        }
    }

    /// Index of the node with a tag.
    fn node(&self, tag: usize, line: &Line<'_>) -> Result<usize, Problem> {
        let node = self.node_of_tag.get(&tag).copied();
        node.ok_or_else(|| line.problem(format!("the element names node {tag}, which is not given above")))
    }

    /// Parses the remaining four words of an element as its nodes, which become indices.
    fn tetrahedron(&self, line: &mut Line<'_>) -> Result<[usize; 4], Problem> {
        let [a, b, c, d] = corners(line)?.map(|tag| self.node(tag, line));
        Ok([a?, b?, c?, d?])
    }

    /// Parses the remaining words of an element as its nodes, which become indices.
    fn nodes_of_element(&self, line: &mut Line<'_>) -> Result<Vec<usize>, Problem> {
        node_tags(line)?.into_iter().map(|tag| self.node(tag, line)).collect()
    }

    /// Puts a tetrahedron into a physical group.
    fn put_into_group(&mut self, tag: i64, tet: usize) {
        let group = self.groups.entry((3, tag)).or_default();
        group.nodes.extend(self.tets[tet]);
        group.tets.push(tet);
    }

    /// Drops the nodes of no tetrahedron and names the groups.
    fn into_mesh(self, names: &Names, end: usize) -> Result<TetMesh, Problem> {
        if self.tets.is_empty() {
            let text = match self.others.is_empty() {
                true => "the file ends without volume elements; in Gmsh, mesh with `-3`, and if there are physical \
                         groups add one of the volume"
                    .to_owned(),
                false => self.others.refusal(IN_GMSH),
            };
            return Err(Problem { line: end, text });
        }
        let groups = self.groups.into_iter().map(|((dimension, tag), group)| {
            let name = names.get(&(dimension, tag)).cloned().unwrap_or_else(|| tag.to_string());
            Group { name, dimension, ..group }
        });
        let (tags, groups, left_out) = (self.tags, groups.collect(), self.others);
        let mesh = TetMesh { tags, groups, left_out, ..TetMesh::new(self.positions, self.tets) };
        Ok(mesh.without_unused_nodes())
    }
}

/// Skips a section.
fn skip_section<R: BufRead>(cursor: &mut Cursor<R>, name: &str) -> Result<(), Problem> {
    let end = format!("$End{name}");
    let expected = format!("`{}`", quoted(&end));
    while cursor.next(&expected)?.text.trim() != end {}
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two tetrahedra with odd node tags, a triangle on a named surface, a stray node, an unknown section.
    pub(super) const GOOD: &str = r#"$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 7 "left side"
3 9 "flesh"
$EndPhysicalNames
$Entities
1 0 1 2
5 0 0 0 0
3 0 0 0 1 1 1 1 -7 0
1 0 0 0 1 1 1 1 9 0
2 0 0 0 1 1 1 2 9 11 0
$EndEntities
$Comments
anything
$EndComments
$Nodes
2 6 3 1000
0 5 0 1
1000
8 8 8
3 1 0 5
40
3
20
10
30
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
3 3 1 12
2 3 2 1
1 40 3 20
3 1 4 1
11 40 3 20 10
3 2 4 1
12 3 20 10 30
$EndElements
"#;

    /// The same in the older format; the second tetrahedron, of two groups, stands there twice.
    pub(super) const OLDER: &str = r#"$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 7 "left side"
3 9 "flesh"
$EndPhysicalNames
$Nodes
6
1000 8 8 8
40 0 0 0
3 1 0 0
20 0 1 0
10 0 0 1
30 1 1 1
$EndNodes
$Elements
5
1 2 2 -7 3 40 3 20
11 4 2 9 1 40 3 20 10
12 4 2 9 2 3 20 10 30
12 4 2 11 2 3 20 10 30
13 15 2 0 5 1000
$EndElements
"#;

    #[test]
    fn both_formats_say_the_same() {
        assert_eq!(parse(OLDER), parse(GOOD));
        // Without groups, and without tags at all.
        let bare = parse(&OLDER.replace("11 4 2 9 1 40", "11 4 0 40")).expect("no tags");
        assert_eq!((bare.groups[1].tets.as_slice(), bare.tets.len()), (&[1][..], 2));
    }

    #[test]
    fn nodes_elements_and_groups_arrive() {
        let mesh = parse(GOOD).expect("a good file");
        assert_eq!((mesh.positions.len(), mesh.dropped_nodes), (5, 1), "the stray node is dropped");
        assert_eq!(mesh.bounds().max, [1.0; 3], "and is not in the bounds");
        assert_eq!(mesh.positions[4], [1.0, 1.0, 1.0]);
        assert_eq!(mesh.tets, [[0, 1, 2, 3], [1, 2, 3, 4]]);
        assert_eq!(mesh.tags, [11, 12]);
        let group = |name: &str, dimension, nodes: &[usize], tets: &[usize]| Group {
            name: name.to_owned(),
            dimension,
            nodes: nodes.to_vec(),
            tets: tets.to_vec(),
        };
        assert_eq!(
            mesh.groups,
            [
                group("left side", 2, &[0, 1, 2], &[]),
                group("flesh", 3, &[0, 1, 2, 3, 4], &[0, 1]),
                group("11", 3, &[1, 2, 3, 4], &[1]),
            ]
        );
        assert!(mesh.rest_shapes().is_ok());
    }

    /// Replaces a piece of the good file and expects a complaint.
    #[track_caller]
    fn check(piece: &str, replacement: &str, line: usize, problem: &str) {
        check_in(GOOD, piece, replacement, line, problem);
    }

    #[track_caller]
    fn check_in(good: &str, piece: &str, replacement: &str, line: usize, problem: &str) {
        assert!(good.contains(piece));
        let text = good.replacen(piece, replacement, 1);
        assert_eq!(parse(&text), Err(Problem { line, text: problem.to_owned() }));
    }

    #[test]
    fn problems_name_the_line() {
        check(
            "4.1 0 8",
            "4 0 8",
            2,
            "the format is MSH `4`, only 4.1 and 2.2 are read; `gmsh OLD.msh -save -format msh41 -o NEW.msh` of \
             Gmsh 4.1 or later converts it",
        );
        check(
            "4.1 0 8",
            "4.1 1 8",
            2,
            "the file is binary, only ASCII is read; `gmsh OLD.msh -save -format msh41 -o NEW.msh` of Gmsh 4.1 or \
             later converts it",
        );
        check("$MeshFormat\n", "solid\n", 1, "expected `$MeshFormat`, found `solid`; is this a Gmsh file?");
        check("\"flesh\"", "flesh", 7, "expected the name of the group in double quotes");
        check("0 1 0\n", "0 one 0\n", 32, "expected the y coordinate, found `one`");
        check("0 1 0\n", "0 NaN 0\n", 32, "the y coordinate is NaN; it must be finite");
        check("\n10\n", "\n40\n", 28, "node 40 is given twice");
        check("11 40 3 20 10", "11 40 3 20 99", 41, "the element names node 99, which is not given above");
        check("11 40 3 20 10", "11 40 3 20", 41, "the tag of a node is missing");
        check("12 3 20 10 30\n", "", 43, "expected the tag of the element, found `$EndElements`");
        check("$EndElements\n", "", 44, "the file ends where the end of the section is expected");
        check("$EndNodes", "$EndNode", 35, "expected `$EndNodes`, found `$EndNode`");
        check("$Comments", "stray", 16, "expected the start of a section, found `stray`");
        check(
            "$Comments",
            "$PartitionedEntities",
            16,
            "the mesh is partitioned, only whole ones are read; in Gmsh, `Mesh > Unpartition` joins the parts",
        );
        check("11 40 3 20 10", "11 40 3 20 10 30", 41, "the tetrahedron has more than four nodes");
        check(
            "3 1 4 1\n11 40 3 20 10\n3 2 4 1\n12 3 20 10 30",
            "3 1 15 1\n11 40\n3 2 15 1\n12 3",
            45,
            "the file ends without volume elements; in Gmsh, mesh with `-3`, and if there are physical groups add \
             one of the volume",
        );
    }

    #[test]
    fn problems_of_the_older_format_name_the_line() {
        check_in(
            OLDER,
            "2.2 0 8",
            "2.2 1 8",
            2,
            "the file is binary, only ASCII is read; `gmsh OLD.msh -save -format msh41 -o NEW.msh` of Gmsh 4.1 or \
             later converts it",
        );
        check_in(OLDER, "\n10 0 0 1", "\n40 0 0 1", 15, "node 40 is given twice");
        check_in(OLDER, "\n10 0 0 1", "\n10 0 0", 15, "the z coordinate is missing");
        check_in(
            OLDER,
            "40 3 20 10",
            "40 3 20 99",
            21,
            "the element names node 99, which is not given above",
        );
        check_in(OLDER, "\n5\n1 2", "\n6\n1 2", 25, "expected the tag of the element, found `$EndElements`");
    }

    /// The words for a version, in the first section or without any.
    #[test]
    fn other_versions_are_named() {
        for version in ["4", "4.0", "1", "2", "2.0", "2.1", "3", "5.0"] {
            let error = parse(&GOOD.replace("4.1 0", &format!("{version} 0"))).expect_err(version).text;
            assert!(error.starts_with(&format!("the format is MSH `{version}`, only 4.1")), "{error}");
        }
        for section in ["$NOD", "$NOE", "$ELM"] {
            let expected = format!("`{section}` is of MSH 1, only 4.1 and 2.2 are read; {CONVERTED}");
            for text in [format!("{section}\n4\n"), GOOD.replace("$Comments", section)] {
                assert_eq!(parse(&text).expect_err(section).text, expected);
            }
        }
    }

    /// Parametric nodes have their coordinates first, in both formats.
    #[test]
    fn parametric_nodes_are_read() {
        let older = OLDER.replace("Nodes", "ParametricNodes").replace("8 8 8", "8 8 8 0 5");
        let older = older.replace("\n3 1 0 0\n", "\n3 1 0 0 2 1 0.25 0.75\n");
        assert_eq!(parse(&older), parse(OLDER));
        let newer =
            GOOD.replace("3 1 0 5", "3 1 1 5").replace("0 0 0\n1 0 0\n", "0 0 0 9 9 9\n1 0 0 9 9 9\n");
        assert_eq!(parse(&newer), parse(GOOD));
    }

    /// A section that could hold nodes or elements is not passed over; comments, fields on nodes and
    /// relations between them are.
    #[test]
    fn sections_with_nodes_or_elements_are_not_passed_over() {
        for section in ["$ParametricNodes", "$nodes", "$HexElements", "$NodeBlocks"] {
            let text = GOOD.replace("Comments", &section[1..]);
            let error = parse(&text).expect_err(section);
            let expected = format!(
                "the section `{section}` is not known; nodes and elements are read from `$Nodes` and `$Elements`"
            );
            assert_eq!(error, Problem { line: 16, text: expected });
        }
        let harmless =
            WITHOUT_MESH.into_iter().chain(["$Periodic", "$InterpolationScheme", "$Parametrizations"]);
        for section in harmless {
            assert_eq!(parse(&GOOD.replace("Comments", &section[1..])), parse(GOOD), "{section}");
        }
    }

    /// Elements by their lines behind number, type, tags: two hexahedra, of which the second is of two groups
    /// in the older format, a prism, a tetrahedron of second order, one of an unknown type.
    const OTHERS: [(usize, usize, &str); 5] = [
        (21, 5, "40 3 20 10 30 1000 40 3"),
        (22, 5, "40 3 20 10 30 1000 3 40"),
        (23, 6, "40 3 20 10 30 1000"),
        (24, 11, "40 3 20 10 30 1000 40 3 20 10"),
        (25, 999, "1 2 3"),
    ];

    /// Both files with other volume elements in addition to the tetrahedra.
    pub(super) fn mixed() -> [String; 2] {
        let newer = OTHERS.map(|(tag, kind, nodes)| format!("3 1 {kind} 1\n{tag} {nodes}\n")).concat();
        let older = OTHERS.map(|(tag, kind, nodes)| format!("{tag} {kind} 2 9 1 {nodes}\n")).concat();
        let again = "26 5 2 11 1 40 3 20 10 30 1000 3 40\n";
        [
            GOOD.replace("3 3 1 12\n", "8 8 1 25\n").replace("$EndElements", &format!("{newer}$EndElements")),
            OLDER
                .replace("$Elements\n5", "$Elements\n11")
                .replace("$EndElements", &format!("{older}{again}$EndElements")),
        ]
    }

    #[test]
    fn other_volume_elements_are_refused_by_type_and_count_or_left_out_and_counted() {
        let others = "2 hexahedra, 1 prism, 1 second-order tetrahedron (10 nodes), 1 element of type 999";
        for text in mixed() {
            let error = parse_msh(&text, "mixed.msh").expect_err("a mixed mesh");
            assert_eq!(
                error.to_string(),
                format!(
                    "mixed.msh: the volume is made of {others}, 2 tetrahedra, and only linear tetrahedra are read; \
                     mesh it with these alone (in Gmsh, without `Recombine` and with `-order 1`)"
                )
            );
            let mesh = error.only_tetrahedra().expect("its tetrahedra");
            assert_eq!(mesh.left_out.to_string(), others);
            let good = parse(GOOD).expect("a good file");
            assert_eq!((mesh.positions, mesh.tets, mesh.tags), (good.positions, good.tets, good.tags));
        }
    }

    #[test]
    fn a_mesh_without_a_linear_tetrahedron_is_refused_whatever_is_wanted() {
        for text in mixed() {
            let text =
                text.replace("12 3 20 10 30\n", "12 3 20 10 30 40 1000\n").replace("3 2 4 1", "3 2 6 1");
            let text = text.replace("11 40 3 20 10\n", "11 40 3 20 10 30\n").replace("3 1 4 1", "3 1 7 1");
            let text = text.replace("12 4 2 9 2 3 20 10 30", "12 6 2 9 2 3 20 10 30 40 1000");
            let text = text.replace("12 4 2 11 2 3 20 10 30", "12 6 2 11 2 3 20 10 30 40 1000");
            let text = text.replace("11 4 2 9 1 40 3 20 10", "11 7 2 9 1 40 3 20 10 30");
            let error =
                parse_msh(&text, "mixed.msh").or_else(ReadError::only_tetrahedra).expect_err("none left");
            let expected = "2 hexahedra, 2 prisms, 1 pyramid, 1 second-order tetrahedron (10 nodes), 1 element of \
                            type 999, and only linear";
            assert!(error.to_string().contains(expected), "{error}");
        }
    }

    /// An element stands there once for each of its groups; twice for one of them is two elements.
    #[test]
    fn an_element_twice_in_one_group_is_two_elements() {
        let mesh = parse(&OLDER.replace("12 4 2 11 2 3 20", "13 4 2 9 2 3 20")).expect("a file");
        assert_eq!(mesh.tags, [11, 12, 13]);
        assert_eq!(
            mesh.rest_shapes().unwrap_err().to_string(),
            "elements 12 and 13 join the same four nodes, which would count their volume twice; remove one of them"
        );
    }

    #[test]
    fn a_byte_order_mark_is_skipped() {
        for good in [GOOD, OLDER] {
            let marked = parse_msh(&format!("\u{feff}{good}"), "marked.msh").expect("a good file");
            assert_eq!(Ok(marked), parse(good));
        }
    }

    /// Escapes, an invisible mark and a line of a million characters in every place where a message quotes
    /// text of the file.
    #[test]
    fn messages_quote_nothing_that_a_terminal_obeys() {
        let hostile = format!("\u{1b}[2J\u{202e}{}", "x".repeat(1_000_000));
        let cuts =
            ["$MeshFormat\n", "4.1 0 8", "\"flesh\"", "0 1 0\n", "$EndNodes", "11 40 3 20 10", "$Comments"];
        for piece in cuts {
            for replacement in [hostile.clone(), format!("${hostile}"), format!("$X {hostile}\n")] {
                let text = GOOD.replacen(piece, &replacement, 1);
                let error = parse_msh(&text, "\u{1b}[31m.msh").expect_err(piece).to_string();
                assert!(error.chars().all(|c| !c.is_control() && c != '\u{202e}'), "{error:?}");
                assert!(error.len() < 300, "{error}");
            }
        }
    }

    #[test]
    fn a_file_cut_anywhere_is_an_error_and_no_panic() {
        for good in [GOOD, OLDER] {
            for end in 0..good.len() - "$EndElements\n".len() {
                assert!(parse(&good[..end]).is_err(), "cut after {end} bytes");
            }
        }
    }

    #[test]
    fn errors_name_the_file() {
        let missing = read_msh("no/such/file.msh").expect_err("no such file");
        assert!(missing.to_string().starts_with("no/such/file.msh: cannot be read: "), "{missing}");
    }
}
