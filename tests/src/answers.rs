//! All that a batch computes of its points, for judges that compare batches.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::batch::{Batch, Kernels};
use piola::{Status, StatusCell, Survey};

/// Results of a batch: energies, stresses, stresses with tangents, the status of each point after each call,
/// and the outcome of each call.
#[derive(Clone, Debug)]
pub struct Answers<E> {
    /// ψ.
    pub energies: Vec<E>,
    /// P, nine entries for each point.
    pub stresses: Vec<E>,
    /// P of the call for tangents.
    pub beside: Vec<E>,
    /// dP/dF, 81 entries for each point.
    pub tangents: Vec<E>,
    /// The status of each point in the calls for energies, stresses and tangents.
    pub statuses: Vec<[Status; 3]>,
    /// The outcomes of these calls.
    pub surveys: [Survey; 3],
}

impl<E: Kernels> Answers<E> {
    /// The results of a batch at deformation gradients, point by point.
    ///
    /// # Panics
    /// If there are not nine entries for each point.
    #[must_use]
    pub fn of(batch: Batch<'_, E>, F: &[E]) -> Self {
        let (n, zero) = (F.len() / 9, E::splat(0.0));
        let cells = [(); 3].map(|()| (0..n).map(|_| StatusCell::default()).collect::<Vec<_>>());
        let (mut energies, mut stresses) = (vec![zero; n], vec![zero; 9 * n]);
        let (mut beside, mut tangents) = (vec![zero; 9 * n], vec![zero; 81 * n]);
        let surveys = [
            batch.with_statuses(&cells[0]).energies(F, &mut energies),
            batch.with_statuses(&cells[1]).stresses(F, &mut stresses),
            batch.with_statuses(&cells[2]).tangents(F, &mut beside, &mut tangents),
        ];
        let surveys = surveys.map(|survey| survey.expect("lengths"));
        let statuses = (0..n).map(|p| [0, 1, 2].map(|call| cells[call][p].get())).collect();
        Self { energies, stresses, beside, tangents, statuses, surveys }
    }

    /// All numbers, one kind after the other.
    #[must_use]
    pub fn numbers(&self) -> Vec<E> {
        [&self.energies[..], &self.stresses, &self.beside, &self.tangents].concat()
    }
}
