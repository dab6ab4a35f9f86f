//! Tetrahedral meshes from Gmsh's MSH 4.1 files in ASCII.
//!
//! [MSH] Gmsh reference manual, "MSH file format", version 4.1.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use super::{Line, Problem, ReadError, named, read};
use crate::mesh::{Group, TetMesh};

/// Gmsh's number for a linear tetrahedron.
const TETRAHEDRON: usize = 4;

/// Reads the linear tetrahedra of a Gmsh file, MSH 4.1 in ASCII, with its physical groups.
///
/// Nodes may have any tags; those that belong to no tetrahedron are dropped. Elements of other types count only for
/// the nodes of their groups. A group without a name is called by its number. Rest volumes are judged later, by
/// [`TetMesh::rest_shapes`].
///
/// # Errors
/// Where the file cannot be read or a line of it (named) is malformed; where it is binary, of another version,
/// partitioned, or without linear tetrahedra.
pub fn read_msh(path: impl AsRef<Path>) -> Result<TetMesh, ReadError> {
    read(path.as_ref(), parse)
}

/// The same from text already in memory, such as a file that is part of the program; `name` goes into complaints.
///
/// # Errors
/// Where a line is malformed, as above.
pub fn parse_msh(text: &str, name: impl AsRef<Path>) -> Result<TetMesh, ReadError> {
    named(name.as_ref(), parse(text))
}

fn parse(text: &str) -> Result<TetMesh, Problem> {
    let mut file = File::default();
    let mut cursor = Cursor { lines: text.lines(), number: 0 };
    let mut seen_format = false;
    while let Some(line) = cursor.next_filled() {
        let section = line.text.trim();
        if !seen_format && section != "$MeshFormat" {
            return Err(line.problem(format!(
                "expected `$MeshFormat`, found `{}`; is this a Gmsh file?",
                clip(section)
            )));
        }
        seen_format = true;
        match section {
            "$MeshFormat" => format(&mut cursor)?,
            "$PhysicalNames" => file.physical_names(&mut cursor)?,
            "$Entities" => file.entities(&mut cursor)?,
            "$Nodes" => file.nodes(&mut cursor)?,
            "$Elements" => file.elements(&mut cursor)?,
            "$PartitionedEntities" => return Err(line.problem("partitioned meshes are not supported")),
            _ if section.starts_with('$') && !section.starts_with("$End") => {
                cursor.skip_section(&section[1..])?;
                continue;
            }
            _ => {
                return Err(
                    line.problem(format!("expected the start of a section, found `{}`", clip(section)))
                );
            }
        }
        let mut end = cursor.next("the end of the section")?;
        let expected = format!("$End{}", &section[1..]);
        if end.words.next() != Some(&expected) {
            return Err(end.problem(format!("expected `{expected}`, found `{}`", clip(end.text))));
        }
    }
    file.into_mesh(cursor.number + 1)
}

/// What the sections of a file say.
#[derive(Default)]
struct File {
    /// Names of physical groups by dimension and tag.
    names: HashMap<(usize, i64), String>,
    /// Tags of the physical groups of each entity, by its dimension and tag.
    physical: HashMap<(usize, i64), Vec<i64>>,
    positions: Vec<[f64; 3]>,
    /// Index of each node by its tag.
    node_of_tag: HashMap<usize, usize>,
    tets: Vec<[usize; 4]>,
    tags: Vec<usize>,
    /// Nodes and tetrahedra of physical groups by dimension and tag.
    groups: BTreeMap<(usize, i64), Group>,
}

/// `version is-binary size-of-a-number`
fn format(cursor: &mut Cursor<'_>) -> Result<(), Problem> {
    let mut line = cursor.next("the format")?;
    let version = line.words.next().unwrap_or_default();
    if version != "4.1" {
        return Err(line.problem(format!(
            "the format is `{}`, only MSH 4.1 is read; in Gmsh, export as version 4 ASCII",
            clip(version)
        )));
    }
    match line.number::<usize>("the file type")? {
        0 => Ok(()),
        _ => Err(line.problem("the file is binary, only ASCII is read; in Gmsh, export as version 4 ASCII")),
    }
}

