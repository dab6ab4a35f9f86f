//! Energies with derivatives by hand, with as few operations as their author could find: the baselines that
//! compute by invariants or by automatic differentiation take them from here.
//!
//! Each agrees with the energy of the same name in the catalogue, which has the formula and its source.

#![expect(non_snake_case, reason = "J as in the literature")]

use piola::Material;
use piola::lanes::{Mask, Real};
use piola::material::{Blocks, PAIRS};

/// μ Σ Ei² + λ/2 (Σ Ei)² with Ei = (λi² − 1)/2.
#[derive(Clone, Copy, Debug)]
pub struct StVenantKirchhoff {
    /// Shear modulus μ, Pa.
    pub mu: f64,
    /// First Lamé parameter λ, Pa.
    pub lambda: f64,
}

impl StVenantKirchhoff {
    /// Σ (λi² − 1).
    #[inline(always)]
    fn trace<R: Real>([q1, q2, q3]: [R; 3]) -> R {
        q1 + q2 + (q3 - R::splat(3.0))
    }
}

impl Material for StVenantKirchhoff {
    #[inline(always)]
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        let [e1, e2, e3] = minus_one(squares(l));
        let trace = e1 + e2 + e3;
        let sum = e1.mul_add(e1, e2.mul_add(e2, e3 * e3));
        (trace * trace).mul_add(R::splat(self.lambda / 8.0), sum * R::splat(self.mu / 4.0))
    }

    #[inline(always)]
    fn gradient<R: Real>(&self, l: [R; 3]) -> [R; 3] {
        let (q, mu) = (squares(l), R::splat(self.mu));
        // λ tr E − μ, so that ψi = λi (μ λi² + rest).
        let rest = Self::trace(q).mul_add(R::splat(self.lambda / 2.0), -mu);
        let mut gradient = l;
        for i in 0..3 {
            gradient[i] = l[i] * mu.mul_add(q[i], rest);
        }
        gradient
    }

    #[inline(always)]
    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (q, mu, lambda) = (squares(l), R::splat(self.mu), R::splat(self.lambda));
        let rest = Self::trace(q).mul_add(R::splat(self.lambda / 2.0), -mu);
        let curvature = R::splat(3.0 * self.mu + self.lambda);
        let (mut gradient, mut hessian, mut flip, mut twist) = (l, [rest; 6], [rest; 3], [rest; 3]);
        for i in 0..3 {
            gradient[i] = l[i] * mu.mul_add(q[i], rest);
            hessian[i] = q[i].mul_add(curvature, rest);
        }
        for k in 0..3 {
            let (i, j) = PAIRS[k];
            // (λi³ ∓ λj³)/(λi ∓ λj) = λi² + λj² ± λi λj.
            let (product, sum) = (l[i] * l[j], mu.mul_add(q[i] + q[j], rest));
            hessian[3 + k] = lambda * product;
            flip[k] = mu.mul_add(product, sum);
            twist[k] = (-mu).mul_add(product, sum);
        }
        Blocks { gradient, hessian, flip, twist }
    }

    #[inline(always)]
    fn admits<R: Real>(&self, _: [R; 3]) -> R::Mask {
        R::Mask::splat(true)
    }

    fn has_pole(&self) -> bool {
        false
    }

    fn ends_at_zero_volume(&self) -> bool {
        false
    }
}

/// μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// Shear modulus μ, Pa.
    pub mu: f64,
    /// First Lamé parameter λ, Pa.
    pub lambda: f64,
}

impl NeoHookean {
    /// 1/λi from one division, and c = λ ln J − μ, so that ψi = μ λi + c/λi.
    #[inline(always)]
    fn reciprocals<R: Real>(&self, [l1, l2, l3]: [R; 3]) -> ([R; 3], R) {
        let area = l1 * l2;
        let J = area * l3;
        let r = R::splat(1.0) / J;
        ([l2 * l3 * r, l1 * l3 * r, area * r], J.ln().mul_add(R::splat(self.lambda), R::splat(-self.mu)))
    }
}

