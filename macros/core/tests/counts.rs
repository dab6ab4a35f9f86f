//! Operations of derivatives, compared with those of a computer algebra system.

use piola_codegen::analyse;
use piola_codegen::model::Variant;
use piola_codegen::schedule::count::{Count, OperationKind};

/// Operations and real powers of ψ with its three first and six second derivatives, where lists have three
/// entries.
///
/// An operation is what sympy counts as one: + − × ÷, a change of sign, a function, a power, however it is
/// computed. Ours are what is emitted, so a real power is one and so is the logarithm that all powers of one
/// base share.
#[track_caller]
fn check(declaration: &str, operations: usize, powers: usize) {
    let (arguments, item) = declaration.split_once(';').expect("arguments; item");
    let (arguments, item) = (arguments.parse().expect("tokens"), item.parse().expect("tokens"));
    let (_, mut model) = analyse(arguments, item, None).expect("an energy without mistakes");
    let Variant { energy, gradient, hessian, .. } = &model.plain;
    let roots = [&[*energy], &gradient[..], hessian].concat();
    let count = Count::of(&model.program(&roots));
    let number = |is_asked: fn(OperationKind) -> bool| count.number(&[3], is_asked);
    assert_eq!((number(|_| true), number(|kind| kind == OperationKind::Power)), (operations, powers));
}

/// sympy 1.14, `count_ops` after `cse`: 138 and 9.
#[test]
fn ogden_takes_fewer_operations_than_its_formulas() {
    check(
        "domain(J > 0.0);
        fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N], kappa: f64) -> f64 {
            sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
                - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
        }",
        137,
        9,
    );
}

/// sympy: 49, or 53 without its `basic` optimisations.
#[test]
fn hencky_takes_fewer_operations_than_its_formulas() {
    check(
        "domain(J > 0.0);
        fn E([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
            mu * (l1.ln().powi(2) + l2.ln().powi(2) + l3.ln().powi(2)) + lambda / 2.0 * J.ln().powi(2)
        }",
        45,
        0,
    );
}

/// sympy: 171 with its `basic` optimisations, 190 without. The formula has J^(−2/3) and I1 apart; ours
/// multiplies the one into the three terms of the other, for neither overflows where their product does not.
#[test]
fn isochoric_gent_takes_fewer_operations_than_its_formulas() {
    check(
        "domain(J > 0.0, I1b - 3.0 < jm), admissible(jm > 0.0);
        fn E([l1, l2, l3]: [f64; 3], mu: f64, jm: f64, kappa: f64) -> f64 {
            -mu * jm / 2.0 * (1.0 - (I1b - 3.0) / jm).ln() + kappa / 2.0 * (J - 1.0).powi(2)
        }",
        168,
        0,
    );
}

/// sympy: 304, with 15 powers, three of them of J. Ours are those of isochoric stretches.
#[test]
fn isochoric_ogden_takes_fewer_operations_than_its_formulas() {
    check(
        "domain(J > 0.0);
        fn E<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N], kappa: f64) -> f64 {
            let shape = sum(|p| {
                let powers = l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]);
                mu[p] / alpha[p] * (J.powf(-alpha[p] / 3.0) * powers - 3.0)
            });
            shape + kappa / 2.0 * (J - 1.0).powi(2)
        }",
        278,
        9,
    );
}
