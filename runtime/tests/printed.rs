//! Energies as papers print them: sums over the stretches, real powers of I1b − 3, functions with `extend`.

use piola::Inversion;
use piola::contract::{Settings, check};

/// Kilian's van der Waals rubber [Kil85], with roots of expressions that vanish at rest.
#[piola::material(domain(J > 0.0, (1.0 - beta) * I1b + beta * I2b - 3.0 < lm.powi(2) - 3.0), admissible(beta >= 0.0, beta <= 1.0, lm > 2.0))]
fn Kilian(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    g: f64,
    /** Dimensionless. */
    lm: f64,
    /** Dimensionless. */
    a: f64,
    /** Dimensionless. */
    beta: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    let i = (1.0 - beta) * I1b + beta * I2b - 3.0;
    let theta = (i / (lm.powi(2) - 3.0)).sqrt();
    g * (-(lm.powi(2) - 3.0) * ((1.0 - theta).ln() + theta) - 2.0 / 3.0 * a * (i / 2.0).powf(1.5))
        + kappa / 2.0 * ((J.powi(2) - 1.0) / 2.0 - J.ln())
}

/// Yamashita, Kawabata, *Approximated form of the strain energy-density function of carbon-black-filled
/// rubbers*, 1992.
#[piola::material(domain(J > 0.0), admissible(n > 0.0), fit)]
fn YamashitaKawabata(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    c1: f64,
    /** Pa. */
    c2: f64,
    /** Pa. */
    c3: f64,
    /** Dimensionless. */
    n: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    c1 * (I1b - 3) + c2 * (I2b - 3) + c3 / (n + 1) * (I1b - 3).powf(n + 1) + kappa / 2 * (J - 1).powi(2)
}

/// A spline of the volume with a continuation.
#[piola::material(domain(J > 0.0), extend)]
fn Volumetric(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Pa. */
    h: piola::Spline,
) -> f64 {
    mu * (sum(|l| l.powi(2) - 1.0) - 2.0 * J.ln()) + h(J)
}

/// Sums over the stretches and their pairs, and functions that are not powers.
#[piola::material(domain(J > 0.0))]
fn Sums(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Dimensionless. */
    b: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    let single = sum(|l| {
        let s = l / J.cbrt();
        (b * (s - 1.0)).cosh()
    });
    let double = sum(|p, q| (p * q / J.powf(2 / 3) - 1.0).powi(2));
    mu * (single / b.powi(2) + double) + mu * (b * (I1b - 3.0)).tanh() + kappa * ((J - 1.0) * b).softplus()
        - kappa * b / 2.0 * J.ln()
}

#[test]
fn energies_as_printed_keep_the_contract() {
    let settings = Settings::default();
    let kilian = Kilian::new(1e6, 10.0, 0.3, 0.2, 1e7).unwrap();
    check(&kilian, &settings).unwrap();
    let yamashita = YamashitaKawabata::new(2e5, 1e4, 1e4, 0.3, 1e7).unwrap();
    check(&yamashita, &settings).unwrap();
    let barrel = piola::Spline::through(&[[0.5, -2e6], [1.0, 0.0], [2.0, 1e6]]).unwrap();
    let volumetric = Volumetric::new(1e6, barrel).unwrap();
    check(&volumetric, &settings).unwrap();
    check(&volumetric.with_inversion(Inversion::Extend { epsilon: 0.1 }).unwrap(), &settings).unwrap();
    check(&Sums::new(1e6, 0.7, 1e7).unwrap(), &settings).unwrap();
}

/// Flory, Erman, *Theory of elasticity of polymer networks. 3*, 1982, as printed: 1 + B and 1 + D cancel on
/// flat elements.
#[piola::material(domain(J > 0.0), admissible(k > 0.0))]
fn FloryErman(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    c: f64,
    /** Dimensionless. */
    k: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    let constraint = sum(|l| {
        let s = (l / J.cbrt()).powi(2);
        let b = k.powi(2) * (s - 1.0) / (s + k).powi(2);
        let d = s * b / k;
        b + d - (1.0 + b).ln() - (1.0 + d).ln()
    });
    c / 2.0 * (I1b - 3.0 + constraint) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}

/// The same, multiplied out by hand: no term of the logarithms is negative.
#[piola::material(domain(J > 0.0), admissible(k > 0.0))]
fn FloryErmanByHand(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    c: f64,
    /** Dimensionless. */
    k: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    let constraint = sum(|l| {
        let s = (l / J.cbrt()).powi(2);
        let b = s * (s + 2.0 * k + k.powi(2));
        let d = (1.0 + k) * s.powi(2) + k * s + k.powi(2);
        k * (s - 1.0) / (s + k) - b.ln() - d.ln() + 4.0 * (s + k).ln()
    });
    c / 2.0 * (I1b - 3.0 + constraint) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}

/// Digits that a root loses, which no fraction helps.
#[piola::material(domain(J > 0.0), admissible(k > 0.0), prestressed)]
fn Lossy(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    mu: f64,
    /** Dimensionless. */
    k: f64,
) -> f64 {
    mu * (I1 - sum(|l| ((l.powi(2) + k.powi(2)).sqrt() - k).ln()) - 2.0 * J.ln())
}

