//! The rule on strains: the gradient near rest against that by stretches.

use super::evaluation::{blocks_at, gradient_at, gradient_at_strains, is_admitted};
use super::samples::at_samples;
use super::{Finding, Rule, Settings, UNIT, Violation, gradient_name, stress_scale};
use crate::material::Material;

/// Agreement of `gradient_at_strains` at s with `gradient` at 1 + s, to the rounding of 1 + s: for strains of
/// samples with λ3 > 0, and these times 10⁻¹ … 10⁻¹⁵ and 0.
///
/// # Errors
/// [`Violation`]: the first that is found.
pub fn strains(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Strains, material, settings, |judge, stretches, _| {
        if stretches[2] <= 0.0 {
            return Ok(());
        }
        for exponent in 0..=16 {
            let factor = if exponent == 16 { 0.0 } else { 10f64.powi(-exponent) };
            let strains = stretches.map(|l| factor * (l - 1.0));
            let stretches = strains.map(|s| 1.0 + s);
            if !is_admitted(material, stretches) {
                continue;
            }
            let found = gradient_at_strains(material, strains);
            let expected = gradient_at(material, stretches);
            let tolerance = 100.0 * UNIT * stress_scale(&blocks_at(material, stretches), stretches);
            for k in 0..3 {
                let name = || format!("{}, from the strain {:e}", gradient_name(k), strains[k]);
                judge.compare(name, stretches, found[k], expected[k], tolerance)?;
            }
        }
        Ok(())
    })
}
