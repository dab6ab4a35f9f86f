//! Every material of the catalogue against an interpreter of its own declaration: parser, derivatives,
//! quotients, schedule and emission at once, in `f64` and `f32`.

use piola::Inversion;
use piola::Real;
use piola::material::{Blocks, MaterialError};
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{Estimate, Point, evaluate};
use piola_codegen::model::{Model, Variant, model};
use piola_codegen::read::domain::Volume;
use piola_codegen::read::parse::Declaration;
use piola_materials::CATALOGUE;
use piola_tests::declared::declarations;
use piola_tests::energies::{ENERGIES, Format, Subject};

/// The declarations of the catalogue crate, understood.
fn models() -> Vec<(Declaration, Model)> {
    let understood = |declaration| {
        let model = model(&declaration).expect("an energy");
        (declaration, model)
    };
    declarations().expect("the catalogue's sources").into_iter().map(understood).collect()
}

#[test]
fn the_catalogue_is_complete_and_sorted() {
    let declared: Vec<_> =
        models().into_iter().map(|(declaration, _)| declaration.name.to_string()).collect();
    for name in &declared {
        assert!(
            ENERGIES.iter().any(|energy| energy.description().name == *name),
            "{name} is not in the catalogue"
        );
    }
    assert_eq!(declared.len(), ENERGIES.len());
    assert!(ENERGIES.is_sorted_by_key(|energy| energy.name), "energies stand in the order of their names");
    assert!(CATALOGUE.is_sorted_by_key(|entry| entry.name), "entries stand in the order of their names");
    for energy in ENERGIES.iter() {
        let (name, description) = (energy.name, energy.description());
        assert!(!description.summary.is_empty() && !description.formula.is_empty(), "{name} is documented");
        for parameter in description.parameters.iter() {
            assert!(!parameter.doc.is_empty(), "{name}: {} is documented", parameter.name);
        }
    }
}

#[test]
fn compiled_materials_compute_what_they_declare() {
    // What a function that is a parameter computes is unknown to the interpreter; contract and oracles judge
    // those.
    for (declaration, model) in models().into_iter().filter(|(declared, _)| !declared.has_functions()) {
        let energy = ENERGIES
            .iter()
            .find(|energy| declaration.name == energy.description().name)
            .expect("in the catalogue");
        let mut judged = 0;
        for sample in &model.samples {
            let values: Vec<&[f64]> = sample.parameters.iter().map(Vec::as_slice).collect();
            let variants = [(Inversion::Refuse, Some(&model.plain)), (EXTEND, model.extended.as_ref())];
            for (inversion, variant) in variants {
                let Some(variant) = variant else { continue };
                let judge = Judge { name: energy.name, model: &model, variant, sample };
                match energy.subject(&values, inversion) {
                    Ok(subject) => {
                        judge.judge(&subject);
                        judged += 1;
                    }
                    // Random parameters need not make a stable or restoring solid.
                    Err(MaterialError::UnstableRest { .. } | MaterialError::DoesNotRestore { .. }) => {}
                    Err(error) => panic!("{}: {error}", energy.name),
                }
            }
        }
        assert!(judged >= 3, "{}: only {judged} samples could be judged", energy.name);
    }
}

const EPSILON: f64 = 0.5; // as in the samples
const EXTEND: Inversion = Inversion::Extend { epsilon: EPSILON };

struct Judge<'a> {
    name: &'a str,
    model: &'a Model,
    variant: &'a Variant,
    sample: &'a Point,
}

impl Judge<'_> {
    fn judge(&self, subject: &Subject) {
        let is_extended = self.variant.has_pole && self.model.volume != Volume::Any;
        let mut points = vec![ordered(self.sample.stretches)];
        if is_extended {
            points.extend([
                [1.2, 0.7, -0.3],
                [0.8, 0.3, 0.1],
                [0.45, 0.3, -0.1],
                [1.3, 0.7, 0.7],
                [0.3, 0.3, 0.3],
            ]);
        }
        for stretches in points {
            let point = Point { stretches, ..self.sample.clone() };
            self.check::<f64>(subject, &point, 256.0);
            self.check::<f32>(subject, &point, 256.0);
        }
        let moduli = subject.moduli;
        for (id, value) in self.model.moduli.into_iter().zip([moduli.mu, moduli.lambda]) {
            let expected = evaluate(&self.model.graph, id, self.sample);
            self.close("modulus", expected, value, 64.0 * f64::UNIT_ROUNDOFF, self.sample);
        }
    }
}

