//! Groups of neighbouring rows, each of which becomes one row of the next level [VMB96 §5].

use crate::system::linear::symmetric_blocks::Pattern;

/// Aggregate of each row, `None` for rows that only the smoother corrects, and number of aggregates.
///
/// Groups rows in the order of the pattern: a row without neighbours in an aggregate forms one with all its
/// neighbours. Each remaining row then joins the aggregate to which most of its neighbours belong.
///
/// Rows that are not `included`, and rows without an included neighbour, do not belong to an aggregate. Only
/// the first `owned` rows can belong to one; a row with no neighbour among them is an aggregate by itself.
pub(super) fn aggregate(pattern: &Pattern, included: &[bool], owned: usize) -> (Vec<Option<usize>>, usize) {
    let Pattern { graph, order, .. } = pattern;
    let mut of_row = vec![None; graph.len()];
    let mut count = 0;
    let included_around = |row: usize| {
        let all = graph.of(row).iter().map(|&other| other as usize);
        all.filter(|&other| included[other])
    };
    let neighbours = |row: usize| included_around(row).filter(|&other| other < owned);
    let rows = || order.iter().map(|&row| row as usize).filter(|&row| row < owned && included[row]);
    for row in rows() {
        let is_founder = of_row[row].is_none()
            && neighbours(row).next().is_some()
            && neighbours(row).all(|other| of_row[other].is_none());
        if is_founder {
            of_row[row] = Some(count);
            neighbours(row).for_each(|other| of_row[other] = Some(count));
            count += 1;
        }
    }
    let founded = of_row.clone();
    for row in rows().filter(|&row| founded[row].is_none()) {
        let mut around: Vec<usize> = neighbours(row).filter_map(|other| founded[other]).collect();
        around.sort_unstable();
        let groups = around.chunk_by(|a, b| a == b);
        let most = groups.max_by_key(|same| (same.len(), std::cmp::Reverse(same[0])));
        of_row[row] = most.map(|same| same[0]);
        if most.is_none() && included_around(row).next().is_some() {
            of_row[row] = Some(count);
            count += 1;
        }
    }
    (of_row, count)
}
