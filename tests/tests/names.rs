//! Declarations whose names could collide with those of generated code.

use piola::Inversion;
use piola::contract::{Settings, check};
use piola::material;
use piola::material::Declared;

/// Every name here is one that generated code uses too.
#[material(domain(J > 0.0), admissible(p[k] != 0.0), extend(t0[k] * p[k] > 0.0))]
fn Unlucky<const N: usize>(
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
#[material]
fn Unit([l1, l2, l3]: [f64; 3]) -> f64 {
    (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2)
}

/// Lists of a literal length, of one entry too.
#[material(domain(J > 0.0))]
fn Fixed([l1, l2, l3]: [f64; 3], a: [f64; 1], b: [f64; 2]) -> f64 {
    sum(|p| a[p]) * (J - 1.0).powi(2)
        + sum(|p| b[p] * (l1.powi(4) + l2.powi(4) + l3.powi(4) - 3.0 - 4.0 * J.ln()))
}

/// Not visible outside, and without stretches of its own.
#[material]
pub(crate) fn Invariant([_x, _y, _z]: [f64; 3], mu: f64) -> f64 {
    mu * ((I1 - 3.0).powi(2) + (I1 * I1 / 3.0 - I2))
}

/// Literal exponents that are not simple fractions.
#[material(domain(J > 0.0))]
fn Literal([l1, l2, l3]: [f64; 3], mu: f64) -> f64 {
    let power = l1.powf(1.305678) + l2.powf(1.305678) + l3.powf(1.305678) - 3.0;
    mu * (power - 1.305678 * J.ln()) + mu * (J - 1.0).powi(2)
}

#[track_caller]
fn keeps_the_contract(material: &impl Declared, settings: &Settings) {
    check(material, settings).unwrap_or_else(|violations| panic!("{violations}"));
}

#[test]
fn names_of_generated_code_are_free() {
    let plain = Unlucky::new([1.0, 0.5], [2.5, -1.5], 2.0, 7.0);
    assert!(plain.is_ok());
    let Ok(plain) = Unlucky::new([1.0, 0.5], [2.5, 1.5], 2.0, 7.0) else { panic!("admissible parameters") };
    assert_eq!((plain.t0(), plain.epsilon(), plain.material()), ([1.0, 0.5], 2.0, 7.0));
    keeps_the_contract(&plain, &Settings::default());
    let extended = plain.with_inversion(Inversion::Extend { epsilon: 0.25 }).expect("a restoring extension");
    keeps_the_contract(&extended, &Settings::default());
}

#[test]
fn few_or_fixed_parameters_are_enough() {
    keeps_the_contract(&Unit::new().expect("no parameters"), &Settings::default());
    keeps_the_contract(&Fixed::new([3.0], [1.0, 0.5]).expect("admissible parameters"), &Settings::default());
    keeps_the_contract(&Literal::new(2.0).expect("admissible parameters"), &Settings::default());
    keeps_the_contract(&Invariant::new(2.0).expect("admissible parameters"), &Settings::default());
    assert_eq!(Unit::from_values(&[], Inversion::Refuse).map(|unit| unit.moduli().mu), Ok(1.0));
}
