//! Energies as papers print them: sums over the stretches, real powers of I1b − 3, functions beside `extend`.

use piola::Inversion;
use piola::contract::{Settings, check};

/// Kilian's van der Waals rubber [Kil85], whose roots are of what vanishes at rest.
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

/// Yamashita, Kawabata, *Approximated form of the strain energy-density function of carbon-black-filled rubbers*, 1992.
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

/// A spline of the volume beside a continuation.
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

/// Sums over the stretches and their pairs, and functions that are no powers.
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
