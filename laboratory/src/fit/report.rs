//! What a fit says.

use std::fmt;

use super::candidate::Numbers;
use super::minimum::Minimum;
use super::others::{Others, SameSolid, change};
use super::refusal::Refusal;
use super::uniqueness::Analysis;
use crate::data::Agreement;

/// Poisson's ratio at small strain below which it matters that the volume was kept. At 0.45, which simulations of rubber choose
/// on purpose, the solid that gives way is 3 % softer in tension, by E = 2 (1 + ν) μ for 3 μ, and 12 % in two axes, by
/// E/(1 − ν) for 6 μ: about what measurements differ by.
const NEARLY_INCOMPRESSIBLE: f64 = 0.45;
/// The bulk modulus by the shear modulus for a Poisson's ratio of 0.49, (2/3) (1 + ν)/(1 − 2 ν).
const RUBBER: f64 = 50.0;

/// Parameters that fit, and how well.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters as [`Declared::from_values`](piola::material::Declared::from_values) takes them.
    pub values: Vec<Vec<f64>>,
    /// The same, one by one.
    pub numbers: Vec<Number>,
    /// R² of each mode and of all, whatever was made small.
    pub agreement: Agreement,
    /// The root of the mean square of the differences that were made small: 0.05 is five percent.
    pub difference: f64,
    /// Of the parameters that were free at the minimum, the greatest singular value of ∂r/∂p, columns scaled to one, by the
    /// least: the fit determines the parameters so many times worse than the data determine the fit.
    pub condition: f64,
    /// Of which start the best minimum is: 0 is the one given, others are random.
    pub start: usize,
    /// Descents that ended in a minimum.
    pub descents: usize,
    /// How often the curves were computed on the way to the best minimum.
    pub evaluations: usize,
    /// Why the search ended there.
    pub ended: Ended,
    /// Why other parameters might do as well, or better.
    pub warnings: Vec<Warning>,
}

/// A parameter, or an entry of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Such as `kappa`, or `mu_1` for the first entry of a list.
    pub name: String,
    /// As fitted.
    pub value: f64,
    /// Whether it was sought.
    pub standing: Standing,
    /// Standard error of the value to first order, the differences being independent and alike, if it was sought from more
    /// points than unknowns, and no edge of what the energy accepts ended the search.
    pub error: Option<f64>,
}

/// Whether a parameter was sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It was.
    Free,
    /// It kept its value, as was asked for.
    Held,
    /// It kept its value, because the data say nothing about it.
    Indifferent,
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The curves go through the data exactly.
    Exact,
    /// No change of the parameters improves the fit to first order.
    Stationary,
    /// Neither parameters nor differences change any more but by rounding.
    Settled,
    /// The energy refuses the parameters on the way to a better fit: [`Warning::Edge`].
    Edge,
    /// The number of evaluations was exhausted before.
    Unfinished,
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Exact => "the curves go through the data",
            Self::Stationary => "no change of the parameters improves the fit",
            Self::Settled => "the parameters change no more but by rounding",
            Self::Edge => "at an edge of what the energy accepts",
            Self::Unfinished => "not at a minimum yet when the evaluations were exhausted",
        })
    }
}

