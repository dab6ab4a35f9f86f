//! The stiffness of a body as an operator, without a matrix.

use std::sync::{Arc, Mutex};

use piola::system::StiffnessOperator;

use crate::body::{Body, of_tetrahedra};
use crate::error::{Code, Failure, guard};
use crate::lent::Arrays;
use crate::options::{self, Survey};
use crate::{handle, lent};

/// The stiffness K of a body, N/m, where it was linearised last: zero before. Threads may share it: calls
/// wait for each other.
pub struct Stiffness {
    body: Arc<piola::system::Body>,
    operator: Mutex<StiffnessOperator>,
}

/// Makes the stiffness of a body, which it keeps: about 400 bytes for each tetrahedron.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stiffness_new(body: *const Body, stiffness: *mut *mut Stiffness) -> Code {
    guard(|| {
        // SAFETY: a handle, and room for another.
        unsafe {
            let body = lent::value("body", body)?.0.clone();
            handle::give("stiffness", stiffness, || {
                Ok(Stiffness { operator: Mutex::new(StiffnessOperator::new(&body)), body })
            })
        }
    })
}

/// Takes the stiffness with the nodes at `positions`, three numbers each, m, and with the filter, one of
/// `piola_filter`, on dP/dF of each tetrahedron. The survey, which may go to null, counts these.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stiffness_linearise(
    stiffness: *const Stiffness,
    positions: *const f64,
    positions_length: usize,
    filter: i32,
    survey: *mut Survey,
) -> Code {
    guard(|| {
        // SAFETY: a handle, an array as long as is said, and room for a result.
        unsafe {
            let Stiffness { body, operator } = lent::value("stiffness", stiffness)?;
            let positions = Arrays::new().input("positions", positions, positions_length)?;
            let (positions, filter) =
                (lent::vectors("positions", positions)?, options::filter("filter", filter)?);
            let counts = handle::wait(operator)?.linearise(body, positions, filter)?;
            lent::report("survey", survey, of_tetrahedra(counts, body))
        }
    })
}

/// The product K x, N, for a displacement `x`, three numbers for each node, m. Shared among threads, with the
/// same bits for any number of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stiffness_multiply(
    stiffness: *const Stiffness,
    x: *const f64,
    x_length: usize,
    product: *mut f64,
    product_length: usize,
) -> Code {
    guard(|| {
        let mut arrays = Arrays::new();
        // SAFETY: a handle, and arrays as long as is said.
        let (stiffness, x, product) = unsafe {
            (
                lent::value("stiffness", stiffness)?,
                arrays.input("x", x, x_length)?,
                arrays.output("product", product, product_length)?,
            )
        };
        let (x, product) = (lent::vectors("x", x)?, lent::vectors_mut("product", product)?);
        handle::wait(&stiffness.operator)?.multiply(x, product).map_err(Failure::from)
    })
}

/// The blocks on the diagonal of K, N/m, nine numbers for each node, which a preconditioner inverts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stiffness_diagonal(
    stiffness: *const Stiffness,
    blocks: *mut f64,
    blocks_length: usize,
) -> Code {
    guard(|| {
        // SAFETY: a handle, and an array as long as is said.
        let (Stiffness { body, operator }, blocks) = unsafe {
            (lent::value("stiffness", stiffness)?, Arrays::new().output("blocks", blocks, blocks_length)?)
        };
        lent::demand_length("blocks", blocks.len(), 9, body.rest().len())?;
        let (rows, _) = blocks.as_chunks_mut::<3>();
        handle::wait(operator)?.diagonal_blocks(rows.as_chunks_mut().0).map_err(Failure::from)
    })
}

/// Frees a stiffness, or does nothing with null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_stiffness_free(stiffness: *mut Stiffness) {
    // SAFETY: a handle that is not used any more.
    unsafe { handle::free(stiffness) }
}
