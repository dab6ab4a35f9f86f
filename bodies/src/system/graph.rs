//! Graph of a symmetric matrix of blocks: pairs of rows with a block in common.

use super::linear::LinearError;
use super::lists::Lists;
use super::memory::reserved;

/// The neighbours of each row, without itself.
pub(crate) type Graph = Lists<u32>;

impl Graph {
    /// Nodes that share a tetrahedron or are one of the pairs, each list ascending.
    pub(crate) fn of_tets(
        nodes: usize,
        tets: impl Iterator<Item = [usize; 4]> + Clone,
        pairs: &[[usize; 2]],
    ) -> Result<Self, LinearError> {
        u32::try_from(nodes).map_err(|_| LinearError::OutOfMemory)?;
        // A pair is an element of two nodes.
        let elements = tets.chain(pairs.iter().map(|&[a, b]| [a, b, a, b]));
        let corners = |tet: [usize; 4]| tet.map(|node| (node, tet.map(|node| node as u32)));
        let around = Lists::new(nodes, || elements.clone().flat_map(corners))?;
        let mut starts = reserved(nodes + 1)?;
        starts.push(0);
        // About fourteen neighbours in three dimensions.
        let mut neighbours = reserved(14 * nodes)?;
        let mut list: Vec<u32> = Vec::new();
        for node in 0..nodes {
            list.clear();
            let all = around.of(node).as_flattened();
            list.extend(all.iter().filter(|&&other| other as usize != node));
            list.sort_unstable();
            list.dedup();
            neighbours.extend_from_slice(&list);
            starts.push(neighbours.len());
        }
        Ok(Self { starts, values: neighbours })
    }

    /// The graph of a matrix of which the rows and columns above the diagonal are given.
    pub(crate) fn of_upper<I: Iterator<Item = (usize, u32)>>(
        rows: usize,
        above: impl Fn() -> I,
    ) -> Result<Self, LinearError> {
        let both = |(row, column): (usize, u32)| [(row, column), (column as usize, row as u32)];
        Self::new(rows, || above().flat_map(both))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_an_element_are_neighbours() {
        let tets = [[0, 1, 2, 3], [3, 2, 1, 5]];
        let graph = Graph::of_tets(6, tets.into_iter(), &[[5, 0]]).expect("small");
        assert_eq!(graph.len(), 6);
        assert_eq!(graph.of(0), [1, 2, 3, 5]);
        assert_eq!(graph.of(2), [0, 1, 3, 5]);
        assert!(graph.of(4).is_empty());
    }

    #[test]
    fn the_upper_half_says_all() {
        let graph = Graph::of_upper(3, || [(0, 2), (0, 1)].into_iter()).expect("small");
        assert_eq!(graph.of(0), [2, 1]);
        assert_eq!((graph.of(1), graph.of(2)), (&[0][..], &[0][..]));
    }
}
