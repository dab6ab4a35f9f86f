//! Three inequalities that a stable solid keeps, as moduli at a triple of stretches.
//!
//! Each is the least of some moduli and is kept if that is positive. The moduli are scaled so that at rest
//! they are the shear modulus μ of Hooke's law (Hill's and the last, as long as K ≥ 2μ/3 and λ ≥ −μ), which
//! makes them comparable. With the Kirchhoff stresses τi = λi ψi and a = (D⁻ + D⁺)/2, which for positive
//! stretches is (τi − τj)/(λi² − λj²):
//!
//! ```text
//! Baker–Ericksen     (σi − σj)(λi − λj) > 0, the larger stress along the larger stretch    aij
//! Hill               dτ : d ln U > 0, stress monotone in logarithmic strain                ½ of the eigenvalues of
//!                                                                                          ∂τi/∂ ln λj = λi λj ψij + δij λi ψi
//!                                                                                          and (τi − τj)/(ln λi − ln λj)
//! strong ellipticity every plane wave has a real speed                                     ρ0 c² of the slowest
//! ```
//!
//! Equal stretches are nothing special: where Baker and Ericksen's condition is void, a is its limit, which
//! [`piola::Material::blocks`] has without a gap; and the second kind of Hill's moduli is a (λi + λj) times
//! the logarithmic mean (λi − λj)/(ln λi − ln λj). So Hill's condition implies Baker and Ericksen's; strong
//! ellipticity does, too, as a is the modulus of a shear wave along a principal axis. Between Hill's
//! condition and strong ellipticity there is no such order: Hencky's energy keeps the first everywhere and
//! loses the second; the polyconvex energy μ/2 I1 + κ/2 (J − c)² with a large κ does the opposite where J <
//! c/2.
//!
//! Hill's condition is what finite-element codes check under the name of Drucker's stability.
//!
//! What floating point does here: a modulus is a sum of terms as large as the stiffest, so that a least one
//! within 64 u of these is not positive beyond doubt, and the condition counts as lost.
//!
//! \[BE54\] Baker, Ericksen, *Inequalities restricting the form of the stress-deformation relations for
//! isotropic elastic solids and Reiner–Rivlin fluids*, J. Washington Acad. Sci. 44, 1954.
//! \[Hill70\] Hill, *Constitutive inequalities for isotropic elastic solids under finite strain*, Proc. R.
//! Soc. A 314, 1970.

use std::fmt;

use nalgebra::Matrix3;
use piola::material::{Blocks, PAIRS};

use super::wave::{Wave, slowest};
use crate::Specimen;

/// An inequality that a stable solid keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The larger principal stress is along the larger stretch \[BE54\]. Both others imply it.
    BakerEricksen,
    /// Kirchhoff stress is monotone in logarithmic strain \[Hill70\].
    Hill,
    /// Every plane wave has a real speed: the energy is convex along rank-one directions.
    StrongEllipticity,
}

impl Criterion {
    /// All criteria, in the order of every list of them.
    pub const ALL: [Self; 3] = [Self::BakerEricksen, Self::Hill, Self::StrongEllipticity];
}

impl fmt::Display for Criterion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::BakerEricksen => "Baker–Ericksen",
            Self::Hill => "Hill",
            Self::StrongEllipticity => "strong ellipticity",
        })
    }
}

/// The criteria of a solid at three stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// λ1 ≥ λ2 ≥ λ3 > 0.
    pub stretches: [f64; 3],
    /// The least modulus of each [`Criterion::ALL`], Pa.
    pub moduli: [f64; 3],
    /// For each modulus, true if it is positive beyond doubt.
    pub kept: [bool; 3],
    /// The slowest wave, whose modulus is that of strong ellipticity.
    pub wave: Wave,
}

impl Judgement {
    /// Judges a material at positive stretches, in any order.
    ///
    /// `None` if the material does not admit them, or its derivatives are infinite or NaN.
    #[must_use]
    pub fn of(specimen: &dyn Specimen<f64>, stretches: [f64; 3]) -> Option<Self> {
        Self::with(specimen, stretches, |_, _| {})
    }

    /// Judges a material whose derivatives at the ordered stretches are changed before.
    pub(super) fn with(
        specimen: &dyn Specimen<f64>,
        mut stretches: [f64; 3],
        change: impl FnOnce(&mut Blocks<f64>, [f64; 3]),
    ) -> Option<Self> {
        stretches.sort_by(|one, other| other.total_cmp(one));
        let in_range = |stretch: &f64| stretch.is_finite() && *stretch > 0.0;
        if !stretches.iter().all(in_range) || !specimen.admits(stretches) {
            return None;
        }
        let mut blocks = specimen.blocks(stretches);
        change(&mut blocks, stretches);
        let Blocks { gradient, hessian, flip, twist } = blocks;
        let (stiffest, steepest) =
            (largest([largest(hessian), largest(flip), largest(twist)]), largest(gradient));
        if !(stiffest + steepest).is_finite() {
            return None;
        }
        let wave = slowest(&blocks);
        let moduli = [baker_ericksen(&blocks), hill(&blocks, stretches)?, wave.modulus];
        if !moduli.iter().sum::<f64>().is_finite() {
            return None;
        }
        let longest = stretches[0];
        let scales = [stiffest, longest * (longest * stiffest + steepest), stiffest];
        let kept = std::array::from_fn(|k| moduli[k] > ROUNDINGS * scales[k]);
        Some(Self { stretches, moduli, kept, wave })
    }
}

/// 64 u: a dozen roundings in the derivatives, as many again in sums and eigenvalues of them.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON;

fn largest<const N: usize>(numbers: [f64; N]) -> f64 {
    let sizes = numbers.into_iter().map(f64::abs);
    sizes.fold(0.0, |largest, size| if size > largest || size.is_nan() { size } else { largest })
}

/// The least aij.
fn baker_ericksen(blocks: &Blocks<f64>) -> f64 {
    (0..PAIRS.len()).map(|pair| blocks.pair_block(pair).0).fold(f64::INFINITY, f64::min)
}

/// Half the least eigenvalue of dτ/d ln U; `None` where that overflows, and has no eigenvalues.
fn hill(blocks: &Blocks<f64>, stretches: [f64; 3]) -> Option<f64> {
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let hessian = Matrix3::new(h11, h12, h13, h12, h22, h23, h13, h23, h33);
    let diagonal = Matrix3::from_diagonal(&stretches.into());
    let stresses: [f64; 3] = std::array::from_fn(|i| stretches[i] * blocks.gradient[i]);
    let tangent = diagonal * hessian * diagonal + Matrix3::from_diagonal(&stresses.into());
    if !tangent.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let shears = PAIRS.into_iter().enumerate().map(|(pair, (i, j))| {
        let mean = logarithmic_mean(stretches[i], stretches[j]);
        blocks.pair_block(pair).0 * (stretches[i] + stretches[j]) * mean
    });
    Some(0.5 * shears.fold(tangent.symmetric_eigenvalues().min(), f64::min))
}

/// (x − y)/(ln x − ln y) for x ≥ y > 0, without a difference of logarithms.
fn logarithmic_mean(x: f64, y: f64) -> f64 {
    let gap = (x - y) / y;
    if gap == 0.0 { y } else { y * (gap / gap.ln_1p()) }
}
