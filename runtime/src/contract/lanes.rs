//! The rule on lanes: many points side by side against each by itself.

use super::results::{COUNT, known, name, results};
use super::samples::{samples, together};
use super::subject::Subject;
use super::{Finding, Judge, Rule, Settings, UNIT, Violation};
use crate::lanes::{Backend, Kernel, Lanes, Real};
use crate::material::{Material, Response};
use crate::random::Random;

/// [`Rule::Lanes`].
pub(super) fn lanes(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
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
    let together = material.side_by_side_on(portable, &points);
    for ((&stretches, found), expected) in points.iter().zip(together).zip(&alone) {
        for k in 0..ALL {
            let name = || format!("{} on the {portable} back end against a scalar", everything_name(k));
            judge.same(name, stretches, found[k], expected[k])?;
        }
    }

    let backend = Backend::best();
    let in_order = material.side_by_side_on(backend, &points);
    // Each in the lane before, with other neighbours.
    let by = 1.min(points.len());
    let mut moved = points.clone();
    moved.rotate_left(by);
    let mut shifted = material.side_by_side_on(backend, &moved);
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

/// Length of a row with results by strains and invariants, and whether stretches and invariants are admitted.
pub(super) const ALL: usize = COUNT + 9;

/// Row of all results. Inlined.
#[inline(always)]
fn everything<R: Real>(material: &(impl Response<R> + ?Sized), stretches: [R; 3]) -> [R; ALL] {
    let results = results(material, stretches);
    let [s1, s2, s3] = material.gradient_at_strains(strains(stretches));
    let [a, b, c] = stretches.map(|l| l * l);
    let invariants = [a + b + c, a * b + a * c + b * c, stretches[0] * stretches[1] * stretches[2]];
    let [w1, w2, wj] = material.gradient_by_invariants(invariants);
    let truth = |mask| R::select(mask, R::splat(1.0), R::splat(0.0));
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
    std::array::from_fn(|k| if k < COUNT { results[k] } else { others[k - COUNT] })
}

/// Strains λi − 1 of the stretches or their mirror image, since strains are above −1.
#[inline(always)]
fn strains<R: Real>([l1, l2, l3]: [R; 3]) -> [R; 3] {
    [l1, l2, l3.abs()].map(|l| l - R::splat(1.0))
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

/// Kernel for the rows of points, as many at once as there are lanes; copies of the last fill the rest.
pub(super) struct SideBySide<'a, M>(pub(super) &'a M, pub(super) &'a [[f64; 3]]);

impl<M: Material> Kernel<f64> for SideBySide<'_, M> {
    type Output = Vec<[f64; ALL]>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = f64>>(self) -> Self::Output {
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
