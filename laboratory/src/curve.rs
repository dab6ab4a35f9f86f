//! Test curves: what a testing machine reads from a homogeneous specimen.
//!
//! The axes of a test are the one along which it pulls, the one across in the plane, and the thickness. A
//! machine prescribes one value, the *control*, and measures one stress:
//!
//! | mode | control | stretches | stress |
//! |---|---|---|---|
//! | uniaxial | λ | λ, t, t | ψ1 |
//! | equibiaxial | λ | λ, λ, t | ψ1 |
//! | pure shear (planar tension) | λ | λ, 1, t | ψ1 |
//! | simple shear | γ | ℓ, 1/ℓ, 1 with ℓ − 1/ℓ = γ | P12 = (ℓ² ψ1 − ψ2) / (ℓ² + 1) |
//! | volumetric | J | ∛J, ∛J, ∛J | ∂ψ/∂J = Σ ψi / (3 ∛J²), the mean Cauchy stress: minus the pressure |
//!
//! ψi are along these axes here, and all except for the last are nominal stresses: force by area at rest, Pa.
//! The stretch t of the sides is such that they are free of stress, ψ3 = 0, or, if the [volume is
//! kept](Volume::Kept), such that J = 1: the incompressible solid, in which a pressure that does no work
//! makes the sides free of stress and the stress is ψ1 − ψ3 t/λ.
//!
//! Nothing is formed that cancels at rest, so that the stress is as accurate at the smallest strains as
//! [`gradient_at_strains`](piola::Material::gradient_at_strains) is.

pub(crate) mod lateral;

use std::fmt;
use std::str::FromStr;

use piola::__private::message::{number, quoted};

use crate::{Specimen, specimen};
use lateral::Side;

/// Test mode: the motion that the machine prescribes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Mode {
    /// Tension or compression along one axis, free across.
    Uniaxial,
    /// Equal tension or compression along two axes, free through the thickness.
    Equibiaxial,
    /// Tension along one axis, held across, free through the thickness: planar tension.
    PureShear,
    /// Shear between parallel plates that keep their distance.
    SimpleShear,
    /// Equal tension or compression from all sides.
    Volumetric,
}

impl Mode {
    /// All modes, in the order of reports.
    pub const ALL: [Self; 5] =
        [Self::Uniaxial, Self::Equibiaxial, Self::PureShear, Self::SimpleShear, Self::Volumetric];

    /// The name in files and on the command line, such as `pure_shear`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniaxial => "uniaxial",
            Self::Equibiaxial => "equibiaxial",
            Self::PureShear => "pure_shear",
            Self::SimpleShear => "simple_shear",
            Self::Volumetric => "volumetric",
        }
    }

    /// The letter of the control: λ, γ or J.
    pub(crate) fn letter(self) -> &'static str {
        match self {
            Self::SimpleShear => "γ",
            Self::Volumetric => "J",
            _ => "λ",
        }
    }

    /// Name of the control in messages.
    pub(crate) fn quantity(self) -> &'static str {
        match self {
            Self::SimpleShear => "the shear",
            Self::Volumetric => "the volume ratio J",
            _ => "the stretch",
        }
    }

    /// The control at rest: λ = 1, γ = 0, J = 1.
    #[must_use]
    pub fn rest(self) -> f64 {
        match self {
            Self::SimpleShear => 0.0,
            _ => 1.0,
        }
    }

    /// The principal strains when the machine's stretch is 1 + `along` and that of free sides 1 + `side`.
    fn strains(self, along: f64, side: f64) -> [f64; 3] {
        match self {
            Self::Equibiaxial => [along, along, side],
            Self::PureShear => [along, 0.0, side],
            _ => [along, side, side],
        }
    }

    /// The strain of free sides that keeps the volume.
    fn isochoric(self, along: f64) -> f64 {
        let power = match self {
            Self::Equibiaxial => -2.0,
            Self::PureShear => -1.0,
            _ => -0.5,
        };
        (power * along.ln_1p()).exp_m1()
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Mode {
    type Err = String;

    /// Parses a name in any case, with spaces or `-` for `_`: the [name](Mode::name), or another common one:
    /// `UT`, `tension`, `uniaxial tension`; `ET`, `EB`, `BT`, `biaxial`, `biaxial tension`; `PS`, `planar`,
    /// `planar tension`; `SS`; `hydrostatic`. `shear` alone could be either of two tests and is refused, as
    /// is `compression`, whose numbers could have either sign.
    fn from_str(text: &str) -> Result<Self, String> {
        let words = text.to_lowercase();
        let words = words.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        let name = words.collect::<Vec<_>>().join("_");
        let mode = NAMES.into_iter().find(|(mode, others)| mode.name() == name || others.contains(&&*name));
        mode.map(|(mode, _)| mode).ok_or_else(|| {
            let hint = match &*name {
                "shear" => " by itself: pure shear has a stretch λ, simple shear an angle γ",
                name if name.contains("compress") => {
                    ": a compression is `uniaxial`, with negative strain and stress or under `compressive strain` and \
                     `compressive stress`"
                }
                _ => "",
            };
            let modes = Self::ALL.map(|mode| format!("`{mode}`")).join(", ");
            format!("`{}` is not a test{hint}; write one of {modes}", quoted(text.trim()))
        })
    }
}

const NAMES: [(Mode, &[&str]); 5] = [
    (Mode::Uniaxial, &["ut", "tension", "uniaxial_tension"]),
    (Mode::Equibiaxial, &["et", "eb", "bt", "biaxial", "equi_biaxial", "biaxial_tension"]),
    (Mode::PureShear, &["ps", "planar", "planar_tension"]),
    (Mode::SimpleShear, &["ss"]),
    (Mode::Volumetric, &["hydrostatic"]),
];

/// Treatment of the volume of a specimen: free or constant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Volume {
    /// Free volume: the energy determines it, and free sides carry no stress.
    #[default]
    Free,
    /// Constant volume, regardless of the energy's resistance to changes of volume: the incompressible solid.
    Kept,
}

