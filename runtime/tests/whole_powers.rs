//! Rivlin's series with its exponents as data, compared with the same series with its nine terms written out.
#![cfg(feature = "batch")]

use piola::material::{Argument, Blocks, Declared, Fittable, Form, MaterialError, Unit};
use piola::{Inversion, Material, material};

/// Rivlin's series.
#[material(
    domain(J > 0.0),
    admissible(c[p] >= 0.0),
    extend,
    fit,
    typical("a soft rubber", c = [1.8e5, 2e3], i = [1, 2], j = [0, 0], K = 1e7)
)]
fn Series(
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

/// Rivlin's series up to the third order.
#[material(domain(J > 0.0), extend, fit)]
fn Written(
    [l1, l2, l3]: [f64; 3],
    c10: f64,
    c01: f64,
    c20: f64,
    c11: f64,
    c02: f64,
    c30: f64,
    c21: f64,
    c12: f64,
    c03: f64,
    K: f64,
) -> f64 {
    let x = I1b - 3.0;
    let y = I2b - 3.0;
    c10 * x
        + c01 * y
        + c20 * x.powi(2)
        + c11 * x * y
        + c02 * y.powi(2)
        + c30 * x.powi(3)
        + c21 * x.powi(2) * y
        + c12 * x * y.powi(2)
        + c03 * y.powi(3)
        + K / 2.0 * (J - 1.0).powi(2)
}

/// Powers of single stretches: quotients between different bases, with a pole.
#[material(prestressed)]
fn Springs(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    c: [f64; 2],
    n: [u32; 2],
    m: u32,
) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(n[p]))) + sum(|l| (l * l - 1.0).powi(m))
}

/// Powers alone, which may be small at rest without being zero by their form.
#[material(prestressed)]
fn Products([l1, l2, l3]: [f64; 3], c: Vec<f64>, n: Vec<u32>, m: Vec<u32>) -> f64 {
    sum(|p| c[p] * sum(|l| (l - 1.0).powi(n[p]) * (l * l - 1.0).powi(m[p])))
}

const ORDERS: [[u32; 2]; 9] = [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0], [2, 1], [1, 2], [0, 3]];
const COEFFICIENTS: [f64; 9] = [1.8e5, 2.1e4, 3e3, 1.1e3, 5e2, 7e2, 1.3e2, 2.2e1, 4e1];
const BULK: f64 = 1e6;

fn series() -> Result<Series, MaterialError> {
    let [i, j] = [0, 1].map(|n| ORDERS.map(|orders| orders[n]).to_vec());
    Series::new(COEFFICIENTS.to_vec(), i, j, BULK)
}

fn written() -> Result<Written, MaterialError> {
    let [c10, c01, c20, c11, c02, c30, c21, c12, c03] = COEFFICIENTS;
    Written::new(c10, c01, c20, c11, c02, c30, c21, c12, c03, BULK)
}

piola::contract!(series: series()?);
piola::contract!(
    extended_series: series()?.with_inversion(Inversion::Extend { epsilon: 0.2 })?,
    range: (0.4, 2.5),
);
piola::contract!(springs: Springs::new([2.0, 3.0], [2, 4], 2)?, stress_free_at_rest: false);

/// Stretches near rest at strains of 10⁻¹ … 10⁻¹⁴, equal ones, and flat ones.
fn stretches() -> Vec<[f64; 3]> {
    let near = (1..=14).flat_map(|digits| {
        let strain = 10f64.powi(-digits);
        let of = |direction: [f64; 3]| direction.map(|part| 1.0 + strain * part);
        [of([1.0, 0.3, -0.7]), of([1.0, 1.0, -2.0]), of([0.5, -0.25, -0.25])]
    });
    let far = [
        [1.0; 3],
        [1.2; 3],
        [1.7, 1.7, 0.4],
        [1.5, 0.8, 0.8],
        [2.0, 0.9, 0.5],
        [1.3, 1.1, 1e-2],
        [1.1, 2e-2, 1e-2],
    ];
    near.chain(far).collect()
}

/// Compares to a few u of the largest of the numbers that are compared together, whose terms are of its size.
#[track_caller]
fn check(found: &[f64], expected: &[f64], scale: f64, what: &str) {
    let largest = expected.iter().fold(scale, |largest, value| largest.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        // Nine terms of a dozen operations each, summed up in two orders.
        let tolerance = 32.0 * f64::EPSILON * largest;
        assert!((found - expected).abs() <= tolerance, "{what}: {found:e} for {expected:e}");
    }
}

#[test]
fn a_series_has_the_digits_of_its_terms_written_out() -> Result<(), MaterialError> {
    let (series, written) = (series()?, written()?);
    for stretches in stretches() {
        let what = format!("{stretches:?}");
        let [a, b] = [series.energy(stretches), written.energy(stretches)];
        // I1b − 3 is known to u.
        check(&[a], &[b], 3.0 * COEFFICIENTS[0], &what);
        check(&series.gradient(stretches), &written.gradient(stretches), 3.0 * COEFFICIENTS[0], &what);
        let all = |Blocks { gradient, hessian, flip, twist }: Blocks<f64>| {
            [&gradient[..], &hessian, &flip, &twist].concat()
        };
        let [a, b] = [all(series.blocks(stretches)), all(written.blocks(stretches))];
        check(&a[..3], &b[..3], 3.0 * COEFFICIENTS[0], &what);
        check(&a[3..], &b[3..], 3.0 * COEFFICIENTS[0], &what);
    }
    Ok(())
}

