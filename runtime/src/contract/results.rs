//! All results of a point in a row, by itself or on lanes.

use super::{gradient_name, hessian_name, pair_name};
use crate::lanes::{Kernel, Lanes, Real};
use crate::material::{Material, Response};

/// Number of entries in a row.
pub(super) const COUNT: usize = 19;

/// Row of results: ψ; ψ1 … ψ3 from `gradient`; gradient, Hessian, flips, twists from `blocks`. Inlined.
#[inline(always)]
pub(super) fn results<R: Real>(material: &(impl Response<R> + ?Sized), stretches: [R; 3]) -> [R; COUNT] {
    let (energy, [g1, g2, g3]) = (material.energy(stretches), material.gradient(stretches));
    let blocks = material.blocks(stretches);
    let [p1, p2, p3] = blocks.gradient;
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let ([f12, f13, f23], [t12, t13, t23]) = (blocks.flip, blocks.twist);
    [energy, g1, g2, g3, p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23]
}

/// Name of an entry by its place in the row.
pub(super) fn name(number: usize) -> String {
    match number {
        0 => "energy".into(),
        1..=3 => format!("{}, as `gradient` gives it", gradient_name(number - 1)),
        4..=6 => format!("{}, as `blocks` gives it", gradient_name(number - 4)),
        7..=12 => hessian_name(number - 7),
        13..=15 => pair_name("flip", number - 13),
        _ => pair_name("twist", number - 16),
    }
}

/// Length of a row with results by strains and invariants, and whether stretches and invariants are admitted.
pub(super) const ALL: usize = COUNT + 15;

/// Row of all results. Inlined.
#[inline(always)]
pub(super) fn everything<R: Real>(material: &(impl Response<R> + ?Sized), stretches: [R; 3]) -> [R; ALL] {
    let results = results(material, stretches);
    let [s1, s2, s3] = material.gradient_at_strains(strains(stretches));
    let [a, b, c] = stretches.map(|l| l * l);
    let invariants = [a + b + c, a * b + a * c + b * c, stretches[0] * stretches[1] * stretches[2]];
    let [w1, w2, wj] = material.gradient_by_invariants(invariants);
    let [.., w11, w22, wjj, w12, w1j, w2j] = material.derivatives_by_invariants(invariants);
    let energy = material.energy_by_invariants(invariants);
    let truth = |mask| R::select(mask, R::splat(1.0), R::splat(0.0));
    let admits = truth(material.admits(stretches));
    let admits_invariants = truth(material.admits_invariants(invariants));
    let others = [s1, s2, s3, energy, w1, w2, wj, w11, w22, wjj, w12, w1j, w2j, admits, admits_invariants];
    std::array::from_fn(|k| if k < COUNT { results[k] } else { others[k - COUNT] })
}

/// Strains λi − 1 of the stretches or their mirror image, since strains are above −1.
#[inline(always)]
fn strains<R: Real>([l1, l2, l3]: [R; 3]) -> [R; 3] {
    [l1, l2, l3.abs()].map(|l| l - R::splat(1.0))
}

pub(super) fn everything_name(number: usize) -> String {
    const OTHERS: [&str; ALL - COUNT] = [
        "derivative of the energy by strain 1",
        "derivative of the energy by strain 2",
        "derivative of the energy by strain 3",
        "energy by invariants",
        "derivative of the energy by I1",
        "derivative of the energy by I2",
        "derivative of the energy by J",
        "second derivative of the energy by I1",
        "second derivative of the energy by I2",
        "second derivative of the energy by J",
        "second derivative of the energy by I1 and I2",
        "second derivative of the energy by I1 and J",
        "second derivative of the energy by I2 and J",
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