impl File {
    /// `count`, then `dimension tag "name"` each.
    fn physical_names(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
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
            self.names.insert(key, name.to_owned());
        }
        Ok(())
    }

    /// Counts of points, curves, surfaces, volumes; then for each its tag, a point or a box, and its physical groups.
    fn entities(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let mut line = cursor.next("the numbers of entities")?;
        let mut counts = [0usize; 4];
        for count in &mut counts {
            *count = line.number("the number of entities of a dimension")?;
        }
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let mut line = cursor.next("an entity")?;
                let tag = line.number("the tag of the entity")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    line.number::<f64>("a coordinate of the entity")?;
                }
                let groups: usize = line.number("the number of physical groups")?;
                let mut tags = Vec::new();
                for _ in 0..groups {
                    // A negative tag means the reversed orientation, which is nothing to a set of elements.
                    tags.push(line.number::<i32>("the tag of a physical group")?.unsigned_abs().into());
                }
                self.physical.insert((dimension, tag), tags);
            }
        }
        Ok(())
    }

    /// `blocks nodes min max`, then for each block `dimension entity parametric count`, its tags, its coordinates.
    fn nodes(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let blocks: usize = cursor.next("the number of node blocks")?.number("the number of node blocks")?;
        let mut tags = Vec::new();
        for _ in 0..blocks {
            let mut line = cursor.next("a block of nodes")?;
            line.number::<usize>("the dimension of the block")?;
            line.number::<i64>("the entity of the block")?;
            line.number::<usize>("whether the block is parametric")?;
            let count: usize = line.number("the number of nodes of the block")?;
            tags.clear();
            for _ in 0..count {
                let mut line = cursor.next("the tag of a node")?;
                let tag = line.number("the tag of a node")?;
                if self.node_of_tag.insert(tag, self.positions.len() + tags.len()).is_some() {
                    return Err(line.problem(format!("node {tag} is given twice")));
                }
                tags.push(tag);
            }
            for tag in &tags {
                self.positions.push(cursor.next(&format!("the position of node {tag}"))?.point()?);
            }
        }
        Ok(())
    }

    /// `blocks elements min max`, then for each block `dimension entity type count` and lines `tag node …`.
    fn elements(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let blocks: usize =
            cursor.next("the number of element blocks")?.number("the number of element blocks")?;
        for _ in 0..blocks {
            let mut line = cursor.next("a block of elements")?;
            let dimension: usize = line.number("the dimension of the block")?;
            let entity: i64 = line.number("the entity of the block")?;
            let kind: usize = line.number("the type of the elements")?;
            let count: usize = line.number("the number of elements of the block")?;
            let groups = self.physical.get(&(dimension, entity)).cloned().unwrap_or_default();
            for _ in 0..count {
                let mut line = cursor.next("an element")?;
                let tag: usize = line.number("the tag of the element")?;
                if kind == TETRAHEDRON {
                    self.tags.push(tag);
                    let tet = [
                        self.node(&mut line)?,
                        self.node(&mut line)?,
                        self.node(&mut line)?,
                        self.node(&mut line)?,
                    ];
                    self.tets.push(tet);
                    for &group in &groups {
                        let group = self.groups.entry((dimension, group)).or_default();
                        group.nodes.extend(tet);
                        group.tets.push(self.tets.len() - 1);
                    }
                } else if !groups.is_empty() {
                    while line.words.clone().next().is_some() {
                        let node = self.node(&mut line)?;
                        for &group in &groups {
                            self.groups.entry((dimension, group)).or_default().nodes.push(node);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The next word of an element as the index of a node.
    fn node(&self, line: &mut Line<'_>) -> Result<usize, Problem> {
        let tag = line.number("the tag of a node")?;
        self.node_of_tag
            .get(&tag)
            .copied()
            .ok_or_else(|| line.problem(format!("the element names node {tag}, which is not given above")))
    }

    /// Drops the nodes of no tetrahedron and names the groups.
    fn into_mesh(self, end: usize) -> Result<TetMesh, Problem> {
        if self.tets.is_empty() {
            return Err(Problem {
                line: end,
                text: "the file ends without a linear tetrahedron (element type 4)".to_owned(),
            });
        }
        let mut used = vec![false; self.positions.len()];
        self.tets.iter().flatten().for_each(|&node| used[node] = true);
        let mut positions = Vec::new();
        let mut renumbered = vec![None; used.len()];
        for (node, _) in used.iter().enumerate().filter(|(_, used)| **used) {
            renumbered[node] = Some(positions.len());
            positions.push(self.positions[node]);
        }
        let groups = self.groups.into_iter().map(|((dimension, tag), group)| {
            let mut nodes: Vec<usize> = group.nodes.into_iter().filter_map(|node| renumbered[node]).collect();
            nodes.sort_unstable();
            nodes.dedup();
            let name = self.names.get(&(dimension, tag)).cloned().unwrap_or_else(|| tag.to_string());
            Group { name, dimension, nodes, tets: group.tets }
        });
        let groups = groups.collect();
        // Every node of a tetrahedron is in use, so that the default is never taken.
        let tets = self.tets.iter().map(|tet| tet.map(|node| renumbered[node].unwrap_or_default())).collect();
        Ok(TetMesh { positions, tets, tags: self.tags, groups })
    }
}

/// The lines of a file in order.
struct Cursor<'a> {
    lines: std::str::Lines<'a>,
    /// Number of the line last read, from 1.
    number: usize,
}

impl<'a> Cursor<'a> {
    /// The next line that is not blank.
    fn next_filled(&mut self) -> Option<Line<'a>> {
        loop {
            let text = self.lines.next()?;
            self.number += 1;
            if !text.trim().is_empty() {
                return Some(Line::new(self.number, text));
            }
        }
    }

    /// The same where `what` is expected.
    fn next(&mut self, what: &str) -> Result<Line<'a>, Problem> {
        self.next_filled().ok_or_else(|| Problem {
            line: self.number + 1,
            text: format!("the file ends where {what} is expected"),
        })
    }

    /// Goes behind the end of a section of no interest.
    fn skip_section(&mut self, name: &str) -> Result<(), Problem> {
        let end = format!("$End{name}");
        while self.next(&format!("`{end}`"))?.text.trim() != end {}
        Ok(())
    }
}

/// At most 40 characters, for a complaint.
fn clip(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two tetrahedra with odd node tags, a triangle on a named surface, a stray node, an unknown section.
    const GOOD: &str = r#"$MeshFormat
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

    #[test]
    fn nodes_elements_and_groups_arrive() {
        let mesh = parse(GOOD).expect("a good file");
        assert_eq!(mesh.positions.len(), 5, "the stray node is dropped");
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
        assert!(GOOD.contains(piece));
        let text = GOOD.replacen(piece, replacement, 1);
        assert_eq!(parse(&text), Err(Problem { line, text: problem.to_owned() }));
    }

    #[test]
    fn problems_name_the_line() {
        check(
            "4.1 0 8",
            "2.2 0 8",
            2,
            "the format is `2.2`, only MSH 4.1 is read; in Gmsh, export as version 4 ASCII",
        );
        check(
            "4.1 0 8",
            "4.1 1 8",
            2,
            "the file is binary, only ASCII is read; in Gmsh, export as version 4 ASCII",
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
        check("$Comments", "$PartitionedEntities", 16, "partitioned meshes are not supported");
        check(
            "3 1 4 1\n11 40 3 20 10\n3 2 4 1\n12 3 20 10 30",
            "3 1 15 1\n11 40\n3 2 15 1\n12 3",
            45,
            "the file ends without a linear tetrahedron (element type 4)",
        );
    }

    #[test]
    fn a_file_cut_anywhere_is_an_error_and_no_panic() {
        for end in 0..GOOD.len() - "$EndElements\n".len() {
            assert!(parse(&GOOD[..end]).is_err(), "cut after {end} bytes");
        }
    }

    #[test]
    fn errors_name_the_file() {
        let missing = read_msh("no/such/file.msh").expect_err("no such file");
        assert!(missing.to_string().starts_with("no/such/file.msh: cannot be read: "), "{missing}");
    }
}
