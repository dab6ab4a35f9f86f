//! Quantities that are computed of points, and the materials of these.

#![expect(non_snake_case, reason = "F and P as in the literature")]

use piola::Survey;
use piola::batch::{Batch, Kernels, LengthError, TileMaterial};
use piola::interpreter::Interpreted;
use piola::material::PerPoint;
use piola::point::Filter;
use piola::point::measures::Measure;

/// A quantity that is computed of each point.
#[derive(Clone, Copy)]
pub(crate) enum Quantity {
    Energy,
    Stress,
    /// P and dP/dF.
    Tangent,
    /// ψ, P and dP/dF.
    All,
    MeasuredStress(Measure),
    MeasuredTangent(Measure),
}

impl Quantity {
    /// The shape of each result.
    pub(crate) fn components(self) -> &'static [&'static [usize]] {
        match self {
            Self::Energy => &[&[]],
            Self::Stress => &[&[3, 3]],
            Self::Tangent => &[&[3, 3], &[3, 3, 3, 3]],
            Self::All => &[&[], &[3, 3], &[3, 3, 3, 3]],
            Self::MeasuredStress(_) => &[&[6]],
            Self::MeasuredTangent(_) => &[&[6], &[6, 6]],
        }
    }

    /// Numbers in a component.
    pub(crate) fn numbers(self) -> impl Iterator<Item = usize> {
        self.components().iter().map(|shape| shape.iter().product())
    }

    /// Computes results.
    pub(crate) fn compute<E: Kernels>(
        self,
        batch: &Batch<'_, E>,
        F: &[E],
        results: &mut [&mut [E]],
    ) -> Result<Survey, LengthError> {
        match (self, results) {
            (Self::Energy, [energies]) => batch.energies(F, energies),
            (Self::Stress, [P]) => batch.stresses(F, P),
            (Self::Tangent, [P, dP_dF]) => batch.tangents(F, P, dP_dF),
            (Self::All, [energies, P, dP_dF]) => batch.energies_and_tangents(F, energies, P, dP_dF),
            (Self::MeasuredStress(measure), [stresses]) => batch.measured_stresses(measure, F, stresses),
            (Self::MeasuredTangent(measure), [stresses, tangents]) => {
                batch.measured_tangents(measure, F, stresses, tangents)
            }
            _ => unreachable!("a result for each of the components"),
        }
    }
}

/// The materials of many points, and the filter of their tangents.
pub(crate) struct Materials<'a, E> {
    /// The material of all points, unless they differ.
    pub(crate) uniform: &'a dyn TileMaterial<E>,
    /// A material for each point, if they differ.
    pub(crate) each: Vec<&'a Interpreted>,
    pub(crate) filter: Filter,
}

impl<E: Kernels> Materials<'_, E> {
    /// Calls a function with a batch of `count` points from `start` on. Those beyond the last point, which
    /// fill up a line, have its material.
    pub(crate) fn with_batch<T>(
        &self,
        start: usize,
        count: usize,
        compute: impl FnOnce(Batch<'_, E>) -> T,
    ) -> T {
        let Some(last) = self.each.len().checked_sub(1) else {
            return compute(Batch::new(self.uniform).with_filter(self.filter));
        };
        let each: Vec<_> = (start..start + count).map(|point| self.each[last.min(point)]).collect();
        match PerPoint::new(each) {
            Ok(materials) => compute(Batch::new(&materials).with_filter(self.filter)),
            Err(_) => unreachable!("all materials do the same outside of their domain"),
        }
    }
}