/// At strains nothing is of the order of 1: the stress is known to a few u of itself.
#[test]
fn small_strains_keep_their_digits() -> Result<(), MaterialError> {
    let (series, written) = (series()?, written()?);
    for digits in 1..=14 {
        let strains = [1.0, 0.3, -0.7].map(|part| 10f64.powi(-digits) * part);
        let [a, b] = [series.gradient_at_strains(strains), written.gradient_at_strains(strains)];
        check(&a, &b, 0.0, &format!("{strains:?}"));
    }
    Ok(())
}

/// ψ1 = n sⁿ⁻¹ tᵐ + m sⁿ tᵐ⁻¹ 2 (1 + s) with t = 2 s + s², to a few u of each term.
#[test]
fn powers_that_are_small_at_rest_keep_their_digits() -> Result<(), MaterialError> {
    for (n, m) in [(2u32, 0u32), (3, 0), (0, 2), (0, 4), (2, 1), (1, 2), (3, 3)] {
        let products = Products::new(vec![1.0], vec![n], vec![m])?;
        for digits in 1..=14 {
            let s = 10f64.powi(-digits);
            let of = |x: f64, n: u32| (x.powi(n as i32), f64::from(n) * x.powi(n as i32 - 1));
            let (of_s, of_t) = (of(s, n), of(s * (2.0 + s), m));
            let expected = of_s.1 * of_t.0 + of_s.0 * of_t.1 * 2.0 * (1.0 + s);
            let [found, ..] = products.gradient_at_strains([s, 0.0, 0.0]);
            check(&[found], &[expected], 0.0, &format!("s^{n} t^{m} at {s}"));
        }
    }
    Ok(())
}

#[test]
fn a_series_has_the_moduli_of_its_terms() -> Result<(), MaterialError> {
    let [a, b] = [series()?.moduli(), written()?.moduli()];
    check(&[a.mu, a.lambda], &[b.mu, b.lambda], 0.0, "moduli");
    Ok(())
}

#[test]
fn a_constant_term_and_a_zero_exponent_count_as_written() -> Result<(), MaterialError> {
    let constant = Series::new(vec![5.0, 1.0], vec![0, 1], vec![0, 0], 2.0)?;
    assert_eq!(constant.energy([1.0; 3]), 5.0);
    assert_eq!(constant.gradient([1.0; 3]), [0.0; 3]);
    let no_shear = Series::new(vec![1.0], vec![2], vec![0], 2.0);
    assert!(matches!(no_shear, Err(MaterialError::UnstableRest { .. })), "{no_shear:?}");
    Ok(())
}

#[test]
fn exponents_are_whole_and_not_too_large() -> Result<(), MaterialError> {
    let not_whole = |given| Some(MaterialError::NotWhole { given });
    let large = Series::new(vec![1.0; 2], vec![1, 65], vec![0; 2], 1.0).err();
    assert_eq!(large, not_whole(Argument::entry("i", 1, 65.0)));
    let message = large.map(|error| error.to_string()).unwrap_or_default();
    assert_eq!(message, "`i[1]` is 65; such an exponent must be a whole number from 0 to 64");
    assert_eq!(Springs::new([1.0; 2], [1, 2], 70).err(), not_whole(Argument::scalar("m", 70.0)));

    let values = |i: &[f64]| Series::from_values(&[&[1.0, 2.0], i, &[0.0, 0.0], &[1.0]], Inversion::Refuse);
    assert_eq!(values(&[1.0, 2.0])?, Series::new(vec![1.0, 2.0], vec![1, 2], vec![0; 2], 1.0)?);
    for value in [0.5, -1.0, 1e10, f64::NAN, f64::INFINITY] {
        let error = values(&[1.0, value]).expect_err("no exponent").to_string();
        assert!(error.starts_with("`i[1]` is ") && error.ends_with("from 0 to 64"), "{error}");
    }
    let short = values(&[1.0]).expect_err("two and one").to_string();
    assert_eq!(short, "`i` must have as many entries as `c`, 2, not 1");
    let springs = Springs::from_values(&[&[1.0, 2.0], &[2.0, 4.0], &[2.0]], Inversion::Refuse)?;
    assert_eq!(springs, Springs::new([1.0, 2.0], [2, 4], 2)?);
    assert_eq!((springs.n(), springs.m()), ([2, 4], 2));
    Ok(())
}

#[test]
fn a_description_tells_exponents() {
    let parameters = Series::DESCRIPTION.parameters;
    let forms: Vec<_> = parameters.iter().map(|parameter| (parameter.form, parameter.unit)).collect();
    let [pascal, none] = [Unit::Pascal, Unit::Dimensionless].map(Some);
    let exponents = (Form::Exponents, none);
    assert_eq!(forms, [(Form::List, pascal), exponents, exponents, (Form::Number, pascal)]);
    assert_eq!(
        Springs::DESCRIPTION.parameters.last().map(|m| (m.form, m.is_list())),
        Some((Form::Exponent, false))
    );
}

#[test]
fn coefficients_have_derivatives_and_exponents_zeros() -> Result<(), MaterialError> {
    let (series, written) = (series()?, written()?);
    for stretches in stretches() {
        let found = series.gradient_by_parameters(stretches);
        let expected = written.gradient_by_parameters(stretches);
        let (coefficients, others) = found.split_at(9);
        let (exponents, bulk) = others.split_at(18);
        assert!(exponents.iter().all(|derivative| *derivative == [0.0; 3]));
        for (found, expected) in coefficients.iter().chain(bulk).zip(&expected) {
            check(found, expected, 3.0, &format!("{stretches:?}"));
        }
    }
    let values = series.values();
    let lists: Vec<&[f64]> = values.iter().map(|list| &**list).collect();
    assert_eq!(Series::from_values(&lists, Inversion::Refuse)?, series);
    Ok(())
}