/// Why other parameters might fit as well, or better.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The data say nothing about a parameter, such as a bulk modulus at constant volume.
    Indifferent {
        /// Its name.
        parameter: String,
    },
    /// The data say little about a combination of parameters.
    Dependent {
        /// Relative changes of parameters that make up for each other, the greatest being 1; absolute where one is zero. A
        /// single one where no other makes up for it.
        changes: Vec<(String, f64)>,
        /// The root of the mean square of what such a change changes of the differences, to first order.
        effect: f64,
    },
    /// There is another minimum, about as good, of a solid with other stresses.
    OtherMinimum {
        /// Its parameters, as [`Fit::values`].
        values: Vec<Vec<f64>>,
        /// The same one by one, by the names of [`Fit::numbers`].
        numbers: Vec<(String, f64)>,
        /// As [`Fit::difference`].
        difference: f64,
        /// [`Fit::difference`] of the one that was found, to compare with.
        found: f64,
    },
    /// Other parameters make the same solid: one grows without end, a term has vanished, two terms have become one, or parameters
    /// make up for each other.
    SameSolid {
        /// Name, value, and value of the other, of the parameters that are not the same but for the order of terms; lists with
        /// all their entries.
        numbers: Vec<(String, f64, f64)>,
        /// Whether that is a single one, far beyond where the search began.
        is_endless: bool,
    },
    /// A better fit is beyond an edge of what the energy accepts: these are the best parameters that were found along it. One
    /// warning for each edge.
    Edge {
        /// Why the parameters next beyond are refused.
        reason: Refusal,
    },
    /// The volume was kept, but the energy with these parameters gives way in volume: a body of it is another solid than the
    /// one fitted.
    Compressible {
        /// Poisson's ratio at small strain.
        poisson: f64,
        /// A bulk modulus that would bring it to 0.49, Pa.
        bulk: f64,
    },
    /// The mean of the measured stresses would be a better guess than the curves.
    Poor {
        /// R² of all points, below 0.
        determination: f64,
    },
    /// The best that was found is no minimum yet, and no edge keeps the search from going on.
    Unfinished,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Indifferent { parameter } => {
                write!(f, "the data say nothing about {parameter}, which keeps its value")
            }
            Self::Dependent { changes, effect } => match changes.as_slice() {
                [(name, _)] => write!(
                    f,
                    "the data say little about {name}: a change by 1 % changes the fit by {}; hold it (`--hold {name}`, \
                     `Settings::held`), or add data of other tests",
                    Percent(*effect)
                ),
                changes => {
                    let together: Vec<_> =
                        changes.iter().map(|(name, change)| format!("{name} {change:+.3} %")).collect();
                    let name = changes.first().map_or("", |(name, _)| name);
                    write!(
                        f,
                        "the data say little about {}: changed together in this proportion, they change the fit by {}; \
                         hold one of them (such as `--hold {name}`, `Settings::held`), or add data of other tests",
                        together.join(", "),
                        Percent(*effect)
                    )
                }
            },
            Self::OtherMinimum { numbers, difference, found, .. } => {
                let numbers: Vec<_> =
                    numbers.iter().map(|(name, value)| format!("{name} = {value:.4e}")).collect();
                write!(
                    f,
                    "another minimum has differences of {:.3} %, beside {:.3} % of this one: {}",
                    100.0 * difference,
                    100.0 * found,
                    numbers.join(", ")
                )
            }
            Self::SameSolid { numbers, is_endless } => {
                let change = |(_, here, there): &(String, f64, f64)| change(*here, *there);
                let most = numbers.iter().max_by(|a, b| change(a).total_cmp(&change(b)));
                let name = most.map_or("", |(name, ..)| name);
                let [here, there]: [Vec<_>; 2] = [
                    numbers.iter().map(|(name, here, _)| format!("{name} = {here:.4e}")).collect(),
                    numbers.iter().map(|(name, _, there)| format!("{name} = {there:.4e}")).collect(),
                ];
                let (here, there) = (here.join(", "), there.join(", "));
                let hold = format_args!("(`--hold {name}`, `Settings::held`)");
                match is_endless {
                    true => write!(
                        f,
                        "{name} grows without end: {there} does about as well as {here}; hold it {hold}, or declare what the \
                         energy becomes in that limit"
                    ),
                    false => write!(
                        f,
                        "the solid is the same with {there} as with {here}: a term has vanished, two terms have become \
                         one, or parameters make up for each other; hold one of them {hold}, or leave the term out"
                    ),
                }
            }
            Self::Edge { reason } => {
                write!(
                    f,
                    "the search ended at an edge of what the energy accepts, and a better fit is beyond: there {reason}"
                )?;
                for (entry, number) in reason.entries() {
                    write!(f, " ({entry} is the number {number})")?;
                }
                f.write_str(
                    "; hold a parameter, start elsewhere, add data of other tests, or, if the bound is one of `admissible` \
                     and not of physics, move it",
                )
            }
            Self::Compressible { poisson, bulk } => write!(
                f,
                "the volume was kept, but this energy gives way: its Poisson's ratio at small strain is {poisson:.2}; to fit \
                 the solid that will move, let the sides go (`--compressible`, \
                 `Settings {{ volume: Volume::Free, .. }}`), or make it incompressible with a term such as \
                 `kappa / 2.0 * (J - 1.0).powi(2)`, kappa being {bulk:.0e} Pa or more"
            ),
            Self::Poor { determination } => write!(
                f,
                "R² of all points is {determination:.3}, below 0: the mean of the measured stresses would be a better \
                 guess than these curves"
            ),
            Self::Unfinished => f.write_str("this is no minimum yet: start from these parameters"),
        }
    }
}

/// A small number of percent, for readers who need no more than that it is small.
struct Percent(f64);

impl fmt::Display for Percent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 < 1e-4 { f.write_str("less than 0.0001 %") } else { write!(f, "{:.4} %", self.0) }
    }
}

