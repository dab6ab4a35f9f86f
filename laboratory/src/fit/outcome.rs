//! Outcome of a fit: parameters, their agreement with the data, and warnings; or the reason for failure.

use std::fmt;

use piola::__private::message::{names, number};
use piola::material::MaterialError;

use crate::data::{Agreement, Measured, PointError, short};

/// Fitted parameters, and their agreement with the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters as [`Energy::with_values`](piola_declare::Energy::with_values) takes them.
    pub values: Vec<Vec<f64>>,
    /// The parameters one by one, lists entry by entry.
    pub numbers: Vec<Number>,
    /// R² of each mode and of all, regardless of what was minimised.
    pub agreement: Agreement,
    /// Root mean square of the differences that were minimised: 0.05 is five percent.
    pub difference: f64,
    /// The condition number of ∂r/∂p for the parameters that were free at the minimum, columns scaled to one:
    /// the fit determines the parameters worse by this factor than the data determine the fit.
    pub condition: f64,
    /// Descents that ended in a minimum.
    pub descents: usize,
    /// Reason why the search ended.
    pub ended: Ended,
    /// Warnings that other parameters might fit as well, or better.
    pub warnings: Vec<Warning>,
}

impl fmt::Display for Fit {
    /// A line for each parameter with its standard error, R², the differences, the end of the search, and the
    /// warnings.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Number { name, value, standing, error } in &self.numbers {
            // Seven digits: rounding changes no stress that is measured.
            let rounded = format!("{value:.6e}").parse().unwrap_or(*value);
            write!(f, "  {name:12} {:<14}", number(rounded))?;
            match (standing, error) {
                (Standing::Free, Some(error)) => {
                    write!(f, " ± {error:.1e} ({:.1} %)", 100.0 * (error / value).abs())?;
                }
                (Standing::Free, None) => {}
                (Standing::Held, _) => f.write_str(" held")?,
                (Standing::Unidentifiable, _) => f.write_str(" held: the data do not determine it")?,
            }
            writeln!(f)?;
        }
        writeln!(f, "  R²           {}", self.agreement)?;
        writeln!(
            f,
            "  differences  {:.3} % (root mean square, points without weight left out)",
            100.0 * self.difference
        )?;
        writeln!(f, "  the best of {} descents: {}", self.descents, self.ended)?;
        // The lines of the parameters have those that the data do not determine.
        let others = |warning: &&Warning| !matches!(warning, Warning::Unidentifiable { .. });
        self.warnings.iter().filter(others).try_for_each(|warning| writeln!(f, "warning: {warning}"))
    }
}

/// A parameter, or an entry of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// The name, such as `kappa`, or `mu_1` for the first entry of a list.
    pub name: String,
    /// The fitted value.
    pub value: f64,
    /// Status of the parameter in the search.
    pub standing: Standing,
    /// Standard error of the value to first order, assuming independent differences of equal variance, if it
    /// was sought from more points than unknowns, and no edge of the admissible parameters ended the search.
    pub error: Option<f64>,
}

/// Status of a parameter in the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Free parameter of the search.
    Free,
    /// Parameter that kept its value, as requested.
    Held,
    /// Parameter that kept its value because it has no effect on the data.
    Unidentifiable,
}

/// Reason why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// No change of the parameters improves the fit, except by rounding.
    Minimum,
    /// The energy refuses the parameters on the way to a better fit: [`Warning::Edge`].
    Edge,
    /// The number of evaluations was exhausted before.
    Unfinished,
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Minimum => "no change of the parameters improves the fit",
            Self::Edge => "at an edge of the admissible parameters",
            Self::Unfinished => "not at a minimum yet when the evaluations were exhausted",
        })
    }
}

