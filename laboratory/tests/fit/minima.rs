//! Other minima, and what only looks like one.

use piola_laboratory::curve::{Mode, Volume};
use piola_laboratory::data::Measurements;
use piola_laboratory::fit::{Candidate, Fit, FitSettings, Warning, fit_parameters};

use super::{Outcome, candidate, of_numbers, synthetic, text, told, treloar};

/// Rubber after Swanson 1985: two sums.
const SWANSON: &str = "
#[material(domain(J > 0.0), admissible(alpha[p] > -1.0, beta[p] > -1.0))]
fn Swanson<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    a: [f64; N],
    alpha: [f64; N],
    b: [f64; N],
    beta: [f64; N],
    kappa: f64,
) -> f64 {
    let first = sum(|p| a[p] / (1.0 + alpha[p]) * (I1b / 3.0).powf(1.0 + alpha[p]));
    let second = sum(|p| b[p] / (1.0 + beta[p]) * (I2b / 3.0).powf(1.0 + beta[p]));
    1.5 * (first + second) + kappa / 2.0 * (J - 1.0).powi(2)
}";

/// Rubber after Hoss and Marczak 2010, the part for large stretches of which becomes an exponential as n
/// grows.
const HOSS_MARCZAK: &str = "
#[material(domain(J > 0.0), admissible(beta > 0.0, b > 0.0, n > 0.0))]
fn HossMarczak([l1, l2, l3]: [f64; 3], alpha: f64, beta: f64, mu: f64, b: f64, n: f64, kappa: f64) -> f64 {
    let small = alpha / beta * (1.0 - (-beta * (I1b - 3.0)).exp());
    let large = mu / (2.0 * b) * ((1.0 + b * (I1b - 3.0) / n).powf(n) - 1.0);
    small + large + kappa / 2.0 * (J - 1.0).powi(2)
}";

/// What a material answers in three tests, as if measured.
fn measured(material: &Candidate) -> Measurements {
    let modes = [Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear];
    synthetic(material, Volume::Kept, &modes, &[1.05, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0])
}

/// The parameters that differ among descents that are about as good, with their ranges.
fn ambiguous(fit: &Fit) -> Vec<(&str, f64, f64)> {
    let ranges = told(fit, |warning| match warning {
        Warning::Ambiguous { ranges, .. } => Some(ranges),
        _ => None,
    });
    let all = ranges.into_iter().flatten();
    all.map(|(name, least, greatest)| (name.as_str(), *least, *greatest)).collect()
}

#[test]
fn terms_of_each_sum_change_places_unsaid_unless_one_has_vanished() -> Outcome {
    let start = candidate(SWANSON, &[&[2e5, 2e3], &[0.3, 2.0], &[1e4, 2e2], &[-0.2, 1.0], &[2e7]])?;
    let fitted = |last: f64| -> Result<Fit, Box<dyn std::error::Error>> {
        let truth = candidate(SWANSON, &[&[3e5, 1e3], &[0.2, 2.5], &[2e4, last], &[-0.3, 1.4], &[2e7]])?;
        Ok(fit_parameters(&start, &measured(&truth), &FitSettings::default())?)
    };
    let found = fitted(1e2)?;
    assert!(found.difference <= 1e-9 && found.descents > 10, "{found:?}");
    assert!(ambiguous(&found).is_empty(), "{found:?}");

    let found = fitted(0.0)?;
    let ranges = ambiguous(&found);
    assert!(!ranges.is_empty() && ranges.iter().all(|(name, ..)| name.starts_with("beta_")), "{ranges:?}");
    let text = text(&found);
    for part in ["; hold one of them (`--hold beta_", "`), leave a term out, declare what"] {
        assert!(text.contains(part), "{text}");
    }
    Ok(())
}

#[test]
fn what_grows_without_end_is_said_once() -> Outcome {
    let start = of_numbers(HOSS_MARCZAK, &[2e5, 0.1, 2e5, 0.02, 2.0, 2e7])?;
    let limit = of_numbers(HOSS_MARCZAK, &[2e5, 0.1, 2e5, 0.02, 1e9, 2e7])?;
    // Of Treloar's, n grows until 1 + b (I1 − 3)/n is rounding; other seeds find other solids, too.
    for data in [measured(&limit), treloar()] {
        let found = fit_parameters(&start, &data, &FitSettings { seed: 2, ..FitSettings::default() })?;
        // Random starts vary by ten at most.
        let ranges = ambiguous(&found);
        assert!(matches!(ranges[..], [("n", _, greatest)] if greatest > 2e3), "{ranges:?}");
    }
    Ok(())
}
