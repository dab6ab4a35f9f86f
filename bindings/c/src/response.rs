//! Energy and forces of a body at any positions.

use std::sync::{Arc, Mutex};

use piola_bodies::system::ElasticResponse;

use crate::body::{Body, of_tetrahedra};
use crate::functions::functions;
use crate::options::Survey;
use crate::{handle, lent};

/// Memory to evaluate the energy of a body. Threads may share it: calls wait for each other.
pub struct Response {
    body: Arc<piola_bodies::system::Body>,
    response: Mutex<ElasticResponse>,
}

functions! {
/// Makes the memory to evaluate the energy of a body, which it keeps.
fn piola_response_new(body: &Body, response: New<Response>) {
    let body = body.0.clone();
    response.give(|| Ok(Response { response: Mutex::new(ElasticResponse::new(&body)), body }))
}

/// Energy of deformation, J, with the nodes at `positions`, three numbers each, m, and its gradient, N, three
/// numbers for each node: **forces are minus this**. If the length of `gradient` is 0, only the energy is
/// computed.
///
/// The survey, which may be null, counts tetrahedra; energy and gradient are valid if none is refused or
/// nonfinite. Shared among threads.
fn piola_response_evaluate(
    response: &Response,
    positions: &[f64],
    energy: Out<f64>,
    gradient: &mut [f64],
    survey: Out<Survey>,
) {
    let Response { body, response } = response;
    let positions = lent::rows("positions", positions)?;
    lent::demand_length("gradient", gradient.len(), 3, gradient.len() / 3)?;
    let gradient = gradient.as_chunks_mut().0;
    let mut response = handle::wait(response)?;
    let (found, mut counts) = response.energy(body, positions)?;
    if !gradient.is_empty() {
        counts = response.gradient_here(body, gradient)?;
    }
    energy.write(found)?;
    survey.write(of_tetrahedra(counts, body))
}
}

/// Frees a response, or does nothing with null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_response_free(response: Option<Box<Response>>) {
    handle::free(response);
}
