//! The rule on strains: the gradient near rest against that by stretches.

use super::samples::at_samples;
use super::subject::Subject;
use super::{Finding, Rule, Settings, UNIT, Violation, gradient_name, stress_scale};

/// [`Rule::Strains`].
pub(super) fn strains(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Strains, material, settings, |judge, stretches, _| {
        if stretches[2] <= 0.0 {
            return Ok(());
        }
        for exponent in 0..=16 {
            let factor = if exponent == 16 { 0.0 } else { 10f64.powi(-exponent) };
            let strains = stretches.map(|l| factor * (l - 1.0));
            let stretches = strains.map(|s| 1.0 + s);
            if !material.admits(stretches) {
                continue;
            }
            let found = material.gradient_at_strains(strains);
            let expected = material.gradient(stretches);
            let tolerance = 100.0 * UNIT * stress_scale(&material.blocks(stretches), stretches);
            for k in 0..3 {
                let name = || format!("{}, from the strain {:e}", gradient_name(k), strains[k]);
                judge.compare(name, stretches, found[k], expected[k], tolerance)?;
            }
        }
        Ok(())
    })
}
