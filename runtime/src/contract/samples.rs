//! Samples of the contract: stretches in descending order, all of which the material admits.

use super::subject::Subject;
use super::{Finding, Judge, Rule, Settings, Violation};
use crate::material::Inversion;
use crate::random::Random;

/// Judges a rule at every sample, with random numbers to draw further choices from.
pub(super) fn at_samples(
    rule: Rule,
    material: &dyn Subject,
    settings: &Settings,
    mut look: impl FnMut(&mut Judge, [f64; 3], &mut Random) -> Result<(), Violation>,
) -> Result<Finding, Violation> {
    let mut judge = Judge::new(rule, settings.notation);
    let mut random = Random::new(settings.seed);
    for stretches in samples(material, settings, &mut random) {
        look(&mut judge, stretches, &mut random)?;
    }
    judge.finding()
}

/// Random descending stretches within the range, plus inverted ones, if the material admits them.
///
/// Around the threshold of an extension the third derivatives jump; samples keep a distance of 1/32 from it.
pub(super) fn samples(material: &dyn Subject, settings: &Settings, random: &mut Random) -> Vec<[f64; 3]> {
    let (low, high) = settings.range;
    let threshold = match material.inversion() {
        Inversion::Refuse => None,
        Inversion::Extend { epsilon } => Some(epsilon),
    };
    (0..settings.points)
        .map(|k| {
            let mut l: [f64; 3] = std::array::from_fn(|_| random.uniform(low.ln(), high.ln()).exp());
            l.sort_by(|a, b| b.total_cmp(a));
            if k % 4 == 3 {
                // Away from λ3 = 0 and λ2 + λ3 = 0, where difference quotients would need steps of their own.
                l[2] = random.uniform(0.05, 0.9).copysign(random.uniform(-1.0, 1.0)) * l[1];
            }
            l
        })
        .filter(|&l| material.admits(l))
        .filter(|l| threshold.is_none_or(|epsilon| l.iter().all(|l| (l - epsilon).abs() > 1.0 / 32.0)))
        .collect()
}

/// Two triples of stretches with λ1, or λ3, moved to a fraction `gap` of λ2 away from λ2; still descending.
pub(super) fn together([l1, l2, l3]: [f64; 3], gap: f64) -> [[f64; 3]; 2] {
    [[l2 * (1.0 + gap), l2, l3], [l1, l2, l2 * (1.0 - gap)]]
}
