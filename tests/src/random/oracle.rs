//! Reference values of an energy and its derivatives, from the generator's expression as it is printed.
//!
//! Taylor polynomials of degree 2 in 256 bits give ψ, ψi and ψij; flips and twists are their definition, (ψi
//! ∓ ψj)/(λi ∓ λj), at stretches that are moved by 2⁻⁷⁰ of themselves, so that no gap is zero. This changes a
//! value by 2⁻¹⁷ u times its sensitivity, and leaves the definition about 100 bits after it has divided by
//! the gap twice.

use std::ops::Add;

use piola::Real;
use piola::material::PAIRS;

use super::expression::Scope;
use super::generator::Declaration;
use super::quantity::{Number, Quantity};

/// A reference value, and how exactly it can be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// The value.
    pub value: Number,
    /// |value| + Σ|λk ∂value/∂λk|; for quotients with |ψii| + |ψij|, of which they are a mean. For values by
    /// strains, changes are relative to those.
    pub scale: f64,
    /// The error of the formula as printed, in units of u.
    pub printed: f64,
}

/// Everything at one point.
#[derive(Clone, Debug)]
pub struct Point {
    /// The largest magnitude of a part of the formula, or the reciprocal of the smallest one.
    pub range: f64,
    /// ψ.
    pub energy: Expected,
    /// ψ1, ψ2, ψ3.
    pub gradient: [Expected; 3],
    /// ψ11, ψ22, ψ33, ψ12, ψ13, ψ23.
    pub hessian: [Expected; 6],
    /// D⁻ of the pairs.
    pub flip: [Expected; 3],
    /// D⁺ of the pairs.
    pub twist: [Expected; 3],
}

/// Relative distance by which stretches are moved apart.
const NUDGE: f64 = 1.0 / (1u128 << 70) as f64;

/// Quotients whose denominator is a larger share of the stretches than this may be computed as they are
/// defined.
const WIDE: f64 = 0.1;

/// All values at stretches, none of which is zero.
pub fn at_stretches(declaration: &Declaration, stretches: [f64; 3]) -> Point {
    let moved: [Number; 3] = std::array::from_fn(|k| {
        let factor = Number::splat(1.0) + Number::splat([2.0, -1.0, 0.5][k] * NUDGE);
        Number::splat(stretches[k]) * factor
    });
    let psi = energy(declaration, moved);
    let relative = |slopes: [f64; 3]| (0..3).map(|k| (stretches[k] * slopes[k]).abs()).sum::<f64>();
    let value_of = |by: &[usize], slopes: [f64; 3]| {
        let value = psi.exact.derivative(by);
        Expected { value, scale: value.to_f64().abs() + relative(slopes), printed: psi.error.derivative(by) }
    };
    let first = |i: usize| psi.exact.derivative(&[i]);
    let second = |i: usize, j: usize| psi.exact.derivative(&[i, j]);
    let gradient = [0, 1, 2].map(|i| value_of(&[i], [0, 1, 2].map(|k| second(i, k).to_f64())));
    let hessian = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        .map(|(i, j)| value_of(&[i, j], [0, 1, 2].map(|k| psi.rough.derivative(&[i, j, k]))));
    let quotient = |(i, j): (usize, usize), sign: f64| {
        let signed = Number::splat(sign);
        let denominator = moved[i] + signed * moved[j];
        let value = (first(i) + signed * first(j)) / denominator;
        let slopes = [0, 1, 2].map(|k| {
            let change =
                if k == i { Number::splat(1.0) } else { Number::splat(if k == j { sign } else { 0.0 }) };
            ((second(i, k) + signed * second(j, k) - value * change) / denominator).to_f64()
        });
        let mean = second(i, i).abs().to_f64() + second(i, j).abs().to_f64();
        let error = |by: &[usize]| psi.error.derivative(by);
        let mut printed = error(&[i, i]) + error(&[j, j]) + error(&[i, j]);
        let gap = denominator.abs().to_f64();
        if gap > WIDE * stretches[i].abs().max(stretches[j].abs()) {
            printed += (error(&[i]) + error(&[j])) / gap;
        }
        Expected { value, scale: value.to_f64().abs().max(mean) + relative(slopes), printed }
    };
    Point {
        range: psi.range,
        energy: value_of(&[], [0, 1, 2].map(|k| first(k).to_f64())),
        gradient,
        hessian,
        flip: PAIRS.map(|pair| quotient(pair, -1.0)),
        twist: PAIRS.map(|pair| quotient(pair, 1.0)),
    }
}

/// ψ1, ψ2, ψ3 at principal strains, which are exact and may be far below u.
pub fn at_strains(declaration: &Declaration, strains: [f64; 3]) -> [Expected; 3] {
    let is_stressed = declaration.words.contains(&"prestressed");
    let psi = energy(declaration, strains.map(|strain| Number::splat(1.0) + Number::splat(strain)));
    [0, 1, 2].map(|i| {
        let value = psi.exact.derivative(&[i]);
        let sum = |of: &dyn Fn(usize) -> f64| (0..3).map(|k| (strains[k] * of(k)).abs()).sum::<f64>();
        let sensitivity = sum(&|k| psi.exact.derivative(&[i, k]).to_f64());
        let at_rest = if is_stressed { psi.error.derivative(&[i]) } else { 0.0 };
        let printed = at_rest + sum(&|k| psi.error.derivative(&[i, k]));
        Expected { value, scale: value.to_f64().abs() + sensitivity, printed }
    })
}

fn energy(declaration: &Declaration, stretches: [Number; 3]) -> Quantity {
    let scope = Scope::new([0, 1, 2].map(|k| Quantity::stretch(k, stretches[k])));
    let terms = declaration.terms.iter().map(|term| term.at(&scope));
    terms.reduce(Add::add).unwrap_or(Quantity::constant(0.0))
}
