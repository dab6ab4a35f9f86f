//! Straight paths out of the rest state, and the first loss of a criterion along each.
//!
//! A path is walked from rest outwards, in 256 equal steps of the logarithm of its stretch; between the last
//! step that keeps a criterion and the first that loses it, the edge is found by halving. A loss regained
//! within a step, that is, within half a per cent of the stretch for the range 0.3 … 3, is not detected; nor
//! is a loss between the last step and the end of the path.

use std::fmt;

use super::criteria::Judgement;
use crate::Specimen;
use crate::curve::{Mode, Volume, respond};

/// A homogeneous test with one stretch λ that is prescribed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// λ along one axis, no stress across.
    Uniaxial,
    /// λ along two axes, no stress across.
    Equibiaxial,
    /// λ along one axis, 1 along another, no stress along the third: planar tension.
    PureShear,
    /// λ along one axis, 1 along the others.
    Confined,
    /// λ along all axes.
    Hydrostatic,
}

impl Path {
    /// All paths, in the order of the report.
    pub const ALL: [Self; 5] =
        [Self::Uniaxial, Self::Equibiaxial, Self::PureShear, Self::Confined, Self::Hydrostatic];

    /// The stretches along the axes; `None` if nothing makes the sides free of stress.
    #[must_use]
    pub fn stretches(self, specimen: &dyn Specimen<f64>, stretch: f64) -> Option<[f64; 3]> {
        let free =
            |mode| respond(specimen, mode, Volume::Free, stretch).ok().map(|response| response.stretches);
        match self {
            Self::Uniaxial => free(Mode::Uniaxial),
            Self::Equibiaxial => free(Mode::Equibiaxial),
            Self::PureShear => free(Mode::PureShear),
            Self::Confined => Some([stretch, 1.0, 1.0]),
            Self::Hydrostatic => Some([stretch; 3]),
        }
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Uniaxial => "uniaxial",
            Self::Equibiaxial => "equibiaxial",
            Self::PureShear => "pure shear",
            Self::Confined => "confined",
            Self::Hydrostatic => "hydrostatic",
        })
    }
}

/// The losses along a path in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// The path.
    pub path: Path,
    /// End of the walk that starts at a stretch of 1.
    pub to: f64,
    /// The stretch that was reached: short of `to` if the sides cannot be free of stress beyond it, or the
    /// domain ends.
    pub reached: f64,
    /// The first stretch at which each of [`Criterion::ALL`](super::criteria::Criterion::ALL) is lost, to
    /// eight digits; 1 if it does not hold at rest.
    pub lost: [Option<f64>; 3],
}

const STEPS: u32 = 256;
/// Halvings of a step: to 10⁻¹² of the way.
const HALVINGS: u32 = 32;

impl Walk {
    /// Walks from rest to a stretch, which is positive.
    pub fn along(path: Path, specimen: &dyn Specimen<f64>, to: f64) -> Self {
        let stretch = |share: f64| to.powf(share);
        let judged = |share| Judgement::of(specimen, path.stretches(specimen, stretch(share))?);
        let (reached, lost) = losses(judged);
        Self { path, to, reached: stretch(reached), lost: lost.map(|lost| lost.map(stretch)) }
    }
}

/// The share of a way from rest that can be judged, and the shares at which each criterion is lost first;
/// `judged` gives the criteria at a share of the way, 0 to 1.
pub(super) fn losses(judged: impl Fn(f64) -> Option<Judgement>) -> (f64, [Option<f64>; 3]) {
    let (mut reached, mut lost) = (0.0, [None; 3]);
    for step in 0..=STEPS {
        let share = f64::from(step) / f64::from(STEPS);
        let Some(judgement) = judged(share) else {
            return (edge(reached, share, |share| judged(share).is_some()), lost);
        };
        for (k, lost) in lost.iter_mut().enumerate() {
            if lost.is_none() && !judgement.kept[k] {
                let keeps = |share| judged(share).is_some_and(|judgement| judgement.kept[k]);
                *lost = Some(edge(reached, share, keeps));
            }
        }
        reached = share;
    }
    (reached, lost)
}

/// The last share between one that holds, or rest, and one that does not.
fn edge(mut holding: f64, mut beyond: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (holding + beyond);
        *(if holds(middle) { &mut holding } else { &mut beyond }) = middle;
    }
    holding
}
