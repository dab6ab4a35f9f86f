//! Parallel reader of Gmsh's files, by their outline: rank 0 finds the lines of nodes and elements, and each
//! rank reads a part of them.

use std::collections::BTreeMap;
use std::path::Path;

use piola_bodies::mesh::{MshItem, MshOutline, ReadError};
use piola_scenes::error::Error as SceneError;

use super::{NO_GROUP, Part, Rows};
use crate::error::Error;
use crate::portion::Homes;
use crate::team::Team;

/// Lines that a rank has read, in which elements name the tags of nodes.
#[derive(Default)]
struct Lines {
    /// Tag, number in the order of the file, and line of nodes.
    tags: Vec<[u64; 3]>,
    /// Number and bits of the position of nodes.
    positions: Vec<[u64; 4]>,
    /// Tetrahedra: tags of the four nodes, line, tag and tag of the group.
    tetrahedra: Vec<[u64; 7]>,
    /// Nodes of points, lines and surfaces: tag, dimension and tag of the group, and line.
    members: Vec<[u64; 4]>,
    /// Number of volume elements that are not linear tetrahedra.
    others: usize,
    /// True if an element names its group itself, as in MSH 2.2.
    names_groups: bool,
}

/// Reads a file; `None` for a mesh without tetrahedra or with other volume elements.
///
/// # Errors
/// [`Error::OnRank`].
pub(super) fn read(team: &Team, path: &Path) -> Result<Option<Part>, Error> {
    let outline = outline(team, path)?;
    let lines = team.agree(lines(team, path, &outline).map_err(|error| SceneError::from(error).into()))?;
    if team.count(lines.others) > 0 || team.count(lines.tetrahedra.len()) == 0 {
        return Ok(None);
    }
    let Lines { tags, positions, mut tetrahedra, members, names_groups, .. } = lines;
    let repeats = team.count(usize::from(names_groups)) > 0;

    let malformed = |line: u64, problem: String| {
        let (path, line) = (path.to_owned(), line as usize);
        Error::from(SceneError::from(ReadError::Malformed { path, line, problem }))
    };
    let directory = Directory::new(team, tags);
    let twice = directory.twice().map(|[tag, _, line]| malformed(line, format!("node {tag} is given twice")));
    team.agree(twice.map_or(Ok(()), Err))?;
    let named = tetrahedra.iter().flat_map(|row| &row[..4]).chain(members.iter().map(|row| &row[0]));
    let numbers = directory.numbers(team, named.copied());
    let number = |tag: u64, line: u64| {
        let at = numbers.binary_search_by_key(&tag, |&[tag, _]| tag);
        at.map(|at| numbers[at][1]).map_err(|_| {
            malformed(line, format!("the element names node {tag}, which is not among the nodes of the file"))
        })
    };
    let mut numbered = || {
        for row in &mut tetrahedra {
            let line = row[4];
            for node in &mut row[..4] {
                *node = number(*node, line)?;
            }
        }
        let members =
            members.iter().map(|&[tag, dimension, group, line]| Ok([number(tag, line)?, dimension, group]));
        members.collect::<Result<Vec<_>, Error>>()
    };
    let members = team.agree(numbered())?;

    let homes = Homes::new(outline.nodes as u64, team.size());
    let mut nodes = team.exchange_rows(&homes.sort(team, positions)).concat();
    nodes.sort_unstable_by_key(|row| row[0]);
    let names: BTreeMap<_, _> =
        outline.names.into_iter().map(|(dimension, tag, name)| ((dimension as u64, tag), name)).collect();
    Part::new(team, homes, Rows { nodes, elements: tetrahedra, members, repeats }, &names).map(Some)
}

/// Outline of the file, which rank 0 reads.
fn outline(team: &Team, path: &Path) -> Result<MshOutline, Error> {
    let read = || {
        let outline = MshOutline::read(path).map_err(SceneError::from)?;
        serde_json::to_vec(&outline).map_err(|error| Error::Options(error.to_string()))
    };
    let bytes = team.agree(if team.rank() == 0 { read() } else { Ok(Vec::new()) })?;
    serde_json::from_slice(&team.from_first(bytes))
        .map_err(|error| Error::Options(format!("the ranks run different programs: {error}")))
}

