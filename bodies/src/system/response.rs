//! Energy, forces and stiffness of a body at any positions, for a user-defined integrator or solver.
//!
//! This module is independent of time and pins: a caller adds inertia and leaves pinned nodes out.

use piola::Survey;
use piola::batch::LengthError;
use piola::point::Filter;

use super::assemble::Elastic;
use super::body::Body;
use super::element::Evaluated;
use super::nodal_stiffness::NodalStiffness;

/// Memory to evaluate the energy of deformation of a body with its first and second derivatives.
///
/// A survey counts elements in the order of [`Body::elements`]. The results of an evaluation are valid if the
/// survey [is clean](Survey::is_clean): they are not for a trial that takes an element out of the domain of
/// its material.
///
/// ```
/// use nalgebra::{DMatrix, DVector};
/// use piola::point::Filter;
/// use piola_bodies::mesh::tetrahedral_box;
/// use piola_bodies::system::{Body, ElasticResponse, LowerTriangle, NodalStiffness, Pins};
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let body = Body::new(&tetrahedral_box([2, 1, 1], [0.2, 0.1, 0.1])?, Rubber::new(1e5, 4e5)?, 1000.0)?;
/// // A weight of 1 N hangs on the last node, and the four nodes of an end are held: Newton's method.
/// let (mut x, last) = (body.rest().to_vec(), body.rest().len() - 1);
/// let pins = Pins::at((0..=last).filter(|&node| x[node][0] == 0.0));
/// let mut stiffness = NodalStiffness::of_body(&body)?;
/// let mut matrix = LowerTriangle::new(&stiffness, &pins)?;
/// let mut response = ElasticResponse::new(&body);
/// let mut gradient = vec![[0.0; 3]; x.len()];
/// for _ in 0..8 {
///     response.energy(&body, &x)?;
///     assert!(response.stiffness_here(&body, Filter::None, &mut gradient, &mut stiffness)?.is_clean());
///     gradient[last][1] += 1.0;
///     // The lower triangle in compressed columns, for any solver: here a dense one.
///     matrix.fill(&stiffness, |_| 0.0)?;
///     let (nodes, starts) = (matrix.free_nodes(), matrix.column_starts());
///     let mut dense = DMatrix::zeros(3 * nodes.len(), 3 * nodes.len());
///     for column in 0..3 * nodes.len() {
///         for at in starts[column]..starts[column + 1] {
///             dense[(matrix.row_indices()[at], column)] = matrix.values()[at];
///         }
///     }
///     let right: Vec<f64> = nodes.iter().flat_map(|&node| gradient[node].map(|g| -g)).collect();
///     let step = dense.cholesky().ok_or("not positive definite")?.solve(&DVector::from_vec(right));
///     for (&node, step) in nodes.iter().zip(step.as_slice().chunks_exact(3)) {
///         (0..3).for_each(|c| x[node][c] += step[c]);
///     }
/// }
/// // The forces of the body on the last node balance the weight.
/// response.energy(&body, &x)?;
/// response.gradient_here(&body, &mut gradient)?;
/// assert!((gradient[last][1] + 1.0).abs() < 1e-10);
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct ElasticResponse {
    elastic: Elastic,
    nodes: usize,
    elements: usize,
}

impl std::fmt::Debug for ElasticResponse {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ElasticResponse {{ nodes: {}, elements: {} }}", self.nodes, self.elements)
    }
}

impl ElasticResponse {
    /// Allocates the memory for a body.
    #[must_use]
    pub fn new(body: &Body) -> Self {
        let (nodes, elements) = (body.rest().len(), body.elements().len());
        Self { elastic: Elastic::new(body), nodes, elements }
    }

    /// Energy of deformation, J, with the nodes at `positions`, of the body for which this memory was made.
    ///
    /// # Errors
    /// [`LengthError`] if there are not as many positions or elements as the body had.
    pub fn energy(&mut self, body: &Body, positions: &[[f64; 3]]) -> Result<(f64, Survey), LengthError> {
        self.check(body, "positions", positions.len())?;
        let Evaluated { survey, .. } = self.elastic.evaluate(body, positions);
        Ok((self.elastic.energy(), survey))
    }

