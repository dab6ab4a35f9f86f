//! Fits that an edge of what an energy accepts keeps from their minimum.

use nalgebra::{DMatrix, DVector};
use piola::material::MaterialError;
use piola_laboratory::curve::{Mode, ResponseError, Volume, respond};
use piola_laboratory::data::PointError;
use piola_laboratory::fit::{Ended, Fit, FitSettings, TrialError, Warning, fit_parameters};

use super::{Linear, Outcome, by, candidate, of_numbers, rubber, tension, text, told, treloar};

/// An edge is met as nearly as a step that gains less than 1e-10 of Σ r² comes to it.
const GAIN: f64 = 1e-10;

/// Rubber after Mooney between bounds of no physical meaning.
const BOUNDED: &str = "
#[material(domain(J > 0.0), admissible(c1 <= 1e5, c2 >= 1e4, c1 + c2 <= 1.2e5))]
fn Bounded([l1, l2, l3]: [f64; 3], c1: f64, c2: f64) -> f64 {
    c1 * (I1b - 3.0) + c2 * (I2b - 3.0) + 1e8 * (J - 1.0).powi(2)
}";

/// The same inside a circle.
const ROUND: &str = "
#[material(domain(J > 0.0), admissible(c1.powi(2) + c2.powi(2) <= 1e10))]
fn Round([l1, l2, l3]: [f64; 3], c1: f64, c2: f64) -> f64 {
    c1 * (I1b - 3.0) + c2 * (I2b - 3.0) + 1e8 * (J - 1.0).powi(2)
}";

/// Rubber that softens until I1 = a.
const SOFTENING: &str = "
#[material(domain(J > 0.0, a - I1b > 0.0))]
fn Softening([l1, l2, l3]: [f64; 3], mu: f64, a: f64) -> f64 {
    mu * (I1b - 3.0) * (2.0 * a - I1b - 3.0) + 1e8 * (J - 1.0).powi(2)
}";

/// Powers of the first invariant above a bound.
const POWERS: &str = "
#[material(domain(J > 0.0), admissible(alpha[p] >= 1.5))]
fn Powers<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N]) -> f64 {
    sum(|p| mu[p] / alpha[p] * (I1b / 3.0).powf(alpha[p])) + 1e8 * (J - 1.0).powi(2)
}";

/// The reason for the rejection at each edge.
fn edges(fit: &Fit) -> Vec<&TrialError> {
    told(fit, |warning| match warning {
        Warning::Edge { reason } => Some(reason),
        _ => None,
    })
}

/// The conditions at whose edge a fit ends.
fn conditions(fit: &Fit) -> Vec<&str> {
    told(fit, |warning| match warning {
        Warning::Edge { reason: TrialError::Inadmissible(MaterialError::Violated { condition, .. }) } => {
            Some(&**condition)
        }
        Warning::Edge { reason } => panic!("{reason:?}"),
        _ => None,
    })
}

/// Asserts that a fit is as good as the least Σ r² along an edge.
#[track_caller]
fn check(linear: &Linear, fit: &Fit, least: f64) {
    let squares = fit.difference.powi(2) * linear.wanted.len() as f64;
    // What a step along the edge could gain, and as much for the way to it; times ten.
    assert!((squares / least - 1.0).abs() <= 10.0 * GAIN, "{squares} for {least}: {fit:?}");
}

/// ∂ψ/∂λi of Murnaghan's solid by λ, μ, l, m, n, in which it is linear: ∂J1 = λi, ∂J2 = λi (J1 − Ei),
/// ∂J3 = λi Ej Ek.
fn murnaghan(stretches: [f64; 3]) -> [[f64; 5]; 3] {
    let strains = stretches.map(|stretch| (stretch * stretch - 1.0) / 2.0);
    let [one, two, three] = strains;
    let (first, second) = (one + two + three, one * two + two * three + three * one);
    [0, 1, 2].map(|i| {
        let (rest, product) = (first - strains[i], strains[(i + 1) % 3] * strains[(i + 2) % 3]);
        let third = 2.0 * (first.powi(2) - second - first * rest);
        [first, 2.0 * (first - rest), first.powi(2), third, product].map(|term| stretches[i] * term)
    })
}

/// ∂ψ/∂λi by c1, c2 at constant volume: 2 λi, and −2 λi⁻³ for I2 = Σ λi⁻².
fn mooney(stretches: [f64; 3]) -> [[f64; 2]; 3] {
    stretches.map(|stretch| [2.0 * stretch, -2.0 * stretch.powi(-3)])
}

#[test]
fn where_the_bulk_modulus_may_not_fall_below_zero_the_best_fit_has_none() -> Outcome {
    let start = rubber("murnaghan", &[2e7, 4e5, -1e3, -1e3, -1e3])?;
    let data = treloar();
    // λ = −2/3 μ.
    let mut edge = DMatrix::zeros(5, 4);
    edge[(0, 0)] = -2.0 / 3.0;
    (0..4).for_each(|k| edge[(k + 1, k)] = 1.0);
    for floor in [0.0, 1.0] {
        let found = fit_parameters(&start, &data, &by(floor))?;
        let linear = Linear::new(&data, floor, murnaghan);
        check(&linear, &found, linear.squares(&linear.best(&DVector::zeros(5), &edge)));
        assert_eq!(found.ended, Ended::Edge);
        assert!(found.agreement.total > Some(0.8), "{found:?}");
        assert!(found.numbers.iter().all(|number| number.error.is_none()), "{found:?}");
        let unstable = |reason: &&TrialError| match reason {
            TrialError::Inadmissible(MaterialError::UnstableRest { moduli }) => moduli.bulk() < 0.0,
            _ => false,
        };
        assert!(edges(&found).len() == 1 && edges(&found).iter().all(unstable), "{found:?}");
    }
    Ok(())
}