/// Reads this rank's part of the runs of lines.
fn lines(team: &Team, path: &Path, outline: &MshOutline) -> Result<Lines, ReadError> {
    let mut lines = Lines::default();
    let total: usize = outline.runs.iter().map(|run| run.count).sum();
    let mut before = 0;
    for run in &outline.runs {
        let rank = (before as u128 * team.size() as u128 / total as u128) as usize;
        before += run.count;
        if rank != team.rank() {
            continue;
        }
        let mut next = [run.first as u64; 2];
        let mut number = |of: usize| {
            next[of] += 1;
            next[of] - 1
        };
        run.read(path, |line, item| {
            let line = line as u64;
            let mut groups = |group: Option<i64>| {
                lines.names_groups |= group.is_some();
                run.groups.iter().copied().chain(group)
            };
            match item {
                MshItem::Tag(tag) => lines.tags.push([tag as u64, number(0), line]),
                MshItem::Position(position) => {
                    let [x, y, z] = position.map(f64::to_bits);
                    lines.positions.push([number(1), x, y, z]);
                }
                MshItem::Tetrahedron { tag, corners, group } => {
                    let [a, b, c, d] = corners.map(|corner| corner as u64);
                    let mut groups = groups(group).peekable();
                    let none = groups.peek().is_none().then_some(NO_GROUP);
                    let rows = groups.chain(none).map(|group| [a, b, c, d, line, tag as u64, group as u64]);
                    lines.tetrahedra.extend(rows);
                }
                MshItem::Member { dimension, nodes, group } => {
                    for group in groups(group) {
                        let row = |&node: &usize| [node as u64, dimension as u64, group as u64, line];
                        lines.members.extend(nodes.iter().map(row));
                    }
                }
                _ => lines.others += 1,
            }
        })?;
    }
    Ok(lines)
}

/// Numbers of nodes by their tags, each on the rank of the tag.
struct Directory {
    /// Tag, number and line of the nodes of this rank, ascending.
    rows: Vec<[u64; 3]>,
}

impl Directory {
    /// Sends each row to the rank of its tag.
    fn new(team: &Team, rows: Vec<[u64; 3]>) -> Self {
        let mut rows = team.exchange_rows(&by_tag(team, rows)).concat();
        rows.sort_unstable();
        Self { rows }
    }

    /// Second row of a tag, on this rank.
    fn twice(&self) -> Option<[u64; 3]> {
        self.rows.windows(2).find(|pair| pair[0][0] == pair[1][0]).map(|pair| pair[1])
    }

    /// Tags and numbers of the nodes with these tags, ascending, without those that do not exist.
    fn numbers(&self, team: &Team, tags: impl Iterator<Item = u64>) -> Vec<[u64; 2]> {
        let mut tags: Vec<u64> = tags.collect();
        tags.sort_unstable();
        tags.dedup();
        let asked = team.exchange_rows(&by_tag(team, tags.into_iter().map(|tag| [tag])));
        let answer = |&[tag]: &[u64; 1]| {
            let at = self.rows.binary_search_by_key(&tag, |row| row[0]).ok()?;
            Some([tag, self.rows[at][1]])
        };
        let answers: Vec<Vec<[u64; 2]>> =
            asked.iter().map(|tags| tags.iter().filter_map(answer).collect()).collect();
        let mut numbers = team.exchange_rows(&answers).concat();
        numbers.sort_unstable();
        numbers
    }
}

/// List of rows for each rank; the first entry of a row is a tag.
fn by_tag<const N: usize>(team: &Team, rows: impl IntoIterator<Item = [u64; N]>) -> Vec<Vec<[u64; N]>> {
    let mut lists = vec![Vec::new(); team.size()];
    rows.into_iter().for_each(|row| lists[row[0] as usize % team.size()].push(row));
    lists
}
