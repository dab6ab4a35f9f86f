//! The rule on invariants: energy and gradient by I1, I2 and J against those by stretches.

use super::samples::at_samples;
use super::subject::Subject;
use super::{Finding, Rule, Settings, UNIT, Violation, gradient_name, stress_scale};

/// [`Rule::Invariants`].
pub(super) fn invariants(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    let rule = Rule::Invariants;
    if !material.has_invariants() {
        return Err(Violation::DoesNotApply { rule, lacks: "energy by invariants" });
    }
    at_samples(rule, material, settings, |judge, stretches, _| {
        let [a, b, c] = stretches.map(|l| l * l);
        let invariants = [a + b + c, a * b + a * c + b * c, stretches.iter().product()];
        if !material.admits_invariants(invariants) {
            return Ok(());
        }
        let is_admitted = material.admits(stretches);
        let remedy =
            "the invariants of these stretches are admitted: narrow `admits_invariants`, or widen `admits`";
        judge.holds(|| "admission of the stretches".into(), stretches, is_admitted, remedy)?;

        let scale = stress_scale(&material.blocks(stretches), stretches);
        let expected = material.energy(stretches);
        let found = material.energy_by_invariants(invariants);
        let tolerance = 100.0 * UNIT * (scale * stretches[0] + expected.abs());
        judge.compare(|| "energy by invariants".into(), stretches, found, expected, tolerance)?;

        let gradient = material.gradient(stretches);
        let [w1, w2, wj] = material.gradient_by_invariants(invariants);
        for i in 0..3 {
            let [l, m, n] = [i, (i + 1) % 3, (i + 2) % 3].map(|k| stretches[k]);
            let terms = [2.0 * l * w1, 2.0 * l * (m * m + n * n) * w2, m * n * wj];
            let found = terms.iter().sum();
            // The terms cancel near rest, and each has its own roundings.
            let tolerance = 100.0 * UNIT * (scale + terms.iter().map(|term| term.abs()).sum::<f64>());
            let name = || format!("{}, from those by invariants", gradient_name(i));
            judge.compare(name, stretches, found, gradient[i], tolerance)?;
        }
        Ok(())
    })
}
