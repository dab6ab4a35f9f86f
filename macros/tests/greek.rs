//! Parameters with the Greek letters of papers look like no name of an expansion.
//!
//! `confusable_idents` judges all names of a crate at once, and a file of its own has none of these.

#![deny(warnings)]

/// Numbers and lists, with everything that an expansion can have.
#[piola::material(domain(J > 0.0), admissible(α[q] > 0.0, ν > 0.0), extend)]
pub fn Listed<const N: usize>(
    [λ1, λ2, λ3]: [f64; 3],
    /** Pa. */
    α: [f64; N],
    /** Pa. */
    ν: f64,
    μ: f64,
    γ: f64,
    ι: f64,
    κ: f64,
    ο: f64,
    ρ: f64,
    υ: f64,
    λ: f64,
    β: f64,
) -> f64 {
    let κ0 = μ * μ + λ * λ + β * β + γ * γ + ι * ι + κ * κ + ο * ο + ρ * ρ + υ * υ;
    sum(|q| α[q]) * (I1b - 3.0) + ν * (1.0 + κ0) * (J - 1.0).powi(2)
}

/// A function, lists of a length known at run time, and whole exponents.
#[piola::material]
pub fn Curve([l1, l2, l3]: [f64; 3], α: piola::Spline, γ: Vec<f64>, ν: Vec<u32>) -> f64 {
    α(l1) + α(l2) + α(l3) + sum(|q| γ[q] * (J - 1.0).powi(ν[q]))
}
