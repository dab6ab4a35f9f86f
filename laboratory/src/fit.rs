//! Parameters from measured data: nonlinear least squares over the stresses of all tests at once.
//!
//! The differences between the stresses of an energy and the measured ones, each divided by a size of its own
//! ([`Difference`]), are minimised in the sum of their squares by the Levenberg–Marquardt method \[Mor78\].
//! The derivatives of a stress by the parameters come from the code that `fit` in the declaration generates,
//! including the motion of free sides ([`Response::weights`](crate::curve::Response::weights)).
//!
//! Such fits are easily ambiguous \[OSS04\]: data may not determine a parameter, or determine only some
//! combination of parameters, and there may be several minima; or the energy refuses the best parameters, or
//! yields in volume although the fit keeps it. All five are detected and reported: [`Warning`].
//!
//! \[Mor78\] Moré, *The Levenberg–Marquardt algorithm: implementation and theory*, 1978.
//! \[OSS04\] Ogden, Saccomandi, Sgura, *Fitting hyperelastic models to experimental data*, 2004.

mod candidate;
mod edge;
mod minimum;
mod others;
mod outcome;
mod problem;
mod report;
mod starts;
mod trial;
mod uniqueness;

use piola::__private::message::quoted;

use crate::curve::Volume;
use crate::data::{Measured, Measurements};

pub use candidate::Candidate;
pub use outcome::{Ended, Fit, FitError, Number, Standing, Warning};
pub use trial::TrialError;

use candidate::Numbers;
use minimum::Minimum;
use problem::{Problem, Task};

/// The measure of the difference at each measured point, whose squares are summed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Difference {
    /// The difference by the measured stress, so that small strains count as much as large ones. Points
    /// without stress are left out.
    #[default]
    Relative,
    /// The difference by the greatest measured stress of all, so that stiff tests and large strains decide.
    /// This maximises R² of all points.
    Absolute,
}

/// Settings of a fit.
///
/// ```
/// use piola_laboratory::curve::Volume;
/// use piola_laboratory::fit::FitSettings;
///
/// let settings =
///     FitSettings { volume: Volume::Free, held: vec!["alpha_1".into()], ..FitSettings::default() };
/// assert_eq!(settings.restarts, 20);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// Treatment of the volume of the specimens. Most data are without lateral stretches; for rubber the
    /// assumption to make then is constant volume, the default. If the energy yields in volume, it describes
    /// another solid ([`Warning::Compressible`]): fit it with [`Volume::Free`].
    pub volume: Volume,
    /// The measure of differences, relative by default.
    pub difference: Difference,
    /// Parameters that keep their values: names as declared, a list with all its entries or a function with
    /// all its values, or one of these as `alpha_1` or `f_1`, counted from 1.
    ///
    /// A fit changes those values of a function that its type provides
    /// ([`Univariate::values`](piola::Univariate::values)); a function without such values stays as it is.
    /// Hold those that keep the rest state free of stress; a [`Spline`](piola::Spline) does so by itself
    /// where x is 1.
    pub held: Vec<String>,
    /// Number of further starts from parameters at random about the given ones, default 20, at most 10 000.
    pub restarts: usize,
    /// Seed of these random parameters, default 1: equal seeds give equal fits.
    pub seed: u64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            volume: Volume::Kept,
            difference: Difference::Relative,
            held: Vec::new(),
            restarts: 20,
            seed: 1,
        }
    }
}

/// Limit of [`FitSettings::restarts`], far beyond the minima of any energy.
const MOST_RESTARTS: usize = 10_000;

