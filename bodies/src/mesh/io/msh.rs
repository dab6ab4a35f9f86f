//! Tetrahedral meshes from Gmsh's MSH files, 4.1 and 2.2, in ASCII.
//!
//! \[MSH\] Gmsh reference manual, "MSH file format" and "MSH file format version 2 (Legacy)".

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use piola::__private::message::quoted;

use super::foreign::{self, BY_MESHIO};
use super::text::{Cursor, IN_GMSH, Line, Problem, ReadError, read, read_text};
use crate::mesh::elements::ElementCounts;
use crate::mesh::{Group, TetMesh};

mod version2;
mod version4;

/// Command that converts files of other versions, and binary ones.
const CONVERTED: &str = "`gmsh OLD.msh -save -format msh41 -o NEW.msh` of Gmsh 4.1 or later converts it";

/// Sections with names like those of nodes or elements that contain neither: fields on them, and lists of
/// their tags.
const WITHOUT_MESH: [&str; 4] = ["$NodeData", "$ElementData", "$ElementNodeData", "$GhostElements"];

/// Reads the linear tetrahedra of a Gmsh file, MSH 4.1 or 2.2 in ASCII, with its physical groups.
///
/// Nodes may have any tags; those that belong to no tetrahedron are dropped and counted in
/// [`TetMesh::dropped_nodes`]; tetrahedra with a negative volume are turned and counted in
/// [`TetMesh::turned_tets`]. Points, lines and surface elements count only for the nodes of their groups. A
/// group without a name is called by its number. Rest volumes are checked later, by [`TetMesh::rest_shapes`].
///
/// # Errors
/// [`ReadError::OtherElements`] for a mesh with other volume elements; [`ReadError::only_tetrahedra`] returns
/// its tetrahedra. [`ReadError::Malformed`], which names the line, also if the file is binary, of another
/// version or format, partitioned, without linear tetrahedra, or has nodes or elements in a section that is
/// not known.
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
    let mut file = File::default();
    let mut cursor = Cursor::new(text, None);
    let mut version = None;
    while let Some(line) = cursor.next_filled() {
        let section = line.text.trim();
        match (section, version) {
            ("$MeshFormat", _) => version = Some(format(&mut cursor)?),
            ("$NOD" | "$NOE" | "$ELM", _) => {
                return Err(
                    line.problem(format!("`{section}` is of MSH 1, only 4.1 and 2.2 are read; {CONVERTED}"))
                );
            }
            (_, None) => {
                return Err(line.problem(match foreign::recognised(text) {
                    Some((name, remedy)) => {
                        format!("the file is in {name}, only Gmsh's MSH and TetGen's files are read; {remedy}")
                    }
                    None => format!(
                        "expected `$MeshFormat`, found `{}`; is this a Gmsh file? If meshio reads it, {BY_MESHIO}",
                        quoted(section)
                    ),
                }));
            }
            ("$PhysicalNames", _) => file.physical_names(&mut cursor)?,
            ("$Nodes" | "$ParametricNodes", Some(Version::Two)) => file.nodes_2(&mut cursor)?,
            ("$Elements", Some(Version::Two)) => file.elements_2(&mut cursor)?,
            ("$Entities", Some(Version::Four)) => file.entities_4(&mut cursor)?,
            ("$Nodes", Some(Version::Four)) => file.nodes_4(&mut cursor)?,
            ("$Elements", Some(Version::Four)) => file.elements_4(&mut cursor)?,
            ("$PartitionedEntities", _) => {
                return Err(line.problem(
                    "the mesh is partitioned, only whole ones are read; in Gmsh, `Mesh > Unpartition` joins the parts",
                ));
            }
            _ if section.starts_with('$') && !section.starts_with("$End") => {
                // Nodes or elements must not go unnoticed. Comments, periodicity and others add nothing to
                // the body.
                let name = section.to_ascii_lowercase();
                let may_hold_mesh = name.contains("node") || name.contains("element");
                if may_hold_mesh && !WITHOUT_MESH.contains(&section) {
                    return Err(line.problem(format!(
                        "the section `{}` is not known; nodes and elements are read from `$Nodes` and `$Elements`",
                        quoted(section)
                    )));
                }
                let end = format!("$End{}", &section[1..]);
                let expected = format!("`{}`", quoted(&end));
                while cursor.next(&expected)?.text.trim() != end {}
                continue;
            }
            _ => {
                return Err(
                    line.problem(format!("expected the start of a section, found `{}`", quoted(section)))
                );
            }
        }
        let mut end = cursor.next("the end of the section")?;
        let expected = format!("$End{}", &section[1..]);
        if end.words.next() != Some(&expected) {
            return Err(end.problem(format!("expected `{expected}`, found `{}`", quoted(end.text))));
        }
    }
    file.into_mesh(cursor.number + 1)
}

