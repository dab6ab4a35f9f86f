//! The rule on extensions: smooth next to and across the threshold, restoring below it.

use super::slopes::{Approach, energy_along, stress_along};
use super::{Judge, Verdict, Violation, gradient_name};
use crate::material::Blocks;

/// Values of −λ3 at which the extension is judged beyond det F = 0.
const DEPTHS: [f64; 3] = [0.01, 0.5, 2.0];

/// [`Extension`](super::Rule::Extension), of a material that is extended from a threshold on.
pub(super) fn extension(judge: &mut Judge<'_>, epsilon: f64) -> Verdict {
    let (_, high) = judge.settings.range;
    for point in 0..judge.settings.points {
        // λ2 clear of the threshold, unless a rule has another value.
        let l2 = judge.random.uniform(1.1 * epsilon, high);
        let l1 = judge.random.uniform(l2, high.max(1.01 * l2));
        let near = [0.0, 1e-3, -1e-3, 1e-8, -1e-8][point % 5];
        across(judge, [l1, l2, epsilon * (1.0 + near)])?;

        let gap = [1.0 / 16.0, 1.0 / 64.0][point % 2];
        let (above, below) = (epsilon * (1.0 + gap), epsilon * (1.0 - gap));
        let (further, lower) = (epsilon * (1.0 + 2.0 * gap), epsilon * (1.0 - 2.0 * gap));
        for (l2, l3) in [(l2, above), (l2, below), (further, above), (above, below), (below, lower)] {
            beside(judge, [l1, l2, l3], epsilon)?;
        }
        for depth in DEPTHS.into_iter().filter(|depth| 1.1 * depth < high) {
            let l2 = judge.random.uniform((1.1 * depth).max(1.1 * epsilon), high);
            let l1 = judge.random.uniform(l2, high.max(1.01 * l2));
            beside(judge, [l1, l2, -depth], epsilon)?;
        }
        for l3 in [epsilon * (1.0 - 1e-6), judge.random.uniform(-0.95, -0.05) * l2, -l2] {
            restoring(judge, [l1, l2, l3], epsilon)?;
        }
    }
    Ok(())
}

fn across(judge: &mut Judge<'_>, stretches: [f64; 3]) -> Verdict {
    if !admitted(judge, stretches)? {
        return Ok(());
    }
    energy_along(judge, stretches, &Approach::smooth(stretches))?;
    stress_along(judge, stretches, &Approach::across(stretches))
}

fn beside(judge: &mut Judge<'_>, stretches: [f64; 3], epsilon: f64) -> Verdict {
    if !admitted(judge, stretches)? {
        return Ok(());
    }
    let approach = Approach::beside(epsilon, stretches);
    energy_along(judge, stretches, &approach)?;
    stress_along(judge, stretches, &approach)?;
    if stretches[2] < epsilon { restoring(judge, stretches, epsilon) } else { Ok(()) }
}

fn restoring(judge: &mut Judge<'_>, stretches: [f64; 3], epsilon: f64) -> Verdict {
    if stretches.iter().product::<f64>() >= 1.0 || !admitted(judge, stretches)? {
        return Ok(());
    }
    let (material, notation) = (judge.material, judge.settings.notation);
    let [l1, l2, _] = stretches;
    let found = material.gradient(stretches)[2];
    let remedy = || {
        let logarithm = notation.either(
            "add `+ kappa * (J - 1.0 - J.ln())` with a parameter of its own (or a greater one, if it has such a term), and state \
             which parameters restore, as in `extend(kappa > 0.0)`",
            "add `+ kappa*(J - 1 - ln(J))` with a parameter of its own (or a greater one, if it has such a term)",
        );
        let refused = notation.either("by `admissible(…)`", "by a condition such as `where kappa > 0`");
        let alone = notation.either(
            "refuse inversion, by `refuse(\"why\")` in place of `extend`",
            "leave the energy without an extension",
        );
        // At the threshold the derivatives are those of the energy as declared.
        let Blocks { gradient, hessian, .. } = material.blocks([l1, l2, epsilon]);
        let (declared, first) = if gradient[2] < 0.0 {
            ("does push λ3 up at epsilon", logarithm.to_owned())
        } else if hessian[2] > 0.0 {
            ("falls there, too", format!("choose a smaller `epsilon`, or {logarithm}"))
        } else {
            let steeper = format!(
                "if it is that of an incompressible solid, write `I1b` and `I2b` for `I1` and `I2`; or refuse such parameters, \
                 {refused}; or add what outweighs it as the volume vanishes"
            );
            ("falls there, too, and the steeper the flatter", steeper)
        };
        let narrower = notation.narrower();
        format!(
            "below epsilon = {epsilon} the extended energy falls as λ3 falls, so that nothing brings a flattened element back; the \
             energy as declared {declared}: {first}; or {narrower}; or {alone}"
        )
    };
    let words = || (gradient_name(2), Some(remedy()));
    judge.demand(found < 0.0, "a negative number", words, stretches, found)
}

/// True if the material admits the mirror image. The point itself must be admitted then, too: a bound such as
/// Gent's on I1 has nothing to do with inversion.
fn admitted(judge: &mut Judge<'_>, stretches: [f64; 3]) -> Result<bool, Violation> {
    let [l1, l2, l3] = stretches;
    if !judge.material.admits([l1, l2, l3.abs()]) {
        return Ok(false);
    }
    let remedy = "a limit of the domain other than J > 0 excludes this inverted point and admits its mirror image: write that limit \
                  in terms that are independent of signs, such as I1, I2 or J * J, or continue the function that ends there";
    judge.holds(|| "admission".into(), stretches, judge.material.admits(stretches), remedy)?;
    Ok(true)
}