/// A point of a test curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// The control that the machine has set: λ, γ or J.
    pub control: f64,
    /// Principal stretches: along, across in the plane, through the thickness. For simple shear: the
    /// greatest, the least, and 1.
    pub stretches: [f64; 3],
    /// Measured stress, Pa.
    pub stress: f64,
    /// The weights that make up the stress: Σ weights · (ψ1, ψ2, ψ3).
    ///
    /// If the sides are free, the weights include their motion, so that for any parameter of the energy the
    /// derivative of the stress is Σ weights · (∂ψ1, ∂ψ2, ∂ψ3) at the stretches held, by the implicit
    /// function theorem.
    pub weights: [f64; 3],
}

impl Response {
    /// J = λ1 λ2 λ3, the volume by that at rest.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.stretches.iter().product()
    }
}

/// Reason why a test curve has no point at a control.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// No specimen can be brought to the control.
    #[error("{} is {}; it must be {}finite", mode.quantity(), number(*control), if *mode == Mode::SimpleShear { "" } else { "positive and " })]
    Control {
        /// The test.
        mode: Mode,
        /// The control as given.
        control: f64,
    },
    /// The deformation is outside the domain of the energy, or its stress is NaN or infinite.
    #[error("outside the domain of the energy")]
    OutsideDomain,
    /// No stretch of the sides between a thousandth and a thousand times that of constant volume makes them
    /// free of stress.
    #[error("no lateral stretch makes the sides free of stress")]
    NoEquilibrium,
    /// A volumetric test of a specimen whose volume is kept.
    #[error("a volumetric test changes the volume; leave it free, or leave the test out")]
    VolumeKept,
}

/// The points of a test curve, one for each control.
///
/// ```
/// use piola_laboratory::curve::{Mode, Volume, sweep};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let rubber = piola_materials::NeoHookean::new(1e6, 5e6)?;
/// let points = sweep(&rubber, Mode::Uniaxial, Volume::Kept, &[1.0, 2.0, -1.0]);
/// // P = μ (λ − 1/λ²), to a few roundings
/// assert!((points[1]?.stress - 1.75e6).abs() < 1e-8);
/// assert!(points[2].is_err());
/// # Ok(())
/// # }
/// ```
pub fn sweep(
    specimen: &dyn Specimen<f64>,
    mode: Mode,
    volume: Volume,
    controls: &[f64],
) -> Vec<Result<Response, ResponseError>> {
    controls.iter().map(|&control| respond(specimen, mode, volume, control)).collect()
}

