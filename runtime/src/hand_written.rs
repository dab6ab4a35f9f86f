//! Energies with derivatives by hand, for tests: the only ones in the workspace.
//!
//! The point and the contract must be testable without the code generator, and against something it has not
//! written. Integration tests include this file, too.

use piola::__private::pole_floor;
use piola::lanes::{Mask, Real};
use piola::material::{Blocks, Inversion, Material, PAIRS};

const MU: f64 = 1.0;
const LAMBDA: f64 = 1.5;

/// Domain and poles of an energy that is defined everywhere.
macro_rules! defined_everywhere {
    (has_pole: $has_pole:literal) => {
        fn admits<R: Real>(&self, _: [R; 3]) -> R::Mask {
            R::Mask::splat(true)
        }

        fn has_pole(&self) -> bool {
            $has_pole
        }

        fn ends_at_zero_volume(&self) -> bool {
            false
        }
    };
}

/// μ ΣE² + λ/2 (ΣE)², E = (λ² − 1)/2: even in every pair, so that its twist is smooth everywhere.
pub(crate) struct SaintVenantKirchhoff;

impl Material for SaintVenantKirchhoff {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        quadratic(stretches.map(|l| (l * l - R::splat(1.0)) * R::splat(0.5)))
    }

    fn gradient_at_strains<R: Real>(&self, s: [R; 3]) -> [R; 3] {
        // (λ² − 1)/2 = s + s²/2.
        let green = s.map(|s| (R::splat(0.5) * s).mul_add(s, s));
        let pressure = R::splat(LAMBDA) * (green[0] + green[1] + green[2]);
        std::array::from_fn(|i| (R::splat(1.0) + s[i]) * (R::splat(2.0 * MU) * green[i] + pressure))
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (mu, lambda) = (R::splat(MU), R::splat(LAMBDA));
        let q = l.map(|l| l * l);
        let volumetric = lambda * R::splat(0.5) * (q[0] + q[1] + q[2] - R::splat(3.0));
        let diagonal = q.map(|q| R::splat(3.0 * MU + LAMBDA) * q + volumetric - mu);
        let mixed = PAIRS.map(|(i, j)| lambda * l[i] * l[j]);
        let even = |sign: f64| {
            PAIRS.map(|(i, j)| mu * (q[i] + q[j] + R::splat(sign) * l[i] * l[j]) + volumetric - mu)
        };
        Blocks {
            gradient: std::array::from_fn(|i| l[i] * (volumetric + mu * q[i] - mu)),
            hessian: [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]],
            flip: even(1.0),
            twist: even(-1.0),
        }
    }

    defined_everywhere!(has_pole: false);
}

/// μ/2 (Σλ² − 3) − μ ln J + λ/2 (ln J)², J > 0.
pub(crate) struct NeoHookean;

impl Material for NeoHookean {
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        logarithmic(l, (l[0] * l[1] * l[2]).ln())
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (mu, lambda, one) = (R::splat(MU), R::splat(LAMBDA), R::splat(1.0));
        let c = lambda * (l[0] * l[1] * l[2]).ln() - mu;
        let r = l.map(|l| one / l);
        let diagonal = r.map(|r| mu + (lambda - c) * r * r);
        let mixed = PAIRS.map(|(i, j)| lambda * r[i] * r[j]);
        Blocks {
            gradient: std::array::from_fn(|i| mu * l[i] + c * r[i]),
            hessian: [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]],
            flip: PAIRS.map(|(i, j)| mu - c * r[i] * r[j]),
            twist: PAIRS.map(|(i, j)| mu + c * r[i] * r[j]),
        }
    }

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

/// μ Σ(λ − 1)² + λ/2 (Σλ − 3)²: not even, with a pole of the twist where two stretches are opposite.
pub(crate) struct RotatedLinear;

impl Material for RotatedLinear {
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        quadratic(l.map(|l| l - R::splat(1.0)))
    }

    fn gradient<R: Real>(&self, l: [R; 3]) -> [R; 3] {
        let pressure = R::splat(LAMBDA) * (l[0] + l[1] + l[2] - R::splat(3.0));
        l.map(|l| R::splat(2.0 * MU) * (l - R::splat(1.0)) + pressure)
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (diagonal, mixed) = (R::splat(2.0 * MU + LAMBDA), R::splat(LAMBDA));
        let gradient = self.gradient(l);
        let floor = pole_floor(l);
        Blocks {
            gradient,
            hessian: [diagonal, diagonal, diagonal, mixed, mixed, mixed],
            flip: [R::splat(2.0 * MU); 3],
            twist: PAIRS.map(|(i, j)| (gradient[i] + gradient[j]) / (l[i] + l[j]).max(floor)),
        }
    }

    defined_everywhere!(has_pole: true);
}

