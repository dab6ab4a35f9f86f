//! Stress measures as values, for codes that choose one at run time, and for batches.

use super::voigt::Matrix6;
use super::{
    areas, green_naghdi_principal, jaumann_principal, kirchhoff_principal, material_principal, six_numbers,
    spatial_principal,
};
use crate::lanes::Real;
use crate::material::Blocks;
use crate::point::matrix::three;
use crate::point::svd::Svd;

/// Measure of stress with a tangent that belongs to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// The second Piola–Kirchhoff stress S and the material tangent dS/dE.
    SecondPiola,
    /// The Kirchhoff stress τ and the tangent J c of its Lie derivative, finite even if F is singular.
    Kirchhoff,
    /// The Cauchy stress σ and the spatial tangent c of its Truesdell rate.
    Cauchy,
    /// The Cauchy stress σ and c°, of the Jaumann rate of τ by deformed volume: DDSDDE of Abaqus.
    Jaumann,
    /// The Cauchy stress σ and c★, of the Green–Naghdi rate of τ by deformed volume.
    GreenNaghdi,
}

impl Measure {
    /// All measures, in the order above.
    pub const ALL: [Self; 5] =
        [Self::SecondPiola, Self::Kirchhoff, Self::Cauchy, Self::Jaumann, Self::GreenNaghdi];

    /// The six components of the stress, Pa, in the order of [`voigt`](super::voigt), for the gradient ψ1,
    /// ψ2, ψ3.
    #[inline(always)]
    #[must_use]
    pub fn stress<R: Real>(self, svd: &Svd<R>, gradient: [R; 3]) -> [R; 6] {
        let l = svd.stretches;
        let areas = areas(l);
        match self {
            Self::SecondPiola => six_numbers(&svd.V, three!(i => gradient[i] / l[i])),
            Self::Kirchhoff => six_numbers(&svd.U, three!(i => gradient[i] * l[i])),
            _ => six_numbers(&svd.U, three!(i => gradient[i] / areas[i])),
        }
    }

    /// The 6×6 tangent, Pa, for unfiltered blocks.
    #[inline(always)]
    #[must_use]
    pub fn tangent<R: Real>(self, svd: &Svd<R>, blocks: &Blocks<R>) -> Matrix6<R> {
        let l = svd.stretches;
        let principal = match self {
            Self::SecondPiola => material_principal(l, blocks),
            Self::Kirchhoff => kirchhoff_principal(l, blocks),
            Self::Cauchy => spatial_principal(l, blocks),
            Self::Jaumann => jaumann_principal(l, blocks),
            Self::GreenNaghdi => green_naghdi_principal(l, blocks),
        };
        principal.to_world(if self == Self::SecondPiola { &svd.V } else { &svd.U })
    }
}
