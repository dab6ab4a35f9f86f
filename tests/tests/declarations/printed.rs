//! What descriptions print, and the digits and domains of energies as papers print them.

use piola::interpreter::Interpreted;
use piola::material::{Blocks, Form, Unit};
use piola::{Inversion, Material};
use piola_codegen::model::{Limit, Model};
use piola_tests::compiled::evaluate_stress;
use piola_tests::declarations::{Sample, find};

/// The remarks about the printed forms.
pub(crate) fn judge(sample: &Sample, model: &Model) {
    let description = sample.judged.description();
    for formula in sample.text.remarks("formula") {
        assert!(description.formula.contains(formula), "{} lacks {formula}", description.formula);
    }
    for modulus in sample.text.remarks("shear-modulus") {
        assert_eq!(description.moduli[0], modulus);
    }
    assert!(sample.text.remarks("pole").next().is_none() || model.plain.has_pole);
    assert!(sample.text.remarks("no-pole").next().is_none() || !model.plain.has_pole);
}

fn material(file: &str, name: &str, values: &[&[f64]]) -> Interpreted {
    find(file, name).judged.energy.material(values, Inversion::Refuse).expect("admissible")
}

/// They contain rest, dilations and rotations.
pub(crate) fn domains_with_a_root_of_the_excess() {
    let root = material("printed", "VanDerWaals", &[&[1e5], &[2.1], &[1e6]]);
    let power = material("printed", "Ending", &[&[0.5]]);
    for k in 0..1000 {
        let a = 0.5 + 1.5 * f64::from(k) / 999.0;
        assert!(root.admits([a; 3]) && power.admits([a; 3]), "{a}");
        assert!(root.admits([a as f32; 3]) && power.admits([a as f32; 3]), "{a}");
        let diagonal = [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
        let [[s, c], [t, d]] = [f64::from(k), 1.7 * a].map(|angle| [angle.sin(), angle.cos()]);
        let rotation = [[c, -s, 0.0], [s * d, c * d, -t], [s * t, c * t, d]];
        for f in [diagonal, rotation] {
            for status in [&root, &power].map(|material| evaluate_stress(material, &f).status) {
                assert!(status.is_clean(), "{f:?}: {status:?}");
            }
        }
    }
    // I1b − 3 is 1.41 where the root is 1, at lm² − 3.
    assert!(root.admits([1.8f64, 0.745, 0.745]) && !root.admits([1.9f64, 0.725, 0.725]));
    assert!(!power.has_invariants() && !power.admits([1.5f64, 0.8, 0.8]));
}

pub(crate) fn a_small_constant_beside_the_excess() {
    for (n, c) in [(0.4f64, 1e-1f64), (0.4, 1e-3), (1.7, 1e-2), (0.5, 1e-4)] {
        // The slope of the power, and so little resistance to changes of volume that nothing cancels.
        let slope = n * (c * c).powf(n - 1.0);
        let kappa = 1e-3 * slope;
        let solid = material("printed", "Gregory", &[&[1.0], &[n], &[c], &[kappa]]);
        for k in 0..1000 {
            let l = 0.5 + 1.5 * f64::from(k) / 999.0;
            // D⁻12 of I1b at a dilation is 4/λ².
            let expected = 4.0 * slope / (l * l) - kappa * (l.powi(3) - 1.0) * l;
            for flip in solid.blocks([l; 3]).flip {
                let error = (flip / expected - 1.0).abs() / (f64::EPSILON / 2.0);
                assert!(error <= 30.0, "{flip} for {expected} at {l}, n = {n}, C = {c}: {error} u");
            }
        }
    }
}

pub(crate) fn fractions_that_cancel_on_flat_elements() {
    let [printed, by_hand] =
        ["FloryErman", "FloryErmanByHand"].map(|name| material("printed", name, &[&[4e5], &[2.59], &[2e7]]));
    for k in 1..=12 {
        let flat = 10f64.powi(-k);
        for stretches in [[1.3, 0.9, flat], [1.2, flat, 0.7 * flat], [3.0 / flat, 1.0, 0.9]] {
            let [found, expected] = [printed.blocks(stretches), by_hand.blocks(stretches)];
            let rows = |b: Blocks<f64>| {
                [&b.gradient[..], &[&b.hessian[..], &b.flip, &b.twist].concat()].map(<[f64]>::to_vec)
            };
            for (found, expected) in rows(found).into_iter().zip(rows(expected)) {
                let largest = expected.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    let error = (found - expected).abs() / (largest * f64::EPSILON / 2.0);
                    // Either formula errs by a few u; 5.2 u have been seen.
                    assert!(error <= 16.0, "{found} for {expected} at {stretches:?}: {error} u");
                }
            }
        }
    }
}

pub(crate) fn an_empty_list_is_a_sum_without_terms() {
    let groups = |b: &[f64]| material("compiled", "Groups", &[&[1.0], b, &[0.0; 2], &[0.0]]);
    assert_eq!(groups(&[]).gradient([2.0, 1.0, 0.7]), groups(&[0.0]).gradient([2.0, 1.0, 0.7]));
}

pub(crate) fn descriptions_tell_lists_and_exponents() {
    let parameters = |name: &str| {
        let parameters = find("compiled", name).judged.description().parameters.to_vec();
        parameters.iter().map(|parameter| (parameter.form, parameter.unit)).collect::<Vec<_>>()
    };
    let [pascal, none] = [Unit::Pascal, Unit::Dimensionless].map(Some);
    assert_eq!(parameters("Terms"), [(Form::List, pascal), (Form::List, none), (Form::Number, pascal)]);
    assert_eq!(parameters("Terms"), parameters("Fixed"));
    let [terms, fixed] = ["Terms", "Fixed"].map(|name| find("compiled", name).judged.description().clone());
    assert_eq!((terms.formula, terms.moduli), (fixed.formula, fixed.moduli));
    let exponents = (Form::Exponents, none);
    let series = [(Form::List, pascal), exponents, exponents, (Form::Number, pascal)];
    assert_eq!(parameters("Series"), series);
    assert_eq!(parameters("Springs").last().map(|m| m.0), Some(Form::Exponent));
    assert!(!find("compiled", "Springs").judged.description().parameters[2].is_list());
}

pub(crate) fn constraints_are_as_many_as_entries() {
    let groups = find("compiled", "Groups");
    let values = [&[1.0, 1.0][..], &[2.0; 3], &[0.0; 2], &[0.0]];
    let solid = groups.judged.energy.material(&values, Inversion::Refuse).expect("admissible");
    let limits = groups.judged.energy.constraints(&solid);
    assert_eq!(limits.len(), 2);
    assert_eq!((limits[0].limit.clone(), limits[0].gradient.len()), (Limit::ShearModulus, 8));
}