/// Kilian's rubber in I1b alone, with the domain that a message offers for it.
#[piola::material(domain(J > 0.0, 1.0 - ((I1b - 3.0) / (lm.powi(2) - 3.0)).sqrt() > 0.0), admissible(lm > 2.0))]
fn VanDerWaals(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    g: f64,
    /** Dimensionless. */
    lm: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    let theta = ((I1b - 3.0) / (lm.powi(2) - 3.0)).sqrt();
    g * (3.0 - lm.powi(2)) * ((1.0 - theta).ln() + theta) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// An energy by invariants that ends at a real power of I1b − 3 and I2b − 3.
#[piola::material(domain(J > 0.0, (I1b - 3.0 + b * (I2b - 3.0)).powf(0.7) < b), admissible(b > 0.0))]
fn Ending([l1, l2, l3]: [f64; 3], b: f64) -> f64 {
    I1b + b * (J - 1.0).powi(2)
}

#[test]
fn a_domain_with_a_root_of_the_excess_contains_rest_dilations_and_rotations()
-> Result<(), Box<dyn std::error::Error>> {
    use piola::Material;
    let (root, power) = (VanDerWaals::new(1e5, 2.1, 1e6)?, Ending::new(0.5)?);
    check(&root, &Settings::default())?;
    check(&power, &Settings::default())?;
    for k in 0..1000 {
        let a = 0.5 + 1.5 * f64::from(k) / 999.0;
        assert!(root.admits([a; 3]) && power.admits([a; 3]), "{a}");
        assert!(root.admits([a as f32; 3]) && power.admits([a as f32; 3]), "{a}");
        let diagonal = [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
        let [[s, c], [t, d]] = [f64::from(k), 1.7 * a].map(|angle| [angle.sin(), angle.cos()]);
        let rotation = [[c, -s, 0.0], [s * d, c * d, -t], [s * t, c * t, d]];
        for f in [diagonal, rotation] {
            for point in [piola::point::evaluate_stress(&root, &f), piola::point::evaluate_stress(&power, &f)]
            {
                let status = point.status;
                assert!(status.is_clean(), "{f:?}: {status:?}");
            }
        }
    }
    // I1b − 3 is 1.41 where the root is 1, at lm² − 3.
    assert!(root.admits([1.8f64, 0.745, 0.745]) && !root.admits([1.9f64, 0.725, 0.725]));
    assert!(!Ending::<f64>::HAS_INVARIANTS && !power.admits([1.5f64, 0.8, 0.8]));
    Ok(())
}

/// Gregory's carbon-filled rubber, 1979: a small constant keeps the base of the power from vanishing at rest.
#[piola::material(domain(J > 0.0), admissible(n > 0.0), fit)]
fn Gregory(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    a: f64,
    /** Dimensionless. */
    n: f64,
    /** Dimensionless. */
    c: f64,
    /** Pa. */
    kappa: f64,
) -> f64 {
    a * (I1b - 3.0 + c.powi(2)).powf(n) + kappa / 2.0 * (J - 1.0).powi(2)
}

#[test]
fn a_small_constant_beside_the_excess_keeps_its_digits() -> Result<(), Box<dyn std::error::Error>> {
    use piola::Material;
    use piola::material::Declared;
    assert!(Gregory::DESCRIPTION.formula.contains("(I1 J^(−2/3) + c² − 3)^n"));
    check(&Gregory::new(1e5, 0.4, 1e-2, 1e6)?, &Settings::default())?;
    for (n, c) in [(0.4f64, 1e-1f64), (0.4, 1e-3), (1.7, 1e-2), (0.5, 1e-4)] {
        // The slope of the power, and so little resistance to changes of volume that nothing cancels.
        let slope = n * (c * c).powf(n - 1.0);
        let kappa = 1e-3 * slope;
        let solid = Gregory::new(1.0, n, c, kappa)?;
        for k in 0..1000 {
            let l = 0.5 + 1.5 * f64::from(k) / 999.0;
            let blocks = solid.blocks([l; 3]);
            // D⁻12 of I1b at a dilation is 4/λ².
            let expected = 4.0 * slope / (l * l) - kappa * (l.powi(3) - 1.0) * l;
            for flip in blocks.flip {
                let error = (flip / expected - 1.0).abs() / (f64::EPSILON / 2.0);
                assert!(error <= 30.0, "{flip} for {expected} at {l}, n = {n}, C = {c}: {error} u");
            }
        }
    }
    Ok(())
}

#[test]
fn fractions_that_cancel_on_flat_elements_keep_their_digits() -> Result<(), Box<dyn std::error::Error>> {
    use piola::Material;
    let (printed, by_hand) = (FloryErman::new(4e5, 2.59, 2e7)?, FloryErmanByHand::new(4e5, 2.59, 2e7)?);
    check(&printed, &Settings::default())?;
    for k in 1..=12 {
        let flat = 10f64.powi(-k);
        for stretches in [[1.3, 0.9, flat], [1.2, flat, 0.7 * flat], [3.0 / flat, 1.0, 0.9]] {
            let [found, expected] = [printed.blocks(stretches), by_hand.blocks(stretches)];
            let rows = |b: piola::material::Blocks<f64>| {
                [&b.gradient[..], &[&b.hessian[..], &b.flip, &b.twist].concat()].map(<[f64]>::to_vec)
            };
            for (found, expected) in rows(found).into_iter().zip(rows(expected)) {
                let largest = expected.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    let error = (found - expected).abs() / (largest * f64::EPSILON / 2.0);
                    // Either formula errs by a few u; 5.2 u have been seen.
                    assert!(error <= 16.0, "{found} for {expected} at {stretches:?}: {error} u");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn digits_that_a_formula_loses_break_the_contract() -> Result<(), Box<dyn std::error::Error>> {
    let violations =
        check(&Lossy::new(1e5, 1.0)?, &Settings::default()).expect_err("lost digits went unnoticed");
    let text = violations.to_string();
    assert!(text.contains("single_precision") && text.contains("**Digits**"), "{text}");
    Ok(())
}
