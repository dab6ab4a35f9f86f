//! Share of a rank: its elements, the nodes that it owns, and copies of the other nodes of its elements.
//!
//! A partitioner divides the graph of the nodes. An element is assigned to the rank that owns most of its
//! nodes, so that every element is evaluated once. Its forces on nodes of other ranks are sent there. The
//! owner of a node has at least one element of the node. This module does not depend on materials or on time.

use std::collections::HashMap;

use crate::error::Error;
use crate::petsc::Matrix;
use crate::portion::{Element, Homes, Place, Portion};
use crate::team::Team;

/// Part of a divided mesh on a rank. Owned nodes come before copies. Among owned nodes, free nodes come
/// before pinned nodes.
#[derive(Clone, Debug)]
pub struct Share {
    /// Number of each node in the whole mesh.
    pub(crate) ids: Vec<u64>,
    /// Number of owned nodes, the first of the nodes.
    pub(crate) owned: usize,
    /// Number of free owned nodes, the first of the owned nodes.
    pub(crate) free: usize,
    /// Positions and marks of the nodes.
    pub(crate) places: Vec<Place>,
    /// Global number of each copy, counted rank after rank.
    pub(crate) copies: Vec<usize>,
    /// Global number of each node among the free nodes, counted rank after rank; `None` for a pinned node.
    pub(crate) free_numbers: Vec<Option<usize>>,
    /// Elements: indices of the four nodes in this share, tag, and number of the material.
    pub elements: Vec<([usize; 4], u64, u64)>,
    /// Numbers of nodes and of elements of all ranks.
    pub(crate) totals: [usize; 2],
}

/// Number among the free nodes that stands for a pinned node.
const PINNED: u64 = u64::MAX;

impl Share {
    /// Divides a mesh.
    ///
    /// # Errors
    /// [`Error::Scene`] for fewer elements than ranks, [`Error::Petsc`].
    pub fn of(team: &Team, portion: Portion) -> Result<Self, Error> {
        let Portion { homes, places, elements } = portion;
        let total = team.count(elements.len());
        if total < team.size {
            let ranks = team.size;
            return Err(Error::usage(format!(
                "{ranks} ranks cannot share {total} elements: use at most as many ranks as there are elements"
            )));
        }
        let mut owner_here = owners(team, &homes, &elements)?;

        // Send elements to their ranks.
        let touched = nodes(&elements);
        let answers = homes.ask(team, &touched, |node| [owner_here[node]]);
        let owner: HashMap<u64, u64> =
            touched.iter().zip(&answers).map(|(&node, &[owner])| (node, owner)).collect();
        let rank =
            |element: &Element| rank_of(std::array::from_fn(|corner| owner[&element[corner]]), element[4]);
        let mut elements = team.send(elements.into_iter().map(|element| (rank(&element), element))).concat();
        elements.sort_unstable_by_key(|element| element[4]);

        // If a rank has no element of a node, another rank that has one becomes the owner of the node.
        let first = homes.range(team.rank).start;
        let touched = nodes(&elements);
        let of_ranks = homes.send(team, touched.iter().map(|&node| [node]));
        let mut with_elements = vec![Vec::new(); places.len()];
        for (rank, nodes) in of_ranks.iter().enumerate() {
            nodes.iter().for_each(|[node]| with_elements[(node - first) as usize].push(rank as u64));
        }
        for (owner, ranks) in owner_here.iter_mut().zip(with_elements) {
            if !ranks.contains(owner) {
                *owner = ranks.first().copied().unwrap_or(*owner);
            }
        }

        // Send nodes to their owners.
        let row = |node: usize| (owner_here[node] as usize, places[node].to_row(first + node as u64));
        let mut owned = team.send((0..places.len()).map(row)).concat();
        owned.sort_unstable_by_key(|row| (row[7] & 1, row[0]));
        let free = owned.iter().filter(|row| row[7] & 1 == 0).count();

        // Send the numbers of owned nodes to their homes, for the ranks with copies.
        let before = |number: usize| team.all(number)[..team.rank].iter().sum::<usize>();
        let (first_owned, first_free) = (before(owned.len()), before(free));
        let free_number = |node: usize| if node < free { (first_free + node) as u64 } else { PINNED };
        let rows = owned
            .iter()
            .enumerate()
            .map(|(node, row)| [row[0], (first_owned + node) as u64, free_number(node)]);
        let mut known = vec![[0; 2]; places.len()];
        for [node, number, free] in homes.send(team, rows).concat() {
            known[(node - first) as usize] = [number, free];
        }

        // Request copies from the homes of the nodes.
        let mut index: HashMap<u64, usize> =
            owned.iter().enumerate().map(|(node, row)| (row[0], node)).collect();
        let copied: Vec<u64> = touched.into_iter().filter(|node| !index.contains_key(node)).collect();
        let answers = homes.ask(team, &copied, |node| {
            let [number, free] = known[node];
            let mut row = [free; 9];
            row[..8].copy_from_slice(&places[node].to_row(number));
            row
        });
        index.extend(copied.iter().enumerate().map(|(copy, &node)| (node, owned.len() + copy)));

        let numbers = (0..owned.len()).map(free_number).chain(answers.iter().map(|row| row[8]));
        let local = |element: &Element| {
            let nodes = std::array::from_fn(|corner| index[&element[corner]]);
            (nodes, element[4], element[5])
        };
        Ok(Self {
            ids: owned.iter().map(|row| row[0]).chain(copied.iter().copied()).collect(),
            owned: owned.len(),
            free,
            places: owned
                .iter()
                .map(|row| Place::from_row(row))
                .chain(answers.iter().map(|row| Place::from_row(row)))
                .collect(),
            copies: answers.iter().map(|row| row[0] as usize).collect(),
            free_numbers: numbers.map(|number| (number != PINNED).then_some(number as usize)).collect(),
            elements: elements.iter().map(local).collect(),
            totals: [homes.total as usize, total],
        })
    }

