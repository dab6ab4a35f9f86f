//! What the energies that the catalogue compiles by default do not have: lists whose lengths are known at run
//! time, whole exponents that are parameters, bounds that depend on parameters, unlucky names, and every
//! elementary function.
//!
//! The test `attribute` compiles these declarations as Rust, too, and compares.

/// Ogden's sum of any number of terms.
//@ values [6.3e5, 1.2e3, 1e4], [1.3, 5.0, 2.0], 2e6
//@ values [6.3e5, 1e4], [1.3, 2.0], 2e6
//@ range 0.2 4.0
//@ epsilon 0.1
//@ refuses [1, 1, 1], [2, 2], 1: `alpha` must have as many entries as `mu`, 3, not 2
//@ refuses [1, 1, 1], [2, 2, 2], [1, 1]: `kappa` must be one number
//@ refuses [1, "inf"], [2, 2], 1: `mu[1]` is inf
//@ refuses [1, 0], [2, 2], 1: `mu[p] != 0` must hold, but mu[1] = 0
//@ refuses [], [], 1: shear modulus
//@ refuses-extension [3, -1], [2, 1], 4: mu[1] = -1, alpha[1] = 1, kappa = 4
//@ points 64
#[piola::material(domain(J > 0.0), admissible(mu[p] != 0.0), extend(mu[p] * alpha[p] * kappa > 0.0))]
pub fn Terms(
    [l1, l2, l3]: [f64; 3],
    /** Moduli, Pa. */
    mu: Vec<f64>,
    /** Exponents. */
    alpha: Vec<f64>,
    /** Volumetric modulus, Pa. */
    kappa: f64,
) -> f64 {
    sum(|p| mu[p] / alpha[p] * (sum(|l| l.powf(alpha[p])) - 3.0)) - sum(|p| mu[p]) * J.ln()
        + kappa / 2.0 * (J - 1.0).powi(2)
}

/// The same sum with a length that the compiler knows.
//@ values [6.3e5, 1.2e3, 1e4], [1.3, 5.0, 2.0], 2e6
//@ values [6.3e5], [1.3], 2e6
//@ epsilon 0.2
#[piola::material(domain(J > 0.0), admissible(mu[p] != 0.0), extend(mu[p] * alpha[p] * kappa > 0.0))]
pub fn Fixed<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /** Moduli, Pa. */
    mu: [f64; N],
    /** Exponents. */
    alpha: [f64; N],
    /** Volumetric modulus, Pa. */
    kappa: f64,
) -> f64 {
    sum(|p| mu[p] / alpha[p] * (sum(|l| l.powf(alpha[p])) - 3.0)) - sum(|p| mu[p]) * J.ln()
        + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Two lists of independent lengths, an array, and an array of one entry.
//@ values [1e5, 1e5, 1e5], [1e6], [1e4, 2e4], [1e3]
//@ values [1], [], [0, 0], [0]
//@ points 64
#[piola::material(domain(J > 0.0))]
pub fn Groups([l1, l2, l3]: [f64; 3], a: Vec<f64>, b: std::vec::Vec<f64>, c: [f64; 2], d: [f64; 1]) -> f64 {
    sum(|p| a[p]) * (I1 - 3.0 - 2.0 * J.ln())
        + (sum(|q| b[q]) + sum(|p| d[p])) * (J - 1.0).powi(2)
        + sum(|p| c[p]) * (I1 - 3.0 - 2.0 * J.ln()).powi(2)
}

/// Rivlin's series with its exponents as data.
//@ values [1.8e5, 2.1e4, 3e3], [1, 0, 2], [0, 1, 0], 1e6
//@ epsilon 0.2
//@ refuses [1, 1], [1, 65], [0, 0], 1: `i[1]` is 65; such an exponent must be a whole number from 0 to 64
//@ refuses [1, 1], [1, 0.5], [0, 0], 1: `i[1]` is 0.5; such an exponent must be a whole number from 0 to 64
//@ refuses [1, 1], [1, -1], [0, 0], 1: `i[1]` is -1; such an exponent must be a whole number from 0 to 64
//@ refuses [1, 1], [1, 1e10], [0, 0], 1: such an exponent must be a whole number from 0 to 64
//@ refuses [1, 1], [1, "NaN"], [0, 0], 1: `i[1]` is NaN; such an exponent must be a whole number from 0 to 64
//@ refuses [1, 1], [1, "inf"], [0, 0], 1: `i[1]` is inf; such an exponent must be a whole number from 0 to 64
//@ refuses [1, 2], [1], [0, 0], 1: `i` must have as many entries as `c`, 2, not 1
//@ refuses [1], [2], [0], 2: shear modulus
//@ points 64
#[piola::material(
    domain(J > 0.0),
    admissible(c[p] >= 0.0),
    extend,
    typical("a soft rubber", c = [1.8e5, 2e3], i = [1, 2], j = [0, 0], K = 1e7)
)]
pub fn Series(
    [l1, l2, l3]: [f64; 3],
    /** Coefficients, Pa. */
    c: Vec<f64>,
    /** Exponents of I1b − 3. */
    i: Vec<u32>,
    /** Exponents of I2b − 3, dimensionless. */
    j: Vec<u32>,
    /** Bulk modulus, Pa. */
    K: f64,
) -> f64 {
    sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p])) + K / 2.0 * (J - 1.0).powi(2)
}

