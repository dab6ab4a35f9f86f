//! The rule on what a material says of its own domain, which decides how exactly a sign is found.

use super::evaluation::{blocks_at, energy_at, gradient_at, is_admitted};
use super::samples::at_samples;
use super::{Finding, Rule, Settings, Violation};
use crate::material::Material;

/// Where the material is defined, its numbers are, and it says truly whether the sign of λ3 decides:
///
/// * energy, gradient and blocks are finite at the samples, and so are energy and gradient where λ3 is only 2⁻¹⁰, 2⁻²⁰ and
///   2⁻³⁰ of λ1, of either sign, as far as such stretches are admitted;
/// * where λ3 = ±2⁻¹⁰⁰⁰ are not both admitted or both not, [`ends_at_zero_volume`](Material::ends_at_zero_volume) holds.
///
/// # Errors
/// The first violation.
pub fn domain(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Domain, material, settings, |judge, stretches, _| {
        let mut finite = |what: &str, stretches, is_finite| {
            let name = || format!("finiteness (1 or −1) of the {what}");
            judge.positive(name, stretches, if is_finite { 1.0 } else { -1.0 })
        };
        let blocks = blocks_at(material, stretches);
        let mut seconds = blocks.hessian.iter().chain(&blocks.flip).chain(&blocks.twist);
        finite("second derivatives and quotients", stretches, seconds.all(|x| x.is_finite()))?;
        let [l1, l2, l3] = stretches;
        let flat = [-10, -20, -30].map(|k| l1 * 2f64.powi(k));
        for l3 in flat.into_iter().flat_map(|l3| [l3, -l3]).chain([l3]) {
            let stretches = [l1, l2, l3];
            if l2 >= l3.abs() && is_admitted(material, stretches) {
                finite("energy", stretches, energy_at(material, stretches).is_finite())?;
                let gradient = gradient_at(material, stretches);
                finite("gradient", stretches, gradient.iter().all(|x| x.is_finite()))?;
            }
        }
        let tiny = 2f64.powi(-1000);
        let decides = is_admitted(material, [l1, l2, tiny]) != is_admitted(material, [l1, l2, -tiny]);
        let told = if decides && !material.ends_at_zero_volume() { -1.0 } else { 1.0 };
        let name = || "`ends_at_zero_volume` (1 where it tells the truth, else −1)".into();
        judge.positive(name, [l1, l2, tiny], told)
    })
}
