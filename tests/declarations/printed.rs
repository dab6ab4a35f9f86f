//! Energies as papers print them: sums over the stretches, real powers of I1b − 3, functions with `extend`.

/// Kilian's van der Waals rubber [Kil85], with roots of expressions that vanish at rest.
//@ values 1e6, 10, 0.3, 0.2, 1e7
//@ points 64
#[material(domain(J > 0.0, (1.0 - beta) * I1b + beta * I2b - 3.0 < lm.powi(2) - 3.0), admissible(beta >= 0.0, beta <= 1.0, lm > 2.0))]
fn Kilian([l1, l2, l3]: [f64; 3], g: f64, lm: f64, a: f64, beta: f64, kappa: f64) -> f64 {
    let i = (1.0 - beta) * I1b + beta * I2b - 3.0;
    let theta = (i / (lm.powi(2) - 3.0)).sqrt();
    g * (-(lm.powi(2) - 3.0) * ((1.0 - theta).ln() + theta) - 2.0 / 3.0 * a * (i / 2.0).powf(1.5))
        + kappa / 2.0 * ((J.powi(2) - 1.0) / 2.0 - J.ln())
}

/// Yamashita, Kawabata, *Approximated form of the strain energy-density function of carbon-black-filled
/// rubbers*, 1992.
//@ values 2e5, 1e4, 1e4, 0.3, 1e7
//@ points 64
#[material(domain(J > 0.0), admissible(n > 0.0))]
fn YamashitaKawabata([l1, l2, l3]: [f64; 3], c1: f64, c2: f64, c3: f64, n: f64, kappa: f64) -> f64 {
    c1 * (I1b - 3) + c2 * (I2b - 3) + c3 / (n + 1) * (I1b - 3).powf(n + 1) + kappa / 2 * (J - 1).powi(2)
}

/// A spline of the volume with a continuation.
//@ values 1e6, [0.5, -2e6, 1, 0, 2, 1e6]
//@ epsilon 0.1
//@ points 64
#[material(domain(J > 0.0), extend)]
fn Volumetric([l1, l2, l3]: [f64; 3], mu: f64, h: piola::Spline) -> f64 {
    mu * (sum(|l| l.powi(2) - 1.0) - 2.0 * J.ln()) + h(J)
}

/// Sums over the stretches and their pairs, and functions that are not powers.
//@ values 1e6, 0.7, 1e7
//@ points 64
#[material(domain(J > 0.0))]
fn Sums([l1, l2, l3]: [f64; 3], mu: f64, b: f64, kappa: f64) -> f64 {
    let single = sum(|l| {
        let s = l / J.cbrt();
        (b * (s - 1.0)).cosh()
    });
    let double = sum(|p, q| (p * q / J.powf(2 / 3) - 1.0).powi(2));
    mu * (single / b.powi(2) + double) + mu * (b * (I1b - 3.0)).tanh() + kappa * ((J - 1.0) * b).softplus()
        - kappa * b / 2.0 * J.ln()
}

/// Flory, Erman, *Theory of elasticity of polymer networks. 3*, 1982, as printed: 1 + B and 1 + D cancel on
/// flat elements.
//@ values 4e5, 2.59, 2e7
//@ points 64
#[material(domain(J > 0.0), admissible(k > 0.0))]
fn FloryErman([l1, l2, l3]: [f64; 3], c: f64, k: f64, kappa: f64) -> f64 {
    let constraint = sum(|l| {
        let s = (l / J.cbrt()).powi(2);
        let b = k.powi(2) * (s - 1.0) / (s + k).powi(2);
        let d = s * b / k;
        b + d - (1.0 + b).ln() - (1.0 + d).ln()
    });
    c / 2.0 * (I1b - 3.0 + constraint) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}

/// The same, multiplied out by hand: no term of the logarithms is negative.
//@ values 4e5, 2.59, 2e7
//@ points 64
#[material(domain(J > 0.0), admissible(k > 0.0))]
fn FloryErmanByHand([l1, l2, l3]: [f64; 3], c: f64, k: f64, kappa: f64) -> f64 {
    let constraint = sum(|l| {
        let s = (l / J.cbrt()).powi(2);
        let b = s * (s + 2.0 * k + k.powi(2));
        let d = (1.0 + k) * s.powi(2) + k * s + k.powi(2);
        k * (s - 1.0) / (s + k) - b.ln() - d.ln() + 4.0 * (s + k).ln()
    });
    c / 2.0 * (I1b - 3.0 + constraint) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}

/// Digits that a root loses, which no fraction helps.
//@ values 1e5, 1
//@ breaks single_precision
//@ breaks **Digits**
//@ points 64
#[material(domain(J > 0.0), admissible(k > 0.0), prestressed)]
fn Lossy([l1, l2, l3]: [f64; 3], mu: f64, k: f64) -> f64 {
    mu * (I1 - sum(|l| ((l.powi(2) + k.powi(2)).sqrt() - k).ln()) - 2.0 * J.ln())
}

/// Kilian's rubber in I1b alone, with the domain that a message offers for it.
//@ values 1e5, 2.1, 1e6
//@ points 64
#[material(domain(J > 0.0, 1.0 - ((I1b - 3.0) / (lm.powi(2) - 3.0)).sqrt() > 0.0), admissible(lm > 2.0))]
fn VanDerWaals([l1, l2, l3]: [f64; 3], g: f64, lm: f64, kappa: f64) -> f64 {
    let theta = ((I1b - 3.0) / (lm.powi(2) - 3.0)).sqrt();
    g * (3.0 - lm.powi(2)) * ((1.0 - theta).ln() + theta) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// An energy by invariants that ends at a real power of I1b − 3 and I2b − 3.
//@ values 0.5
//@ points 64
#[material(domain(J > 0.0, (I1b - 3.0 + b * (I2b - 3.0)).powf(0.7) < b), admissible(b > 0.0))]
fn Ending([l1, l2, l3]: [f64; 3], b: f64) -> f64 {
    I1b + b * (J - 1.0).powi(2)
}

/// Gregory's carbon-filled rubber, 1979: a small constant keeps the base of the power from vanishing at rest.
//@ values 1e5, 0.4, 1e-2, 1e6
//@ formula (I1 J^(−2/3) + c² − 3)^n
//@ points 64
#[material(domain(J > 0.0), admissible(n > 0.0))]
fn Gregory([l1, l2, l3]: [f64; 3], a: f64, n: f64, c: f64, kappa: f64) -> f64 {
    a * (I1b - 3.0 + c.powi(2)).powf(n) + kappa / 2.0 * (J - 1.0).powi(2)
}
