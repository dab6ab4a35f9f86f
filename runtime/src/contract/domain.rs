//! The rule on a material's domain as it states it, which decides how exactly the sign of λ3 is found.

use super::evaluation::{energy_at, gradient_at, is_admitted};
use super::numbers::{name, numbers_alone};
use super::samples::at_samples;
use super::{Finding, Rule, Settings, Violation, gradient_name};
use crate::material::{Inversion, Material};

/// Finite results wherever the material is defined, and a true [`Material::ends_at_zero_volume`]:
///
/// * energy, gradient and blocks are finite at the samples, and so are energy and gradient where λ3 is only
///   2⁻¹⁰, 2⁻²⁰ and 2⁻³⁰ of λ1, of either sign, as far as such stretches are admitted;
/// * but at these small λ3 ψ may be +∞: an exponential in `I1b`, say, overflows as J falls, where the range
///   of numbers ends and not the domain. Such a point is `nonfinite`, and a solver takes a shorter step.
///   Where ψ > 2⁵¹² Pa, the root of the largest number, derivatives overflow before ψ does and are not looked
///   at. NaN and −∞ are violations;
/// * where λ3 = ±2⁻¹⁰⁰⁰ are not both admitted or both not,
///   [`ends_at_zero_volume`](Material::ends_at_zero_volume) holds.
///
/// # Errors
/// [`Violation`]: the first that is found.
pub fn domain(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Domain, material, settings, |judge, stretches, _| {
        for (k, number) in numbers_alone(material, stretches).into_iter().enumerate() {
            judge.finite(|| name(k), stretches, number, &remedy(material, stretches, number))?;
        }
        let [l1, l2, _] = stretches;
        let flat = [-10, -20, -30].map(|k| l1 * 2f64.powi(k));
        for l3 in flat.into_iter().flat_map(|l3| [l3, -l3]) {
            let stretches = [l1, l2, l3];
            if l2 >= l3.abs() && is_admitted(material, stretches) {
                let energy = energy_at(material, stretches);
                if energy != f64::INFINITY {
                    judge.finite(
                        || "energy".into(),
                        stretches,
                        energy,
                        &remedy(material, stretches, energy),
                    )?;
                }
                let overflows = energy > 2f64.powi(512);
                if !overflows {
                    for (k, slope) in gradient_at(material, stretches).into_iter().enumerate() {
                        judge.finite(
                            || gradient_name(k),
                            stretches,
                            slope,
                            &remedy(material, stretches, slope),
                        )?;
                    }
                }
            }
        }
        let tiny = 2f64.powi(-1000);
        let decides = is_admitted(material, [l1, l2, tiny]) != is_admitted(material, [l1, l2, -tiny]);
        let is_true = !decides || material.ends_at_zero_volume();
        let name = || "truth of `ends_at_zero_volume`".into();
        let advice = "the material admits these stretches or their mirror image, but not both: let `ends_at_zero_volume` give `true`";
        judge.holds(name, [l1, l2, tiny], is_true, advice)
    })
}

/// Advice for an energy or derivative that is infinite or NaN.
fn remedy(material: &impl Material, [_, _, l3]: [f64; 3], found: f64) -> String {
    const NONE: &str = "the domain admits these stretches, but the energy has no value there (a root, real power or logarithm of \
                        something negative?): add a condition to `domain(…)`, or to `admissible(…)` if a parameter divides by zero; \
                        or, where I1 − 3 may not be negative, write `I1b` for `I1`, which is 3 or more wherever J > 0";
    const BEYOND: &str = "the domain admits these stretches, but the number overflows there: where a denominator or the argument of \
                          a logarithm vanishes, add a condition to `domain(…)`, or to `admissible(…)` if it is one of parameters \
                          alone; else choose smaller parameters, or narrow the stretches of the test, as in `range: (0.7, 1.4)`";
    match material.inversion() {
        _ if found.is_nan() => NONE.into(),
        Inversion::Extend { epsilon } if l3 < epsilon => format!(
            "the energy overflows where its extension begun at epsilon = {epsilon} has come to these stretches, as exponentials and \
             high powers do: choose a greater `epsilon` or smaller parameters, or narrow the stretches of the test, as in \
             `range: (0.7, 1.4)`"
        ),
        _ => BEYOND.into(),
    }
}