/// Why nothing can be fitted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FitError {
    /// A parameter that is to be held does not exist.
    UnknownParameter {
        /// The name as given.
        name: String,
        /// The names that exist, list by entry.
        known: Vec<String>,
    },
    /// No parameter is left that could change, or that the data say anything about.
    NothingFree,
    /// There is no point that counts.
    NoPoints,
    /// There are fewer points than parameters.
    TooFewPoints {
        /// Points that count.
        points: usize,
        /// Parameters that are sought.
        free: usize,
    },
    /// With the parameters to start from, the energy is refused, or has no stress at a measured point.
    Start(
        /// Why.
        Refusal,
    ),
    /// Numbers left their range from every start.
    NoMinimum,
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownParameter { name, known } => {
                write!(f, "there is no parameter `{name}` to hold; there are {}", known.join(", "))
            }
            Self::NothingFree => {
                f.write_str("no parameter is left to fit: hold fewer, or add data of other tests")
            }
            Self::NoPoints => f.write_str("there is no point with a stress to fit"),
            Self::TooFewPoints { points, free } => {
                write!(f, "{points} points cannot determine {free} parameters; hold some, or add data")
            }
            Self::Start(Refusal::Unanswered(unanswered)) => {
                write!(f, "the parameters to start from must reach all points, but {unanswered}")
            }
            Self::Start(Refusal::Inadmissible(reason)) => {
                write!(f, "the parameters to start from are refused without an extension: {reason}")
            }
            Self::NoMinimum => {
                f.write_str("numbers leave their range on the way; start nearer to the solution")
            }
        }
    }
}

impl std::error::Error for FitError {}

pub(super) fn report(
    numbers: &Numbers,
    held: &[Option<Standing>],
    minima: &[Minimum<'_>],
    best: &Minimum<'_>,
    agreement: Agreement,
    analysis: Analysis,
) -> Fit {
    let (count, free) = (best.problem.count(), best.problem.free.len());
    let difference = |minimum: &Minimum<'_>| (minimum.squares / count as f64).sqrt();
    let deviation = (count > free).then(|| (best.squares / (count - free) as f64).sqrt());
    let error = |number: usize| {
        let place = best.problem.free.iter().position(|&other| other == number)?;
        Some(deviation? * analysis.errors.get(place)?).filter(|_| best.ended != Ended::Edge)
    };
    let number = |(number, standing): (usize, &Option<Standing>)| Number {
        name: numbers.names[number].clone(),
        value: best.problem.values[number],
        standing: standing.unwrap_or(Standing::Free),
        error: error(number),
    };
    let fitted: Vec<_> = held.iter().enumerate().map(number).collect();

    let silent = fitted.iter().filter(|number| number.standing == Standing::Indifferent);
    let mut warnings: Vec<_> =
        silent.map(|number| Warning::Indifferent { parameter: number.name.clone() }).collect();
    warnings.extend(compressible(best));
    if agreement.total.is_finite() && agreement.total < 0.0 {
        warnings.push(Warning::Poor { determination: agreement.total });
    }
    warnings.extend(best.edges.iter().map(|reason| Warning::Edge { reason: reason.clone() }));
    if best.ended == Ended::Unfinished {
        warnings.push(Warning::Unfinished);
    }
    warnings.extend(analysis.warnings);
    let Others { solids, same_solid } = Others::of(best, minima, numbers);
    let others = solids.into_iter().map(|minimum| Warning::OtherMinimum {
        values: numbers.lists(&minimum.problem.values),
        numbers: numbers.names.iter().cloned().zip(minimum.problem.values.iter().copied()).collect(),
        difference: difference(minimum),
        found: difference(best),
    });
    warnings.extend(others);
    warnings.extend(same_solid.map(|SameSolid { minimum, differing, is_endless, .. }| {
        let both = |number: usize| {
            let [here, there] = [best, minimum].map(|minimum| minimum.problem.values[number]);
            (numbers.names[number].clone(), here, there)
        };
        Warning::SameSolid { numbers: differing.into_iter().map(both).collect(), is_endless }
    }));
    Fit {
        values: numbers.lists(&best.problem.values),
        numbers: fitted,
        agreement,
        difference: difference(best),
        condition: analysis.condition,
        start: best.start,
        descents: minima.len(),
        evaluations: best.evaluations,
        ended: best.ended,
        warnings,
    }
}

/// Whether what was fitted at constant volume is far from keeping it.
fn compressible(best: &Minimum<'_>) -> Option<Warning> {
    let moduli = best.problem.moduli_if_volume_is_imposed()?;
    let poisson = moduli.poisson();
    // Prestressed energies may have moduli of which no ratio makes sense.
    let is_told = moduli.mu > 0.0 && moduli.bulk() >= 0.0 && poisson < NEARLY_INCOMPRESSIBLE;
    is_told.then_some(Warning::Compressible { poisson, bulk: RUBBER * moduli.mu })
}
