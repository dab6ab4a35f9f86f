//! Test curves against closed forms and against the energy itself.

use piola::interpreter::Interpreted;
use piola::material::Moduli;
use piola::{Inversion, Material};
use piola_declare::Energy;
use piola_laboratory::chart::{Curve, draw};
use piola_laboratory::curve::{Mode, Response, ResponseError, Volume, respond};
use piola_laboratory::data::Measurements;
use piola_materials::{DECLARATIONS, Gent, NeoHookean, Ogden, RotatedLinear};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const TENSIONS: [Mode; 3] = [Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear];

#[test]
fn blatz_and_kos_foam_has_closed_forms() -> Outcome {
    // [BK62]: with f = 0 and ν = 1/4 the sides are free where J = t⁻², and P = μ (J − λ⁻²)/λ.
    let foam = DECLARATIONS.iter().find(|declaration| declaration.name == "blatz_ko");
    let foam = Energy::from_rust(foam.ok_or("no foam")?.source)?;
    let foam = foam.material(&[&[2.2e5], &[0.0], &[0.5]], Inversion::Refuse)?;
    for (mode, power) in TENSIONS.into_iter().zip([-0.25, -2.0 / 3.0, -1.0 / 3.0]) {
        for stretch in [0.2, 0.7, 1.0 + 1e-9, 1.3, 4.0_f64] {
            let response = respond(&foam, mode, Volume::Free, stretch)?;
            let side = stretch.powf(power);
            let expected = 2.2e5 * (side.powi(-2) - stretch.powi(-2)) / stretch;
            // A dozen roundings of the two terms, of which the closed form cancels near rest.
            let scale = 2.2e5 * (side.powi(-2) + stretch.powi(-2)) / stretch;
            let error =
                (response.stress - expected).abs().max(scale * (response.stretches[2] / side - 1.0).abs());
            assert!(
                error <= 12.0 * f64::EPSILON * scale,
                "{mode} {stretch}: {response:?}, expected {expected}"
            );
        }
    }
    Ok(())
}

#[test]
fn linear_elasticity_has_poissons_contraction_at_any_strain() -> Outcome {
    // Without rotations linear elasticity is exact: P = E s and t = 1 − ν s; through plane strain E/(1 − ν²),
    // ν/(1 − ν).
    let Moduli { mu, lambda } = Moduli::from_young_poisson(1e6, 0.3)?;
    let linear = RotatedLinear::new(mu, lambda)?;
    for strain in [-0.3, 1e-20, 1e-9, 0.2] {
        let stretch = 1.0 + strain;
        let strain = stretch - 1.0;
        let expected = [(1e6, 0.3), (1e6 / 0.7, 0.6 / 0.7), (1e6 / 0.91, 0.3 / 0.7)]
            .map(|(e, nu)| [e * strain, -nu * strain]);
        for (mode, [stress, side]) in TENSIONS.into_iter().zip(expected) {
            let response = respond(&linear, mode, Volume::Free, stretch)?;
            // Relative to the strain, however small; the side is 1 plus its strain, rounded.
            assert!(
                (response.stress - stress).abs() <= 16.0 * f64::EPSILON * stress.abs(),
                "{response:?} {stress}"
            );
            assert!((response.stretches[2] - (1.0 + side)).abs() <= f64::EPSILON, "{response:?} {side}");
        }
    }
    Ok(())
}

