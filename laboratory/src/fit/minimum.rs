//! One descent.

use levenberg_marquardt::{LevenbergMarquardt, TerminationReason};

use super::problem::Problem;
use super::report::Ended;

/// Evaluations before a descent is given up, by the number of unknowns.
const PATIENCE: usize = 400;

pub(super) struct Minimum<'a> {
    pub(super) problem: Problem<'a>,
    /// Σ r².
    pub(super) squares: f64,
    pub(super) evaluations: usize,
    pub(super) ended: Ended,
    /// Of which start: 0 is the one given.
    pub(super) start: usize,
}

/// To the minimum below where the problem stands; `None` where numbers leave their range on the way.
pub(super) fn descend(problem: Problem<'_>, start: usize) -> Option<Minimum<'_>> {
    let (problem, report) = LevenbergMarquardt::new().with_patience(PATIENCE).minimize(problem);
    let ended = match report.termination {
        TerminationReason::ResidualsZero => Ended::Exact,
        TerminationReason::Orthogonal => Ended::Stationary,
        TerminationReason::Converged { .. } | TerminationReason::NoImprovementPossible(_) => Ended::Settled,
        TerminationReason::LostPatience => Ended::Unfinished,
        _ => return None,
    };
    let is_sound = problem.answers().is_ok() && report.objective_function.is_finite();
    let (squares, evaluations) = (2.0 * report.objective_function, report.number_of_evaluations);
    is_sound.then_some(Minimum { problem, squares, evaluations, ended, start })
}
