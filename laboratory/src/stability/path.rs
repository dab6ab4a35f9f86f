//! Straight paths out of the rest state, and the first loss of a criterion along each.
//!
//! A path is walked from rest outwards, in 256 equal steps of the logarithm of its stretch; between the last
//! step that keeps a criterion and the first that loses it, the edge is found by halving. A loss regained
//! within a step, that is, within half a per cent of the stretch for the range 0.3 … 3, is not detected; nor
//! is a loss between the last step and the end of the path.

use std::fmt;

use super::SurveySettings;
use super::criteria::{Criterion, Judgement};
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
    pub fn stretches(self, specimen: &dyn Specimen, stretch: f64) -> Option<[f64; 3]> {
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
    /// The first stretch at which each of [`Criterion::ALL`] is lost, to eight digits; 1 if it does not hold
    /// at rest.
    pub lost: [Option<f64>; 3],
}

/// Steps of a path.
pub(super) const STEPS: u32 = 256;

/// Halvings of the logarithms between two stretches: from one end of f64 to the other they leave 10⁻¹⁵.
const HALVINGS: u32 = 60;

impl Walk {
    /// Walks from rest to a stretch, which is positive.
    pub fn along(path: Path, specimen: &dyn Specimen, to: f64) -> Self {
        let judged = |stretch: f64| Judgement::of(specimen, path.stretches(specimen, stretch)?);
        let mut walk = Self { path, to, reached: 1.0, lost: [None; 3] };
        for step in 0..=STEPS {
            let stretch = to.powf(f64::from(step) / f64::from(STEPS));
            let last = walk.reached;
            let Some(judgement) = judged(stretch) else {
                walk.reached = edge(last, stretch, |x| judged(x).is_some());
                return walk;
            };
            walk.reached = stretch;
            for (k, lost) in walk.lost.iter_mut().enumerate() {
                if lost.is_none() && !judgement.kept[k] {
                    let keeps = |x: f64| judged(x).is_some_and(|judgement| judgement.kept[k]);
                    *lost = Some(edge(last, stretch, keeps));
                }
            }
        }
        walk
    }

    /// Walks from rest to both ends of the settings' range along every path.
    pub(super) fn all(specimen: &dyn Specimen, settings: &SurveySettings) -> Vec<Self> {
        let ends = [settings.from, settings.to];
        let both = |path| ends.map(|to| Self::along(path, specimen, to));
        Path::ALL.into_iter().flat_map(both).collect()
    }

    /// The first stretch at which a criterion is lost.
    #[must_use]
    pub fn lost(&self, criterion: Criterion) -> Option<f64> {
        self.lost[criterion as usize]
    }
}

/// The last stretch between one that holds, or rest, and one that does not.
fn edge(mut holding: f64, mut beyond: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        if (holding / beyond).ln().abs() <= 1e-9 {
            break;
        }
        // Each root by itself: the product may overflow.
        let middle = holding.sqrt() * beyond.sqrt();
        if holds(middle) { holding = middle } else { beyond = middle }
    }
    holding
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(holding: f64, beyond: f64, edge_at: f64) {
        let found = edge(holding, beyond, |x| (x < edge_at) == (holding < edge_at));
        assert!((found / edge_at).ln().abs() <= 1.1e-9, "{found:e} for {edge_at:e}");
    }

    #[test]
    fn an_edge_is_found_over_the_whole_range() {
        check(1.0, 2.0, 1.5);
        check(1.0, 1e-300, 1e-299);
        check(1e300, 1.7e308, 1e301);
        check(f64::MAX, 5e-324, 1e-200);
        // There is none: it ends all the same.
        for nowhere in [0.0, f64::INFINITY, f64::NAN] {
            edge(1.0, nowhere, |_| false);
        }
    }
}
