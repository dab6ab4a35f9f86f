//! Fits whose answer is known.

use piola_laboratory::curve::{Mode, Volume};
use piola_laboratory::data::{Measured, Measurements};
use piola_laboratory::fit::{Candidate, Ended, Fit, FitSettings, Standing, Warning, fit_parameters};

use super::{Linear, Outcome, by, candidate, catalogue, of_numbers, rubber, tension, text, told, treloar};

/// Rubber after Gao 1997, of a compressible solid: I2/J² is tr C⁻¹.
const GAO: &str = "
#[material(domain(J > 0.0))]
fn Gao([l1, l2, l3]: [f64; 3], a: f64, n: f64) -> f64 {
    a * (I1.powf(n) + (I2 / J.powi(2)).powf(n))
}";

/// Rivlin's series of terms that are found at run time.
const RIVLIN: &str = "
#[material(domain(J > 0.0))]
fn Rivlin([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, j: Vec<u32>, K: f64) -> f64 {
    sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p])) + K / 2.0 * (J - 1.0).powi(2)
}";

/// What a material answers in these tests, as if measured.
fn synthetic(material: &Candidate, volume: Volume, modes: &[Mode]) -> Measurements {
    super::synthetic(material, volume, modes, &[0.7, 0.85, 1.1, 1.3, 1.6, 2.0, 2.5])
}

/// With a free volume.
fn free() -> FitSettings {
    FitSettings { volume: Volume::Free, ..FitSettings::default() }
}

/// From `start` to the parameters of `wanted`, which answer the data exactly.
#[track_caller]
fn recovers(wanted: &Candidate, start: &Candidate, modes: &[Mode]) {
    let data = synthetic(wanted, Volume::Free, modes);
    let settings = FitSettings { restarts: 4, ..free() };
    let name = &wanted.energy.description().name;
    let found = fit_parameters(start, &data, &settings).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(found.difference <= 1e-9, "{name}: {found:?}");
    assert!(found.numbers.iter().all(|number| number.standing == Standing::Free), "{name}: {found:?}");
    for (value, wanted) in found.values.concat().iter().zip(wanted.energy.values(&wanted.material).concat()) {
        // The differences are down to a billionth; the parameters by the condition of the problem less.
        let tolerance = 1e-9 * found.condition * wanted.abs();
        assert!((value - wanted).abs() <= tolerance, "{name}: {value} for {wanted} in {found:?}");
    }
}

#[test]
fn whole_exponents_are_held() -> Outcome {
    let rivlin = |c: [f64; 3], bulk| candidate(RIVLIN, &[&c, &[1.0, 0.0, 2.0], &[0.0, 1.0, 0.0], &[bulk]]);
    let (wanted, start) = (rivlin([2e5, 3e4, 1e3], 2e6)?, rivlin([1e5, 1e4, 1e2], 1e6)?);
    let data = synthetic(&wanted, Volume::Free, &[Mode::Uniaxial, Mode::Equibiaxial]);
    let settings = FitSettings { restarts: 2, ..free() };
    let found = fit_parameters(&start, &data, &settings)?;
    assert!(found.difference <= 1e-9, "{found:?}");
    let standings: Vec<_> = found.numbers.iter().map(|number| number.standing).collect();
    let (free, held) = (Standing::Free, Standing::Held);
    assert_eq!(standings, [free, free, free, held, held, held, held, held, held, free]);
    assert_eq!(found.values[1..3], [[1.0, 0.0, 2.0], [0.0, 1.0, 0.0]]);
    Ok(())
}

