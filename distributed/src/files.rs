//! Mesh files that all ranks read at once, so that none holds the whole mesh.
//!
//! This module does not depend on materials, pins or prescribed motions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use piola_bodies::mesh::MeshError;

use crate::error::Error;
use crate::portion::Homes;
use crate::team::Team;

mod gmsh;
mod tetgen;

/// Part of a mesh on a rank.
#[derive(Debug)]
pub struct Part {
    /// Homes of all nodes.
    pub homes: Homes,
    /// Position, in the unit of the file, of each node that is at home on this rank.
    pub nodes: Vec<[f64; 3]>,
    /// Elements: four nodes and tag. Each element is on one rank, the home of its least node.
    pub elements: Vec<([u64; 4], u64)>,
    /// Groups of nodes and elements, with the members on this rank; the list is the same on all ranks.
    pub groups: Vec<Group>,
    /// Number of nodes of the file that do not belong to a tetrahedron, and are left out.
    pub dropped: usize,
    /// True if the file defines the orientation of its elements.
    pub is_oriented: bool,
}

/// Group of nodes or elements of a mesh.
#[derive(Debug)]
pub struct Group {
    /// Name.
    pub name: String,
    /// Dimension of its elements: 3 for tetrahedra.
    pub dimension: u64,
    /// Members on this rank: indices in [`Part::elements`] if the dimension is 3, or else in [`Part::nodes`].
    pub members: Vec<usize>,
}

/// Dimension and tag of a group.
type Key = (u64, i64);

/// Tag in a row of an element that belongs to no group.
const NO_GROUP: i64 = i64::MIN;

/// Lines of a file that a rank has read. Nodes are numbered from 0 in the order of the file.
#[derive(Default)]
struct Rows {
    /// Nodes that are at home on this rank, ascending: number and bits of the position.
    nodes: Vec<[u64; 4]>,
    /// Elements that this rank has read: four nodes, line, tag and tag of the group. An element of several
    /// groups has a row for each.
    elements: Vec<[u64; 7]>,
    /// Nodes in groups: node, dimension and tag.
    members: Vec<[u64; 3]>,
    /// True if the file repeats an element of several groups.
    repeats: bool,
}

/// Reads a mesh file, Gmsh's or TetGen's. The result is `None` if one rank must read the file as a whole: it
/// has no tetrahedron, or other volume elements.
///
/// # Errors
/// [`Error::OnRank`], with the place at which a file is malformed.
pub fn read(team: &Team, path: &Path) -> Result<Option<Part>, Error> {
    let is_tetgen = path.extension().is_some_and(|end| end == "node" || end == "ele");
    if is_tetgen { tetgen::read(team, path).map(Some) } else { gmsh::read(team, path) }
}

impl Part {
    /// Part of a mesh without the nodes that do not belong to a tetrahedron. `names` has the names of groups;
    /// the others are called by their tags.
    fn new(
        team: &Team,
        homes: Homes,
        Rows { nodes, elements, members, repeats }: Rows,
        names: &BTreeMap<Key, String>,
    ) -> Result<Self, Error> {
        // Number of each node at home among the nodes of tetrahedra.
        let first = homes.range(team.rank()).start;
        let mut touched: Vec<u64> = elements.iter().flat_map(|element| &element[..4]).copied().collect();
        touched.sort_unstable();
        touched.dedup();
        let mut is_used = vec![false; nodes.len()];
        for [node] in team.exchange_rows(&homes.sort(team, touched.iter().map(|&node| [node]))).concat() {
            is_used[(node - first) as usize] = true;
        }
        let used = is_used.iter().filter(|&&used| used).count();
        let mut next = team.all(used)[..team.rank()].iter().sum::<usize>() as u64;
        let number = |&is_used: &bool| {
            is_used.then(|| {
                next += 1;
                next - 1
            })
        };
        let numbers: Vec<Option<u64>> = is_used.iter().map(number).collect();
        let answers = homes.ask(team, &touched, |node| [numbers[node].unwrap_or_default()]);
        let renumbered = |node: u64| touched.binary_search(&node).map_or(node, |at| answers[at][0]);

        // Members and nodes go to their new homes by way of the old ones.
        let total = team.count(used);
        let new_homes = Homes::new(total as u64, team.size());
        let members = team.exchange_rows(&homes.sort(team, members)).concat();
        let members = members
            .into_iter()
            .filter_map(|[node, key @ ..]| numbers[(node - first) as usize].map(|node| (node, key)))
            .map(|(node, [dimension, tag])| [node, dimension, tag]);
        let mut members = team.exchange_rows(&new_homes.sort(team, members)).concat();
        members.sort_unstable();
        members.dedup();
        let rows = nodes.iter().zip(&numbers);
        let rows = rows.filter_map(|(&[_, x, y, z], number)| number.map(|number| [number, x, y, z]));
        let mut nodes = team.exchange_rows(&new_homes.sort(team, rows)).concat();
        nodes.sort_unstable_by_key(|row| row[0]);

        // Elements go to the homes of their least nodes, where all rows of the same four nodes meet.
        let rows = elements.iter().map(|&[a, b, c, d, line, tag, group]| {
            let corners = [a, b, c, d].map(renumbered);
            let mut row = [0; 11];
            row[..4].copy_from_slice(&corners);
            row[..4].sort_unstable();
            row[4..].copy_from_slice(&[line, corners[0], corners[1], corners[2], corners[3], tag, group]);
            row
        });
        let mut rows = team.exchange_rows(&new_homes.sort(team, rows)).concat();
        rows.sort_unstable();
        let (elements, of_elements) = team.agree(joined(&rows, repeats))?;

        let mut part = Self {
            homes: new_homes,
            nodes: nodes.iter().map(|&[_, x, y, z]| [x, y, z].map(f64::from_bits)).collect(),
            elements,
            groups: Vec::new(),
            dropped: homes.total() as usize - total,
            is_oriented: true,
        };
        let first = new_homes.range(team.rank()).start;
        let members =
            members.iter().map(|&[node, dimension, tag]| ((dimension, tag as i64), (node - first) as usize));
        let members: Vec<(Key, usize)> = members.chain(of_elements).collect();
        part.groups = groups(team, &members, names);
        Ok(part)
    }
}

