//! Fits of exponentials: one term may drown the others where a search begins, and edges are where it has to
//! turn.

use piola_laboratory::fit::{
    Candidate, Ended, Fit, FitError, FitSettings, Standing, Warning, fit_parameters,
};

use super::{Outcome, candidate, catalogue, of_numbers, told, treloar};

/// Rubber after Mansouri and Darijani 2014, made compressible.
const EXPONENTIALS: &str = include_str!("exponentials.txt");

/// To Treloar's data.
fn fitted(start: &Candidate, settings: &FitSettings) -> Result<Fit, FitError> {
    fit_parameters(start, &treloar(), settings)
}

/// From the start given alone.
fn alone() -> FitSettings {
    FitSettings { restarts: 0, ..FitSettings::default() }
}

/// Names of the parameters that the data do not determine, according to the fit.
#[track_caller]
fn indifferent(fit: &Fit) -> Vec<&str> {
    let names = told(fit, |warning| match warning {
        Warning::Unidentifiable { parameter } => Some(parameter.as_str()),
        _ => None,
    });
    let kept = fit.numbers.iter().filter(|number| number.standing == Standing::Unidentifiable);
    assert!(kept.map(|number| &number.name).eq(&names), "{fit:?}");
    names
}

#[test]
fn what_is_drowned_at_the_start_is_not_indifferent() -> Outcome {
    // Along two axes the exponent of the second term is 40; at small stretches the first is most of the
    // stress.
    let start = of_numbers(EXPONENTIALS, &[1e7, 0.018, 2.0, 1e5, 0.1, 2.0, 2e7])?;
    // With A, m, and alpha as given R² would be 0.77 from there.
    for (settings, determination) in [(alone(), 0.9), (FitSettings::default(), 0.995)] {
        let found = fitted(&start, &settings)?;
        assert_eq!(indifferent(&found), ["kappa"]);
        assert!(found.agreement.total > Some(determination), "{found:?}");
        let values = found.values.concat();
        assert!(values.iter().zip([1e7, 0.018, 2.0]).all(|(&value, start)| value != start), "{found:?}");
    }
    Ok(())
}

#[test]
fn what_a_factor_of_zero_hides_is_not_indifferent() -> Outcome {
    let start = candidate(catalogue("ogden"), &[&[6e5, 0.0], &[1.3, 5.0], &[2e7]])?;
    assert_eq!(indifferent(&fitted(&start, &FitSettings::default())?), ["kappa"]);
    let held = FitSettings { held: vec!["mu_2".into()], ..FitSettings::default() };
    assert_eq!(indifferent(&fitted(&start, &held)?), ["alpha_2", "kappa"]);
    Ok(())
}

#[test]
fn at_an_edge_no_one_is_sent_back_to_it() -> Outcome {
    // What is worth no step is 1e-10 of Σ r²; half of that of its root. Rounding at the edge, where moduli
    // cancel, hides up to 1e-6 from one in seven starts.
    for (beta, hidden) in [(1.0, 1e-10), (0.5, 1e-6)] {
        let start = of_numbers(EXPONENTIALS, &[4.98e6, 0.0152, 2.15, 1e7, 0.15, beta, 2e7])?;
        let found = fitted(&start, &alone())?;
        assert_eq!(found.ended, Ended::Edge);
        assert!(found.warnings.iter().any(|warning| matches!(warning, Warning::Edge { .. })), "{found:?}");
        assert!(!found.warnings.contains(&Warning::Unfinished), "{found:?}");
        let Candidate { energy, material } = &start;
        let material = energy.with_values(material, &found.values)?;
        let again = fitted(&Candidate { energy: energy.clone(), material }, &alone())?;
        let [before, after] = [found.difference, again.difference];
        assert!(after >= before * (1.0 - hidden), "{after} for {before}");
    }
    Ok(())
}
