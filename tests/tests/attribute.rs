//! The declarations of `declarations/compiled.rs`, compiled by the attribute and at run time: equal results,
//! bit by bit, equal descriptions and equal refusals; and the typed constructors, which only a compiled type
//! has.
//!
//! The catalogue is compared in the same way by `interpreted.rs`.

use piola::__private::random::Random;
use piola::batch::{Batch, TileMaterial};
use piola::interpreter::Interpreted;
use piola::lanes::Backend;
use piola::material::{Argument, Declared, MaterialError, PerPoint};
use piola::{Inversion, Material};
use piola_tests::answers::{Answers, deformations};
use piola_tests::declarations::{find, slices, values};
use piola_tests::twins::{self, responses};

#[path = "../declarations/compiled.rs"]
mod declarations;

use declarations::{
    Elementary, Fixed, Functions, FunctionsOfInvariants, Groups, Implied, Invariant, Literal, Locking,
    LockingAtSum, Products, Roots, Series, Springs, Terms, Unit, Unlucky,
};

const EXTEND: Inversion = Inversion::Extend { epsilon: 0.2 };

/// Stretches of all kinds, those of a rest state and of a point without extent among them.
fn stretches() -> impl Iterator<Item = [f64; 3]> {
    let mut random = Random::new(7);
    let fixed = [[1.0, 1.0, 1.0], [1.3, 1.1, 0.7], [2.5, 2.5, 0.16], [1.2, 0.8, -0.3], [0.0; 3]];
    fixed.into_iter().chain((0..200).map(move |_| twins::stretches(&mut random)))
}

/// Compares a compiled type with the energy of the same text, at all values of its remarks.
#[track_caller]
fn check<M: Declared>() -> Vec<(M, Interpreted)> {
    let sample = find("compiled", &M::DESCRIPTION.name);
    let energy = &sample.judged.energy;
    assert_eq!(*energy.description(), M::DESCRIPTION);
    let mut judged = Vec::new();
    for values in sample.values() {
        for inversion in sample.judged.inversions(0.2) {
            let compiled = match M::from_values(&slices(&values), inversion) {
                // A list of another length.
                Err(MaterialError::Shape { .. }) => continue,
                compiled => compiled.map_err(|error| error.to_string()),
            };
            let interpreted = energy.material(&slices(&values), inversion).map_err(|error| error.to_string());
            let (compiled, interpreted) = match (compiled, interpreted) {
                (Ok(compiled), Ok(interpreted)) => (compiled, interpreted),
                (compiled, interpreted) => {
                    assert_eq!(compiled.err(), interpreted.err());
                    continue;
                }
            };
            for at in stretches() {
                let what = format!("{} {values:?} {inversion:?} at {at:?}", M::DESCRIPTION.name);
                twins::check(&what, &responses(&interpreted, at), &responses(&compiled, at));
            }
            judged.push((compiled, interpreted));
        }
    }
    assert!(!judged.is_empty(), "{}", M::DESCRIPTION.name);
    for (word, inversion) in [("refuses", Inversion::Refuse), ("refuses-extension", EXTEND)] {
        for remark in sample.text.remarks(word) {
            let (given, _) = remark.split_once(": ").expect("values and a message");
            let values = values(given);
            let refused = M::from_values(&slices(&values), inversion).map(|_| ());
            let by_text = energy.material(&slices(&values), inversion).map(|_| ());
            // As text, so that NaN equals itself. The message is judged by the test `declarations`.
            assert_eq!(format!("{refused:?}"), format!("{by_text:?}"), "{given}");
        }
    }
    judged
}

#[test]
fn types_and_texts_give_the_same_bits() {
    check::<Fixed<1>>();
    check::<Fixed<3>>();
    check::<Groups>();
    check::<Series>();
    check::<Locking>();
    check::<Springs>();
    check::<Products>();
    check::<LockingAtSum>();
    check::<Implied>();
    check::<Unlucky<2>>();
    check::<Unit>();
    check::<Invariant>();
    check::<Literal>();
    check::<Elementary>();
    check::<Roots>();
    check::<Functions>();
    check::<FunctionsOfInvariants>();
}

#[test]
fn lists_have_the_same_bits_on_lanes() {
    let points = deformations().concat();
    for (compiled, interpreted) in check::<Terms>() {
        for backend in Backend::available() {
            let materials: [&dyn TileMaterial<f64>; 2] = [&interpreted, &compiled];
            let [found, expected] =
                materials.map(|material| Answers::of(Batch::new(material).with_backend(backend), &points));
            assert_eq!(found.statuses, expected.statuses, "{backend}");
            twins::check(&format!("on {backend}"), &found.numbers(), &expected.numbers());
        }
    }
}