/// Warning that other parameters might fit as well, or better.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The data do not determine a parameter, such as a bulk modulus at constant volume.
    Unidentifiable {
        /// Its name.
        parameter: String,
    },
    /// The data hardly determine a combination of parameters.
    Collinear {
        /// Relative changes of parameters that compensate each other, the greatest being 1; absolute if one
        /// is zero. A single one if no other compensates it.
        changes: Vec<(String, f64)>,
        /// Root mean square of the effect of such a change on the differences, to first order.
        effect: f64,
    },
    /// Other descents end about as well at other parameters: a term has vanished, two terms have become one,
    /// a parameter grows without bound, parameters compensate each other, or there are several minima.
    Ambiguous {
        /// Name, least and greatest value of the parameters that differ by more than the order of terms.
        ranges: Vec<(String, f64, f64)>,
        /// The greatest [`Fit::difference`] of these descents.
        difference: f64,
        /// [`Fit::difference`] of the minimum that was found, to compare with.
        found: f64,
    },
    /// A better fit is beyond an edge of the admissible parameters: these are the best parameters found along
    /// it. One warning for each edge.
    Edge {
        /// Reason why the parameters next beyond are refused.
        reason: TrialError,
    },
    /// The volume was kept, but the energy with these parameters yields in volume: a body of it is another
    /// solid than the one fitted.
    Compressible {
        /// Poisson's ratio at small strain.
        poisson: f64,
        /// A bulk modulus that would bring it to 0.49, Pa.
        bulk: f64,
    },
    /// Few readings near zero stress carry more than half of the sum of squares: a tenth of all at most.
    Few {
        /// These readings, by falling share of the sum.
        readings: Vec<Measured>,
        /// Their share of the sum.
        share: f64,
    },
    /// The mean of the measured stresses would be a better guess than the curves.
    Poor {
        /// R² of all points, below 0.
        determination: f64,
    },
    /// The best result is not yet a minimum, and no edge stops the search.
    Unfinished,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unidentifiable { parameter } => {
                write!(f, "the data do not determine {parameter}, which keeps its value")
            }
            Self::Collinear { changes, effect } => {
                let together: Vec<_> =
                    changes.iter().map(|(name, change)| format!("{name} {change:+.3} %")).collect();
                let name = changes.first().map_or("", |(name, _)| name);
                let (together, what, which) = match changes.as_slice() {
                    [_] => (name.to_owned(), "a change by 1 % changes", "it"),
                    _ => (
                        together.join(", "),
                        "changed together in this proportion, they change",
                        "one of them",
                    ),
                };
                let effect = match effect {
                    ..1e-4 => "less than 0.0001 %".to_owned(),
                    _ => format!("{effect:.4} %"),
                };
                write!(
                    f,
                    "the data hardly determine {together}: {what} the fit by {effect}; hold {which} (`--hold {name}`, \
                     `FitSettings::held`), or add data of other tests"
                )
            }
            Self::Ambiguous { ranges, difference, found } => {
                let spread = |(_, least, greatest): &(String, f64, f64)| {
                    (greatest - least) / least.abs().min(greatest.abs())
                };
                let most = ranges.iter().max_by(|a, b| spread(a).total_cmp(&spread(b)));
                let name = most.map_or("", |(name, ..)| name);
                let ranges: Vec<_> = ranges
                    .iter()
                    .map(|(name, least, greatest)| format!("{name} from {least:.4e} to {greatest:.4e}"))
                    .collect();
                write!(
                    f,
                    "other descents end about as well, with differences of up to {:.3} %, compared with {:.3} % of this one, \
                     at {}: a term has vanished, two terms have become one, a parameter grows without bound, parameters \
                     compensate each other, or there are several minima; hold one of them (`--hold {name}`, \
                     `FitSettings::held`), leave a term out, declare what the energy becomes in that limit, or add data of \
                     other tests",
                    100.0 * difference,
                    100.0 * found,
                    ranges.join(", ")
                )
            }
            Self::Edge { reason } => {
                write!(
                    f,
                    "the search ended at an edge of the admissible parameters, and a better fit is beyond: there {reason}"
                )?;
                let given = match reason {
                    TrialError::Inadmissible(MaterialError::Violated { given, .. }) => given.as_slice(),
                    _ => &[],
                };
                // A constructor counts entries from 0, names of numbers from 1: `beta[0]` and `beta_1`.
                for (entry, index) in given.iter().filter_map(|entry| Some((entry, entry.index?))) {
                    write!(f, " ({} is the number {}_{})", entry.name(), entry.parameter, index + 1)?;
                }
                f.write_str(
                    "; hold a parameter, start elsewhere, add data of other tests, or, if the bound is one of `admissible` \
                     and not of physics, move it",
                )
            }
            Self::Compressible { poisson, bulk } => write!(
                f,
                "the volume was kept, but this energy is compressible: its Poisson's ratio at small strain is {poisson:.2}; to \
                 fit the solid that will move, leave the sides free (`--compressible`, \
                 `FitSettings::volume`), or make it incompressible with a term such as \
                 `kappa / 2.0 * (J - 1.0).powi(2)`, kappa being {bulk:.0e} Pa or more"
            ),
            Self::Few { readings, share } => {
                let at = |point: &Measured| format!("{} {:.4}", point.mode, point.control);
                let (readings, percent) = (names(readings.iter().map(at)), 100.0 * share);
                write!(
                    f,
                    "readings near zero stress decide the fit, with {percent:.0} % of the sum of squares: {readings}; noise \
                     and offsets count less by `--floor 0.05` (`FitSettings::floor`), or by `--absolute` (a floor of 1)"
                )
            }
            Self::Poor { determination } => write!(
                f,
                "R² of all points is {}, below 0: the mean of the measured stresses would be a better guess than these \
                 curves",
                short(*determination)
            ),
            Self::Unfinished => f.write_str("this is not a minimum yet: start from these parameters"),
        }
    }
}

/// Reason why nothing can be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// Fewer points than parameters.
    #[error("{points} points cannot determine {free} parameters; hold some (`--hold`), or add data")]
    TooFewPoints {
        /// Points that count.
        points: usize,
        /// Parameters that are sought.
        free: usize,
    },
    /// Start parameters that the energy refuses, or with which it has no stress at a measured point.
    #[error("the parameters to start from {verb} {error}; give others (`--param`, `Candidate`)",
        error = .0, verb = match .0 {
        TrialError::Point(_) => "must reach all points, but",
        TrialError::Inadmissible(_) => "are refused without an extension:",
    })]
    Start(
        /// The reason.
        #[from]
        TrialError,
    ),
    /// Another reason: a setting or a point out of range, a parameter that does not exist, nothing to fit.
    #[error("{0}")]
    Other(String),
}

/// Reason why an energy with trial parameters has no curves to compare with the data.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
pub enum TrialError {
    /// The constructor of the energy refuses the parameters.
    Inadmissible(
        /// Its reason.
        #[from]
        MaterialError,
    ),
    /// A measured point has no stress.
    Point(
        /// The point and the reason.
        #[from]
        PointError,
    ),
}