#[derive(Clone, Copy)]
enum Version {
    /// 2.2.
    Two,
    /// 4.1.
    Four,
}

/// Contents of the sections of a file, or of TetGen's two files.
#[derive(Default)]
pub(super) struct File {
    /// Names of physical groups by dimension and tag.
    names: HashMap<(usize, i64), String>,
    /// Tags of the physical groups of each entity, by its dimension and tag.
    physical: HashMap<(usize, i64), Vec<i64>>,
    pub(super) positions: Vec<[f64; 3]>,
    /// Index of each node by its tag.
    pub(super) node_of_tag: HashMap<usize, usize>,
    pub(super) tets: Vec<[usize; 4]>,
    pub(super) tags: Vec<usize>,
    /// Volume elements other than linear tetrahedra.
    others: ElementCounts,
    /// Nodes and tetrahedra of physical groups by dimension and tag.
    pub(super) groups: BTreeMap<(usize, i64), Group>,
}

/// `version is-binary size-of-a-number`
fn format(cursor: &mut Cursor<'_>) -> Result<Version, Problem> {
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

    /// Parses the next words of a line as the tag of a node, which errors call `what`, and its position.
    pub(super) fn add_node(&mut self, line: &mut Line<'_>, what: &str) -> Result<(), Problem> {
        let tag = line.number(what)?;
        if self.node_of_tag.insert(tag, self.positions.len()).is_some() {
            return Err(line.problem(format!("node {tag} is given twice")));
        }
        self.positions.push(line.point()?);
        Ok(())
    }

    /// Parses the next word of an element as the index of a node.
    pub(super) fn node(&self, line: &mut Line<'_>) -> Result<usize, Problem> {
        let tag = line.number("the tag of a node")?;
        let node = self.node_of_tag.get(&tag).copied();
        node.ok_or_else(|| line.problem(format!("the element names node {tag}, which does not exist")))
    }

    /// Parses the remaining four words of an element as the indices of its nodes.
    fn tetrahedron(&self, line: &mut Line<'_>) -> Result<[usize; 4], Problem> {
        let nodes = [self.node(line)?, self.node(line)?, self.node(line)?, self.node(line)?];
        match line.words.next() {
            None => Ok(nodes),
            Some(_) => Err(line.problem("the tetrahedron has more than four nodes")),
        }
    }

    /// Parses the remaining words of an element as the indices of its nodes.
    fn nodes_of_element(&self, line: &mut Line<'_>) -> Result<Vec<usize>, Problem> {
        let mut nodes = Vec::new();
        while line.words.clone().next().is_some() {
            nodes.push(self.node(line)?);
        }
        Ok(nodes)
    }

    /// Adds a tetrahedron to a group of volumes.
    pub(super) fn put_into_group(&mut self, tag: i64, tet: usize) {
        let group = self.groups.entry((3, tag)).or_default();
        group.nodes.extend(self.tets[tet]);
        group.tets.push(tet);
    }

    /// Drops the nodes of no tetrahedron, turns tetrahedra with a negative volume and names the groups.
    pub(super) fn into_mesh(self, end: usize) -> Result<TetMesh, Problem> {
        if self.tets.is_empty() {
            let text = match self.others.is_empty() {
                true => "the file ends without volume elements; in Gmsh, mesh with `-3`, and if there are \
                         physical groups add one of the volume"
                    .to_owned(),
                false => self.others.refusal(IN_GMSH),
            };
            return Err(Problem { line: end, text });
        }
        let groups = self.groups.into_iter().map(|((dimension, tag), group)| {
            let name = self.names.get(&(dimension, tag)).cloned().unwrap_or_else(|| tag.to_string());
            Group { name, dimension, ..group }
        });
        let (tags, groups, left_out) = (self.tags, groups.collect(), self.others);
        let mesh = TetMesh { tags, groups, left_out, ..TetMesh::new(self.positions, self.tets) };
        Ok(mesh.without_unused_nodes().turn_tets())
    }
}

#[cfg(test)]
mod tests;
