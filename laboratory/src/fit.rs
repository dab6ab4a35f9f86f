//! Parameters from measured data: nonlinear least squares over the stresses of all tests at once.
//!
//! The differences between the stresses of an energy and the measured ones, each divided by a size of its own
//! ([`FitSettings::floor`]), are minimised in the sum of their squares by the Levenberg–Marquardt method
//! \[Mor78\].
//! The derivatives of a stress by the parameters come from the declaration of the energy
//! ([`Energy::gradient_by_parameters`](piola_declare::Energy::gradient_by_parameters)), and include the
//! motion of free sides ([`Response::weights`](crate::curve::Response::weights)).
//!
//! Such fits are easily ambiguous \[OSS04\]: data may not determine a parameter, or determine only some
//! combination of parameters, and there may be several minima; or the energy refuses the best parameters, or
//! yields in volume although the fit keeps it; or a few readings decide. All six are detected and reported:
//! [`Warning`].
//!
//! \[Mor78\] Moré, *The Levenberg–Marquardt algorithm: implementation and theory*, 1978.
//! \[OSS04\] Ogden, Saccomandi, Sgura, *Fitting hyperelastic models to experimental data*, 2004.

mod edge;
mod minimum;
mod outcome;
mod problem;
mod uniqueness;

use levenberg_marquardt::LeastSquaresProblem;
use piola::__private::message::{names, quoted};
use piola::__private::random::Random;
use piola::interpreter::Interpreted;
use piola::material::Form;
use piola_declare::Energy;

use crate::curve::{Mode, Volume};
use crate::data::{Agreement, Measured, Measurements};
use crate::specimen;

pub use outcome::{Ended, Fit, FitError, Number, Standing, TrialError, Warning};

use minimum::Minimum;
use problem::{Problem, Task};

/// An energy that was declared at run time, and the parameters from which a fit begins.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The energy.
    pub energy: Energy,
    /// A material of it with these parameters.
    pub material: Interpreted,
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
    /// Least divisor of a difference, as a share of the greatest measured stress; where the measured stress
    /// is more, it is the divisor. With 0, the default, differences are relative, so that small strains count
    /// as much as large ones, and points without stress are left out. With 1 they are absolute: stiff tests
    /// and large strains decide, and R² of all points is greatest. A few per cent limit the weight of noise
    /// near zero stress ([`Warning::Few`]).
    pub floor: f64,
    /// Parameters that keep their values: names as declared, a list with all its entries or a function with
    /// all its values, or one of these as `alpha_1` or `f_1`, counted from 1.
    ///
    /// A fit changes the ordinates of a [`Spline`](piola::Spline), except for one at x = 1, which keeps the
    /// rest state free of stress.
    pub held: Vec<String>,
    /// Number of further starts from parameters at random about the given ones, default 20, at most 10 000.
    pub restarts: usize,
    /// Seed of these random parameters, default 1: equal seeds give equal fits.
    pub seed: u64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self { volume: Volume::Kept, floor: 0.0, held: Vec::new(), restarts: 20, seed: 1 }
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
    start: &Candidate,
    data: &Measurements,
    settings: &FitSettings,
) -> Result<Fit, FitError> {
    let restarts = settings.restarts;
    if restarts > MOST_RESTARTS {
        return Err(FitError::Other(format!(
            "the number of random starts is {restarts}; it must be at most {MOST_RESTARTS}"
        )));
    }
    if !(0.0..=1.0).contains(&settings.floor) {
        let mistake = "it must be a share of the greatest stress, from 0 to 1";
        return Err(FitError::Other(format!("the floor is {}; {mistake}", settings.floor)));
    }
    for (index, point) in data.points.iter().enumerate() {
        let refused = |fault| format!("the point {index} (from 0) cannot be fitted: {fault}");
        point.check().map_err(|fault| FitError::Other(refused(fault)))?;
    }
    let (mut numbers, parameters) = numbers(start, &settings.held)?;
    let values: Vec<f64> = numbers.iter().map(|number| number.value).collect();
    let points = points(data, settings.floor)?;
    let all: Vec<usize> = (0..numbers.len()).collect();
    let (volume, points) = (settings.volume, &*points);
    let task = Task { start, parameters: &parameters, free: &all, points, volume };

    let given = Problem::new(task, values.clone());
    if let Err(refusal) = &given.trial {
        return Err(refusal.clone().into());
    }
    // About zero nothing else is random, and a factor that is zero hides others.
    let without_zero = |number: &Number| match number.value {
        0.0 if number.standing == Standing::Free => 1.0,
        value => value,
    };
    let nonzero: Vec<f64> = numbers.iter().map(without_zero).collect();
    let elsewhere = starts(task, &nonzero, &numbers, settings);
    let are_silent = uniqueness::are_silent(std::iter::once(given).chain(elsewhere), numbers.len());
    for (number, is_silent) in numbers.iter_mut().zip(are_silent) {
        if is_silent && number.standing == Standing::Free {
            number.standing = Standing::Unidentifiable;
        }
    }
    let is_free = |number: &usize| numbers[*number].standing == Standing::Free;
    let free: Vec<usize> = all.iter().copied().filter(is_free).collect();
    if free.is_empty() {
        let mistake = "no parameter is left to fit: hold fewer, or add data of other tests";
        return Err(FitError::Other(mistake.into()));
    }
    if points.len() < free.len() {
        return Err(FitError::TooFewPoints { points: points.len(), free: free.len() });
    }

    let task = Task { free: &free, ..task };
    let minima: Vec<Minimum<'_>> =
        starts(task, &values, &numbers, settings).filter_map(minimum::descend).collect();
    let no_minimum =
        || FitError::Other("residuals become infinite on the way; start nearer to the solution".into());
    let least = minima.iter().map(|minimum| minimum.squares).reduce(f64::min).ok_or_else(no_minimum)?;
    // Of those that differ by rounding alone the first.
    let is_least = |minimum: &&Minimum<'_>| minimum.squares <= least * (1.0 + 1e-9);
    let best = minima.iter().find(is_least).ok_or_else(no_minimum)?;
    let agreement = data.agreement(best.problem.specimen(), volume).map_err(TrialError::Point)?;
    Ok(report(numbers, &minima, best, agreement))
}

