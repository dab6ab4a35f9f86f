//! Moduli, splines and materials come back from JSON with the same bits (feature `serde`).
#![cfg(feature = "serde")]

use std::fmt::Debug;

use piola::material::Moduli;
use piola::{Inversion, Spline, material};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The text of a value that comes back equal, and as the same text: the same bits except for NaN, which JSON
/// has not.
#[track_caller]
fn check<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> String {
    let text = serde_json::to_string(value).expect("serialises");
    let back: T = serde_json::from_str(&text).expect("deserialises");
    assert_eq!(back, *value);
    assert_eq!(serde_json::to_string(&back).expect("serialises"), text);
    text
}

#[test]
fn materials_are_written_as_their_parameters() -> Result<(), Box<dyn std::error::Error>> {
    check(&Moduli::from_young_poisson(1e6, 0.3)?);
    assert_eq!(check(&Inversion::Refuse), r#""refuse""#);
    assert_eq!(check(&Inversion::Extend { epsilon: 0.1 }), r#"{"extend":{"epsilon":0.1}}"#);
    let spline = Spline::through(&[[0.5, -2e5 / 3.0], [1.0, 0.0], [2.0, 1e5]])?;
    assert_eq!(check(&spline), "[[0.5,-66666.66666666667],[1.0,0.0],[2.0,100000.0]]");
    let error = serde_json::from_str::<Spline>("[[1.0, 0.0], [0.5, 2.0]]").expect_err("not in order");
    assert!(error.to_string().contains("increasing order of x"), "{error}");
    Ok(())
}

/// Ogden's sum, with a list of any length.
#[material(domain(J > 0.0), admissible(mu[p] * alpha[p] > 0.0), extend, serde)]
fn Mixed<const N: usize>([l1, l2, l3]: [f64; 3], mu: [f64; N], alpha: [f64; N], K: f64) -> f64 {
    sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
        - sum(|p| mu[p]) * J.ln()
        + K / 2.0 * (J - 1.0).powi(2)
}

/// Ogden's sum, with lists whose lengths are known at run time.
#[material(domain(J > 0.0), extend, serde)]
fn Terms([l1, l2, l3]: [f64; 3], mu: Vec<f64>, alpha: Vec<f64>, K: f64) -> f64 {
    sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0))
        - sum(|p| mu[p]) * J.ln()
        + K / 2.0 * (J - 1.0).powi(2)
}

/// A polynomial with its exponents as data.
#[material(prestressed, serde)]
fn Polynomial([l1, l2, l3]: [f64; 3], c: Vec<f64>, i: Vec<u32>, k: [u32; 2], d: [f64; 2], n: u32) -> f64 {
    sum(|p| c[p] * (I1 - 3.0).powi(i[p])) + sum(|p| d[p] * (I2 - 3.0).powi(k[p])) + (J - 1.0).powi(n)
}

/// Forces in each stretch, Pa.
#[material(serde)]
fn Drawn([l1, l2, l3]: [f64; 3], f: Spline) -> f64 {
    f(l1) + f(l2) + f(l3)
}

#[test]
fn declared_materials_come_back_checked() -> Result<(), Box<dyn std::error::Error>> {
    let inversion = Inversion::Extend { epsilon: 0.1 };
    let material = Mixed::new([6.3e5, -1e4 / 3.0], [1.3, -2.0], 2e7)?.with_inversion(inversion)?;
    let text = check(&material);
    let expected = r#"{"mu":[630000.0,-3333.3333333333335],"alpha":[1.3,-2.0],"K":20000000.0,"inversion":{"extend":{"epsilon":0.1}}}"#;
    assert_eq!(text, expected);
    let read = |text: &str| serde_json::from_str::<Mixed<1>>(text).map_err(|error| error.to_string());
    assert_eq!(read(r#"{"mu": [1e5], "alpha": [2], "K": 1e6}"#), Ok(Mixed::new([1e5], [2.0], 1e6)?));
    for (text, complaint) in [
        (r#"{"mu": [1e5], "alpha": [-2], "K": 1e6}"#, "mu[p] * alpha[p] > 0"),
        (r#"{"mu": [1e5, 2e5], "alpha": [2], "K": 1e6}"#, "`mu` must have 1 entries, not 2"),
        (r#"{"mu": [1e5], "alpha": [2]}"#, "missing field `K`"),
        (r#"{"mu": [1e5], "alpha": [2], "K": 1e6, "kappa": 1}"#, "unknown field `kappa`"),
        (r#"{"mu": [1e5], "alpha": [2], "K": 1e6, "inversion": {"extend": {"epsilon": 2}}}"#, "2"),
    ] {
        let error = read(text).expect_err(complaint);
        assert!(error.contains(complaint), "{error}");
    }
    let terms = Terms::new(vec![6.3e5, -1e4 / 3.0], vec![1.3, -2.0], 2e7)?.with_inversion(inversion)?;
    assert_eq!(check(&terms), expected);
    let error = serde_json::from_str::<Terms>(r#"{"mu": [1e5, 2e5], "alpha": [2], "K": 1e6}"#);
    let error = error.expect_err("two and one").to_string();
    assert!(error.starts_with("`alpha` must have as many entries as `mu`, 2, not 1"), "{error}");
    let text = check(&Polynomial::new(vec![1.5, 2.0], vec![1, 2], [0, 3], [1.0, 2.5], 2)?);
    assert_eq!(text, r#"{"c":[1.5,2.0],"i":[1,2],"k":[0,3],"d":[1.0,2.5],"n":2}"#);
    for (old, new, complaint) in [
        ("[1,2]", "[1,65]", "`i[1]` is 65"),
        ("[1,2]", "[1,-1]", "u32"),
        ("[0,3]", "[0]", "`k` must have 2 entries, not 1"),
    ] {
        let error = serde_json::from_str::<Polynomial>(&text.replace(old, new)).expect_err(complaint);
        assert!(error.to_string().contains(complaint), "{error}");
    }
    check(&Drawn::new(Spline::through(&[[0.5, -2e5], [1.0, 0.0], [2.0, 1e5 / 3.0]])?)?);
    Ok(())
}
