//! Energies whose derivatives by parameters meet every rule, each harder than any of the catalogue.

use piola::material;
use piola::material::{Fittable, MaterialError};

use crate::check_slopes;

/// Sums in products, in logarithms, in each other's terms and in exponents; lists of two lengths; names of
/// what is emitted.
#[material(domain(J > 0.0), prestressed, fit)]
pub fn Nested<const N: usize, const M: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Shares, Pa.
    mu: [f64; N],
    /// Exponents.
    alpha: [f64; N],
    /// Coefficients.
    derivatives: [f64; M],
    /// A stress, Pa.
    p: f64,
) -> f64 {
    let total = sum(|k| mu[k]);
    let powers = sum(|k| mu[k] / total * (l1.powf(alpha[k]) + l2.powf(alpha[k]) + l3.powf(alpha[k])));
    let series = sum(|k| derivatives[k] * (derivatives[k] * powers).exp());
    total * series.ln() + p * powers * sum(|k| alpha[k] * mu[k]).ln() + p * I1.powf(sum(|k| derivatives[k]))
}

/// Powers of what differs from entry to entry, in a list of fixed length.
#[material(prestressed, fit)]
pub fn Shifted(
    [l1, l2, l3]: [f64; 3],
    /// Moduli, Pa.
    mu: [f64; 2],
    /// Stiffening.
    b: [f64; 2],
    /// Exponent.
    n: f64,
) -> f64 {
    sum(|k| mu[k] * (1.0 + b[k] * I1).powf(n * b[k]))
}

/// A real power, whose logarithm vanishes at rest.
#[material(domain(J > 0.0), admissible(n > 2.0), fit)]
pub fn Stiffening(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus, Pa.
    mu: f64,
    /// Modulus of the power, Pa.
    c: f64,
    /// Its exponent.
    n: f64,
) -> f64 {
    mu / 2.0 * (I1b - 3.0) + c * (1.0 + (I1b - 3.0)).powf(n) + mu * (J - 1.0).powi(2)
}

#[test]
fn sums_inside_everything() -> Result<(), MaterialError> {
    check_slopes("Nested", &Nested::new([1.5, 2.0, 0.5], [1.3, 4.0, -2.0], [0.25, 0.5], 3.0)?)?;
    // An exponent of zero, where λ^α is 1 and its derivative ln λ.
    let zero = Nested::new([1.5, 2.0], [1.0, 0.0], [0.5], 3.0)?;
    let [.., to_exponent, _, _] = zero.gradient_by_parameters([2.0, 1.0, 0.5])[..] else {
        panic!("six numbers")
    };
    assert!(to_exponent[0] > 0.0 && to_exponent[1] > 0.0, "{to_exponent:?}");
    Ok(())
}

#[test]
fn powers_that_differ_from_entry_to_entry() -> Result<(), MaterialError> {
    check_slopes("Shifted", &Shifted::new([1.0, 2.0], [0.5, 0.7], 1.2)?)
}

#[test]
fn powers_whose_logarithm_vanishes_at_rest() -> Result<(), MaterialError> {
    let solid = Stiffening::new(1.0, 2.0, 2.5)?;
    check_slopes("Stiffening", &solid)?;
    assert_eq!(solid.gradient_by_parameters([1.0; 3]), [[0.0; 3]; 3]);
    Ok(())
}
