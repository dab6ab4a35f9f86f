//! Fits of exponentials, which lead to edges.

use piola_laboratory::data::{Measurements, TRELOAR_1944};
use piola_laboratory::fit::{Candidate, Ended, Fit, FitError, Settings, Warning, fit};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Rubber after Mansouri and Darijani 2014, made compressible.
#[piola::material(domain(J > 0.0), fit)]
fn Exponentials(
    [l1, l2, l3]: [f64; 3],
    A: f64,
    m: f64,
    alpha: f64,
    B: f64,
    n: f64,
    beta: f64,
    kappa: f64,
) -> f64 {
    let tension = A * ((m * (l1.powf(alpha) + l2.powf(alpha) + l3.powf(alpha) - 3.0)).exp() - 1.0);
    let compression = B * ((n * (l1.powf(-beta) + l2.powf(-beta) + l3.powf(-beta) - 3.0)).exp() - 1.0);
    tension + compression - (A * m * alpha - B * n * beta) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}

/// To Treloar's data.
fn fitted(start: &dyn Candidate, settings: &Settings) -> Result<Fit, FitError> {
    fit(start, &Measurements::read(TRELOAR_1944).expect("a table"), settings)
}

/// From the start given alone.
fn alone() -> Settings {
    Settings { restarts: 0, ..Settings::default() }
}

#[test]
fn at_an_edge_no_one_is_sent_back_to_it() -> Outcome {
    let start = Exponentials::new(4.98e6, 0.0152, 2.15, 1e7, 0.15, 0.5, 2e7)?;
    let found = fitted(&start, &alone())?;
    assert_eq!(found.ended, Ended::Edge);
    assert!(found.warnings.iter().any(|warning| matches!(warning, Warning::Edge { .. })), "{found:?}");
    assert!(!found.warnings.contains(&Warning::Unfinished), "{found:?}");
    let again = fitted(start.with_values(&found.values)?.as_ref(), &alone())?;
    // What is worth no step is 1e-10 of Σ r²; half of that of its root.
    assert!(
        again.difference >= found.difference * (1.0 - 1e-10),
        "{} for {}",
        again.difference,
        found.difference
    );
    Ok(())
}
