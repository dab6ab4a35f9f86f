//! One descent: down to a minimum, and along active constraints.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};

use super::edge::{self, Stop};
use super::outcome::{Ended, TrialError};
use super::problem::Problem;

/// Evaluations before a search is given up, by the number of unknowns.
const PATIENCE: usize = 400;
/// Maximum number of restarts of a descent along an active constraint: two or three suffice if it is flat.
const WAYS: usize = 12;
/// Share of the effect of the most influential number on the residuals below which another number is drowned:
/// rounding is then more than a ten-millionth of its effect.
const DROWNED: f64 = 1e-9;

pub(super) struct Minimum<'a> {
    pub(super) problem: Problem<'a>,
    /// Σ r².
    pub(super) squares: f64,
    pub(super) ended: Ended,
    /// The reasons of the edges that ended the search, if edges did.
    pub(super) edges: Vec<TrialError>,
    /// True if this is a minimum: no step is worth taking, or the energy accepts none that is.
    pub(super) is_least: bool,
}

/// Descends to the nearest minimum below the current values; `None` if numbers leave their range on the way.
pub(super) fn descend(problem: Problem<'_>) -> Option<Minimum<'_>> {
    let approached = approach(&problem);
    let mut minimum = search(approached.map_or(problem, |approached| approached.problem.anew()))?;
    for slides in 0.. {
        let Some(Stop { reasons, ways, is_least }) = edge::stop(&minimum.problem) else { break };
        if slides == WAYS {
            return Some(Minimum { ended: Ended::Unfinished, is_least: false, ..minimum });
        }
        // Where no way along the edges is found, other units may lead past them.
        let is_least = is_least || !ways.is_empty();
        let is_stuck = !is_least && minimum.ended != Ended::Unfinished;
        let anew = is_stuck.then(|| search(minimum.problem.anew())).flatten();
        let nexts = ways.into_iter().filter_map(|(from, basis)| {
            let slid = search(minimum.problem.within(from, basis))?;
            // In all directions again: the edge may end, or turn away.
            search(slid.problem.anew())
        });
        let next = nexts.chain(anew).min_by(|a, b| a.squares.total_cmp(&b.squares));
        let is_gain = |next: &Minimum<'_>| !edge::is_no_gain(minimum.squares - next.squares, minimum.squares);
        let Some(next) = next.filter(is_gain) else {
            return Some(Minimum { ended: Ended::Edge, edges: reasons, is_least, ..minimum });
        };
        minimum = next;
    }
    Some(minimum)
}

/// Fits only the parameters with a noticeable slope and keeps the rest fixed, until the rest has one too.
/// `None` if all or none are noticeable.
///
/// The effect of the rest is less than the rounding of the others' effect, and steps that change it too are
/// random.
fn approach<'a>(problem: &Problem<'a>) -> Option<Minimum<'a>> {
    let slopes = problem.jacobian()?;
    let lengths: Vec<f64> = slopes.column_iter().map(|column| column.norm()).collect();
    let greatest = lengths.iter().copied().fold(0.0, f64::max);
    let loud: Vec<usize> = (0..lengths.len()).filter(|&k| lengths[k] > DROWNED * greatest).collect();
    if loud.is_empty() || loud.len() == lengths.len() {
        return None;
    }
    search(problem.with_alone(&loud))
}

fn search(problem: Problem<'_>) -> Option<Minimum<'_>> {
    let (problem, report) = LevenbergMarquardt::new().with_patience(PATIENCE).minimize(problem);
    let ended = match report.termination {
        TerminationReason::ResidualsZero
        | TerminationReason::Orthogonal
        | TerminationReason::Converged { .. }
        | TerminationReason::NoImprovementPossible(_) => Ended::Minimum,
        TerminationReason::LostPatience => Ended::Unfinished,
        _ => return None,
    };
    let is_sound = problem.trial.is_ok() && report.objective_function.is_finite();
    let (squares, is_least) = (2.0 * report.objective_function, ended != Ended::Unfinished);
    is_sound.then_some(Minimum { problem, squares, ended, edges: Vec::new(), is_least })
}