    /// Pinned nodes of this rank, copies included, ascending.
    pub(crate) fn pinned(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|&node| self.places[node].marks & 1 == 1).collect()
    }
}

/// Nodes of elements, ascending.
fn nodes(elements: &[Element]) -> Vec<u64> {
    let mut nodes: Vec<u64> = elements.iter().flat_map(|element| &element[..4]).copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Rank of an element with these owners of its nodes, in any order: the most frequent owner. Among equally
/// frequent owners, the tag of the element decides.
fn rank_of(mut owners: [u64; 4], tag: u64) -> usize {
    owners.sort_unstable();
    let times = |owner: u64| owners.iter().filter(|&&other| other == owner).count();
    let most = owners.iter().map(|&owner| times(owner)).max().unwrap_or(0);
    let first = (tag % 4) as usize;
    let in_turn = (0..4).map(|corner| owners[(first + corner) % 4]);
    in_turn.into_iter().find(|&owner| times(owner) == most).unwrap_or(0) as usize
}

/// Owner of each node that is at home on this rank.
fn owners(team: &Team, homes: &Homes, elements: &[Element]) -> Result<Vec<u64>, Error> {
    let range = homes.range(team.rank);
    let here = (range.end - range.start) as usize;
    if team.size == 1 {
        return Ok(vec![0; here]);
    }
    let mut pairs = Vec::with_capacity(12 * elements.len());
    for element in elements {
        for i in 0..4 {
            for j in (0..4).filter(|&j| j != i) {
                pairs.push([element[i], element[j]]);
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    let places = pairs.iter().map(|pair| pair.map(|node| node as usize));
    let graph = Matrix::new(&team.library, here, 1, places)?;
    graph.set_values(&vec![1.0; pairs.len()])?;
    Ok(graph.partition()?.into_iter().map(|rank| rank as u64).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_goes_to_the_owner_of_most_of_its_nodes() {
        assert_eq!(rank_of([2, 1, 2, 2], 0), 2);
        assert_eq!(rank_of([0, 3, 1, 3], 7), 3);
        // Equally frequent owners take turns, for any order of the nodes.
        let of_tags = |owners| (0..4).map(|tag| rank_of(owners, tag)).collect::<Vec<_>>();
        assert_eq!(of_tags([5, 6, 5, 6]), of_tags([6, 5, 6, 5]));
        assert_eq!(of_tags([5, 6, 5, 6]), [5, 5, 6, 6]);
    }
}
