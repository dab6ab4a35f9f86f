//! Derivatives of an energy in stretches of any order and sign.
//!
//! A [`Material`](crate::Material) takes stretches λ1 ≥ λ2 ≥ |λ3|. Where each belongs to an axis of a body,
//! as in plane stress, they come as they are: x1, x2, x3. With p the order of their magnitudes and signs σ
//! of product 1,
//!
//! ```text
//! λk = σk x_p(k),     ψ(x1, x2, x3) = ψ(λ1, λ2, λ3),
//! ```
//!
//! because an isotropic energy is a function of F and exchanging two axes, or reversing two, is a rotation.
//! So ∂ψ/∂x_p(k) = σk ψk and ∂²ψ/∂x_p(k)∂x_p(l) = σk σl ψkl. Of a pair with two signs that are different,
//! flip and twist change places: (ψk + ψl)/(λk + λl) is (∂ψ/∂x − ∂ψ/∂y)/(x − y) then.

use crate::lanes::Real;
use crate::material::{Blocks, PAIRS, Response};

/// Stretches of axes in the order of a material, and the way back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes<R> {
    /// λ1 ≥ λ2 ≥ |λ3|.
    pub(super) sorted: [R; 3],
    /// The axis of each.
    order: [usize; 3],
    /// 1 or −1 for each.
    signs: [R; 3],
}

impl<R: Real<Mask = bool>> Axes<R> {
    pub(super) fn new(stretches: [R; 3]) -> Self {
        let mut order = [0, 1, 2];
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if stretches[order[i]].abs().less(stretches[order[j]].abs()) {
                order.swap(i, j);
            }
        }
        let one = R::splat(1.0);
        let mut signs = order.map(|axis| one.copysign(stretches[axis]));
        signs[2] = signs[0] * signs[1];
        let sorted = std::array::from_fn(|k| signs[k] * stretches[order[k]]);
        Self { sorted, order, signs }
    }

    /// The derivatives in the stretches of the axes, with the pairs of axes in the order of [`PAIRS`].
    pub(super) fn blocks(&self, material: &(impl Response<R> + ?Sized)) -> Blocks<R> {
        let blocks = material.blocks(self.sorted);
        let mut of_axes = blocks;
        for (k, axis) in self.order.into_iter().enumerate() {
            of_axes.gradient[axis] = self.signs[k] * blocks.gradient[k];
            of_axes.hessian[axis] = blocks.hessian[k];
        }
        for (pair, (k, l)) in PAIRS.into_iter().enumerate() {
            // The pairs 12, 13, 23 have the axes' sums 1, 2, 3.
            let place = self.order[k] + self.order[l] - 1;
            let sign = self.signs[k] * self.signs[l];
            of_axes.hessian[3 + place] = sign * blocks.hessian[3 + pair];
            let (flip, twist) = (blocks.flip[pair], blocks.twist[pair]);
            (of_axes.flip[place], of_axes.twist[place]) =
                if sign.less(R::splat(0.0)) { (twist, flip) } else { (flip, twist) };
        }
        of_axes
    }
}
