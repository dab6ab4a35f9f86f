//! Damping of a motion in addition to that of implicit Euler.
//!
//! Both kinds are terms of the function that a step minimises, with h the time step, xₙ the positions before
//! it and K the stiffness there, its negative eigenvalues clamped:
//!
//! ```text
//! mass         α/(2h) ‖x − xₙ‖²_M          force −α M v
//! stiffness    β/(2h) (x − xₙ)ᵀK(x − xₙ)    force −β K v
//! ```
//!
//! Taking K at the start of the step keeps the second one quadratic, and so the step a minimisation: damping
//! never drives a body, even a stiff or inverted one.

use std::ops::Range;

use piola::batch::element::TILE;
use piola::point::Filter;

use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::element::StiffnessBlocks;
use crate::system::stiffnesses::ElementStiffnesses;

/// Damping: forces against velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Damping {
    /// No damping except that of implicit Euler.
    #[default]
    None,
    /// Mass-proportional damping: the force −α m v on each node slows every motion alike, falling too.
    Mass {
        /// Rate α, 1/s.
        rate: f64,
    },
    /// Stiffness-proportional damping: the force −β K v, with the stiffness K at the start of each step,
    /// slows fast oscillations of deformation the most. It is zero for a body that moves as a whole without
    /// stress. Costs 720 bytes for each element, and one more evaluation of the stiffness in each step.
    Stiffness {
        /// Time β, s: a mode of the angular frequency ω decays like exp(−β ω² t/2).
        time: f64,
    },
}

impl Damping {
    /// α, 1/s.
    pub(super) fn rate(self) -> f64 {
        match self {
            Self::Mass { rate } => rate,
            Self::None | Self::Stiffness { .. } => 0.0,
        }
    }

    /// β, s.
    pub(super) fn time(self) -> f64 {
        match self {
            Self::Stiffness { time } => time,
            Self::None | Self::Mass { .. } => 0.0,
        }
    }

    /// Memory for β K; `None` if it is zero.
    pub(super) fn viscosity(self, body: &Body) -> Option<Viscosity> {
        (self.time() > 0.0).then(|| Viscosity { stiffnesses: ElementStiffnesses::new(body), factor: 0.0 })
    }

    /// The rule that these settings break, if any.
    pub(super) fn broken_rule(self) -> Option<&'static str> {
        let (Self::Mass { rate: number } | Self::Stiffness { time: number }) = self else { return None };
        (!(number >= 0.0 && number.is_finite())).then_some("damping must be finite and not negative")
    }
}

/// Matrix β/h K of the current step.
#[derive(Clone)]
pub(crate) struct Viscosity {
    stiffnesses: ElementStiffnesses,
    /// β/h.
    factor: f64,
}

impl Viscosity {
    /// Takes the stiffnesses where the energies were evaluated last.
    pub(super) fn linearise(&mut self, body: &Body, elastic: &mut Elastic, factor: f64) {
        self.factor = factor;
        elastic.linearise(body, Filter::Clamp, 0, self.stiffnesses.tiles_mut());
    }

    /// Adds β/h K d for a displacement of each node.
    pub(crate) fn add_product(
        &self,
        body: &Body,
        displacement: impl Fn(usize) -> [f64; 3],
        total: &mut [[f64; 3]],
    ) {
        self.stiffnesses.add_product(body, self.factor, displacement, total);
    }

    /// β/h dᵀK d.
    pub(super) fn curvature(&self, body: &Body, displacement: &[[f64; 3]]) -> f64 {
        self.factor * self.stiffnesses.quadratic_form(body, displacement)
    }

    /// Adds β/h K to the stiffnesses of the elements of some tiles.
    pub(crate) fn add_tiles_to(&self, tiles: Range<usize>, to: &mut [[StiffnessBlocks; TILE]]) {
        self.stiffnesses.add_tiles_to(self.factor, tiles, to);
    }
}

#[cfg(all(test, feature = "faer"))]
mod tests;
