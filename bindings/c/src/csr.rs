//! Assembly into a sparse matrix of the caller.

use piola::batch::{CsrPlaces, Layout, Tetrahedra};

use crate::functions::functions;
use crate::{handle, lent};

/// The places of the stiffnesses of tetrahedra in a sparse matrix of compressed rows. Immutable: threads may
/// share it.
pub struct Csr(CsrPlaces);

/// Marks a node without unknowns, instead of its first unknown: PIOLA_NO_UNKNOWN of the header.
pub(crate) const NO_UNKNOWN: usize = usize::MAX;

functions! {
    E = i32, i64: " for a matrix with indices of 64 bits.";

/// Finds the places of the stiffnesses of tetrahedra in a sparse matrix: row r has the columns
/// `columns[row_starts[r]]` to `columns[row_starts[r + 1] - 1]`, in any order, counted from 0. The matrix may
/// be whole or one of its triangles; compressed columns work as well, since it is symmetric.
///
/// `corners` has four nodes, from 0, for each tetrahedron; `unknowns` the first of the three successive
/// unknowns of each of the `nodes` nodes, or PIOLA_NO_UNKNOWN. It may be null, with a length of 0, if node n
/// has the unknowns 3n, 3n + 1, 3n + 2. Takes 576 bytes for each tetrahedron.
///
/// Errors: PIOLA_CODE_MATRIX for arrays that are not a matrix and for missing entries, PIOLA_CODE_VALUE for
/// nodes that do not exist.
fn piola_csr_new_i32, piola_csr_new_i64(
    nodes: usize,
    corners: &[usize],
    unknowns: &[usize],
    row_starts: &[E],
    columns: &[E],
    csr: New<Csr>,
) {
    let corners = lent::rows("corners", corners)?;
    if !unknowns.is_empty() {
        lent::demand_length("unknowns", unknowns.len(), 1, nodes)?;
    }
    csr.give(|| {
        let tetrahedra = Tetrahedra::new(nodes, corners)?;
        let unknown = |node: usize| match unknowns.get(node) {
            Some(&unknown) => (unknown != NO_UNKNOWN).then_some(unknown),
            None => Some(node.saturating_mul(3)),
        };
        Ok(Csr(CsrPlaces::new(tetrahedra, unknown, row_starts, columns)?))
    })
}
}

functions! {
    E = f64, f32: " in single precision.";

/// Adds the stiffnesses of all tetrahedra, 144 numbers each from `piola_stiffnesses` in this layout, one of
/// `piola_layout`, to the values of the matrix, one for each of its columns. The sums are taken in the order
/// of the tetrahedra, on the thread of the caller.
fn piola_csr_add, piola_csr_add_f32(csr: &Csr, layout: i32, stiffnesses: &[E], values: &mut [E]) {
    let layout = lent::choice("layout", layout, [Layout::Points, Layout::Lines])?;
    Ok(csr.0.add(stiffnesses, layout, values)?)
}
}

/// Frees what `piola_csr_new_i32` has made, or does nothing with null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_csr_free(csr: Option<Box<Csr>>) {
    handle::free(csr);
}
