//! Loss of a criterion of incompressible solids on the way from rest to the end of a test.
//!
//! At constant volume an energy does not determine the pressure, and no criterion may depend on it. So each
//! is required only for changes that keep the volume: Hill's for tr d ln U = 0, strong ellipticity for waves
//! with m · F⁻ᵀN = 0. To these it is restricted by a penalty K/2 (J − 1)², with K a million times the
//! greatest of the moduli, which at J = 1 adds K/(λi λj) to ψij and nothing else. Pressures and bulk moduli
//! of the energy vanish compared with it, and what coupling takes from the other modes is a millionth of the
//! greatest.

use piola::material::{Blocks, PAIRS};

use super::criteria::Judgement;
use super::path::losses;
use crate::Specimen;
use crate::curve::{Mode, Volume, respond};

/// The penalty by the greatest modulus.
const PENALTY: f64 = 1e6;

/// The first control at which each of [`Criterion::ALL`](super::criteria::Criterion::ALL) is lost on the way
/// from rest to a control, the volume being kept; rest itself if it does not hold there.
///
/// The steps are as many as those of a [`Walk`](super::Walk), equal in ln λ or in γ. A volumetric test has no
/// path of constant volume and loses nothing; nor does a path beyond the domain.
///
/// ```
/// use piola_laboratory::curve::Mode;
/// use piola_laboratory::stability::constant_volume::lost;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // τ2 − τ3 = 2 (λ2² − λ3²) (1 − λ1²/4) for I1 − I2/4 as two terms of Ogden's: lost where λ1 = 2.
/// let solid = piola_materials::Ogden::new([2.0, 0.5], [2.0, -2.0], 1e3)?;
/// let [baker_ericksen, ..] = lost(&solid, Mode::Uniaxial, 3.0);
/// // What vanishes to 64 u of the penalty, 10⁶ times the bulk modulus of 10³, is not kept beyond doubt.
/// assert!(baker_ericksen.is_some_and(|stretch| (stretch - 2.0).abs() < 1e-4));
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn lost(specimen: &dyn Specimen<f64>, mode: Mode, to: f64) -> [Option<f64>; 3] {
    let control = |share: f64| match mode {
        Mode::SimpleShear => share * to,
        _ => to.powf(share),
    };
    let (_, lost) = losses(|share| {
        let response = respond(specimen, mode, Volume::Kept, control(share)).ok()?;
        Judgement::with(specimen, response.stretches, penalise)
    });
    lost.map(|lost| lost.map(control))
}

/// Adds the penalty on the volume, at J = 1.
fn penalise(blocks: &mut Blocks<f64>, stretches: [f64; 3]) {
    // Those of ψii, then those of the pairs.
    let products: [f64; 6] = std::array::from_fn(|k| match k.checked_sub(3) {
        None => stretches[k] * stretches[k],
        Some(pair) => stretches[PAIRS[pair].0] * stretches[PAIRS[pair].1],
    });
    let stresses = (0..3).map(|i| (stretches[i] * blocks.gradient[i]).abs());
    let moduli = (0..6).map(|k| (products[k] * blocks.hessian[k]).abs());
    let penalty = PENALTY * stresses.chain(moduli).fold(0.0, f64::max);
    for (modulus, product) in blocks.hessian.iter_mut().zip(products) {
        *modulus += penalty / product;
    }
}