#[test]
fn bounds_that_end_a_fit_are_named() -> Outcome {
    let data = treloar();
    for floor in [0.0, 1.0] {
        // The second runs into the corner of two bounds, one of which it can leave.
        for start in [of_numbers(BOUNDED, &[5e4, 2e4])?, of_numbers(BOUNDED, &[2e4, 9e4])?] {
            let found = fit_parameters(&start, &data, &by(floor))?;
            let edge = DMatrix::from_column_slice(2, 1, &[0.0, 1.0]);
            let corner = DVector::from_vec(vec![1e5, 0.0]);
            let linear = Linear::new(&data, floor, mooney);
            check(&linear, &found, linear.squares(&linear.best(&corner, &edge)));
            assert_eq!(conditions(&found), ["c1 <= 1e5"]);
            let text = text(&found);
            assert!(
                text.contains("`c1 <= 1e5` must hold, but c1 = 1") && text.contains("`admissible`"),
                "{text}"
            );
            assert!(!text.contains("other descents"), "all descents end there: {text}");
        }
    }
    Ok(())
}

#[test]
fn in_a_corner_both_bounds_are_named() -> Outcome {
    // Of a rubber with more of c1. In tension c1 gives more stress than c2 does, so that both bounds are in
    // its way.
    let (wanted, mut data) = (rubber("mooney_rivlin", &[1.5e5, 1e3, 1e8])?, treloar());
    data.points.retain(|point| point.mode == Mode::Uniaxial);
    for point in &mut data.points {
        point.stress = respond(&wanted.material, point.mode, Volume::Kept, point.control)?.stress;
    }
    let found = fit_parameters(&of_numbers(BOUNDED, &[5e4, 2e4])?, &data, &FitSettings::default())?;
    let mut bounds = conditions(&found);
    bounds.sort_unstable();
    assert_eq!(bounds, ["c1 + c2 <= 1.2e5", "c1 <= 1e5"]);
    for (value, corner) in found.values.concat().iter().zip([1e5, 2e4]) {
        assert!((value / corner - 1.0).abs() <= 1e-6, "{found:?}");
    }
    Ok(())
}

#[test]
fn curved_edges_are_followed() -> Outcome {
    let data = treloar();
    for start in [of_numbers(ROUND, &[5e4, 2e4])?, of_numbers(ROUND, &[2e4, 8e4])?] {
        let found = fit_parameters(&start, &data, &FitSettings::default())?;
        let linear = Linear::new(&data, 0.0, mooney);
        let on_circle = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            linear.squares(&DVector::from_vec(vec![1e5 * cosine, 1e5 * sine]))
        };
        let least = (0..100_000).map(|k| on_circle(1e-5 * f64::from(k))).fold(f64::INFINITY, f64::min);
        // The angle is at most half of 1e-5 off, and Σ r² by the square of that times its curvature, which is
        // some ten times itself; what a step along the edge could gain is as little.
        check(&linear, &found, least);
        assert_eq!(conditions(&found), ["c1.powi(2) + c2.powi(2) <= 1e10"]);
    }
    Ok(())
}

#[test]
fn points_that_lose_their_stress_are_an_edge_too() -> Outcome {
    // The last point would have I1 > a.
    let data = tension(&[(1.1, 2e4), (1.5, 1e5), (2.0, 1.2e5), (2.5, 1e5), (3.0, -5e4)]);
    let found = fit_parameters(&of_numbers(SOFTENING, &[1e4, 20.0])?, &data, &by(1.0))?;
    assert_eq!(found.ended, Ended::Edge);
    let Some(TrialError::Point(PointError { point, reason })) = edges(&found).first() else {
        panic!("{found:?}");
    };
    assert_eq!((point.control, *reason), (3.0, ResponseError::OutsideDomain));
    // I1 = λ² + 2/λ there.
    assert!((found.values[1][0] - (9.0 + 2.0 / 3.0)).abs() <= 1e-9, "{found:?}");
    Ok(())
}

#[test]
fn a_fit_worse_than_the_mean_says_so() -> Outcome {
    // No shear modulus pushes when it is pulled.
    let data = tension(&[(1.5, -1e5), (2.0, -2e5), (2.5, -2.2e5)]);
    let found = fit_parameters(&rubber("neo_hookean", &[1e5, 1e7])?, &data, &FitSettings::default())?;
    assert!(found.agreement.total < Some(0.0) && text(&found).contains("below 0"), "{found:?}");
    assert_eq!(conditions(&found), ["mu > 0"]);
    assert_eq!(found.warnings.len(), 3, "nothing about λ, poor, edge: {found:?}");
    Ok(())
}

#[test]
fn entries_of_lists_at_an_edge_go_by_their_names_among_the_numbers() -> Outcome {
    let found = fit_parameters(&candidate(POWERS, &[&[3e5], &[2.0]])?, &treloar(), &FitSettings::default())?;
    assert_eq!(conditions(&found), ["alpha[p] >= 1.5"]);
    let text = text(&found);
    assert!(
        text.contains("but alpha[0] = 1.4") && text.contains(" (alpha[0] is the number alpha_1); hold"),
        "{text}"
    );
    assert_eq!(found.numbers[1].name, "alpha_1");
    Ok(())
}
