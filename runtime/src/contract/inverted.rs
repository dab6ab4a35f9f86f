//! The rule on extensions: smooth across the threshold, restoring below it.

use super::{Finding, Judge, Rule, Settings, Violation, gradient_name, slopes};
use crate::material::Material;
use crate::random::Random;

/// For a material built with `Inversion::Extend { epsilon }`: it admits every point; at and around λ3 = ε
/// difference quotients approach P and dP/dF (as h, since third derivatives jump there), deep inside inversion as
/// h²; and ∂ψ/∂λ3 < 0 wherever λ3 < ε and J < 1, so that inverted material is driven back.
///
/// # Errors
/// The first violation.
pub fn extension(material: &impl Material, settings: &Settings, epsilon: f64) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Extension);
    let mut random = Random::new(settings.seed);
    let (_, high) = settings.range;
    for point in 0..settings.points {
        let l2 = random.uniform(1.1 * epsilon, high);
        let l1 = random.uniform(l2, high.max(1.01 * l2));
        let near = [0.0, 1e-3, -1e-3, 1e-8, -1e-8][point % 5];
        let threshold = [l1, l2, epsilon * (1.0 + near)];
        admitted(&mut judge, material, threshold)?;
        slopes::energy_at(&mut judge, material, threshold, 1, &mut random)?;
        slopes::stress_at(&mut judge, material, threshold, 1, &mut random)?;

        let inverted = [l1, l2, random.uniform(-0.95, -0.05) * l2];
        admitted(&mut judge, material, inverted)?;
        slopes::stress_at(&mut judge, material, inverted, 2, &mut random)?;

        for l3 in [epsilon * (1.0 - 1e-6), inverted[2], -l2] {
            let stretches = [l1, l2, l3];
            if l3 < epsilon && l1 * l2 * l3 < 1.0 {
                admitted(&mut judge, material, stretches)?;
                let found = -material.gradient(stretches)[2];
                judge.positive(|| format!("negative {}", gradient_name(2)), stretches, found)?;
            }
        }
    }
    judge.finding()
}

fn admitted(judge: &mut Judge, material: &impl Material, stretches: [f64; 3]) -> Result<(), Violation> {
    let admitted = if material.admits(stretches) { 1.0 } else { -1.0 };
    judge.positive(|| "admission (1 or −1)".into(), stretches, admitted)
}