impl Material for NeoHookean {
    #[inline(always)]
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        let [e1, e2, e3] = minus_one(squares(l));
        let log = (l[0] * l[1] * l[2]).ln();
        let volumetric = log.mul_add(R::splat(self.lambda / 2.0), R::splat(-self.mu));
        (e1 + e2 + e3).mul_add(R::splat(self.mu / 2.0), volumetric * log)
    }

    #[inline(always)]
    fn gradient<R: Real>(&self, l: [R; 3]) -> [R; 3] {
        let (r, c) = self.reciprocals(l);
        let mut gradient = l;
        for i in 0..3 {
            gradient[i] = R::splat(self.mu).mul_add(l[i], c * r[i]);
        }
        gradient
    }

    #[inline(always)]
    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (mu, lambda) = (R::splat(self.mu), R::splat(self.lambda));
        let (r, c) = self.reciprocals(l);
        let (mut gradient, mut hessian, mut flip, mut twist) = (l, [c; 6], [c; 3], [c; 3]);
        for i in 0..3 {
            gradient[i] = mu.mul_add(l[i], c * r[i]);
            hessian[i] = (lambda - c).mul_add(r[i] * r[i], mu);
        }
        for k in 0..3 {
            let (i, j) = PAIRS[k];
            let product = r[i] * r[j];
            hessian[3 + k] = lambda * product;
            flip[k] = (-c).mul_add(product, mu);
            twist[k] = c.mul_add(product, mu);
        }
        Blocks { gradient, hessian, flip, twist }
    }

    #[inline(always)]
    fn admits<R: Real>(&self, l: [R; 3]) -> R::Mask {
        R::splat(0.0).less(l[2])
    }

    fn has_pole(&self) -> bool {
        false
    }

    fn ends_at_zero_volume(&self) -> bool {
        true
    }
}

#[inline(always)]
fn squares<R: Real>([l1, l2, l3]: [R; 3]) -> [R; 3] {
    [l1 * l1, l2 * l2, l3 * l3]
}

#[inline(always)]
fn minus_one<R: Real>([q1, q2, q3]: [R; 3]) -> [R; 3] {
    let one = R::splat(1.0);
    [q1 - one, q2 - one, q3 - one]
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRETCHES: [[f64; 3]; 3] = [[1.4, 1.1, 0.6], [1.2, 1.2, 0.9], [1.0, 1.0, 1.0]];

    /// The largest difference, relative to the moduli, which all numbers here are a few times as large as.
    #[track_caller]
    fn compare(by_hand: &impl Material, generated: &impl Material) {
        for l in STRETCHES {
            let numbers = |material: &dyn Fn([f64; 3]) -> Blocks<f64>| {
                let Blocks { gradient, hessian, flip, twist } = material(l);
                [gradient.to_vec(), hessian.to_vec(), flip.to_vec(), twist.to_vec()].concat()
            };
            let (found, expected) = (numbers(&|l| by_hand.blocks(l)), numbers(&|l| generated.blocks(l)));
            let pairs = found.into_iter().zip(expected).chain([(by_hand.energy(l), generated.energy(l))]);
            let gradients = by_hand.gradient(l).into_iter().zip(generated.gradient(l));
            for (found, expected) in pairs.chain(gradients) {
                // A dozen operations on either side, with intermediate results up to ten times the moduli.
                assert!((found - expected).abs() <= 200.0 * f64::UNIT_ROUNDOFF, "{l:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn they_are_those_of_the_catalogue() {
        let (mu, lambda) = (1.0, 1.5);
        let generated = piola_materials::StVenantKirchhoff::new(mu, lambda).expect("admissible parameters");
        compare(&StVenantKirchhoff { mu, lambda }, &generated);
        let generated = piola_materials::NeoHookean::new(mu, lambda).expect("admissible parameters");
        compare(&NeoHookean { mu, lambda }, &generated);
    }
}
