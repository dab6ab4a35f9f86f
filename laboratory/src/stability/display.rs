//! A report as a table of at most 90 columns.

use std::fmt;

use super::criteria::Criterion;
use super::{Finding, Report, SurveySettings, Walk};
use crate::curve::Volume;
use crate::rest::{AtRest, digits};

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { settings: SurveySettings { from, to, .. }, moduli, points, admitted, findings, walks } =
            self;
        writeln!(f, "at rest  {}", AtRest { moduli: *moduli, volume: Volume::Free })?;
        write!(f, "box      {from} ≤ λ3 ≤ λ2 ≤ λ1 ≤ {to}: {points} points, ")?;
        match points - admitted {
            0 => writeln!(f, "all inside the domain")?,
            refused => writeln!(f, "{refused} outside the domain left out")?,
        }

        writeln!(f, "\ncriterion            kept at    least modulus   at λ1, λ2, λ3")?;
        for Finding { criterion, kept, worst } in findings {
            write!(f, "{criterion:20} {:10}", share(*kept, *admitted))?;
            match worst {
                Some(worst) => {
                    let modulus = worst.moduli[*criterion as usize] / moduli.mu;
                    writeln!(f, " {:15} {}", digits(modulus) + " μ", triple(worst.stretches))?;
                }
                None => writeln!(f, " –")?,
            }
        }
        if let Some(Finding { worst: Some(worst), .. }) = findings.last() {
            let (normal, polarisation) = (triple(worst.wave.normal), triple(worst.wave.polarisation));
            writeln!(f, "  its wave there has the normal N = ({normal}), the motion m = ({polarisation})")?;
        }

        let [first, second, third] = Criterion::ALL;
        writeln!(f, "\nfirst lost at               {first:16} {second:10} {third}")?;
        for walk in walks {
            let Walk { path, to, reached, lost } = walk;
            let path = if *to < 1.0 { path.to_string() } else { String::new() };
            let end =
                if reached == to { to.to_string() } else { format!("{}, no further", digits(*reached)) };
            let [first, second, third] = lost.map(|lost| lost.map_or("–".to_owned(), digits));
            writeln!(f, "{path:12} {:14} {first:16} {second:10} {third}", format!("to {end}"))?;
        }
        write!(
            f,
            "(sides free of stress, but stretches λ, 1, 1 in confined and λ, λ, λ in hydrostatic tests)"
        )
    }
}

/// Rounded down, so that no exception disappears.
fn share(part: usize, whole: usize) -> String {
    match whole {
        0 => "–".into(),
        _ if part == whole => "100 %".into(),
        _ => format!("{:.1} %", (1000.0 * part as f64 / whole as f64).floor() / 10.0),
    }
}

fn triple(numbers: [f64; 3]) -> String {
    numbers.map(digits).join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_rounded_down() {
        assert_eq!(
            [(0, 0), (3, 3), (9_999, 10_000)].map(|(part, whole)| share(part, whole)),
            ["–", "100 %", "99.9 %"]
        );
    }
}