#[test]
fn parameters_are_recovered_from_what_they_make() -> Outcome {
    use Mode::{Equibiaxial, SimpleShear, Uniaxial, Volumetric};
    recovers(&rubber("neo_hookean", &[1e6, 5e6])?, &rubber("neo_hookean", &[3e5, 1e6])?, &[Uniaxial]);
    recovers(
        &rubber("neo_hookean", &[1e6, 5e6])?,
        &rubber("neo_hookean", &[3e6, 1e8])?,
        &[SimpleShear, Volumetric],
    );
    recovers(
        &rubber("gent", &[3e5, 30.0, 2e6])?,
        &rubber("gent", &[1e5, 100.0, 1e6])?,
        &[Uniaxial, Equibiaxial],
    );
    recovers(
        &rubber("yeoh", &[2e5, -2e3, 50.0, 2e7])?,
        &rubber("yeoh", &[1e5, 1e3, 10.0, 1e7])?,
        &[Uniaxial, Equibiaxial],
    );
    let (storakers, start) = (
        candidate(catalogue("storakers"), &[&[1e5, 2e4], &[2.0, 6.0], &[0.5, 0.5]])?,
        candidate(catalogue("storakers"), &[&[5e4, 1e4], &[1.5, 4.0], &[0.3, 0.3]])?,
    );
    recovers(&storakers, &start, &[Uniaxial, Equibiaxial]);
    let (ogden, start) = (
        candidate(catalogue("ogden"), &[&[6e5, -2e4], &[1.5, -2.5], &[2e6]])?,
        candidate(catalogue("ogden"), &[&[4e5, -4e4], &[1.8, -2.0], &[1e6]])?,
    );
    recovers(&ogden, &start, &[Uniaxial, Equibiaxial]);
    Ok(())
}

/// Valanis and Landel's energy with a curve for the stretches.
const DRAWN: &str = "
#[material]
fn Drawn([l1, l2, l3]: [f64; 3], f: Spline, kappa: f64) -> f64 {
    f(l1) + f(l2) + f(l3) + kappa / 2.0 * (J - 1.0).powi(2)
}";

#[test]
fn ordinates_of_a_curve_are_recovered_from_what_they_make() -> Outcome {
    let drawn = |[a, b, c, d]: [f64; 4], kappa: f64| {
        candidate(DRAWN, &[&[0.3, a, 0.7, b, 1.0, 0.0, 1.7, c, 2.6, d], &[kappa]])
    };
    let wanted = drawn([-9e5, -3e5, 4e5, 1.2e6], 2e6)?;
    let start = drawn([-6e5, -2e5, 3e5, 6e5], 1e6)?;
    recovers(&wanted, &start, &[Mode::Uniaxial, Mode::Equibiaxial]);

    let data = synthetic(&wanted, Volume::Free, &[Mode::Uniaxial, Mode::Equibiaxial]);
    let holding = |name: &str| FitSettings { held: vec![name.into()], restarts: 0, ..free() };
    let found = fit_parameters(&start, &data, &holding("f_2"))?;
    let names: Vec<_> = found.numbers.iter().map(|number| number.name.as_str()).collect();
    assert_eq!(names, ["f_1", "f_2", "f_3", "f_4", "kappa"]);
    assert_eq!((found.numbers[1].standing, found.numbers[1].value), (Standing::Held, -2e5));
    assert!(found.difference > 1e-3, "{found:?}");
    // The curve as a whole.
    let found = fit_parameters(&start, &data, &holding("f"))?;
    assert!(found.numbers[..4].iter().all(|number| number.standing == Standing::Held), "{found:?}");
    assert_eq!(found.values[0], start.energy.values(&start.material)[0]);
    Ok(())
}

