//! The report of a fit from its descents, and its text.

use std::fmt;

use piola::__private::message::number;

use super::candidate::Numbers;
use super::minimum::Minimum;
use super::others;
use super::outcome::{Ended, Fit, Number, Standing, Warning};
use super::uniqueness::Analysis;
use crate::data::Agreement;

/// Poisson's ratio at small strain below which it matters that the volume was kept. At 0.45, which
/// simulations of rubber choose on purpose, the solid that gives way is 3 % softer in tension, by E = 2 (1 +
/// ν) μ for 3 μ, and 12 % in two axes, by E/(1 − ν) for 6 μ: about what measurements differ by.
const NEARLY_INCOMPRESSIBLE: f64 = 0.45;
/// The bulk modulus by the shear modulus for a Poisson's ratio of 0.49, (2/3) (1 + ν)/(1 − 2 ν).
const RUBBER: f64 = 50.0;

pub(super) fn report(
    numbers: &Numbers,
    held: &[Option<Standing>],
    minima: &[Minimum<'_>],
    best: &Minimum<'_>,
    agreement: Agreement,
    analysis: Analysis,
) -> Fit {
    let (count, free) = (best.problem.count(), best.problem.free.len());
    let deviation = (count > free).then(|| (best.squares / (count - free) as f64).sqrt());
    let error = |number: usize| {
        let place = best.problem.free.iter().position(|&other| other == number)?;
        Some(deviation? * analysis.errors.get(place)?).filter(|_| best.ended != Ended::Edge)
    };
    let sought = |(number, standing): (usize, &Option<Standing>)| Number {
        name: numbers.names[number].clone(),
        value: best.problem.values[number],
        standing: standing.unwrap_or(Standing::Free),
        error: error(number),
    };
    let fitted: Vec<_> = held.iter().enumerate().map(sought).collect();

    let silent = fitted.iter().filter(|number| number.standing == Standing::Unidentifiable);
    let mut warnings: Vec<_> =
        silent.map(|number| Warning::Unidentifiable { parameter: number.name.clone() }).collect();
    warnings.extend(compressible(best));
    if let Some(determination) = agreement.total.filter(|&total| total < 0.0) {
        warnings.push(Warning::Poor { determination });
    }
    warnings.extend(best.edges.iter().map(|reason| Warning::Edge { reason: reason.clone() }));
    if best.ended == Ended::Unfinished {
        warnings.push(Warning::Unfinished);
    }
    warnings.extend(analysis.warnings);
    warnings.extend(others::warning(best, minima, numbers));
    Fit {
        values: numbers.lists(&best.problem.values),
        numbers: fitted,
        agreement,
        difference: (best.squares / count as f64).sqrt(),
        condition: analysis.condition,
        start: best.start,
        descents: minima.len(),
        evaluations: best.evaluations,
        ended: best.ended,
        warnings,
    }
}

/// Warning if an energy that was fitted at constant volume is far from keeping it.
fn compressible(best: &Minimum<'_>) -> Option<Warning> {
    let moduli = best.problem.moduli_if_volume_is_imposed()?;
    let poisson = moduli.poisson();
    // Prestressed energies may have moduli of which no ratio makes sense.
    let is_told = moduli.mu > 0.0 && moduli.bulk() >= 0.0 && poisson < NEARLY_INCOMPRESSIBLE;
    is_told.then_some(Warning::Compressible { poisson, bulk: RUBBER * moduli.mu })
}

impl fmt::Display for Fit {
    /// A line for each parameter with its standard error, R², the differences, the way to the minimum, and
    /// the warnings.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Number { name, value, standing, error } in &self.numbers {
            write!(f, "  {name:12} {:<14}", number(rounded(*value)))?;
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
            "  differences  {:.3} % (root mean square, points without stress left out)",
            100.0 * self.difference
        )?;
        let start = match self.start {
            0 => "the parameters given".into(),
            start => format!("random start {start}"),
        };
        let Self { descents, ended, evaluations, .. } = self;
        writeln!(
            f,
            "  the best of {descents} descents, from {start}: {ended} after {evaluations} evaluations"
        )?;
        // The lines of the parameters have those that the data do not determine.
        let others = |warning: &&Warning| !matches!(warning, Warning::Unidentifiable { .. });
        self.warnings.iter().filter(others).try_for_each(|warning| writeln!(f, "warning: {warning}"))
    }
}

/// A value in seven digits: rounding changes no stress that is measured.
fn rounded(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
