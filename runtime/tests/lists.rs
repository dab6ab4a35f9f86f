//! Lists whose lengths are known at run time, compared with the same energies with lengths known to the
//! compiler.
#![cfg(feature = "batch")]

use piola::__private::random::Random;
use piola::batch::Batch;
use piola::lanes::Backend;
use piola::material::{Argument, Blocks, Declared, Fittable, Form, Limit, MaterialError};
use piola::{Inversion, Material, material};

/// Ogden's sum.
#[material(domain(J > 0.0), admissible(mu[p] != 0.0), extend(mu[p] * alpha[p] * kappa > 0.0), fit)]
fn Ogden<const N: usize>(
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

/// Ogden's sum of any number of terms.
#[material(domain(J > 0.0), admissible(mu[p] != 0.0), extend(mu[p] * alpha[p] * kappa > 0.0), fit)]
fn Terms(
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

/// Two lists of independent lengths and an array.
#[material(domain(J > 0.0), fit)]
fn Groups(
    [l1, l2, l3]: [f64; 3],
    /** Pa. */
    a: Vec<f64>,
    /** Pa. */
    b: std::vec::Vec<f64>,
    /** Pa. */
    c: [f64; 2],
) -> f64 {
    sum(|p| a[p]) * (I1 - 3.0 - 2.0 * J.ln())
        + sum(|q| b[q]) * (J - 1.0).powi(2)
        + sum(|p| c[p]) * (I1 - 3.0 - 2.0 * J.ln()).powi(2)
}

piola::contract!(terms: Terms::new(vec![6.3e5, 1.2e3, 1e4], vec![1.3, 5.0, 2.0], 2e6)?);
piola::contract!(
    extended_terms: Terms::new(vec![6.3e5, 1e4], vec![1.3, 2.0], 2e6)?
        .with_inversion(Inversion::Extend { epsilon: 0.1 })?,
    range: (0.2, 4.0),
);
piola::contract!(groups: Groups::new(vec![1e5; 3], vec![1e6], [1e4, 2e4])?);

const MU: [f64; 7] = [6.3e5, 1.2e3, 1e4, 7.7e2, 3.1e4, 1e3, 5.5e4];
const ALPHA: [f64; 7] = [1.3, 5.0, 2.0, 3.7, 1.1, 8.2, 0.4];

fn bits<const K: usize>(numbers: [f64; K]) -> [u64; K] {
    numbers.map(f64::to_bits)
}

fn same_bits<const N: usize>(inversion: Inversion) -> Result<(), MaterialError> {
    let mu: [f64; N] = core::array::from_fn(|p| MU[p]);
    let alpha: [f64; N] = core::array::from_fn(|p| ALPHA[p]);
    let array = Ogden::new(mu, alpha, 2e6)?.with_inversion(inversion)?;
    let vector = Terms::new(mu.to_vec(), alpha.to_vec(), 2e6)?.with_inversion(inversion)?;

    let mut random = Random::new(7);
    let points: Vec<f64> =
        (0..9 * 70).map(|k| if k % 9 % 4 == 0 { 1.0 } else { 0.0 } + random.uniform(-0.3, 0.3)).collect();
    for stretches in points.chunks(3).map(|three| [three[0], three[1], three[2]].map(|l| l.abs() + 0.3)) {
        assert_eq!(array.energy(stretches).to_bits(), vector.energy(stretches).to_bits());
        assert_eq!(bits(array.gradient(stretches)), bits(vector.gradient(stretches)));
        let [a, b] = [array.blocks(stretches), vector.blocks(stretches)];
        let all = |Blocks { gradient, hessian, flip, twist }: Blocks<f64>| {
            (bits(gradient), bits(hessian), bits(flip), bits(twist))
        };
        assert_eq!(all(a), all(b));
        let strains = stretches.map(|l| l - 1.0);
        assert_eq!(bits(array.gradient_at_strains(strains)), bits(vector.gradient_at_strains(strains)));
        let [a, b] = [array.gradient_by_parameters(stretches), vector.gradient_by_parameters(stretches)];
        assert_eq!(a, b);
    }
    assert_eq!(array.constraints(), vector.constraints());
    for backend in Backend::available() {
        let tangents = |batch: Batch<'_, f64>| {
            let count = points.len() / 9;
            let (mut stresses, mut tangents) = (vec![0.0; 9 * count], vec![0.0; 81 * count]);
            let survey = batch.with_backend(backend).tangents(&points, &mut stresses, &mut tangents);
            let numbers = stresses.into_iter().chain(tangents).map(f64::to_bits).collect::<Vec<_>>();
            (survey.expect("slices of one number of points"), numbers)
        };
        assert!(tangents(Batch::new(&array)) == tangents(Batch::new(&vector)), "{backend:?}, {N} terms");
    }
    Ok(())
}

#[test]
fn a_list_of_any_length_gives_the_bits_of_an_array() -> Result<(), MaterialError> {
    for inversion in [Inversion::Refuse, Inversion::Extend { epsilon: 0.2 }] {
        same_bits::<1>(inversion)?;
        same_bits::<2>(inversion)?;
        same_bits::<3>(inversion)?;
        same_bits::<7>(inversion)?;
    }
    Ok(())
}

#[test]
fn lists_that_are_read_together_are_equally_long() -> Result<(), MaterialError> {
    let shape = |expected: &str| Some(MaterialError::Shape { expected: expected.to_owned() });
    let message = "`alpha` must have as many entries as `mu`, 3, not 2";
    assert_eq!(Terms::new(vec![1.0; 3], vec![2.0; 2], 1.0).err(), shape(message));
    let values: [&[f64]; 3] = [&[1.0; 3], &[2.0; 2], &[1.0]];
    assert_eq!(Terms::from_values(&values, Inversion::Refuse).err(), shape(message));
    let values: [&[f64]; 3] = [&[1.0; 3], &[2.0; 3], &[1.0; 2]];
    assert_eq!(Terms::from_values(&values, Inversion::Refuse).err(), shape("`kappa` must be one number"));
    // Those of other sums have lengths of their own.
    Groups::new(vec![1.0; 3], vec![2.0], [0.0, 1.0])?;
    Ok(())
}

#[test]
fn an_empty_list_is_a_sum_without_terms() -> Result<(), MaterialError> {
    let [without, with_zero] = [vec![], vec![0.0]].map(|b| Groups::new(vec![1.0], b, [0.0; 2]));
    assert_eq!(without?.gradient([2.0, 1.0, 0.7]), with_zero?.gradient([2.0, 1.0, 0.7]));
    let nothing = Terms::new(vec![], vec![], 1.0);
    assert!(matches!(nothing, Err(MaterialError::UnstableRest { .. })), "{nothing:?}");
    Ok(())
}

#[test]
fn every_entry_is_checked() -> Result<(), MaterialError> {
    let message = |material: Result<Terms, MaterialError>| material.expect_err("no material").to_string();
    let infinite = message(Terms::new(vec![1.0, f64::INFINITY], vec![2.0; 2], 1.0));
    assert!(infinite.starts_with("`mu[1]` is inf"), "{infinite}");
    let zero = message(Terms::new(vec![1.0, 0.0], vec![2.0; 2], 1.0));
    assert_eq!(zero, "`mu[p] != 0` must hold, but mu[1] = 0");
    let terms = Terms::new(vec![3.0, -1.0], vec![2.0, 1.0], 4.0)?;
    let collapses = message(terms.with_inversion(Inversion::Extend { epsilon: 0.1 }));
    assert!(collapses.contains("mu[1] = -1, alpha[1] = 1, kappa = 4"), "{collapses}");
    Ok(())
}

#[test]
fn a_material_lends_its_lists_and_replaces_them() -> Result<(), MaterialError> {
    let terms = Terms::new(vec![3.0, 1.0], vec![2.0, 1.0], 4.0)?;
    let (mu, alpha): (&[f64], &[f64]) = (terms.mu(), terms.alpha());
    assert_eq!((mu, alpha, terms.kappa()), (&[3.0, 1.0][..], &[2.0, 1.0][..], 4.0));
    let values = terms.values();
    assert_eq!(values, [&[3.0, 1.0][..], &[2.0, 1.0], &[4.0]]);
    let lists: Vec<&[f64]> = values.iter().map(|list| &**list).collect();
    assert_eq!(Terms::from_values(&lists, Inversion::Refuse)?, terms);
    let replaced = terms.clone().with_mu(vec![3.0, 2.0])?;
    assert_eq!(replaced.mu(), [3.0, 2.0]);
    assert!(terms.with_mu(vec![3.0; 3]).is_err());
    Ok(())
}

#[test]
fn a_description_tells_lists() {
    let description = Terms::DESCRIPTION;
    let forms = description.parameters.iter().map(|parameter| parameter.form);
    assert_eq!(forms.collect::<Vec<_>>(), [Form::List, Form::List, Form::Number]);
    let fixed = Ogden::<2>::DESCRIPTION;
    assert_eq!(Terms::DESCRIPTION.formula, fixed.formula);
    assert_eq!(Terms::DESCRIPTION.moduli, fixed.moduli);
}

#[test]
fn constraints_are_as_many_as_entries() -> Result<(), MaterialError> {
    let limits = Groups::new(vec![1.0; 2], vec![2.0; 3], [0.0; 2])?.constraints();
    assert_eq!(limits.len(), 2);
    assert_eq!((limits[0].limit.clone(), limits[0].gradient.len()), (Limit::ShearModulus, 7));
    Ok(())
}

/// Rubber that locks at a power of a stretch.
#[material(domain(J > 0.0, I1b < lm.powi(n)), fit)]
fn Locking([l1, l2, l3]: [f64; 3], mu: f64, lm: f64, n: u32, kappa: f64) -> f64 {
    -mu * (lm.powi(n) - I1b).ln() + kappa / 2.0 * (J - 1.0).powi(2)
}

/// Rubber that locks at a sum.
#[material(domain(J > 0.0, l1 > 0.1 * k, I1b < sum(|p| m[p])))]
fn LockingAtSum([l1, l2, l3]: [f64; 3], k: f64, m: Vec<f64>) -> f64 {
    -(sum(|p| m[p]) - I1b).ln() + k * (J - 1.0).powi(2)
}

/// A bound that a condition on a parameter implies, one without parameters, and one of stretches alone.
#[material(domain(J > 0.0, I1b - 3.0 < jm, I1b < 1e3, J < 1e3), admissible(jm > 0.0))]
fn Implied([l1, l2, l3]: [f64; 3], jm: f64) -> f64 {
    -jm * (1.0 - (I1b - 3.0) / jm).ln() + jm * (J - 1.0).powi(2)
}

#[test]
fn a_material_that_would_refuse_rest_is_not_made() {
    let outside = |condition: &'static str, given: &[Argument]| MaterialError::RestOutside {
        condition: condition.into(),
        given: given.to_vec(),
    };
    let given = |lm, n| [Argument::scalar("lm", lm), Argument::scalar("n", n)];
    assert_eq!(Locking::new(1.0, 1.5, 2, 1.0).err(), Some(outside("I1b < lm.powi(n)", &given(1.5, 2.0))));
    let solid = Locking::new(1.0, 1.5, 3, 1.0).expect("1.5³ is above 3");
    assert!(solid.admits([1.0f64; 3]));
    assert_eq!(solid.with_lm(1.25).err(), Some(outside("I1b < lm.powi(n)", &given(1.25, 3.0))));
    let values: [&[f64]; 4] = [&[1.0], &[1.0], &[1.0], &[1.0]];
    assert!(Locking::from_values(&values, Inversion::Refuse).is_err());

    let solid = LockingAtSum::new(1.0, vec![1.0, 2.5]).expect("3.5 is above 3");
    assert!(solid.admits([1.0f64; 3]));
    let error = LockingAtSum::new(1.0, vec![1.0, 2.0]).expect_err("3 is not above 3");
    assert_eq!(error, outside("I1b < sum(|p| m[p])", &[]));
    let error = LockingAtSum::new(10.0, vec![4.0]).expect_err("1 is not above 1");
    assert_eq!(error, outside("l1 > 0.1 * k", &[Argument::scalar("k", 10.0)]));
    assert!(error.to_string().contains("`l1 > 0.1 * k` must hold there too, but k = 10; change"), "{error}");

    assert!(matches!(Implied::new(0.0), Err(MaterialError::Violated { .. })));
    assert!(Implied::new(1e-9).is_ok_and(|solid| solid.admits([1.0f64; 3])));
}