/// The number of values of a parameter, and its form.
type Shape = (usize, Form);

/// The parameters of an energy one by one, those with these names and whole exponents being held, and their
/// shapes.
fn numbers(
    Candidate { energy, material }: &Candidate,
    held: &[String],
) -> Result<(Vec<Number>, Vec<Shape>), FitError> {
    let (mut numbers, mut parameters) = (Vec::new(), Vec::new());
    let mut unknown: Vec<&str> = held.iter().map(String::as_str).collect();
    for (parameter, list) in energy.description().parameters.iter().zip(energy.values(material)) {
        parameters.push((list.len(), parameter.form));
        for (entry, value) in (1..).zip(list) {
            let name = match parameter.is_list() {
                true => format!("{}_{entry}", parameter.name),
                false => parameter.name.to_string(),
            };
            // A list is held with all its entries.
            let is_meant = |held: &str| held == name || held == parameter.name;
            let is_held = parameter.is_whole() || held.iter().any(|held| is_meant(held));
            let standing = if is_held { Standing::Held } else { Standing::Free };
            unknown.retain(|held| !is_meant(held));
            numbers.push(Number { name, value, standing, error: None });
        }
    }
    if let Some(name) = unknown.first() {
        let known = names(numbers.iter().map(|number: &Number| format!("`{}`", number.name)));
        let name = quoted(name);
        return Err(FitError::Other(format!("there is no parameter `{name}` to hold; there are {known}")));
    }
    Ok((numbers, parameters))
}

/// The points that count, each with the divisor of its difference, Pa.
fn points(data: &Measurements, floor: f64) -> Result<Vec<(Measured, f64)>, FitError> {
    let greatest = data.points.iter().fold(0.0_f64, |greatest, point| greatest.max(point.stress.abs()));
    let least = floor * greatest;
    let size = |point: &Measured| if least >= point.stress.abs() { least } else { point.stress };
    let counting = data.points.iter().filter(|point| !point.is_rest() && size(point) != 0.0);
    let points: Vec<_> = counting.map(|point| (*point, size(point))).collect();
    if points.is_empty() {
        return Err(FitError::Other("there is no point with a stress to fit".into()));
    }
    Ok(points)
}

/// The greatest factor between a random number and the one given.
const SPREAD: f64 = 10.0;
/// Draws for each descent; those that the energy refuses begin none.
const DRAWS: usize = 20;

/// Problems to start from: the values given, then random ones, the free numbers being multiplied by factors
/// between 1/10 and 10, evenly by their logarithms, and once in four with the other sign.
fn starts<'a>(
    task: Task<'a>,
    values: &[f64],
    numbers: &[Number],
    settings: &FitSettings,
) -> impl Iterator<Item = Problem<'a>> {
    let mut random = Random::new(settings.seed);
    let mut at_random = move |(&value, number): (&f64, &Number)| {
        let factor = SPREAD.powf(random.uniform(-1.0, 1.0));
        let sign = if random.once_in(4) { -1.0 } else { 1.0 };
        if number.standing == Standing::Free { sign * factor * value } else { value }
    };
    let start = move |draw: usize| match draw {
        0 => values.to_vec(),
        _ => values.iter().zip(numbers).map(&mut at_random).collect(),
    };
    (0..=settings.restarts * DRAWS)
        .map(start)
        .map(move |values| Problem::new(task, values))
        .filter(|problem| problem.trial.is_ok())
        .take(1 + settings.restarts)
}