#[test]
fn lists_of_any_length_give_the_bits_of_arrays() -> Result<(), MaterialError> {
    let [mu, alpha] = [[6.3e5, 1.2e3, 1e4], [1.3, 5.0, 2.0]];
    for inversion in [Inversion::Refuse, EXTEND] {
        let array = Fixed::new(mu, alpha, 2e6)?.with_inversion(inversion)?;
        let vector = Terms::new(mu.to_vec(), alpha.to_vec(), 2e6)?.with_inversion(inversion)?;
        for at in stretches() {
            let what = format!("{inversion:?} at {at:?}");
            twins::check(&what, &responses(&array, at), &responses(&vector, at));
        }
    }
    Ok(())
}

#[test]
fn points_of_a_batch_have_lists_and_exponents_of_their_own() -> Result<(), MaterialError> {
    let short = Series::new(vec![2e5], vec![1], vec![0], 1e6)?;
    let long = Series::new(vec![1.8e5, 2.1e4, 3e3], vec![1, 0, 2], vec![0, 1, 0], 1e6)?;
    let (series, points) = ([short, long], deformations().concat());
    let energies = |series: &[Series], points: &[f64]| {
        let mut energies = vec![0.0; series.len()];
        let each = PerPoint::new(series).expect("alike");
        Batch::<f64>::new(&each).energies(points, &mut energies).expect("lengths");
        energies
    };
    let alone = [energies(&series[..1], &points[..9]), energies(&series[1..], &points[9..18])].concat();
    assert_eq!(energies(&series, &points[..18]), alone);
    Ok(())
}

#[test]
fn materials_lend_their_lists_and_replace_them() -> Result<(), MaterialError> {
    let terms = Terms::new(vec![3.0, 1.0], vec![2.0, 1.0], 4.0)?;
    let (mu, alpha): (&[f64], &[f64]) = (terms.mu(), terms.alpha());
    assert_eq!((mu, alpha, terms.kappa()), (&[3.0, 1.0][..], &[2.0, 1.0][..], 4.0));
    assert_eq!(Terms::from_values(&[&[3.0, 1.0], &[2.0, 1.0], &[4.0]], Inversion::Refuse)?, terms);
    let replaced = terms.clone().with_mu(vec![3.0, 2.0])?;
    assert_eq!(replaced.mu(), [3.0, 2.0]);
    assert!(terms.with_mu(vec![3.0; 3]).is_err());
    Groups::new(vec![1.0; 3], vec![2.0], [0.0, 1.0], [0.0])?;
    let springs = Springs::from_values(&[&[1.0, 2.0], &[2.0, 4.0], &[2.0]], Inversion::Refuse)?;
    assert_eq!(springs, Springs::new([1.0, 2.0], [2, 4], 2)?);
    assert_eq!((springs.n(), springs.m()), ([2, 4], 2));
    let series = Series::from_values(&[&[1.0, 2.0], &[1.0, 2.0], &[0.0; 2], &[1.0]], Inversion::Refuse)?;
    assert_eq!(series, Series::new(vec![1.0, 2.0], vec![1, 2], vec![0; 2], 1.0)?);
    let unlucky = Unlucky::new([1.0, 0.5], [2.5, 1.5], 2.0, 7.0)?;
    assert_eq!((unlucky.t0(), unlucky.epsilon(), unlucky.material()), ([1.0, 0.5], 2.0, 7.0));
    assert_eq!(Unit::from_values(&[], Inversion::Refuse).map(|unit| unit.moduli().mu), Ok(1.0));
    Ok(())
}

#[test]
fn typed_constructors_refuse_what_is_inadmissible() -> Result<(), MaterialError> {
    let number = |name: &'static str, value| Argument { parameter: name.into(), index: None, value };
    let not_whole = |name: &str, value: f64| {
        let message = format!("`{name}` is {value}; such an exponent must be a whole number from 0 to 64");
        Some(MaterialError::Other(message))
    };
    let large = Series::new(vec![1.0; 2], vec![1, 65], vec![0; 2], 1.0).err();
    assert_eq!(large, not_whole("i[1]", 65.0));
    assert_eq!(Springs::new([1.0; 2], [1, 2], 70).err(), not_whole("m", 70.0));
    let given = vec![number("lm", 1.25), number("n", 3.0)];
    let outside = MaterialError::RestOutside { condition: "I1b < lm.powi(n)".into(), given };
    let solid = Locking::new(1.0, 1.5, 3, 1.0)?;
    assert!(solid.admits([1.0f64; 3]));
    assert_eq!(solid.with_lm(1.25).err(), Some(outside));
    assert!(LockingAtSum::new(1.0, vec![1.0, 2.5])?.admits([1.0f64; 3]));
    assert!(Implied::new(1e-9).is_ok_and(|solid| solid.admits([1.0f64; 3])));
    Ok(())
}
