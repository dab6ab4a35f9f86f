//! Energy and forces of a body at any positions.

use std::sync::{Arc, Mutex};

use piola_bodies::system::ElasticResponse;

use crate::body::{Body, of_tetrahedra};
use crate::error::{Code, guard};
use crate::lent::Arrays;
use crate::options::Survey;
use crate::{handle, lent};

/// Memory to evaluate the energy of a body. Threads may share it: calls wait for each other.
pub struct Response {
    body: Arc<piola_bodies::system::Body>,
    response: Mutex<ElasticResponse>,
}

/// Makes the memory to evaluate the energy of a body, which it keeps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_response_new(body: *const Body, response: *mut *mut Response) -> Code {
    guard(|| {
        // SAFETY: a handle, and room for another.
        unsafe {
            let body = lent::value("body", body)?.0.clone();
            handle::give("response", response, || {
                Ok(Response { response: Mutex::new(ElasticResponse::new(&body)), body })
            })
        }
    })
}

/// Energy of deformation, J, with the nodes at `positions`, three numbers each, m, and its gradient, N, three
/// numbers for each node: **forces are minus this**. If the length of `gradient` is 0, only the energy is
/// computed.
///
/// The survey, which may be null, counts tetrahedra; energy and gradient are valid if none is refused or
/// nonfinite. Shared among threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_response_evaluate(
    response: *const Response,
    positions: *const f64,
    positions_length: usize,
    energy: *mut f64,
    gradient: *mut f64,
    gradient_length: usize,
    survey: *mut Survey,
) -> Code {
    guard(|| {
        let mut arrays = Arrays::new();
        // SAFETY: a handle, arrays as long as stated, and room for results.
        unsafe {
            let Response { body, response } = lent::value("response", response)?;
            let positions =
                lent::vectors("positions", arrays.input("positions", positions, positions_length)?)?;
            let gradient =
                lent::vectors_mut("gradient", arrays.output("gradient", gradient, gradient_length)?)?;
            let mut response = handle::wait(response)?;
            let (found, mut counts) = response.energy(body, positions)?;
            if !gradient.is_empty() {
                counts = response.gradient_here(body, gradient)?;
            }
            lent::report("energy", energy, found)?;
            lent::report("survey", survey, of_tetrahedra(counts, body))
        }
    })
}

/// Frees a response, or does nothing with null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_response_free(response: *mut Response) {
    // SAFETY: a handle that is not used any more.
    unsafe { handle::free(response) }
}