#[test]
fn what_is_linear_has_the_closed_form() -> Outcome {
    let data = treloar();
    // ∂ψ/∂λi of μ/2 I1.
    let neo_hookean = |stretches: [f64; 3]| stretches.map(|stretch| [stretch]);
    let (expected, errors) = Linear::new(&data, 0.0, neo_hookean).best_of_all();
    let found = fit_parameters(&rubber("neo_hookean", &[1e6, 1e8])?, &data, &FitSettings::default())?;
    assert_eq!(found.numbers[1].standing, Standing::Unidentifiable, "λ at constant volume");
    assert_eq!(found.warnings, [Warning::Unidentifiable { parameter: "lambda".into() }]);
    let mu = &found.numbers[0];
    // Both solve a system of condition 1 in about 50 points.
    assert!((mu.value / expected[0] - 1.0).abs() <= 100.0 * f64::EPSILON, "{mu:?}, {expected}");
    // λ, which changes nothing, rounds to u λ/μ of the stress.
    assert!((mu.error.unwrap_or(f64::NAN) / errors[0] - 1.0).abs() <= 1e-10, "{mu:?}, {errors}");

    // ∂ψ/∂λi of (I1 − 3)ᵏ.
    let yeoh = |stretches: [f64; 3]| {
        let above_rest = stretches.iter().map(|stretch| stretch * stretch).sum::<f64>() - 3.0;
        stretches.map(|stretch| [1, 2, 3].map(|k| f64::from(k) * above_rest.powi(k - 1) * 2.0 * stretch))
    };
    let (expected, errors) = Linear::new(&data, 0.0, yeoh).best_of_all();
    let found = fit_parameters(&rubber("yeoh", &[1e5, -1e3, 10.0, 2e7])?, &data, &FitSettings::default())?;
    for (term, number) in found.numbers[..3].iter().enumerate() {
        // The condition of the normal equations is the square of that of the system.
        let tolerance = 10.0 * found.condition.powi(2) * f64::EPSILON;
        assert!((number.value / expected[term] - 1.0).abs() <= tolerance, "{number:?}, {expected}");
        assert!(
            (number.error.unwrap_or(f64::NAN) / errors[term] - 1.0).abs() <= 1e-6,
            "{number:?}, {errors}"
        );
    }
    Ok(())
}

#[test]
fn three_terms_follow_treloar_more_closely_than_ogdens_own() -> Outcome {
    let ogdens = candidate(catalogue("ogden"), &[&[0.63e6, 0.0012e6, -0.01e6], &[1.3, 5.0, -2.0], &[2e7]])?;
    let (data, settings) = (treloar(), by(1.0));
    let before = data.agreement(&ogdens.material, Volume::Kept)?;
    let found = fit_parameters(&ogdens, &data, &settings)?;
    assert!(found.agreement.total > before.total, "{found:?}");
    assert_ne!(found.ended, Ended::Unfinished);
    assert!(found.agreement.modes.iter().all(|(_, determination)| *determination > Some(0.995)), "{found:?}");
    // Nothing about κ, little about some combination of the six others.
    assert_eq!(found.warnings[0], Warning::Unidentifiable { parameter: "kappa".into() });
    assert!(found.warnings.iter().any(|warning| matches!(warning, Warning::Collinear { .. })), "{found:?}");
    assert_eq!(fit_parameters(&ogdens, &data, &settings)?, found, "the same seed, the same fit");
    Ok(())
}

#[test]
fn pure_shear_cannot_tell_the_invariants_apart() -> Outcome {
    // There I1 = I2 = λ² + 1 + λ⁻²: only c1 + c2 matters.
    let truth = rubber("mooney_rivlin", &[2e5, 1e5, 2e7])?;
    let data = synthetic(&truth, Volume::Kept, &[Mode::PureShear]);
    let found = fit_parameters(&rubber("mooney_rivlin", &[1e5, 1e5, 2e7])?, &data, &FitSettings::default())?;
    let sum = found.numbers[0].value + found.numbers[1].value;
    assert!((sum - 3e5).abs() <= 1e-3, "{found:?}");
    let dependent = told(&found, |warning| match warning {
        Warning::Collinear { changes, effect } => Some((changes, effect)),
        _ => None,
    });
    let (changes, effect) = dependent[0];
    assert_eq!(changes.len(), 2, "{changes:?}");
    // One grows by as much as the other shrinks.
    let total = changes[0].1 * found.numbers[0].value + changes[1].1 * found.numbers[1].value;
    assert!(total.abs() <= 1e-6 * 3e5 && *effect <= 1e-9, "{found:?}");
    let text = text(&found);
    assert!(text.contains("they change the fit by less than 0.0001 %; hold one of them"), "{text}");
    assert!(text.contains("of up to 0.000 %, compared with 0.000 % of this one, at c10 from "), "{text}");
    Ok(())
}

#[test]
fn what_small_strains_say_little_about_is_named() -> Outcome {
    // There the stresses of c10 and c01 differ by a factor of λ only, and c01 is small.
    let truth = rubber("mooney_rivlin", &[2e5, 10.0, 2e7])?;
    let data = super::synthetic(&truth, Volume::Kept, &[Mode::Uniaxial], &[0.99, 1.01, 1.02, 1.03]);
    let found = fit_parameters(&truth, &data, &FitSettings { restarts: 0, ..FitSettings::default() })?;
    let text = text(&found);
    assert_eq!(text.matches("hardly determine").count(), 1, "{text}");
    assert!(text.contains("hardly determine c01: a change by 1 % changes the fit by"), "{text}");
    assert!(text.contains("hold it (`--hold c01`"), "{text}");
    Ok(())
}

