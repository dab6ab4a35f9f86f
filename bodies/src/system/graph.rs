//! Graph of a symmetric matrix of blocks: pairs of rows with a block in common.

use super::linear::LinearError;
use super::memory::{filled, reserved};

/// The neighbours of each row, without itself.
#[derive(Clone, Debug)]
pub(crate) struct Graph {
    /// Start of each row among the neighbours, and the end of the last.
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Graph {
    /// Nodes that share a tetrahedron or are one of the pairs, each list ascending.
    ///
    /// # Errors
    /// [`LinearError::OutOfMemory`], also for more nodes than a `u32` counts.
    pub(crate) fn of_tets(
        nodes: usize,
        tets: impl Iterator<Item = [usize; 4]> + Clone,
        pairs: &[[usize; 2]],
    ) -> Result<Self, LinearError> {
        u32::try_from(nodes).map_err(|_| LinearError::OutOfMemory)?;
        // A pair is an element of two nodes.
        let elements = tets.chain(pairs.iter().map(|&[a, b]| [a, b, a, b]));
        let mut around = filled(nodes + 1, 0)?;
        elements.clone().flatten().for_each(|node| around[node + 1] += 1);
        for node in 0..nodes {
            around[node + 1] += around[node];
        }
        let mut next = around.clone();
        let mut corners = filled(around[nodes], [0_u32; 4])?;
        for tet in elements {
            for node in tet {
                corners[next[node]] = tet.map(|node| node as u32);
                next[node] += 1;
            }
        }
        let mut starts = reserved(nodes + 1)?;
        starts.push(0);
        // About fourteen neighbours in three dimensions.
        let mut neighbours = reserved(14 * nodes)?;
        let mut list: Vec<u32> = Vec::new();
        for node in 0..nodes {
            list.clear();
            let all = corners[around[node]..around[node + 1]].as_flattened();
            list.extend(all.iter().filter(|&&other| other as usize != node));
            list.sort_unstable();
            list.dedup();
            neighbours.extend_from_slice(&list);
            starts.push(neighbours.len());
        }
        Ok(Self { starts, neighbours })
    }

    /// The graph of a matrix of which the columns above the diagonal are given, row by row.
    pub(crate) fn of_upper(rows: &[Vec<u32>]) -> Self {
        let mut starts = vec![0; rows.len() + 1];
        for (row, columns) in rows.iter().enumerate() {
            starts[row + 1] += columns.len();
            columns.iter().for_each(|&column| starts[column as usize + 1] += 1);
        }
        for row in 0..rows.len() {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0; starts[rows.len()]];
        let mut put = |at: usize, other: u32| {
            neighbours[next[at]] = other;
            next[at] += 1;
        };
        for (row, columns) in rows.iter().enumerate() {
            for &column in columns {
                put(row, column);
                put(column as usize, row as u32);
            }
        }
        Self { starts, neighbours }
    }

    pub(crate) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    pub(crate) fn neighbours(&self, row: usize) -> &[u32] {
        &self.neighbours[self.starts[row]..self.starts[row + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_an_element_are_neighbours() {
        let tets = [[0, 1, 2, 3], [3, 2, 1, 5]];
        let graph = Graph::of_tets(6, tets.into_iter(), &[[5, 0]]).expect("small");
        assert_eq!(graph.rows(), 6);
        assert_eq!(graph.neighbours(0), [1, 2, 3, 5]);
        assert_eq!(graph.neighbours(2), [0, 1, 3, 5]);
        assert!(graph.neighbours(4).is_empty());
    }

    #[test]
    fn the_upper_half_says_all() {
        let graph = Graph::of_upper(&[vec![2, 1], vec![], vec![]]);
        assert_eq!(graph.neighbours(0), [2, 1]);
        assert_eq!((graph.neighbours(1), graph.neighbours(2)), (&[0][..], &[0][..]));
    }
}