/// Four nodes and tag of each element, and memberships of elements in groups.
type Joined = (Vec<([u64; 4], u64)>, Vec<(Key, usize)>);

/// Elements, and their memberships in groups of dimension 3, from rows of elements in ascending order.
fn joined(rows: &[[u64; 11]], repeats: bool) -> Result<Joined, Error> {
    let (mut elements, mut members) = (Vec::<([u64; 4], u64)>::new(), Vec::new());
    for same in rows.chunk_by(|one, other| one[..4] == other[..4]) {
        let mut groups = BTreeSet::new();
        for &[_, _, _, _, line, a, b, c, d, tag, group] in same {
            let (corners, [_, _, _, _, first_line, ..]) = ([a, b, c, d], same[0]);
            match elements.last().filter(|_| !groups.is_empty()) {
                None => elements.push((corners, tag)),
                // A row for another group of the same element.
                Some(&(known, _))
                    if (line == first_line || repeats) && known == corners && !groups.contains(&group) => {}
                Some(&(_, first_tag)) => {
                    let elements = [first_tag as usize, tag as usize];
                    return Err(Error::Options(MeshError::SameTwice { elements }.to_string()));
                }
            }
            groups.insert(group);
        }
        let groups = groups.into_iter().map(|group| group as i64).filter(|&group| group != NO_GROUP);
        members.extend(groups.map(|group| ((3, group), elements.len() - 1)));
    }
    Ok((elements, members))
}

/// Groups of all ranks, ordered by dimension and tag, with the members on this rank.
fn groups(team: &Team, members: &[(Key, usize)], names: &BTreeMap<Key, String>) -> Vec<Group> {
    let here: BTreeSet<Key> = members.iter().map(|&(key, _)| key).collect();
    let here: Vec<[u64; 2]> = here.into_iter().map(|(dimension, tag)| [dimension, tag as u64]).collect();
    let all = team.exchange_rows(&vec![here; team.size()]).concat();
    let all: BTreeSet<Key> = all.into_iter().map(|[dimension, tag]| (dimension, tag as i64)).collect();
    let mut of_keys: BTreeMap<Key, Vec<usize>> = all.into_iter().map(|key| (key, Vec::new())).collect();
    for &(key, member) in members {
        of_keys.entry(key).or_default().push(member);
    }
    let group = |(key, members): (Key, Vec<usize>)| Group {
        name: names.get(&key).cloned().unwrap_or_else(|| key.1.to_string()),
        dimension: key.0,
        members,
    };
    of_keys.into_iter().map(group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row of an element of the nodes 3, 5, 6, 9.
    fn row(line: u64, corners: [u64; 4], tag: u64, group: i64) -> [u64; 11] {
        let [a, b, c, d] = corners;
        [3, 5, 6, 9, line, a, b, c, d, tag, group as u64]
    }

    #[test]
    fn an_element_of_several_groups_is_one() -> Result<(), Error> {
        let one = [row(7, [5, 3, 6, 9], 1, 2), row(7, [5, 3, 6, 9], 1, 4)];
        let expected = (vec![([5, 3, 6, 9], 1)], vec![((3, 2), 0), ((3, 4), 0)]);
        assert_eq!(joined(&one, false)?, expected);
        let repeated = [row(7, [5, 3, 6, 9], 1, 2), row(8, [5, 3, 6, 9], 6, 4)];
        assert_eq!(joined(&repeated, true)?, expected);
        assert_eq!(joined(&[row(7, [5, 3, 6, 9], 1, NO_GROUP)], true)?, (vec![([5, 3, 6, 9], 1)], vec![]));
        Ok(())
    }

    #[test]
    fn two_elements_of_the_same_nodes_are_an_error() {
        let first = row(7, [5, 3, 6, 9], 1, 2);
        for (second, repeats) in [
            (row(8, [5, 3, 6, 9], 6, 4), false),
            (row(8, [5, 3, 6, 9], 6, 2), true),
            (row(8, [3, 5, 6, 9], 6, 4), true),
        ] {
            let error = joined(&[first, second], repeats).expect_err("the same nodes twice").to_string();
            assert!(error.starts_with("elements 1 and 6 join the same four nodes"), "{error}");
        }
    }
}
