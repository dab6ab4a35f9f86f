//! Every energy compared with an interpreter of its own declaration: parser, derivatives, quotients, schedule
//! and emission at once, in `f64` and `f32`.

use piola::Inversion;
use piola::Real;
use piola::material::{Blocks, MaterialError};
use piola_codegen::algebra::expr::Id;
use piola_codegen::algebra::interpret::{Estimate, Point, evaluate};
use piola_codegen::model::{Model, Variant};
use piola_codegen::read::domain::Volume;
use piola_tests::declarations::{Sample, slices};
use piola_tests::declared::understood;
use piola_tests::energies::{Format, Subject};

pub(crate) fn judge(sample: &Sample) {
    let (declaration, model) = understood(&sample.text.source).expect("one declaration");
    crate::powers::judge(sample, &model);
    crate::printed::judge(sample, &model);
    // What a function that is a parameter computes is unknown to the interpreter; the contract judges it.
    if declaration.has_functions() {
        return;
    }
    let energy = sample.judged;
    let mut judged = 0;
    for point in &model.samples {
        let variants = [(Inversion::Refuse, Some(&model.plain)), (EXTEND, model.extended.as_ref())];
        for (inversion, variant) in variants {
            let Some(variant) = variant else { continue };
            let judge = Judge { name: energy.name, model: &model, variant, sample: point };
            match energy.subject(&slices(&point.parameters), inversion) {
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
            self.check::<f64>(subject, &point);
            self.check::<f32>(subject, &point);
        }
        let moduli = subject.moduli;
        for (id, value) in self.model.moduli.into_iter().zip([moduli.mu, moduli.lambda]) {
            let expected = evaluate(&self.model.graph, id, self.sample);
            self.close("modulus", expected, value, 64.0 * f64::UNIT_ROUNDOFF, self.sample);
        }
    }

    /// Within 256 u of the magnitudes that enter, exponents included: a count of operations, generously.
    fn check<R: Format>(&self, subject: &Subject, point: &Point) {
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
                self.close(what, expected, value.widen(), 256.0 * R::UNIT_ROUNDOFF, point);
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

/// λ1 ≥ λ2 ≥ |λ3|, as a material may expect them.
fn ordered(stretches: [f64; 3]) -> [f64; 3] {
    let sign = stretches.iter().product::<f64>().signum();
    let mut magnitudes = stretches.map(f64::abs);
    magnitudes.sort_by(|a, b| b.total_cmp(a));
    [magnitudes[0], magnitudes[1], sign * magnitudes[2]]
}
