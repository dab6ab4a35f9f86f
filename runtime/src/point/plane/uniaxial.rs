//! Uniaxial stress: a bar that is free on all sides.

use super::release::{Side, Unreleased, release};
use super::{Axes, defined_at};
use crate::lanes::Real;
use crate::material::Response;
use crate::status::Status;

/// Stress and tangent of a bar in uniaxial stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniaxialPoint<R> {
    /// The stretch t > 0 of all directions across the bar.
    pub lateral_stretch: R,
    /// dt/dλ.
    pub lateral_slope: R,
    /// Energy density ψ, J/m³ of rest volume.
    pub energy: R,
    /// Nominal stress P along the bar: force by area at rest, Pa.
    pub stress: R,
    /// dP/dλ with free sides, Pa.
    pub tangent: R,
    /// Whether the results mean something.
    pub status: Status,
    /// Whether the point is refused because no lateral stretch frees the sides of stress.
    pub no_equilibrium: bool,
}

/// Stress and tangent of a bar with the axial stretch λ, whose sides are free.
///
/// The stretches across are equal. Another equilibrium with unequal ones is possible only where this one is
/// unstable against shear of the cross-section.
///
/// `refused` where the energy is not defined for any lateral stretch, and where none frees the sides.
#[must_use]
pub fn uniaxial_stress<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    stretch: R,
) -> UniaxialPoint<R> {
    let nan = R::splat(f64::NAN);
    let meaningless = UniaxialPoint {
        lateral_stretch: nan,
        lateral_slope: nan,
        energy: nan,
        stress: nan,
        tangent: nan,
        status: Status { nonfinite: true, ..Status::clean() },
        no_equilibrium: false,
    };
    if !stretch.is_finite() {
        return meaningless;
    }
    let side = |lateral: R| {
        let blocks = defined_at(material, [stretch, lateral, lateral])?;
        // Of axis 2; axis 3 has the same, but for rounding.
        let [_, across, _] = blocks.gradient;
        let [_, h22, _, h12, _, h23] = blocks.hessian;
        let terms = [across, lateral * h22, stretch * h12, lateral * h23];
        let magnitude = terms.into_iter().fold(R::splat(0.0), |sum, term| sum + term.abs());
        Some(Side { stress: across, slope: h22 + h23, magnitude })
    };
    let lateral = match release(side, R::splat(1.0) / stretch.abs().sqrt()) {
        Ok(lateral) => lateral,
        Err(reason) => {
            let status = Status { refused: true, ..Status::clean() };
            return UniaxialPoint {
                status,
                no_equilibrium: reason == Unreleased::NoEquilibrium,
                ..meaningless
            };
        }
    };
    let axes = Axes::new([stretch, lateral, lateral]);
    let blocks = axes.blocks(material);
    let ([along, across, _], [h11, h22, _, h12, _, h23]) = (blocks.gradient, blocks.hessian);
    let slope = -(h12 / (h22 + h23));
    let twice = slope + slope;
    let point = UniaxialPoint {
        lateral_stretch: lateral,
        lateral_slope: slope,
        energy: material.energy(axes.sorted),
        // Takes away to first order what is left of the stress of the sides.
        stress: twice.mul_add(across, along),
        tangent: twice.mul_add(h12, h11),
        ..meaningless
    };
    let numbers = [point.lateral_slope, point.energy, point.stress, point.tangent];
    let nonfinite = !numbers.into_iter().all(|number| number.is_finite());
    UniaxialPoint { status: Status { nonfinite, ..Status::clean() }, ..point }
}
