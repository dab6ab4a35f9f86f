//! Rubber with a curve instead of a formula: its domain, and different curves at two points.

use piola::batch::Batch;
use piola::material::PerPoint;
use piola::{Real, Univariate, material};

/// Chains that lock: φ′(x) = μ/2 · limit/(limit − x) for x = I1b − 3 below the limit.
#[derive(Clone, Debug, PartialEq)]
struct Chains {
    mu: f64,
    limit: f64,
}

impl Univariate for Chains {
    #[inline(always)]
    fn admits<R: Real>(&self, x: R) -> R::Mask {
        x.less(R::splat(self.limit))
    }
    #[inline(always)]
    fn value<R: Real>(&self, x: R) -> R {
        R::splat(-0.5 * self.mu * self.limit) * (-(x / R::splat(self.limit))).ln_1p()
    }
    #[inline(always)]
    fn derivative<R: Real>(&self, x: R) -> R {
        R::splat(0.5 * self.mu * self.limit) / (R::splat(self.limit) - x)
    }
    #[inline(always)]
    fn second_derivative<R: Real>(&self, x: R) -> R {
        let left = R::splat(self.limit) - x;
        R::splat(0.5 * self.mu * self.limit) / (left * left)
    }
}

/// Rubber of chains.
#[material(domain(J > 0.0))]
fn Rubber(
    [l1, l2, l3]: [f64; 3],
    /// Energy of the chains, Pa.
    f: Chains,
    /// Volumetric modulus κ, Pa.
    kappa: f64,
) -> f64 {
    f(I1b - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let long = Rubber::new(Chains { mu: 3e5, limit: 100.0 }, 2e7)?;
    let short = long.clone().with_f(Chains { mu: 3e5, limit: 5.0 })?;
    // Two points at a stretch of 3, where I1b − 3 is 6.7: one rubber admits this value, the other does not.
    let thin = 1.0 / 3f64.sqrt();
    let stretch = [3.0, 0.0, 0.0, 0.0, thin, 0.0, 0.0, 0.0, thin];
    let mut energies = [0.0; 2];
    let survey =
        Batch::new(&PerPoint::new(&[long, short])?).energies(&[stretch, stretch].concat(), &mut energies)?;
    println!("{:.3e} J/m³, and {} refused", energies[0], survey.refused);
    Ok(())
}