/// One point of a test curve.
///
/// # Errors
/// [`ResponseError`] if the test has no point there.
pub fn respond(
    specimen: &dyn Specimen<f64>,
    mode: Mode,
    volume: Volume,
    control: f64,
) -> Result<Response, ResponseError> {
    if !control.is_finite() || (mode != Mode::SimpleShear && control <= 0.0) {
        return Err(ResponseError::Control { mode, control });
    }
    let (strains, weights) = match (mode, volume) {
        (Mode::SimpleShear, _) => simple_shear(control),
        (Mode::Volumetric, Volume::Free) => volumetric(control),
        (Mode::Volumetric, Volume::Kept) => return Err(ResponseError::VolumeKept),
        (_, Volume::Kept) => kept(mode, control),
        (_, Volume::Free) => free(specimen, mode, control)?,
    };
    let gradient = specimen::gradient(specimen, strains).ok_or(ResponseError::OutsideDomain)?;
    // Where the sides are free, this takes away to first order what is left of their stress.
    let stress: f64 = (0..3).map(|axis| weights[axis] * gradient[axis]).sum();
    match stress.is_finite() {
        true => Ok(Response { control, stretches: specimen::stretches(strains), stress, weights }),
        false => Err(ResponseError::OutsideDomain),
    }
}

type StrainsAndWeights = ([f64; 3], [f64; 3]);

/// Strains and weights from dℓ/dγ = ℓ²/(ℓ² + 1) and d(1/ℓ)/dγ = −1/(ℓ² + 1).
fn simple_shear(shear: f64) -> StrainsAndWeights {
    let half = 0.5 * shear.abs();
    // ℓ − 1 = γ/2 + √(1 + γ²/4) − 1
    let along = half + half * (half / (1.0 + half.hypot(1.0)));
    let across = -along / (1.0 + along);
    // 1/(ℓ² + 1), the square out of the way of overflow
    let share = 1.0 / (1.0 + along);
    let weight = share * share / (1.0 + share * share);
    ([along, across, 0.0], [(1.0 - weight).copysign(shear), -weight.copysign(shear), 0.0])
}

/// Strains and weights from dλi/dJ = 1/(3 ∛J²).
fn volumetric(volume: f64) -> StrainsAndWeights {
    let strain = ((volume - 1.0).ln_1p() / 3.0).exp_m1();
    let weight = 1.0 / (3.0 * volume.cbrt().powi(2));
    ([strain; 3], [weight; 3])
}

/// Strains and weights from the pressure that frees the sides, which adds −p J/λi to each ψi.
fn kept(mode: Mode, stretch: f64) -> StrainsAndWeights {
    let along = stretch - 1.0;
    let side = mode.isochoric(along);
    (mode.strains(along, side), [1.0, 0.0, -(1.0 + side) / stretch])
}

/// Strains and weights from the stretch of the sides at which ψ3 = 0: dψ1 = ∂ψ1 − (∂ψ1/∂t) (∂ψ3/∂t)⁻¹ ∂ψ3.
fn free(specimen: &dyn Specimen<f64>, mode: Mode, stretch: f64) -> Result<StrainsAndWeights, ResponseError> {
    let along = stretch - 1.0;
    // ∂ψ1/∂t and ∂ψ3/∂t, where the sides of one or of two axes are free.
    let slopes = |strains: [f64; 3]| {
        let hessian = specimen::hessian(specimen, strains);
        [0, 2].map(|axis| {
            let across = if mode == Mode::Uniaxial { hessian[axis][1] } else { 0.0 };
            hessian[axis][2] + across
        })
    };
    let stress_of_sides = |side: f64| {
        let strains = mode.strains(along, side);
        let [.., stress] = specimen::gradient(specimen, strains)?;
        let [_, slope] = slopes(strains);
        Some(Side { stress, slope })
    };
    let side =
        lateral::release(stress_of_sides, mode.isochoric(along)).ok_or(ResponseError::NoEquilibrium)?;
    let strains = mode.strains(along, side);
    let [along_slope, slope] = slopes(strains);
    Ok((strains, [1.0, 0.0, -along_slope / slope]))
}
