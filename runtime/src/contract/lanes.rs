//! The rule on lanes: many points side by side against each by itself.

use super::numbers::{COUNT, known, name, numbers};
use super::samples::{samples, together};
use super::{Finding, Judge, Rule, Settings, UNIT, Violation};
use crate::lanes::{Backend, Kernel, Lanes, Real};
use crate::material::Material;
use crate::random::Random;

/// On lanes, every number is what it is by itself:
///
/// * on the portable back end, with the bits of a scalar;
/// * on any, with the same bits whatever its lane and its neighbours;
/// * on the fastest one of this processor, as a scalar but for rounding: it has other instructions.
///
/// Neighbours differ as much as they can: beside one of the samples are the same stretches with two of them 10⁻⁹ apart and
/// equal, so that what is done for some lanes alone shows. Truth values are compared as 0 and 1.
///
/// # Errors
/// The first violation.
pub fn lanes(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Lanes);
    let mut random = Random::new(settings.seed);
    let mut points = Vec::new();
    for stretches in samples(material, settings, &mut random) {
        points.push(stretches);
        let close = [1e-9, 0.0].into_iter().flat_map(|gap| together(stretches, gap));
        points.extend(close.filter(|&close| material.admits(close)));
    }
    let alone: Vec<_> = points.iter().map(|&stretches| everything(material, stretches)).collect();

    let portable = Backend::portable();
    let side_by_side = portable.run(SideBySide(material, &points));
    for ((&stretches, found), expected) in points.iter().zip(side_by_side).zip(&alone) {
        for k in 0..ALL {
            let name = || format!("{} on the {portable} back end against a scalar", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }

    let backend = Backend::best();
    let in_order = backend.run(SideBySide(material, &points));
    // Each in the lane before, with other neighbours.
    let by = 1.min(points.len());
    let mut moved = points.clone();
    moved.rotate_left(by);
    let mut shifted = backend.run(SideBySide(material, &moved));
    shifted.rotate_right(by);
    for ((&stretches, found), expected) in points.iter().zip(shifted).zip(&in_order) {
        for k in 0..ALL {
            let name = || format!("{} in another lane of {backend}", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }
    for (&stretches, found) in points.iter().zip(&in_order) {
        let Some((expected, tolerances)) = known(material, stretches) else { continue };
        for k in 0..COUNT {
            let name = || format!("{} on {backend} against a scalar", name(k));
            judge.compare(name, stretches, found[k], expected[k], UNIT * tolerances[k])?;
        }
    }
    judge.finding()
}

/// The numbers, those by strains and by invariants, and whether stretches and invariants are admitted.
const ALL: usize = COUNT + 9;

#[inline(always)]
fn everything<R: Real>(material: &impl Material, stretches: [R; 3]) -> [R; ALL] {
    let [l1, l2, l3] = stretches;
    let one = R::splat(1.0);
    let truth = |mask| R::select(mask, one, R::splat(0.0));
    let [a, b, c] = stretches.map(|l| l * l);
    let invariants = [a + b + c, a * b + a * c + b * c, l1 * l2 * l3];
    // Strains are above −1.
    let [s1, s2, s3] = material.gradient_at_strains([l1 - one, l2 - one, l3.abs() - one]);
    let [w1, w2, wj] = material.gradient_by_invariants(invariants);
    let others = [
        s1,
        s2,
        s3,
        material.energy_by_invariants(invariants),
        w1,
        w2,
        wj,
        truth(material.admits(stretches)),
        truth(material.admits_invariants(invariants)),
    ];
    let numbers = numbers(material, stretches);
    std::array::from_fn(|k| if k < COUNT { numbers[k] } else { others[k - COUNT] })
}

fn everything_name(number: usize) -> String {
    const OTHERS: [&str; ALL - COUNT] = [
        "derivative of the energy by strain 1",
        "derivative of the energy by strain 2",
        "derivative of the energy by strain 3",
        "energy by invariants",
        "derivative of the energy by I1",
        "derivative of the energy by I2",
        "derivative of the energy by J",
        "admission (1 or 0)",
        "admission of the invariants (1 or 0)",
    ];
    if number < COUNT { name(number) } else { OTHERS[number - COUNT].into() }
}

/// Everything at these stretches, as many points at once as there are lanes; the last point fills up what is left.
struct SideBySide<'a, M>(&'a M, &'a [[f64; 3]]);

impl<M: Material> Kernel<f64> for SideBySide<'_, M> {
    type Output = Vec<[f64; ALL]>;

    #[inline(always)]
    fn run<R: Lanes<Element = f64>>(self) -> Self::Output {
        let Self(material, points) = self;
        let mut all = vec![[0.0; ALL]; points.len()];
        let mut lanes = vec![0.0; R::LANES];
        for (points, all) in points.chunks(R::LANES).zip(all.chunks_mut(R::LANES)) {
            let stretches: [R; 3] =
                std::array::from_fn(|k| R::from_fn(|lane| points[lane.min(points.len() - 1)][k]));
            for (k, number) in everything(material, stretches).into_iter().enumerate() {
                number.store(&mut lanes);
                all.iter_mut().zip(&lanes).for_each(|(all, number)| all[k] = *number);
            }
        }
        all
    }
}
