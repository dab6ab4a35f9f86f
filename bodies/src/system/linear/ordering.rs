//! Order of the unknowns of a sparse matrix in which a Cholesky factor stays sparse.

use super::LinearError;
use crate::system::graph::Graph;
use crate::system::memory::reserved;
use crate::system::pins::Pins;

/// Orders the free nodes by approximate minimum degree; without the feature `faer`, where nothing of this
/// crate factors a sparse matrix, by their numbers.
///
/// On bodies of this size minimum degree is better than nested dissection: METIS needs 1.75 times as many
/// operations for a factor of the horse and 1.16 times as many for that of the dinosaur, dissection by planes
/// 1.9 and 1.4 times.
pub(crate) fn order(graph: &Graph, pins: &Pins) -> Result<Vec<usize>, LinearError> {
    let mut free: Vec<usize> = reserved(graph.len())?;
    free.extend((0..graph.len()).filter(|node| pins.nodes().binary_search(node).is_err()));
    #[cfg(feature = "faer")]
    let free = by_minimum_degree(graph, &free)?;
    Ok(free)
}

#[cfg(feature = "faer")]
fn by_minimum_degree(graph: &Graph, free: &[usize]) -> Result<Vec<usize>, LinearError> {
    use faer::dyn_stack::{MemBuffer, MemStack};
    use faer::sparse::SymbolicSparseColMatRef;
    use faer::sparse::linalg::amd;

    let count = free.len();
    let mut number = crate::system::memory::filled(graph.len(), None)?;
    free.iter().enumerate().for_each(|(at, &node)| number[node] = Some(at));
    let (mut starts, mut rows): (_, Vec<usize>) = (reserved(count + 1)?, Vec::new());
    starts.push(0);
    for (at, &node) in free.iter().enumerate() {
        let start = rows.len();
        rows.push(at);
        rows.extend(graph.of(node).iter().filter_map(|&other| number[other as usize]));
        rows[start..].sort_unstable();
        starts.push(rows.len());
    }
    let pattern = SymbolicSparseColMatRef::new_checked(count, count, &starts, None, &rows);
    let (mut order, mut inverse) = (vec![0; count], vec![0; count]);
    let scratch = amd::order_scratch::<usize>(count, rows.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| LinearError::OutOfMemory)?;
    amd::order(&mut order, &mut inverse, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| LinearError::OutOfMemory)?;
    Ok(order.into_iter().map(|at| free[at]).collect())
}
