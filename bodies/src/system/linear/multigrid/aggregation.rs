//! Groups of neighbouring rows, each of which becomes one row of the next level [VMB96 §5].

use crate::system::graph::Graph;

pub(super) struct Aggregates {
    /// Aggregate of each row, `None` for rows that only the smoother corrects.
    of_row: Vec<Option<usize>>,
    count: usize,
}

impl Aggregates {
    /// Groups rows in this order: a row without neighbours in an aggregate forms one with all its neighbours.
    /// Each remaining row then joins the aggregate to which most of its neighbours belong.
    ///
    /// Rows that are not `included`, and rows without an included neighbour, do not belong to an aggregate.
    /// Only the first `owned` rows can belong to one; a row with no neighbour among them is an aggregate by
    /// itself.
    pub(super) fn new(graph: &Graph, order: &[u32], included: &[bool], owned: usize) -> Self {
        let mut of_row = vec![None; graph.rows()];
        let mut count = 0;
        let included_around = |row: u32| {
            let all = graph.neighbours(row as usize).iter();
            all.map(|&other| other as usize).filter(|&other| included[other])
        };
        let neighbours = |row: u32| included_around(row).filter(|&other| other < owned);
        let order = || order.iter().filter(|&&row| (row as usize) < owned);
        for &row in order() {
            let is_founder = included[row as usize]
                && of_row[row as usize].is_none()
                && neighbours(row).next().is_some()
                && neighbours(row).all(|other| of_row[other].is_none());
            if is_founder {
                of_row[row as usize] = Some(count);
                neighbours(row).for_each(|other| of_row[other] = Some(count));
                count += 1;
            }
        }
        let founded = of_row.clone();
        for &row in order() {
            if included[row as usize] && of_row[row as usize].is_none() {
                let mut around: Vec<usize> = neighbours(row).filter_map(|other| founded[other]).collect();
                around.sort_unstable();
                let most = around
                    .chunk_by(|a, b| a == b)
                    .max_by_key(|same| (same.len(), std::cmp::Reverse(same[0])));
                of_row[row as usize] = most.map(|same| same[0]);
                if most.is_none() && included_around(row).next().is_some() {
                    of_row[row as usize] = Some(count);
                    count += 1;
                }
            }
        }
        Self { of_row, count }
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Aggregate of a row, if it has one.
    pub(super) fn of(&self, row: usize) -> Option<usize> {
        self.of_row[row]
    }
}
