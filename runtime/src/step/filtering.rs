//! Choice of the filter in each iteration of Newton's method.
//!
//! Without a filter Newton's method converges fastest, but only near a minimum is its matrix positive
//! definite. Clamped eigenvalues are safe everywhere, absolute ones safer where the energy curves downwards,
//! and slower where it does not. So the choice may depend on how the iteration goes.
//!
//! \[CLLJZ24\] Chen, Liu, Levin, Jacobson, Zheng, *Trust-Region Eigenvalue Filtering for Projected Newton*,
//! 2024.

use crate::point::Filter;
use crate::system::Body;
use crate::system::factored::FactoredStiffness;

use super::objective::{Objective, product};

/// Choice of the filter in each iteration of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Filtering {
    /// One filter in all iterations.
    Always(Filter),
    /// No filter where the matrix is positive definite without one, and clamped eigenvalues where it is not,
    /// which costs a second linearisation and factorisation: half the iterations of clamping always, or
    /// fewer, where steps are solved to their end (`cargo speed-report`).
    OnDemand,
    /// Clamped eigenvalues where the quadratic model without a filter has predicted the step before to within
    /// `tolerance`, absolute ones elsewhere and in the first iteration \[CLLJZ24\].
    ///
    /// The prediction costs one more evaluation of the stiffness in each iteration, and 240 bytes for each
    /// element.
    TrustRegion {
        /// Largest distance of the ratio of actual to predicted decrease from 1; 0.01 in the paper.
        tolerance: f64,
    },
}

impl Filtering {
    /// The filter to begin an iteration with; `ratio` is that of actual to predicted decrease in the one
    /// before.
    pub(super) fn choice(self, ratio: Option<f64>) -> Filter {
        match self {
            Self::Always(filter) => filter,
            Self::OnDemand => Filter::None,
            Self::TrustRegion { tolerance } => match ratio {
                Some(ratio) if (ratio - 1.0).abs() <= tolerance => Filter::Clamp,
                _ => Filter::Absolute,
            },
        }
    }

    /// Memory for predictions, where they are made.
    pub(super) fn model(self, body: &Body) -> Option<Model> {
        matches!(self, Self::TrustRegion { .. }).then(|| Model {
            stiffness: FactoredStiffness::new(body),
            slope: 0.0,
            curvature: 0.0,
        })
    }

    /// The rule that these settings break, if any.
    pub(super) fn broken_rule(self) -> Option<&'static str> {
        match self {
            Self::TrustRegion { tolerance } if !(tolerance > 0.0 && tolerance.is_finite()) => {
                Some("the tolerance of the trust-region ratio must be positive and finite")
            }
            _ => None,
        }
    }
}

/// The quadratic model of the objective along a direction, without a filter.
#[derive(Clone)]
pub(super) struct Model {
    stiffness: FactoredStiffness,
    slope: f64,
    curvature: f64,
}

impl Model {
    /// Takes the model where the energies were evaluated last; `product_of` is memory.
    pub(super) fn take(
        &mut self,
        objective: &mut Objective<'_>,
        slope: f64,
        direction: &[[f64; 3]],
        product_of: &mut [[f64; 3]],
    ) {
        objective.elastic.linearise(objective.body, Filter::None, &mut self.stiffness);
        self.stiffness.multiply(direction, product_of);
        self.slope = slope;
        self.curvature = product(product_of, direction)
            + objective.quadratic_curvature(direction)
            + objective.blocks.curvature(direction);
    }

    /// The ratio of an actual change of the objective to the predicted one.
    pub(super) fn ratio(&self, step: f64, actual: f64) -> f64 {
        actual / (step * self.slope + 0.5 * step * step * self.curvature)
    }
}

#[cfg(test)]
mod tests;