#[test]
fn trials_beyond_the_limit_of_chains_are_refused_not_fatal() -> Outcome {
    // Treloar's longest chains need jm > 55; on the way from 1000 steps would overshoot it.
    let found = fit_parameters(&rubber("gent", &[1e5, 1000.0, 2e7])?, &treloar(), &FitSettings::default())?;
    // What the catalogue's typical parameters are rounded from.
    assert!(
        (found.values[0][0] / 3.3e5 - 1.0).abs() < 0.02 && (found.values[1][0] / 108.0 - 1.0).abs() < 0.01,
        "{found:?}"
    );
    Ok(())
}

/// Poisson's ratio of a fit at kept volume that is told to be of another solid.
fn compressible(fit: &Fit) -> Option<f64> {
    let poisson = told(fit, |warning| match warning {
        Warning::Compressible { poisson, .. } => Some(*poisson),
        _ => None,
    });
    poisson.first().copied()
}

#[test]
fn a_solid_that_gives_way_is_not_fitted_at_kept_volume_unsaid() -> Outcome {
    let start = of_numbers(GAO, &[1e4, 1.2])?;
    let kept = fit_parameters(&start, &treloar(), &FitSettings::default())?;
    // λ = 8 A n (n − 1) 3ⁿ⁻² and μ = 4 A n 3ⁿ⁻¹.
    let n = kept.values[1][0];
    let poisson = compressible(&kept).expect("a warning");
    assert!((poisson - (n - 1.0) / (2.0 * n + 1.0)).abs() <= 1e-14 && poisson < 0.0, "{kept:?}");
    assert!(text(&kept).contains("`--compressible`, `FitSettings::volume`"), "{kept:?}");
    let free = fit_parameters(&start, &treloar(), &free())?;
    assert_eq!(compressible(&free), None, "{free:?}");
    assert!(
        free.agreement.total > Some(0.8) && kept.agreement.total.is_some_and(|total| total < 0.0),
        "{free:?}, {kept:?}"
    );
    // Simple shear keeps the volume of any solid.
    let sheared = synthetic(&start, Volume::Kept, &[Mode::SimpleShear]);
    assert_eq!(compressible(&fit_parameters(&start, &sheared, &FitSettings::default())?), None);
    Ok(())
}

/// Twenty draws for each start, and one more start, would be beyond usize.
#[test]
fn starts_and_points_beyond_all_bounds_and_fits_of_nothing_are_refused() -> Outcome {
    let rubber = rubber("neo_hookean", &[1e5, 5e6])?;
    let data = treloar();
    for restarts in [10_001, usize::MAX / 20 + 1, usize::MAX] {
        let error = fit_parameters(&rubber, &data, &FitSettings { restarts, ..FitSettings::default() });
        let error = error.expect_err("too many").to_string();
        assert_eq!(error, format!("the number of random starts is {restarts}; it must be at most 10000"));
    }
    let held = FitSettings { held: vec!["mu".into()], ..FitSettings::default() };
    for (data, settings, words) in [
        (&data, held, "hold fewer"),
        (&tension(&[(2.0, 0.0)]), FitSettings::default(), "no point with a stress"),
    ] {
        let error = fit_parameters(&rubber, data, &settings).expect_err("nothing to fit").to_string();
        assert!(error.contains(words), "{error}");
    }
    for (control, stress) in [(2.0, f64::NAN), (2.0, 1e300), (f64::INFINITY, 1e5), (1e-9, 1e5), (-1.0, 1e5)] {
        let mut wild = data.clone();
        wild.points[3] = Measured { mode: Mode::Uniaxial, control, stress };
        let error = fit_parameters(&rubber, &wild, &FitSettings::default()).expect_err("no measurement");
        assert!(error.to_string().starts_with("the point 3 (from 0) cannot be fitted: "), "{error}");
    }
    Ok(())
}
