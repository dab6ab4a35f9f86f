//! Reference values of quotients of stresses, and how hard they are to compute.
//!
//! The oracle is the definition, (ψi ∓ ψj)/(λi ∓ λj), from the gradient in enough digits for any gap. It
//! shares the gradient with its subject, which the reference cases judge, and nothing of the calculus of
//! quotients.

use piola::material::PAIRS;
use piola::{Material, Real};

use crate::multiprecision::Multiprecision;

/// 320 bits, 96 digits: 30 go into the nudge below, 40 into differences, and 26 remain.
pub type Number = Multiprecision<5>;

/// A quotient to more digits than any format holds, and how exactly it can be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Quotient {
    /// D.
    pub value: Number,
    /// max(|D|, |ψii| + |ψij|), Pa: D is a mean of ψii ∓ ψij, and can be the small difference of them.
    pub scale: Number,
    /// Σk |λk ∂D/∂λk|, Pa: what relative changes of the stretches by one change in D; with |ε ∂D/∂ε| where an
    /// extension has a threshold ε, which takes the place of a stretch below it.
    pub sensitivity: Number,
}

impl Quotient {
    /// |found − D| in units of u: of the scale alone, and of scale + sensitivity. Infinite where `found` is not finite.
    pub fn error(&self, found: f64, unit_roundoff: f64) -> Error {
        let distance = (Number::splat(found) - self.value).abs();
        if !distance.is_finite() {
            return Error { flat: f64::INFINITY, conditioned: f64::INFINITY };
        }
        if !Number::splat(0.0).less(distance) {
            return Error { flat: 0.0, conditioned: 0.0 };
        }
        let units = |of: Number| (distance / of).to_f64() / unit_roundoff;
        Error { flat: units(self.scale), conditioned: units(self.scale + self.sensitivity) }
    }

    /// Adds |ε ∂D/∂ε| to the sensitivity, from the value `moved` of D where ε is larger by this fraction.
    pub fn with_threshold(self, moved: Number, fraction: f64) -> Self {
        let change = (moved - self.value).abs() / Number::splat(fraction);
        Self { sensitivity: self.sensitivity + change, ..self }
    }

    /// Raises the scale to Σ|terms|, Pa, if that is larger.
    pub fn with_terms(self, terms: f64) -> Self {
        Self { scale: self.scale.max(Number::splat(terms)), ..self }
    }
}

/// An error in units of u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// Error over u times the scale.
    pub flat: f64,
    /// Error over u times scale + sensitivity, that is, (1 + κ) times the scale.
    pub conditioned: f64,
}

/// Flips, then twists, of the [`PAIRS`] at stretches that are exact numbers.
///
/// All stretches are nudged by about 10⁻³⁰ of the largest one, each differently, so that no gap is zero; this
/// changes a quotient by 10⁻³⁰ of its sensitivity. Second derivatives and the quotients' own derivatives are
/// forward differences over 10⁻⁴⁰.
pub fn expected(material: &impl Material, stretches: [f64; 3]) -> [[Quotient; 3]; 2] {
    let size = Number::splat(stretches[0].abs());
    let nudge = size * Number::splat(1e-30);
    let step = size * Number::splat(1e-40);
    let base: [Number; 3] =
        std::array::from_fn(|k| Number::splat(stretches[k]) + nudge * Number::splat([2.0, -1.0, 0.5][k]));
    let gradient = material.gradient(base);
    let moved: [([Number; 3], [Number; 3]); 3] = std::array::from_fn(|k| {
        let mut stretches = base;
        stretches[k] = stretches[k] + step;
        (stretches, material.gradient(stretches))
    });
    let second = |i: usize, k: usize| ((moved[k].1[i] - gradient[i]) / step).abs();
    let judge = |(i, j): (usize, usize), sign: Number| {
        let quotient = |stretches: &[Number; 3], gradient: &[Number; 3]| {
            (gradient[i] + sign * gradient[j]) / (stretches[i] + sign * stretches[j])
        };
        let value = quotient(&base, &gradient);
        let sensitivity = (0..3).fold(Number::splat(0.0), |sum, k| {
            let change = quotient(&moved[k].0, &moved[k].1) - value;
            sum + (Number::splat(stretches[k]) * change / step).abs()
        });
        Quotient { value, scale: value.abs().max(second(i, i) + second(i, j)), sensitivity }
    };
    [-1.0, 1.0].map(|sign| PAIRS.map(|pair| judge(pair, Number::splat(sign))))
}

/// Triples λ1 ≥ λ2 ≥ |λ3| in which two stretches, or their magnitudes, differ by every gap.
///
/// `scales` are sizes of the close pair. With `signed`, λ3 may be negative or zero. With a `threshold`, pairs
/// also stand on either side of it, on it, and below it.
pub fn samples(scales: &[f64], signed: bool, threshold: Option<f64>) -> Vec<[f64; 3]> {
    let mut samples = Vec::new();
    for gap in gaps() {
        let mut pairs: Vec<(f64, f64)> = scales.iter().map(|&y| (y * (1.0 + gap), y)).collect();
        if let Some(epsilon) = threshold {
            pairs.extend([
                (epsilon * (1.0 + gap), epsilon),
                (epsilon, epsilon / (1.0 + gap)),
                (epsilon * (1.0 + 0.5 * gap), epsilon / (1.0 + 0.5 * gap)),
                (0.7 * epsilon * (1.0 + gap), 0.7 * epsilon),
            ]);
        }
        for (x, y) in pairs {
            samples.extend([[x, y, 0.6 * y], [1.4 * x, x, y], [x, 0.5 * (x + y), y], [x, y, y]]);
            if signed {
                samples.extend([[x, y, -0.4 * y], [x, y, 0.0], [1.4 * x, x, -y], [x, x, -y], [x, y, -y]]);
            }
        }
    }
    // Rounding of a midpoint may exceed the ends by a unit.
    samples.retain(|[l1, l2, l3]| l1 >= l2 && *l2 >= l3.abs());
    samples
}

/// Relative gaps: 10, 3, decades from 1 to 10⁻¹⁶, every fourth power of two to 2⁻⁵², and zero.
pub fn gaps() -> impl Iterator<Item = f64> {
    let decades = (0..=16).map(|k| 10f64.powi(-k));
    let powers = (1..=13).map(|k| 2f64.powi(-4 * k));
    [10.0, 3.0, 0.5, 0.0].into_iter().chain(decades).chain(powers)
}
