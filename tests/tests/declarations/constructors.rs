//! What constructors refuse, and with which message.

use piola::Inversion;
use piola_tests::declarations::{Sample, slices, values};

const EXTEND: Inversion = Inversion::Extend { epsilon: 0.5 };

/// What must be refused is, and what a material is made of is what it returns.
pub(crate) fn judge(sample: &Sample) {
    let energy = &sample.judged.energy;
    let extension = Inversion::Extend { epsilon: 0.1 };
    for (word, inversion) in [("refuses", Inversion::Refuse), ("refuses-extension", extension)] {
        for remark in sample.text.remarks(word) {
            let (given, expected) = remark.split_once(": ").expect("values and a message");
            let error = energy.material(&slices(&values(given)), inversion).expect_err(given).to_string();
            assert!(error.contains(expected), "{given}: {error}");
        }
    }
    for values in sample.values() {
        let material = energy.material(&slices(&values), Inversion::Refuse).expect("admissible");
        if !sample.has_functions() {
            assert_eq!(energy.values(&material), values);
        }
        assert_eq!(energy.with_values(&material, &energy.values(&material)).as_ref(), Ok(&material));
    }
}

/// What no remark of a text says: messages about the energies of the catalogue, and by name.
pub(crate) fn compiled_ones_refuse_what_is_inadmissible() {
    let message = |name: &str, values: &[&[f64]], inversion| {
        // Of the compiled constructor: the lists of the catalogue have a few lengths only.
        let entry = piola_materials::find(name).expect("compiled by default");
        entry.material(values, inversion).err().map(|error| error.to_string()).unwrap_or_default()
    };
    let check =
        |found: String, expected: &str| assert!(found.contains(expected), "{found}\nlacks {expected}");
    let plain = Inversion::Refuse;
    check(message("st_venant_kirchhoff", &[&[1.0], &[-1.0]], plain), "bulk modulus is");
    check(message("st_venant_kirchhoff", &[&[1.0]], plain), "2 parameters are expected: `mu`, `lambda`");
    check(
        message("st_venant_kirchhoff", &[&[1.0], &[1.0]], EXTEND),
        "StVenantKirchhoff has no extension beyond its domain: it is defined for every deformation gradient already",
    );
    check(
        message("mooney_rivlin", &[&[1.0], &[1.0], &[1.0]], EXTEND),
        "do not push a collapsed point open; use `Inversion::Refuse`",
    );
    check(message("ogden", &[&[1.0, 1.0], &[2.0], &[1.0]], plain), "`alpha` must have 2 entries");
    check(message("ogden", &[&[1.0; 4], &[2.0; 4], &[1.0]], plain), "have 1, 2, 3 entries by name, not 4");
    for epsilon in [-0.1, 0.0, 1.0, 1.5, f64::INFINITY, f64::NAN] {
        let found = message("neo_hookean", &[&[1.0], &[1.0]], Inversion::Extend { epsilon });
        check(found, &format!("threshold epsilon is {epsilon}; it must satisfy 0 < epsilon < 1"));
    }
    for epsilon in [f64::MIN_POSITIVE, 1.0 - f64::EPSILON] {
        assert_eq!(message("neo_hookean", &[&[1.0], &[1.0]], Inversion::Extend { epsilon }), "");
    }
    // At rest the stress is f′(1) + 2 g′(1) + h′(1), of straight lines here: 4 − 6 + h′(1).
    let spline =
        |h: &[f64]| message("stretch_spline", &[&[0.5, 0.0, 1.5, 8.0], &[0.5, -3.0, 1.5, -3.0], h], plain);
    check(spline(&[0.5, 0.0, 1.5, 6.0]), "the rest state would carry a stress of 1 Pa");
    assert_eq!(spline(&[0.5, -1.0, 1.5, 5.0]), "");
}