#[test]
fn incompressible_solids_follow_the_textbook() -> Outcome {
    // Neo-Hookean, P = μ (λ − λ⁻²), μ (λ − λ⁻⁵), μ (λ − λ⁻³) [Ogd84, section 7.2]; as a limit where the
    // volume is free.
    for stretch in [0.3, 0.9, 1.5, 7.0_f64] {
        for (mode, power) in TENSIONS.into_iter().zip([-2, -5, -3]) {
            let expected = stretch - stretch.powi(power);
            // The bulk modulus does not enter, but its rounding does.
            let kept = respond(&NeoHookean::new(1.0, 10.0)?, mode, Volume::Kept, stretch)?;
            let scale = stretch + stretch.powi(power);
            assert!(
                (kept.stress - expected).abs() <= 60.0 * f64::EPSILON * scale,
                "{mode}: {kept:?}, {expected}"
            );
            // ψ3 = 0 is ln J = μ (1 − t²)/λ, and leaves ψ1 = μ (λ − t²/λ). The pressure rounds to u of the
            // bulk modulus. A stretch is 1 plus a strain, which rounds to u.
            let free = respond(&NeoHookean::new(1.0, 1e6)?, mode, Volume::Free, stretch)?;
            let side_squared = free.stretches[2].powi(2);
            let logarithm = (1.0 - side_squared) * 1e-6;
            let rounding = 8.0 * f64::EPSILON / free.stretches[2].min(stretch);
            assert!((free.volume().ln() - logarithm).abs() <= rounding, "{mode}: {free:?}");
            let expected = stretch - side_squared / stretch;
            assert!(
                (free.stress - expected).abs() <= 8e6 * f64::EPSILON / stretch,
                "{mode}: {free:?}, {expected}"
            );
        }
        // P12 = μ γ
        let shear = respond(&NeoHookean::new(1.0, 10.0)?, Mode::SimpleShear, Volume::Free, -stretch)?;
        assert!(
            (shear.stress + stretch).abs() <= 8.0 * f64::EPSILON * stretch * (1.0 + stretch),
            "{shear:?}"
        );
    }
    Ok(())
}

