//! dP/dF by central differences of P: two stresses for each of the nine entries of F.
//!
//! ```text
//! ∂P/∂Fkl ≈ (P(F + h ek elᵀ) − P(F − h ek elᵀ)) / 2h
//! ```
//!
//! The formula errs by h²/6 times a third derivative of P, rounding adds u ‖P‖/h: together at least about
//! u^⅔, for h ≈ u^⅓ ‖F‖, a third of the digits. Where an energy is stiff in one direction and soft in another
//! no single step serves both.

#![expect(non_snake_case, reason = "F, P as in the formula")]

use piola::point::{Matrix3, evaluate_stress};
use piola::{Material, Real};

/// dP/dF, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F, with h = `step` · max |Fij|.
///
/// Of each entry the two values that floating point makes of Fkl ± h are taken, and divided by their own
/// distance. Symmetric up to the error of the method. NaN where one of the eighteen stresses is, at F = 0 for
/// instance.
#[inline(always)]
#[must_use]
pub fn tangent<R: Real<Mask = bool>>(material: &impl Material, F: &Matrix3<R>, step: f64) -> [[R; 9]; 9] {
    let zero = R::splat(0.0);
    let largest = F.as_flattened().iter().fold(zero, |largest, entry| largest.max(entry.abs()));
    let h = R::splat(step) * largest;
    let mut dP_dF = [[zero; 9]; 9];
    for k in 0..3 {
        for l in 0..3 {
            let (mut above, mut below) = (*F, *F);
            above[k][l] = F[k][l] + h;
            below[k][l] = F[k][l] - h;
            let inverse = R::splat(1.0) / (above[k][l] - below[k][l]);
            let P_above = evaluate_stress(material, &above).stress;
            let P_below = evaluate_stress(material, &below).stress;
            for i in 0..3 {
                for j in 0..3 {
                    dP_dF[3 * i + j][3 * k + l] = (P_above[i][j] - P_below[i][j]) * inverse;
                }
            }
        }
    }
    dP_dF
}

#[cfg(test)]
mod tests {
    use piola_materials::NeoHookean;

    use super::*;
    use crate::testing::{SHEARED, convert, error, exact};

    fn error_of_step<R: Real<Mask = bool> + Into<f64>>(step: f64) -> f64 {
        let material = NeoHookean::new(1.0, 2.0).expect("admissible parameters");
        let F = convert::<R>(&SHEARED);
        error(&tangent(&material, &F, step), &exact(&material, &F).1)
    }

    /// The third derivative is that of 1/λ³ at 0.7, hundreds of moduli: a few dozen times ‖dP/dF‖.
    #[test]
    fn the_best_step_leaves_two_thirds_of_the_digits() {
        assert!(error_of_step::<f64>(f64::UNIT_ROUNDOFF.cbrt()) <= 10.0 * f64::UNIT_ROUNDOFF.powf(2.0 / 3.0));
        assert!(error_of_step::<f32>(f32::UNIT_ROUNDOFF.cbrt()) <= 10.0 * f32::UNIT_ROUNDOFF.powf(2.0 / 3.0));
    }

    /// Halving a step that is still too long quarters the error, up to the fourth power of the step.
    #[test]
    fn the_error_falls_with_the_square_of_the_step() {
        let ratio = error_of_step::<f64>(1e-3) / error_of_step::<f64>(5e-4);
        assert!((3.99..4.01).contains(&ratio), "{ratio}");
    }

    /// From u ‖P‖/h alone, the average of many roundings, and never much better than u^⅔.
    #[test]
    fn no_step_gives_the_others() {
        let best =
            (2..13).map(|digits| error_of_step::<f64>(10f64.powi(-digits))).fold(f64::INFINITY, f64::min);
        assert!(best >= 0.05 * f64::UNIT_ROUNDOFF.powf(2.0 / 3.0), "{best:e}");
    }
}
