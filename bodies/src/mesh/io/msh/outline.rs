//! Outline of a Gmsh file: the places of its lists, which readers can take in parts.

use std::io::BufRead;
use std::path::Path;

use super::super::text::{Cursor, Line, Problem, ReadError};
use super::version2::{self, Element};
use super::{
    Block, ELEMENT, Lists, NODE, NODE_TAG, Names, POSITION, corners, element_tag, node_tag, node_tags,
    sections,
};
use crate::mesh::elements::TETRAHEDRON;

/// Largest number of lines of a run.
const MOST: usize = 4096;

/// Outline of a Gmsh file, MSH 4.1 or 2.2 in ASCII: its groups, and the places of nodes and elements, which
/// are not read. Several readers can then read the runs of lines at the same time.
///
/// ```
/// use piola_bodies::mesh::{MshItem, MshOutline};
///
/// let file = std::env::temp_dir().join(format!("piola-outline-{}.msh", std::process::id()));
/// let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
///     $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
///     $Elements\n1\n7 4 0 1 2 3 4\n$EndElements\n";
/// std::fs::write(&file, text)?;
/// let outline = MshOutline::read(&file)?;
/// let (nodes, elements) = (&outline.runs[0], &outline.runs[1]);
/// assert_eq!((nodes.count, elements.count, elements.line), (4, 1, 12));
/// elements.read(&file, |_, item| {
///     assert_eq!(item, MshItem::Tetrahedron { tag: 7, corners: [1, 2, 3, 4], group: None });
/// })?;
/// # std::fs::remove_file(&file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MshOutline {
    /// Number of nodes.
    pub nodes: usize,
    /// Runs of lines in the order of the file.
    pub runs: Vec<MshRun>,
    /// Dimension, tag and name of each physical group with a name. A group without a name is called by its
    /// tag.
    pub names: Vec<(usize, i64, String)>,
}

/// Run of lines of one kind, with nodes or elements.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MshRun {
    /// Number of bytes of the file before the run.
    pub offset: u64,
    /// Number of lines of the file before the run.
    pub line: usize,
    /// Number of lines of the run, blank lines excluded: at most 4096.
    pub count: usize,
    /// Index of the first node, in a run of tags or positions of nodes.
    pub first: usize,
    /// Tags of the physical groups of all elements of the run. In MSH 2.2 each element has its own.
    pub groups: Vec<i64>,
    kind: Kind,
}

/// Kind of the lines of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Kind {
    Tags,
    Positions,
    /// Nodes of MSH 2.2.
    Nodes,
    /// Elements of MSH 2.2.
    Elements,
    Tetrahedra,
    /// Elements that are members of groups of this dimension.
    Members {
        dimension: usize,
    },
    /// Volume elements that are not linear tetrahedra.
    Others,
}

/// Content of a line of a run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MshItem {
    /// Tag of the next node.
    Tag(usize),
    /// Position of the next node, in the unit of the file.
    Position([f64; 3]),
    /// Linear tetrahedron.
    Tetrahedron {
        /// Tag of the element.
        tag: usize,
        /// Tags of its nodes.
        corners: [usize; 4],
        /// Tag of its physical group, in MSH 2.2. An element of several groups is repeated for each of them,
        /// perhaps with other tags.
        group: Option<i64>,
    },
    /// Point, line or surface element, which is read for the nodes of its groups.
    Member {
        /// Dimension of the groups.
        dimension: usize,
        /// Tags of its nodes.
        nodes: Vec<usize>,
        /// Tag of its physical group, in MSH 2.2.
        group: Option<i64>,
    },
    /// Volume element that is not a linear tetrahedron.
    Other,
}

impl MshOutline {
    /// Reads the outline of a file. The file is read once, and not held in memory.
    ///
    /// # Errors
    /// [`ReadError::Unreadable`], [`ReadError::Malformed`]. Malformed lines within the runs are reported by
    /// [`MshRun::read`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let mut outline = Self::default();
        let names: Names =
            sections(&mut Cursor::open(path)?, &mut outline).map_err(|problem| problem.in_file(path))?;
        outline.names = names.into_iter().map(|((dimension, tag), name)| (dimension, tag, name)).collect();
        Ok(outline)
    }

    /// Passes over lines and records their places.
    fn pass<R: BufRead>(
        &mut self,
        cursor: &mut Cursor<R>,
        (count, kind, what): (usize, Kind, &str),
        groups: &[i64],
    ) -> Result<(), Problem> {
        for begin in (0..count).step_by(MOST) {
            let run = MshRun {
                offset: cursor.offset,
                line: cursor.number,
                count: MOST.min(count - begin),
                first: self.nodes + begin,
                groups: groups.to_vec(),
                kind,
            };
            cursor.skip(run.count, what)?;
            self.runs.push(run);
        }
        Ok(())
    }
}