/// Poisson's ratio at small strain below which it matters that the volume was kept. At 0.45, which
/// simulations of rubber choose on purpose, the solid that gives way is 3 % softer in tension, by E = 2 (1 +
/// ν) μ for 3 μ, and 12 % in two axes, by E/(1 − ν) for 6 μ: about what measurements differ by.
const NEARLY_INCOMPRESSIBLE: f64 = 0.45;
/// The bulk modulus by the shear modulus for a Poisson's ratio of 0.49, (2/3) (1 + ν)/(1 − 2 ν).
const RUBBER: f64 = 50.0;

/// The report of a fit from its descents.
fn report(mut numbers: Vec<Number>, minima: &[Minimum<'_>], best: &Minimum<'_>, agreement: Agreement) -> Fit {
    let Minimum { problem, squares, .. } = best;
    let (count, free) = (problem.task.points.len(), problem.task.free);
    let (errors, condition, hardly_determined) =
        uniqueness::analyse(problem, &numbers).unwrap_or((Vec::new(), f64::INFINITY, Vec::new()));

    let silent = numbers.iter().filter(|number| number.standing == Standing::Unidentifiable);
    let mut warnings: Vec<_> =
        silent.map(|number| Warning::Unidentifiable { parameter: number.name.clone() }).collect();
    warnings.extend(compressible(problem));
    warnings.extend(few(best));
    if let Some(determination) = agreement.total.filter(|&total| total < 0.0) {
        warnings.push(Warning::Poor { determination });
    }
    warnings.extend(best.edges.iter().map(|reason| Warning::Edge { reason: reason.clone() }));
    if best.ended == Ended::Unfinished {
        warnings.push(Warning::Unfinished);
    }
    warnings.extend(hardly_determined);
    warnings.extend(uniqueness::ambiguous(best, minima, &numbers));

    for (number, &value) in numbers.iter_mut().zip(&problem.values) {
        number.value = value;
    }
    if count > free.len() && best.ended != Ended::Edge {
        let deviation = (squares / (count - free.len()) as f64).sqrt();
        for (&number, error) in free.iter().zip(errors) {
            numbers[number].error = Some(deviation * error);
        }
    }
    Fit {
        values: problem.task.lists(&problem.values),
        numbers,
        agreement,
        difference: (squares / count as f64).sqrt(),
        condition,
        descents: minima.len(),
        ended: best.ended,
        warnings,
    }
}

/// Share of the greatest stress below which a reading is near zero.
const NEAR_ZERO: f64 = 0.05;
/// Differences, root mean square, that may be roundings of the data.
const ROUNDING: f64 = 1e-3;

/// Warning if few readings near zero stress carry most of the sum: a tenth of all readings, or a single one.
/// Of differences with a normal distribution more than a tenth would have to.
fn few(Minimum { problem, squares, .. }: &Minimum<'_>) -> Option<Warning> {
    let points = problem.task.points;
    let greatest = points.iter().fold(0.0_f64, |greatest, (point, _)| greatest.max(point.stress.abs()));
    let residuals = problem.residuals()?;
    let shares = residuals.iter().zip(points).map(|(residual, point)| (residual.powi(2) / squares, point));
    let mut near: Vec<_> = shares.filter(|(_, (_, size))| size.abs() < NEAR_ZERO * greatest).collect();
    near.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    near.truncate((points.len() / 10).max(1));
    let mut share = 0.0;
    let last = near.iter().position(|(of_one, _)| {
        share += of_one;
        share > 0.5
    })?;
    let readings = near[..=last].iter().map(|(_, (point, _))| *point).collect();
    (*squares > ROUNDING.powi(2) * points.len() as f64).then_some(Warning::Few { readings, share })
}

/// Warning if an energy that was fitted at constant volume is far from keeping it.
fn compressible(problem: &Problem<'_>) -> Option<Warning> {
    let Task { volume, points, .. } = problem.task;
    // Simple shear keeps the volume of every solid.
    if volume == Volume::Free || points.iter().all(|(point, _)| point.mode == Mode::SimpleShear) {
        return None;
    }
    let moduli = specimen::moduli(problem.specimen());
    let poisson = moduli.poisson();
    // Prestressed energies may have moduli of which no ratio makes sense.
    let is_told = moduli.mu > 0.0 && moduli.bulk() >= 0.0 && poisson < NEARLY_INCOMPRESSIBLE;
    is_told.then_some(Warning::Compressible { poisson, bulk: RUBBER * moduli.mu })
}