    /// Replaces `gradient` by the gradient of the energy in the position of each node, N, minus the forces,
    /// at the positions where [`ElasticResponse::energy`] was computed last.
    ///
    /// # Errors
    /// [`LengthError`] if `gradient` or the body does not have the length of the body that this was made for.
    pub fn gradient_here(&mut self, body: &Body, gradient: &mut [[f64; 3]]) -> Result<Survey, LengthError> {
        self.check(body, "gradient", gradient.len())?;
        let energies = self.elastic.survey();
        self.elastic.evaluate_gradients(body);
        Ok(self.sum(energies, body, gradient))
    }

    /// Replaces `gradient` as [`ElasticResponse::gradient_here`] does, and `matrix` by the stiffness, N/m,
    /// with the filter on dP/dF of each element. The matrix comes from [`NodalStiffness::of_body`].
    ///
    /// # Errors
    /// [`LengthError`] if a slice, the matrix or the body does not have the length of the body that this was
    /// made for.
    pub fn stiffness_here(
        &mut self,
        body: &Body,
        filter: Filter,
        gradient: &mut [[f64; 3]],
        matrix: &mut NodalStiffness,
    ) -> Result<Survey, LengthError> {
        self.check(body, "gradient", gradient.len())?;
        let [nodes, elements, tiles] = matrix.counts();
        same("matrix", 3 * nodes, self.nodes, 3)?;
        same("matrix", elements, self.elements, 1)?;
        same("matrix", tiles, body.groups().count(), 1)?;
        let energies = self.elastic.survey();
        matrix.linearise(body, &mut self.elastic, filter);
        Ok(self.sum(energies, body, gradient))
    }

    /// Sums the gradients of all elements. Returns the survey of the energies or, if these are clean, of the
    /// derivatives.
    fn sum(&self, energies: Evaluated, body: &Body, gradient: &mut [[f64; 3]]) -> Survey {
        gradient.fill([0.0; 3]);
        self.elastic.add_gradient(body, gradient);
        if energies.survey.is_clean() { self.elastic.survey().survey } else { energies.survey }
    }

    /// Checks the length of a slice with a vector for each node, and that the body is the one of this memory.
    fn check(&self, body: &Body, slice: &'static str, found: usize) -> Result<(), LengthError> {
        same(slice, 3 * found, self.nodes, 3)?;
        same("elements", body.elements().len(), self.elements, 1)?;
        same("nodes", body.rest().len(), self.nodes, 1)
    }
}

/// Checks that a slice holds `components` for each of `points`.
fn same(slice: &'static str, found: usize, points: usize, components: usize) -> Result<(), LengthError> {
    if found == components * points {
        return Ok(());
    }
    Err(LengthError { slice, found, components, points, group: 1 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::testing::{beam, neo_hookean};

    #[test]
    fn lengths_and_bodies_must_fit_and_refused_elements_are_counted() {
        let body = Body::new(&beam(1), neo_hookean(), 1000.0).expect("a body");
        let other = Body::new(&beam(2), neo_hookean(), 1000.0).expect("a body");
        let mut response = ElasticResponse::new(&body);
        let mut gradient = vec![[0.0; 3]; 8];
        assert!(response.energy(&body, &body.rest()[1..]).is_err());
        assert!(response.energy(&other, body.rest()).is_err());
        assert!(response.gradient_here(&body, &mut gradient[1..]).is_err());
        let mut matrix = NodalStiffness::of_body(&other).expect("small");
        assert!(response.stiffness_here(&body, Filter::None, &mut gradient, &mut matrix).is_err());
        // As many nodes, of which another number of elements is made.
        let [five, six] = [false, true].map(|with_last| {
            let mut mesh = beam(1);
            mesh.tets.truncate(if with_last { 6 } else { 5 });
            Body::new(&mesh.without_unused_nodes(), neo_hookean(), 1000.0).expect("a body")
        });
        assert_eq!((five.rest().len(), six.rest().len()), (8, 8));
        let mut matrix = NodalStiffness::of_body(&five).expect("small");
        let error = response.stiffness_here(&six, Filter::None, &mut gradient, &mut matrix);
        assert_eq!(error.expect_err("of five elements").slice, "matrix");
        let mirrored: Vec<[f64; 3]> = body.rest().iter().map(|&[x, y, z]| [-x, y, z]).collect();
        response.energy(&body, &mirrored).expect("lengths");
        let survey = response.gradient_here(&body, &mut gradient).expect("lengths");
        assert_eq!((survey.refused, survey.first), (body.elements().len(), Some(0)));
    }
}