impl Lists for MshOutline {
    fn nodes_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        self.pass(cursor, (count, Kind::Nodes, NODE), &[])?;
        self.nodes += count;
        Ok(())
    }

    fn elements_2<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        self.pass(cursor, (count, Kind::Elements, ELEMENT), &[])
    }

    fn nodes_4<R: BufRead>(&mut self, count: usize, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        self.pass(cursor, (count, Kind::Tags, NODE_TAG), &[])?;
        self.pass(cursor, (count, Kind::Positions, POSITION), &[])?;
        self.nodes += count;
        Ok(())
    }

    fn elements_4<R: BufRead>(&mut self, block: &Block, cursor: &mut Cursor<R>) -> Result<(), Problem> {
        let kind = match block.kind {
            TETRAHEDRON => Kind::Tetrahedra,
            _ if block.is_volume() => Kind::Others,
            _ if block.has_members() => Kind::Members { dimension: block.dimension },
            _ => return cursor.skip(block.count, ELEMENT),
        };
        self.pass(cursor, (block.count, kind, ELEMENT), &block.groups)
    }
}

impl MshRun {
    /// Reads the run from the file of the outline. `take` receives each item with the number of its line.
    ///
    /// # Errors
    /// [`ReadError::Unreadable`], [`ReadError::Malformed`].
    pub fn read(
        &self,
        path: impl AsRef<Path>,
        mut take: impl FnMut(usize, MshItem),
    ) -> Result<(), ReadError> {
        let path = path.as_ref();
        let mut cursor = Cursor::open_at(path, self.offset, self.line)?;
        self.take(&mut cursor, &mut take).map_err(|problem| problem.in_file(path))
    }

    fn take<R: BufRead>(
        &self,
        cursor: &mut Cursor<R>,
        take: &mut impl FnMut(usize, MshItem),
    ) -> Result<(), Problem> {
        for _ in 0..self.count {
            let mut line = cursor.next("another line of nodes or elements")?;
            let (number, line) = (line.number, &mut line);
            match self.kind {
                Kind::Tags => take(number, MshItem::Tag(node_tag(line)?)),
                Kind::Positions => take(number, MshItem::Position(line.point()?)),
                Kind::Nodes => {
                    let (tag, position) = version2::node(line)?;
                    take(number, MshItem::Tag(tag));
                    take(number, MshItem::Position(position));
                }
                Kind::Elements => element_2(line)?.into_iter().for_each(|item| take(number, item)),
                Kind::Tetrahedra => {
                    let (tag, corners) = (element_tag(line)?, corners(line)?);
                    take(number, MshItem::Tetrahedron { tag, corners, group: None });
                }
                Kind::Members { dimension } => {
                    element_tag(line)?;
                    take(number, MshItem::Member { dimension, nodes: node_tags(line)?, group: None });
                }
                Kind::Others => take(number, MshItem::Other),
            }
        }
        Ok(())
    }
}

