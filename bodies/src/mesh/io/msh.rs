//! Tetrahedral meshes from Gmsh's MSH files, 4.1 and 2.2, in ASCII.
//!
//! \[MSH\] Gmsh reference manual, "MSH file format" and "MSH file format version 2 (Legacy)".

use std::collections::{BTreeMap, HashMap};
use std::io::BufRead;
use std::path::Path;

use piola::__private::message::quoted;

use super::text::{Cursor, IN_GMSH, Line, Problem, ReadError, read, read_text};
use crate::mesh::elements::ElementCounts;
use crate::mesh::{Group, TetMesh};

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
mod tests;