/// λ1 ≥ λ2 ≥ |λ3|, as a material may expect them.
fn ordered(stretches: [f64; 3]) -> [f64; 3] {
    let sign = stretches.iter().product::<f64>().signum();
    let mut magnitudes = stretches.map(f64::abs);
    magnitudes.sort_by(|a, b| b.total_cmp(a));
    [magnitudes[0], magnitudes[1], sign * magnitudes[2]]
}

impl Judge<'_> {
    /// Within `roundings` times u of the magnitudes that enter, exponents included: a count of operations,
    /// generously.
    fn check<R: Format>(&self, subject: &Subject, point: &Point, roundings: f64) {
        let material = R::of(subject);
        let stretches = point.stretches.map(R::splat);
        let Blocks { gradient, hessian, flip, twist } = material.blocks(stretches);
        let energy = [material.energy(stretches)];
        let alone = material.gradient(stretches);
        let groups: [(&str, &[Id], &[R]); 6] = [
            ("ψ", &[self.variant.energy], &energy),
            ("gradient alone", &self.variant.gradient, &alone),
            ("gradient", &self.variant.gradient, &gradient),
            ("Hessian", &self.variant.hessian, &hessian),
            ("flip", &self.variant.flip, &flip),
            ("twist", &self.variant.twist, &twist),
        ];
        for (what, ids, values) in groups {
            for (&id, &value) in ids.iter().zip(values) {
                let expected = evaluate(&self.model.graph, id, point);
                self.close(what, expected, value.widen(), roundings * R::UNIT_ROUNDOFF, point);
            }
        }
    }

    fn close(&self, what: &str, expected: Estimate, value: f64, tolerance: f64, point: &Point) {
        let error = (value - expected.value).abs();
        assert!(
            error <= tolerance * expected.magnitude,
            "{}: {what} is {value:e}, not {:e}, at {:?} with {:?}",
            self.name,
            expected.value,
            point.stretches,
            point.parameters
        );
    }
}

#[test]
fn constructors_refuse_what_is_inadmissible() {
    let message = |name: &str, values: &[&[f64]], inversion| {
        // Of the compiled constructor: the lists of the catalogue have a few lengths only.
        let entry = piola_materials::find(name).expect("compiled by default");
        entry.moduli(values, inversion).err().map(|error| error.to_string()).unwrap_or_default()
    };
    let check =
        |found: String, expected: &str| assert!(found.contains(expected), "{found}\nlacks {expected}");
    let plain = Inversion::Refuse;
    check(
        message("st_venant_kirchhoff", &[&[f64::NAN], &[1.0]], plain),
        "`mu` is NaN; it must be a finite number",
    );
    check(
        message("ogden", &[&[1.0, 1.0], &[2.0, f64::INFINITY], &[1.0]], plain),
        "`alpha[1]` is inf; it must",
    );
    check(message("st_venant_kirchhoff", &[&[-1.0], &[1.0]], plain), "`mu > 0` must hold, but mu = -1");
    check(message("st_venant_kirchhoff", &[&[1.0], &[-1.0]], plain), "bulk modulus is");
    check(message("st_venant_kirchhoff", &[&[1.0]], plain), "2 parameters are expected: `mu`, `lambda`");
    check(message("st_venant_kirchhoff", &[&[1.0], &[1.0, 2.0]], plain), "`lambda` must be one number");
    check(
        message("st_venant_kirchhoff", &[&[1.0], &[1.0]], EXTEND),
        "StVenantKirchhoff has no extension beyond its domain: it is defined for every deformation gradient already",
    );
    check(
        message("mooney_rivlin", &[&[1.0], &[1.0], &[1.0]], EXTEND),
        "do not push a collapsed point open; use `Inversion::Refuse`",
    );
    check(
        message("ogden", &[&[1.0, 1.0], &[2.0, 0.0], &[1.0]], plain),
        "`alpha[p] != 0` must hold, but alpha[1] = 0",
    );
    check(message("ogden", &[&[1.0, 1.0], &[2.0], &[1.0]], plain), "`alpha` must have 2 entries");
    check(message("ogden", &[&[1.0; 4], &[2.0; 4], &[1.0]], plain), "have 1, 2, 3 entries by name, not 4");
    check(
        message("ogden", &[&[2.0, 1.0], &[2.0, -1.0], &[1.0]], EXTEND),
        "`mu[p] * alpha[p] > 0` must hold, but mu[1] = 1, alpha[1] = -1",
    );
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