/// Stress against the slope of the energy along the curve, for any material: no side does work.
fn count_conjugate(name: &str, material: &Interpreted) -> usize {
    let energy = |mode, volume, control| {
        let response = respond(material, mode, volume, control).ok()?;
        let mut stretches = response.stretches;
        stretches.sort_by(|a, b| b.total_cmp(a));
        Some(Material::energy(material, stretches))
    };
    let mut compared = 0;
    for volume in [Volume::Free, Volume::Kept] {
        for mode in Mode::ALL {
            for control in [0.6, 0.85, 1.15, 1.6] {
                const STEP: f64 = 1e-3;
                let Ok(middle) = respond(material, mode, volume, control) else { continue };
                let slope = |step: f64| {
                    let before = energy(mode, volume, control - step)?;
                    let after = energy(mode, volume, control + step)?;
                    Some(((after - before) / (2.0 * step), before.abs() + after.abs()))
                };
                let (Some((rough, _)), Some((slope, energy))) = (slope(STEP), slope(0.5 * STEP)) else {
                    continue;
                };
                let works_on = if mode == Mode::Equibiaxial { 2.0 } else { 1.0 };
                // What is left of h² is a third of the change that halving the step makes; the energy
                // rounds to u of the moduli and of itself.
                let moduli = Moduli::of(material);
                let scale = energy + moduli.mu + moduli.lambda.abs();
                let tolerance = 0.5 * (slope - rough).abs() + 40.0 * f64::EPSILON * scale / STEP;
                assert!(
                    (works_on * middle.stress - slope).abs() <= tolerance,
                    "{} {mode} {volume:?} {control}: {middle:?}, slope {slope}",
                    name
                );
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn stresses_are_slopes_of_the_energy() -> Outcome {
    for declaration in DECLARATIONS {
        let energy = Energy::from_rust(declaration.source)?;
        let compared =
            count_conjugate(declaration.name, &energy.material(&energy.typical(), Inversion::Refuse)?);
        // Not where a solid has no equilibrium or locks: 2 volumes × 5 modes × 4 points, less the volumetric
        // test at constant volume. The stress of Murnaghan's plastic falls from a strain of some 6 % on.
        let enough = if declaration.name == "murnaghan" { 20 } else { 30 };
        assert!(compared >= enough, "{}: only {compared} points of 36", declaration.name);
    }
    Ok(())
}

#[test]
fn weights_are_the_derivative_by_what_the_energy_depends_on() -> Outcome {
    let at = |kappa: f64, mode, volume| {
        respond(&Ogden::new([6e5, -1e5], [1.3, -2.0], kappa)?, mode, volume, 1.7)
            .map_err(Box::<dyn std::error::Error>::from)
    };
    for mode in TENSIONS {
        let response = at(2e6, mode, Volume::Free)?;
        // ψi by κ is (J − 1) J/λi.
        let volume = response.volume();
        let by_kappa: f64 =
            (0..3).map(|k| response.weights[k] * (volume - 1.0) * volume / response.stretches[k]).sum();
        let step = 20.0;
        let slope = (at(2e6 + step, mode, Volume::Free)?.stress - at(2e6 - step, mode, Volume::Free)?.stress)
            / (2.0 * step);
        // h²/6 of a curvature by κ of about 1/κ², and u P/h.
        assert!((by_kappa - slope).abs() <= 1e-10 + 1e-15 * response.stress, "{mode}: {by_kappa} {slope}");
        let kept = at(2e6, mode, Volume::Kept)?.stress - at(4e6, mode, Volume::Kept)?.stress;
        assert!(kept.abs() <= 1e-9, "{mode}: {kept}");
    }
    Ok(())
}

#[test]
fn points_that_do_not_exist_are_said_to() -> Outcome {
    let rubber = NeoHookean::new(1.0, 5.0)?;
    for (mode, control) in [(Mode::Uniaxial, 0.0), (Mode::Volumetric, -1.0), (Mode::SimpleShear, f64::NAN)] {
        let error = respond(&rubber, mode, Volume::Free, control).expect_err("no place for a specimen");
        assert!(matches!(error, ResponseError::Control { .. }), "{error}");
    }
    assert_eq!(respond(&rubber, Mode::Volumetric, Volume::Kept, 1.1), Err(ResponseError::VolumeKept));
    let locking = Gent::new(1.0, 5.0, 100.0)?;
    assert_eq!(respond(&locking, Mode::Uniaxial, Volume::Kept, 3.0), Err(ResponseError::OutsideDomain));
    assert_eq!(respond(&locking, Mode::Uniaxial, Volume::Free, 3.0), Err(ResponseError::NoEquilibrium));
    Ok(())
}

/// R² would divide by zero, or by the rounding of a mean.
#[test]
fn equal_stresses_have_no_determination() -> Outcome {
    let rubber = NeoHookean::new(1e6, 5e6)?;
    let read = |rows: &str| Measurements::read(&format!("mode,stretch,nominal_stress_kPa\n{rows}"));
    for rows in ["uniaxial,2,1\n", "uniaxial,2,0.1\nuniaxial,3,0.1\nuniaxial,4,0.1\n"] {
        let agreement = read(rows)?.agreement(&rubber, Volume::Kept)?;
        assert_eq!((agreement.modes[0].1, agreement.total), (None, None));
        assert_eq!(
            agreement.to_string(),
            "uniaxial undefined (equal stresses), all undefined (equal stresses)"
        );
    }
    let agreement = read("uniaxial,2,1e-80\nequibiaxial,2,1e-70\n")?.agreement(&rubber, Volume::Kept)?;
    assert_eq!(agreement.modes.iter().map(|(_, alone)| *alone).collect::<Vec<_>>(), [None; 2]);
    assert!(agreement.total.is_some_and(|total| total < -1e100), "{agreement}");
    assert!(agreement.to_string().len() < 120, "{agreement}");
    Ok(())
}

/// Numbers too large for an axis, or too close for its ticks.
#[test]
fn charts_are_drawn_or_refused_and_never_without_end() -> Outcome {
    let curve = |points: &[(f64, f64)]| {
        let point = |&(control, stress): &(f64, f64)| {
            Ok(Response { control, stretches: [1.0; 3], stress, weights: [1.0, 0.0, 0.0] })
        };
        Curve { mode: Mode::Uniaxial, points: points.iter().map(point).collect() }
    };
    let drawn = |points: &[(f64, f64)]| draw("title", "note", &[curve(points)], None);
    for points in [
        [(1.0, 0.0), (2.0, 0.0)],
        [(1.0, 0.0), (1.0, 0.0)],
        [(1e15, 1e15), (1e15 + 1.0, 1e15 + 1.0)],
        [(0.0, 5e-324), (1e-300, 1e-300)],
        [(-1e100, -1e100), (1e100, 1e100)],
    ] {
        assert!(drawn(&points)?.contains("</svg>"), "{points:?}");
    }
    for wild in [1e101, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        for points in [[(1.0, 0.0), (2.0, wild)], [(wild, 0.0), (2.0, 1.0)]] {
            let error = drawn(&points).expect_err("beyond all axes").to_string();
            assert!(error.starts_with("an axis of the chart would have to be from "), "{points:?}: {error}");
        }
    }
    Ok(())
}