/// Reads the line of an element of MSH 2.2; `None` for one that is neither of the volume nor of a group.
fn element_2(line: &mut Line<'_>) -> Result<Option<MshItem>, Problem> {
    let element = Element::read(line)?;
    let Element { tag, kind, dimension, group } = element;
    Ok(match dimension {
        _ if kind == TETRAHEDRON => Some(MshItem::Tetrahedron { tag, corners: corners(line)?, group }),
        _ if element.is_volume() => Some(MshItem::Other),
        Some(dimension) if group.is_some() => {
            Some(MshItem::Member { dimension, nodes: node_tags(line)?, group })
        }
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{GOOD, OLDER, mixed};
    use super::*;

    /// Name of a file that only one test uses.
    fn file(test: &str) -> std::path::PathBuf {
        std::env::temp_dir().join(format!("piola-outline-{test}-{}.msh", std::process::id()))
    }

    /// Items of all runs, each with its line.
    fn items(text: &str, file: &Path) -> Result<Vec<(usize, MshItem)>, ReadError> {
        std::fs::write(file, text).expect("a scratch file");
        let mut items = Vec::new();
        for run in MshOutline::read(file)?.runs {
            run.read(file, |line, item| items.push((line, item)))?;
        }
        Ok(items)
    }

    #[test]
    fn runs_have_all_nodes_and_elements() -> Result<(), Box<dyn std::error::Error>> {
        let file = file("runs");
        let tags = |items: &[(usize, MshItem)]| -> Vec<usize> {
            items
                .iter()
                .filter_map(|(_, item)| if let MshItem::Tag(tag) = item { Some(*tag) } else { None })
                .collect()
        };
        let tetrahedron = |tag, corners, group| MshItem::Tetrahedron { tag, corners, group };
        let newer = items(&format!("\u{feff}{GOOD}"), &file)?;
        assert_eq!(tags(&newer), [1000, 40, 3, 20, 10, 30]);
        assert_eq!(newer[1], (23, MshItem::Position([8.0; 3])));
        assert_eq!(newer[12], (39, MshItem::Member { dimension: 2, nodes: vec![40, 3, 20], group: None }));
        assert_eq!(newer[13], (41, tetrahedron(11, [40, 3, 20, 10], None)));
        let outline = MshOutline::read(&file)?;
        assert_eq!(
            (outline.nodes, outline.runs.last().map(|run| run.groups.clone())),
            (6, Some(vec![9, 11]))
        );
        assert_eq!(outline.names, [(2, 7, "left side".to_owned()), (3, 9, "flesh".to_owned())]);

        let older = items(&OLDER.replace('\n', "\r\n"), &file)?;
        assert_eq!(tags(&older), [1000, 40, 3, 20, 10, 30]);
        let expected = [
            (20, MshItem::Member { dimension: 2, nodes: vec![40, 3, 20], group: Some(7) }),
            (21, tetrahedron(11, [40, 3, 20, 10], Some(9))),
            (22, tetrahedron(12, [3, 20, 10, 30], Some(9))),
            (23, tetrahedron(12, [3, 20, 10, 30], Some(11))),
        ];
        assert_eq!(older[12..], expected);
        std::fs::remove_file(file)?;
        Ok(())
    }

    #[test]
    fn other_volume_elements_are_found() -> Result<(), Box<dyn std::error::Error>> {
        let file = file("others");
        for (text, count) in mixed().iter().zip([5, 6]) {
            let found = items(text, &file)?;
            assert_eq!(found.iter().filter(|(_, item)| *item == MshItem::Other).count(), count);
        }
        std::fs::remove_file(file)?;
        Ok(())
    }

    /// A long list is divided, and blank lines do not count.
    #[test]
    fn long_lists_are_divided() -> Result<(), Box<dyn std::error::Error>> {
        let file = file("long");
        let count = 2 * MOST + 7;
        let nodes: String = (1..=count).map(|node| format!("{node} 0 0 {node}\n\n")).collect();
        let text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{count}\n{nodes}$EndNodes\n");
        let found = items(&text, &file)?;
        for (node, pair) in found.chunks(2).enumerate() {
            let (line, tag) = (2 * node + 6, node + 1);
            assert_eq!(pair, [(line, MshItem::Tag(tag)), (line, MshItem::Position([0.0, 0.0, tag as f64]))]);
        }
        let runs = MshOutline::read(&file)?.runs;
        let firsts: Vec<_> = runs.iter().map(|run| (run.first, run.count)).collect();
        assert_eq!(firsts, [(0, MOST), (MOST, MOST), (2 * MOST, 7)]);
        std::fs::remove_file(file)?;
        Ok(())
    }

    /// Errors are those of the reader of whole files, in the outline or in a run.
    #[test]
    fn problems_are_those_of_the_whole_file() -> Result<(), Box<dyn std::error::Error>> {
        let file = file("problems");
        for (good, piece, replacement) in [
            (GOOD, "4.1 0 8", "4 0 8"),
            (GOOD, "0 1 0\n", "0 one 0\n"),
            (GOOD, "11 40 3 20 10", "11 40 3 20"),
            (GOOD, "11 40 3 20 10", "11 40 3 20 10 30"),
            (GOOD, "$EndElements\n", ""),
            (GOOD, "$Comments", "stray"),
            (OLDER, "\n10 0 0 1", "\n10 0 0"),
            (OLDER, "12 4 2 11", "12 4 2 x"),
        ] {
            let text = good.replacen(piece, replacement, 1);
            let found = items(&text, &file).expect_err(piece).to_string();
            assert_eq!(found, crate::mesh::read_msh(&file).expect_err(piece).to_string());
        }
        let cut = items(&GOOD.replace("12 3 20 10 30\n", ""), &file).expect_err("a missing line").to_string();
        assert!(cut.ends_with(":43: expected an element, found `$EndElements`"), "{cut}");
        std::fs::remove_file(&file)?;
        let missing = MshOutline::read(&file).expect_err("no such file").to_string();
        assert!(missing.contains("cannot be read: "), "{missing}");
        Ok(())
    }
}