/// [`NeoHookean`] with ln continued below ε as its quadratic Taylor polynomial: admits every point, C² across
/// ε, and with a pole where two stretches are opposite.
pub(crate) struct ExtendedNeoHookean {
    pub(crate) epsilon: f64,
}

impl ExtendedNeoHookean {
    /// ln x or its continuation: value, first and second derivative.
    fn log<R: Real>(&self, x: R) -> [R; 3] {
        let (epsilon, one) = (R::splat(self.epsilon), R::splat(1.0));
        let inside = x.max(epsilon);
        let r = one / inside;
        let t = (x - inside) * r;
        [inside.ln() + t - R::splat(0.5) * t * t, r - t * r, -(r * r)]
    }

    /// The divided difference of the first derivative, for x ≥ y: −1/xy, −1/ε², or their convex combination.
    fn slope_difference<R: Real>(&self, x: R, y: R) -> R {
        let (epsilon, one) = (R::splat(self.epsilon), R::splat(1.0));
        let (a, b) = (x.max(epsilon), y.max(epsilon));
        let above = -(one / (a * b));
        let below = -(one / (epsilon * epsilon));
        let gap = x - y;
        let share =
            R::select(R::splat(0.0).less(gap), (a - b) / gap, R::select(y.less(epsilon), R::splat(0.0), one));
        share * above + (one - share) * below
    }
}

impl Material for ExtendedNeoHookean {
    fn energy<R: Real>(&self, l: [R; 3]) -> R {
        let log = l.map(|l| self.log(l)[0]);
        logarithmic(l, log[0] + log[1] + log[2])
    }

    fn blocks<R: Real>(&self, l: [R; 3]) -> Blocks<R> {
        let (mu, lambda) = (R::splat(MU), R::splat(LAMBDA));
        let log = l.map(|l| self.log(l));
        let c = lambda * (log[0][0] + log[1][0] + log[2][0]) - mu;
        let gradient: [R; 3] = std::array::from_fn(|i| mu * l[i] + c * log[i][1]);
        let diagonal = log.map(|log| mu + lambda * log[1] * log[1] + c * log[2]);
        let mixed = PAIRS.map(|(i, j)| lambda * log[i][1] * log[j][1]);
        let floor = pole_floor(l);
        Blocks {
            gradient,
            hessian: [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]],
            flip: PAIRS.map(|(i, j)| mu + c * self.slope_difference(l[i], l[j])),
            twist: PAIRS.map(|(i, j)| (gradient[i] + gradient[j]) / (l[i] + l[j]).max(floor)),
        }
    }

    defined_everywhere!(has_pole: true);

    fn inversion(&self) -> Inversion {
        Inversion::Extend { epsilon: self.epsilon }
    }
}

/// A multiple of an energy by stretches, for other stiffnesses.
pub(crate) struct Scaled<M> {
    pub(crate) factor: f64,
    pub(crate) material: M,
}

impl<M: Material> Material for Scaled<M> {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        self.material.energy(stretches) * R::splat(self.factor)
    }

    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        let Blocks { gradient, hessian, flip, twist } = self.material.blocks(stretches);
        let factor = R::splat(self.factor);
        Blocks {
            gradient: gradient.map(|number| number * factor),
            hessian: hessian.map(|number| number * factor),
            flip: flip.map(|number| number * factor),
            twist: twist.map(|number| number * factor),
        }
    }

    fn admits<R: Real>(&self, stretches: [R; 3]) -> R::Mask {
        self.material.admits(stretches)
    }

    fn has_pole(&self) -> bool {
        self.material.has_pole()
    }

    fn ends_at_zero_volume(&self) -> bool {
        self.material.ends_at_zero_volume()
    }
}

/// μ Σe² + λ/2 (Σe)² of strains e.
fn quadratic<R: Real>([e1, e2, e3]: [R; 3]) -> R {
    let trace = e1 + e2 + e3;
    R::splat(MU) * (e1 * e1 + e2 * e2 + e3 * e3) + R::splat(LAMBDA / 2.0) * trace * trace
}

/// μ/2 (Σλ² − 3) − μ ln J + λ/2 (ln J)², given ln J.
fn logarithmic<R: Real>(l: [R; 3], log: R) -> R {
    let shear = R::splat(MU / 2.0) * (l[0] * l[0] + l[1] * l[1] + l[2] * l[2] - R::splat(3.0));
    shear + (R::splat(LAMBDA / 2.0) * log - R::splat(MU)) * log
}