/// Powers of single stretches: quotients between different bases, with a pole.
//@ values [2, 3], [2, 4], 2
//@ refuses [1, 1], [1, 2], 70: `m` is 70; such an exponent must be a whole number from 0 to 64
//@ points 64
#[piola::material(prestressed)]
pub fn Springs([l1, l2, l3]: [f64; 3], c: [f64; 2], n: [u32; 2], m: u32) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(n[p]))) + sum(|l| (l * l - 1.0).powi(m))
}

/// Powers alone, which may be small at rest without being zero by their form.
//@ values [1], [2], [0]
#[piola::material(prestressed)]
pub fn Products([l1, l2, l3]: [f64; 3], c: Vec<f64>, n: Vec<u32>, m: Vec<u32>) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(n[p]) * (l * l - 1.0).powi(m[p])))
}

/// Rubber that locks at a power of a stretch.
//@ values 1, 2.1, 3, 1
//@ refuses 1, 1.5, 2, 1: `I1b < lm.powi(n)` must hold there too, but lm = 1.5, n = 2; change
//@ refuses 1, 1.25, 3, 1: `I1b < lm.powi(n)` must hold there too, but lm = 1.25, n = 3; change
//@ refuses 1, 1, 1, 1: `I1b < lm.powi(n)`
#[piola::material(domain(J > 0.0, I1b < lm.powi(n)))]
pub fn Locking([l1, l2, l3]: [f64; 3], mu: f64, lm: f64, n: u32, kappa: f64) -> f64 {
    -mu * (lm.powi(n) - I1b).ln() + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Rubber that locks at a sum.
//@ values 1, [5, 4]
//@ refuses 1, [1, 2]: `I1b < sum(|p| m[p])`
//@ refuses 10, [4]: `l1 > 0.1 * k` must hold there too, but k = 10; change
#[piola::material(domain(J > 0.0, l1 > 0.1 * k, I1b < sum(|p| m[p])))]
pub fn LockingAtSum([l1, l2, l3]: [f64; 3], k: f64, m: Vec<f64>) -> f64 {
    -(sum(|p| m[p]) - I1b).ln() + k * (J - 1.0).powi(2)
}

/// A bound that a condition on a parameter implies, one without parameters, and one of stretches alone.
//@ values 20
//@ refuses 0: `jm > 0` must hold, but jm = 0
#[piola::material(domain(J > 0.0, I1b - 3.0 < jm, I1b < 1e3, J < 1e3), admissible(jm > 0.0))]
pub fn Implied([l1, l2, l3]: [f64; 3], jm: f64) -> f64 {
    -jm * (1.0 - (I1b - 3.0) / jm).ln() + jm * (J - 1.0).powi(2)
}

/// Every name here is one that generated code uses too.
//@ values [1, 0.5], [2.5, 1.5], 2, 7
//@ values [1, 0.5], [2.5, -1.5], 2, 7
//@ epsilon 0.25
//@ points 64
#[piola::material(domain(J > 0.0), admissible(p[k] != 0.0), extend(t0[k] * p[k] > 0.0))]
pub fn Unlucky<const N: usize>(
    [w, u1, value]: [f64; 3],
    /// Moduli, Pa.
    t0: [f64; N],
    /// Exponents.
    p: [f64; N],
    /// Shear modulus, Pa.
    epsilon: f64,
    /// Volumetric modulus, Pa.
    material: f64,
) -> f64 {
    sum(|k| t0[k] / p[k] * (w.powf(p[k]) + u1.powf(p[k]) + value.powf(p[k]) - 3.0)) - sum(|k| t0[k]) * J.ln()
        + epsilon / 2.0 * (I1 - 3.0 - 2.0 * J.ln())
        + material / 2.0 * (J - 1.0).powi(2)
}

/// No parameters at all.
//@ points 64
#[piola::material]
pub fn Unit([l1, l2, l3]: [f64; 3]) -> f64 {
    (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2)
}

/// Without stretches of its own, and not visible outside.
//@ values 2
//@ points 64
#[piola::material]
pub(crate) fn Invariant([_x, _y, _z]: [f64; 3], mu: f64) -> f64 {
    mu * ((I1 - 3.0).powi(2) + (I1 * I1 / 3.0 - I2))
}

/// Literal exponents that are not simple fractions.
//@ values 2
//@ points 64
#[piola::material(domain(J > 0.0))]
pub fn Literal([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    let power = l1.powf(1.305678) + l2.powf(1.305678) + l3.powf(1.305678) - 3.0;
    mu * (power - 1.305678 * J.ln()) + mu * (J - 1.0).powi(2)
}

/// All elementary functions of an invariant, within sums over a list, over stretches and over pairs.
//@ values 1e5, [0.2, 0.3], [0.7, 0.1], 1e6
#[piola::material(domain(J > 0.0), extend)]
pub fn Elementary([l1, l2, l3]: [f64; 3], mu: f64, a: Vec<f64>, b: Vec<f64>, kappa: f64) -> f64 {
    let x = (I1b - 3.0) / 10.0;
    let first =
        sum(|p| (a[p] * x).softplus() + (b[p] * x).tanh() + (a[p] * x + b[p]).sigmoid() + (b[p] * x).asinh());
    let second =
        x.atan() + x.sin() - (0.1 * x).cos() + (x / 2.0).sinh() + (x / 3.0).exp_m1() + x.ln_1p() + x.erf();
    let single = sum(|l| (l / J.cbrt() - 1.0).cosh() + (l / J.cbrt()).atan());
    let double = sum(|p, q| (p * q / J.powf(2 / 3) - 1.0).powi(2));
    mu * (I1b - 3.0 + first + second + single + double) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Roots of expressions that vanish at rest, and fractions of stretches that cancel on flat elements.
//@ values 1e5, 10, 2.59, 1e6
#[piola::material(domain(J > 0.0, (I1b - 3.0).sqrt() < lm), admissible(lm > 1.0, k > 0.0))]
pub fn Roots([l1, l2, l3]: [f64; 3], mu: f64, lm: f64, k: f64, kappa: f64) -> f64 {
    let root = (I1b - 3.0).sqrt() / lm;
    let constraint = sum(|l| {
        let s = (l / J.cbrt()).powi(2);
        let b = k.powi(2) * (s - 1.0) / (s + k).powi(2);
        b - (1.0 + b).ln()
    });
    mu * (I1b - 3.0 + constraint + ((I2b - 3.0) / 2.0).powf(1.5) - lm * ((1.0 - root).ln() + root))
        + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Functions of the volume, of its logarithm and of each stretch, within a sum over a list and within another
/// function too.
//@ values 1e5, [0.5, 1.5], [0.1, -5e5, 1, 0, 2, 3e5, 9, 4e6]
#[piola::material(domain(J > 0.0), prestressed, extend)]
pub fn Functions([l1, l2, l3]: [f64; 3], mu: f64, a: Vec<f64>, f: piola::Spline) -> f64 {
    let listed =
        sum(|p| f(1.0 + a[p] * (l1 - 1.0)) + f(1.0 + a[p] * (l2 - 1.0)) + f(1.0 + a[p] * (l3 - 1.0)));
    let volume = f(J) + f(1.0 + J.ln().powi(2)) + f(1.0 + f(J) / 1e6);
    mu * (sum(|l| l.powi(2) - 1.0) - 2.0 * J.ln()) + listed + volume + sum(|l| f(l))
}

/// Functions of the invariants, one of which begins where I1b − 3 does.
//@ values [0, 1e5, 3, 1.2e5, 10, 2e5], [0, 1e4, 3, 2e4, 10, 2e4], 1e6
#[piola::material(domain(J > 0.0))]
pub fn FunctionsOfInvariants([l1, l2, l3]: [f64; 3], f: piola::Spline, g: piola::Spline, kappa: f64) -> f64 {
    f(I1b) + f(I1b - 3.0) + g(I2b) + kappa / 2.0 * (J - 1.0).powi(2)
}
