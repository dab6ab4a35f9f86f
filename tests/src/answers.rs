//! All that a batch computes of its points, for judges that compare batches, and points of all kinds.

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
    pub fn numbers(&self) -> Vec<E> {
        [&self.energies[..], &self.stresses, &self.beside, &self.tangents].concat()
    }
}

impl Answers<f64> {
    /// Fails unless the points from `first` on have the results that they have alone, bit by bit.
    #[track_caller]
    pub fn check(&self, what: &str, first: usize, alone: &Self) {
        let count = alone.energies.len();
        assert_eq!(self.statuses[first..][..count], alone.statuses, "{what}, point {first}");
        for (entries, together, alone) in [
            (1, &self.energies, &alone.energies),
            (9, &self.stresses, &alone.stresses),
            (9, &self.beside, &alone.beside),
            (81, &self.tangents, &alone.tangents),
        ] {
            // As bits, so that NaN equals itself.
            let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let together = &together[entries * first..][..entries * count];
            assert_eq!(bits(together), bits(alone), "{what}, point {first}");
        }
    }
}

/// Number of [`deformations`]: more than two tiles, and not a whole number of lines.
pub const COUNT: usize = 150;

/// The one of [`deformations`] that is out of the range of the invariants.
pub const HUGE: usize = 41;

/// Deformation gradients from gentle to inside out, a rank-deficient one and a huge one.
pub fn deformations() -> Vec<[f64; 9]> {
    let mut all: Vec<[f64; 9]> = (0..COUNT)
        .map(|p| {
            let turn = 0.7 * p as f64;
            let shear = 0.4 * turn.sin();
            let last = if p % 7 == 3 { -0.5 } else { 0.5 + (0.3 * turn.cos()).abs() };
            [1.0 + 0.3 * turn.cos(), shear, 0.1, -0.2 * shear, 1.1, shear, 0.05, 0.2, last]
        })
        .collect();
    all[40] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    all[HUGE] = [1e60, 0.0, 0.0, 0.0, 1e60, 0.0, 0.0, 0.0, 1e60];
    all
}
