//! The rules on the rest state F = I, and on the domain that a material declares, which determines how
//! exactly the sign of λ3 is computed.

use super::results::{name, results};
use super::{Judge, Notation, UNIT, Verdict, gradient_name, pair_name, stiffness};
use crate::material::Moduli;

/// [`Domain`](super::Rule::Domain).
pub(super) fn domain(judge: &mut Judge<'_>) -> Verdict {
    let (material, notation) = (judge.material, judge.settings.notation);
    let finite = |judge: &mut Judge<'_>, component: &dyn Fn() -> String, stretches, number| {
        judge.finite(component, stretches, number, || remedy(notation, number))
    };
    for stretches in judge.samples() {
        for (k, number) in results(material, stretches).into_iter().enumerate() {
            finite(judge, &|| name(k), stretches, number)?;
        }
        let [l1, l2, _] = stretches;
        let flat = [-10, -20, -30].map(|k| l1 * 2f64.powi(k));
        for l3 in flat.into_iter().flat_map(|l3| [l3, -l3]) {
            let stretches = [l1, l2, l3];
            if l2 >= l3.abs() && material.admits(stretches) {
                let energy = material.energy(stretches);
                if energy != f64::INFINITY {
                    finite(judge, &|| "energy".into(), stretches, energy)?;
                }
                let overflows = energy > 2f64.powi(512);
                if !overflows {
                    for (k, slope) in material.gradient(stretches).into_iter().enumerate() {
                        finite(judge, &|| gradient_name(k), stretches, slope)?;
                    }
                }
            }
        }
        let tiny = 2f64.powi(-1000);
        let decides = material.admits([l1, l2, tiny]) != material.admits([l1, l2, -tiny]);
        let is_true = !decides || material.ends_at_zero_volume();
        let name = || "truth of `ends_at_zero_volume`".into();
        let advice = "the material admits these stretches or their mirror image, but not both: let `ends_at_zero_volume` return `true`";
        judge.holds(name, [l1, l2, tiny], is_true, advice)?;
    }
    Ok(())
}

/// Advice for an energy or derivative that is infinite or NaN.
fn remedy(notation: Notation, found: f64) -> String {
    let narrower = notation.narrower();
    match found.is_nan() {
        true => {
            let condition = notation.either(
                "add a condition to `domain(…)`, or to `admissible(…)` if a parameter divides by zero; let `admits` of a function \
                 that is a parameter tell where it is defined",
                "add a condition after the formula, such as `where J > 0, I1 < 9`, or `where b > 0` if a parameter divides by zero",
            );
            format!(
                "the domain admits these stretches, but the energy has no value there (a root, real power or logarithm of \
                 something negative?): {condition}; or, where I1 − 3 may not be negative, write `I1b` for `I1`, which is 3 or \
                 more wherever J > 0"
            )
        }
        false => {
            let vanishing = notation.either(
                "; where a denominator or the argument of a logarithm vanishes, add a condition to `domain(…)`, or to \
                 `admissible(…)` if it is one of parameters alone",
                "",
            );
            format!(
                "the domain admits these stretches, but the number overflows there: choose smaller parameters, or \
                 {narrower}{vanishing}"
            )
        }
    }
}

/// [`Rest`](super::Rule::Rest).
pub(super) fn rest(judge: &mut Judge<'_>) -> Verdict {
    let stretches = [1.0; 3];
    let blocks = judge.material.blocks(stretches);
    let tolerance = 64.0 * UNIT * stiffness(&blocks);
    for k in 0..3 {
        if judge.settings.stress_free_at_rest {
            let (name, stress) = (|| gradient_name(k), blocks.gradient[k]);
            judge.compare_or(name, stretches, stress, 0.0, tolerance, Some(STRESSED))?;
            judge.compare(|| pair_name("twist", k), stretches, blocks.twist[k], 0.0, tolerance)?;
        }
        let shear = blocks.hessian[0] - blocks.hessian[3];
        judge.compare(|| pair_name("flip", k), stretches, blocks.flip[k], shear, tolerance)?;
        let (flip, words) = (blocks.flip[k], || (pair_name("flip", k), None));
        judge.demand(flip > 0.0, "a positive number", words, stretches, flip)?;
    }
    Ok(())
}

/// Advice for stress at rest, be it a mistake or meant.
const STRESSED: &str = "append to the energy a term that cancels this stress, such as `- mu * J.ln()`; or, where the rest state carries it \
                        on purpose, as that of a material declared `prestressed`, set `stress_free_at_rest: false`, as in \
                        `piola::contract!(gel: Gel::new(1e4, 1e6)?, stress_free_at_rest: false)`";

/// [`Moduli`](super::Rule::Moduli), of a material that states these.
pub(super) fn moduli(judge: &mut Judge<'_>, stated: Moduli) -> Verdict {
    let stretches = [1.0; 3];
    let tolerance = 64.0 * UNIT * stiffness(&judge.material.blocks(stretches));
    let found = Moduli::at_rest(judge.material);
    judge.compare(|| "shear modulus".into(), stretches, stated.mu, found.mu, tolerance)?;
    judge.compare(|| "first Lamé parameter".into(), stretches, stated.lambda, found.lambda, tolerance)
}