/// Fits the parameters of an energy to data, starting from those that it has.
///
/// Trials stay where the constructor accepts the parameters and every measured point has a stress. If the
/// best fit is beyond that, the search follows the edge to the best fit there: [`Warning::Edge`].
///
/// # Errors
/// [`FitError`] if nothing can be fitted.
pub fn fit_parameters(
    start: &dyn Candidate,
    data: &Measurements,
    settings: &FitSettings,
) -> Result<Fit, FitError> {
    let restarts = settings.restarts;
    if restarts > MOST_RESTARTS {
        return Err(FitError::Other(format!(
            "the number of random starts is {restarts}; it must be at most {MOST_RESTARTS}"
        )));
    }
    if let Some((index, fault)) =
        data.points.iter().map(Measured::fault).enumerate().find_map(|(index, fault)| Some((index, fault?)))
    {
        return Err(FitError::Other(format!("the point {index} (from 0) cannot be fitted: {fault}")));
    }
    let numbers = Numbers::of(start);
    let mut held = held(&numbers, &settings.held)?;
    let points = points(data, settings.difference)?;
    let task = Task { start, numbers: &numbers, points: &points, volume: settings.volume };
    let problem = |held: &[Option<Standing>], values: Vec<f64>| {
        let free = (0..held.len()).filter(|&number| held[number].is_none()).collect();
        Problem::new(task, free, values)
    };

    let first = problem(&vec![None; held.len()], numbers.values.clone());
    first.answers()?;
    let elsewhere = starts::without_zeros(&numbers.values, &held);
    let elsewhere = starts::around(&elsewhere, &held, settings)
        .map(|values| problem(&vec![None; values.len()], values))
        .filter(|problem| problem.answers().is_ok())
        .take(1 + restarts);
    let silent = uniqueness::unidentifiable(std::iter::once(first).chain(elsewhere), &numbers);
    for number in silent {
        held[number].get_or_insert(Standing::Unidentifiable);
    }
    let free = held.iter().filter(|standing| standing.is_none()).count();
    if free == 0 {
        let mistake = "no parameter is left to fit: hold fewer, or add data of other tests";
        return Err(FitError::Other(mistake.into()));
    }
    if points.len() < free {
        return Err(FitError::TooFewPoints { points: points.len(), free });
    }

    let minima: Vec<Minimum> = starts::around(&numbers.values, &held, settings)
        .map(|values| problem(&held, values))
        .filter(|problem| problem.answers().is_ok())
        .take(1 + restarts)
        .enumerate()
        .filter_map(|(start, problem)| minimum::descend(problem, start))
        .collect();
    let no_minimum =
        || FitError::Other("residuals become infinite on the way; start nearer to the solution".into());
    let least = minima.iter().map(|minimum| minimum.squares).reduce(f64::min).ok_or_else(no_minimum)?;
    // Of those that differ by rounding alone the first.
    let is_least = |minimum: &&Minimum<'_>| minimum.squares <= least * (1.0 + 1e-9);
    let best = minima.iter().find(is_least).ok_or_else(no_minimum)?;
    let agreement = data.agreement(best.problem.specimen(), settings.volume);
    let agreement = agreement.map_err(TrialError::Point)?;
    let analysis = uniqueness::analyse(&best.problem, &numbers);
    Ok(report::report(&numbers, &held, &minima, best, agreement, analysis))
}

/// Numbers that are held: those of the names, and whole exponents.
fn held(numbers: &Numbers, names: &[String]) -> Result<Vec<Option<Standing>>, FitError> {
    let mut held: Vec<_> = numbers.are_whole.iter().map(|whole| whole.then_some(Standing::Held)).collect();
    for name in names {
        let mut is_known = false;
        for (number, standing) in held.iter_mut().enumerate() {
            if numbers.is_named(number, name) {
                (is_known, *standing) = (true, Some(Standing::Held));
            }
        }
        if !is_known {
            let (name, known) = (quoted(name), numbers.names.join(", "));
            return Err(FitError::Other(format!(
                "there is no parameter `{name}` to hold; there are {known}"
            )));
        }
    }
    Ok(held)
}

/// The points that count, each with the divisor of its difference, Pa.
fn points(data: &Measurements, difference: Difference) -> Result<Vec<(Measured, f64)>, FitError> {
    let greatest = data.points.iter().fold(0.0_f64, |greatest, point| greatest.max(point.stress.abs()));
    let size = |point: &Measured| match difference {
        Difference::Relative => point.stress,
        Difference::Absolute => greatest,
    };
    let counting = data.points.iter().filter(|point| !point.is_rest() && size(point) != 0.0);
    let points: Vec<_> = counting.map(|point| (*point, size(point))).collect();
    if points.is_empty() {
        return Err(FitError::Other("there is no point with a stress to fit".into()));
    }
    Ok(points)
}
