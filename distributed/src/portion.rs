//! Part of a mesh on a rank before the mesh is divided: some of the elements, and the nodes of a home range.
//!
//! This module does not depend on parts of a body or on a solver.

use std::ops::Range;

use piola_bodies::mesh::tetrahedra_of_cell;

use crate::team::Team;

/// Home rank of each node: contiguous ranges of node numbers of equal length, rank after rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Homes {
    /// Number of nodes.
    pub(crate) total: u64,
    each: u64,
}

impl Homes {
    /// Divides a number of nodes among all ranks.
    pub(crate) fn new(total: u64, ranks: usize) -> Self {
        Self { total, each: total.div_ceil(ranks as u64).max(1) }
    }

    /// Home rank of a node.
    pub(crate) fn of(&self, node: u64) -> usize {
        (node / self.each) as usize
    }

    /// Numbers of the nodes that are at home on a rank.
    pub(crate) fn range(&self, rank: usize) -> Range<u64> {
        let at = |rank: usize| (rank as u64 * self.each).min(self.total);
        at(rank)..at(rank + 1)
    }

    /// Sends rows to the homes of the nodes that are their first entries; returns the rows received from each
    /// rank.
    pub(crate) fn send<const N: usize>(
        &self,
        team: &Team,
        rows: impl IntoIterator<Item = [u64; N]>,
    ) -> Vec<Vec<[u64; N]>> {
        team.send(rows.into_iter().map(|row| (self.of(row[0]), row)))
    }

    /// Answers of the homes of these nodes, which must be ascending; `answer` has the index of a node in the
    /// home range.
    pub(crate) fn ask<const N: usize>(
        &self,
        team: &Team,
        nodes: &[u64],
        answer: impl Fn(usize) -> [u64; N],
    ) -> Vec<[u64; N]> {
        let asked = self.send(team, nodes.iter().map(|&node| [node]));
        let first = self.range(team.rank).start;
        let asked =
            asked.iter().enumerate().flat_map(|(rank, nodes)| nodes.iter().map(move |node| (rank, node)));
        // Homes ascend with the nodes.
        team.send(asked.map(|(rank, [node])| (rank, answer((node - first) as usize)))).concat()
    }
}

/// Node before the mesh is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Position at rest, m.
    pub(crate) rest: [f64; 3],
    /// Position before the first step, m.
    pub(crate) start: [f64; 3],
    /// Prescribed motions and springs of the node: bit 0 for a pin; the caller defines the other bits.
    pub(crate) marks: u64,
}

impl Place {
    /// Row of a number, such as that of the node, and the words of the place.
    pub(crate) fn to_row(self, number: u64) -> [u64; 8] {
        let [r, s] = [self.rest, self.start].map(|x| x.map(f64::to_bits));
        [number, r[0], r[1], r[2], s[0], s[1], s[2], self.marks]
    }

    /// Place in a row of [`Place::to_row`].
    pub(crate) fn from_row(row: &[u64]) -> Self {
        let vector = |at: usize| std::array::from_fn(|c| f64::from_bits(row[at + c]));
        Self { rest: vector(1), start: vector(4), marks: row[7] }
    }
}

/// Tetrahedron before the mesh is divided: its four nodes, its tag and the number of its material.
pub type Element = [u64; 6];

/// Part of a mesh before it is divided.
#[derive(Clone, Debug, PartialEq)]
pub struct Portion {
    /// Homes of all nodes.
    pub(crate) homes: Homes,
    /// Nodes that are at home on this rank.
    pub(crate) places: Vec<Place>,
    /// Some elements of the mesh; each element is on one rank.
    pub elements: Vec<Element>,
}

impl Portion {
    /// Distributes a mesh from rank 0; the lists of other ranks must be empty.
    pub(crate) fn spread(team: &Team, places: Vec<Place>, elements: Vec<Element>) -> Self {
        let [nodes, count] = [places.len(), elements.len()].map(|number| team.count(number) as u64);
        let homes = Homes::new(nodes, team.size);
        let rows = places.into_iter().enumerate().map(|(node, place)| place.to_row(node as u64));
        let places = homes.send(team, rows).concat();
        let of_elements = Homes::new(count, team.size);
        let elements = elements.into_iter().enumerate();
        let elements = elements.map(|(number, element)| (of_elements.of(number as u64), element));
        Self {
            homes,
            places: places.iter().map(|row| Place::from_row(row)).collect(),
            elements: team.send(elements).concat(),
        }
    }

    /// Part, on this rank, of a cube with six tetrahedra in each of `cells`³ cells, equal to the mesh of
    /// [`piola_bodies::mesh::tetrahedral_box`]. The rest of the mesh is not generated. Nodes with x = 0 are
    /// pinned.
    #[must_use]
    pub fn of_cube(team: &Team, cells: u64, length: f64) -> Self {
        let side = cells + 1;
        let homes = Homes::new(side * side * side, team.size);
        let coordinate = |at: u64| length * (at as f64 / cells as f64);
        let place = |node: u64| {
            let at = [node / (side * side), node / side % side, node % side];
            let rest = at.map(coordinate);
            Place { rest, start: rest, marks: u64::from(at[0] == 0) }
        };
        let of_cells = Homes::new(cells * cells * cells, team.size);
        let strides = [side * side, side, 1].map(|stride| stride as usize);
        let tetrahedra = of_cells.range(team.rank).flat_map(|cell| {
            let at = [cell / (cells * cells), cell / cells % cells, cell % cells].map(|place| place as usize);
            (1..).zip(tetrahedra_of_cell(at, strides)).map(move |(tag, nodes)| {
                let [a, b, c, d] = nodes.map(|node| node as u64);
                [a, b, c, d, 6 * cell + tag, 0]
            })
        });
        Self { homes, places: homes.range(team.rank).map(place).collect(), elements: tetrahedra.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_one_home() {
        for (total, ranks) in [(0, 1), (1, 3), (7, 3), (12, 4), (3, 5)] {
            let homes = Homes::new(total, ranks);
            let all: Vec<u64> = (0..ranks).flat_map(|rank| homes.range(rank)).collect();
            assert_eq!(all, (0..total).collect::<Vec<_>>(), "{total} nodes, {ranks} ranks");
            assert!((0..ranks).all(|rank| homes.range(rank).all(|node| homes.of(node) == rank)));
        }
    }

    #[test]
    fn places_keep_their_bits() {
        let place = Place { rest: [0.1, -0.0, 3.0], start: [f64::MAX, 1e-300, 7.0], marks: 1 << 40 | 1 };
        assert_eq!(Place::from_row(&place.to_row(7)), place);
    }
}
