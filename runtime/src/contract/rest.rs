//! Rules on F = I.

use super::subject::Subject;
use super::{Finding, Judge, Rule, Settings, UNIT, Violation, gradient_name, pair_name, stiffness};
use crate::material::Moduli;

/// [`Rule::Rest`].
pub(super) fn rest(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Rest, settings.notation);
    let stretches = [1.0; 3];
    let blocks = material.blocks(stretches);
    let tolerance = 64.0 * UNIT * stiffness(&blocks);
    for k in 0..3 {
        if settings.stress_free_at_rest {
            judge.vanishes(|| gradient_name(k), stretches, blocks.gradient[k], tolerance, STRESSED)?;
            judge.compare(|| pair_name("twist", k), stretches, blocks.twist[k], 0.0, tolerance)?;
        }
        let shear = blocks.hessian[0] - blocks.hessian[3];
        judge.compare(|| pair_name("flip", k), stretches, blocks.flip[k], shear, tolerance)?;
        judge.positive(|| pair_name("flip", k), stretches, blocks.flip[k])?;
    }
    judge.finding()
}

/// Advice for stress at rest, be it a mistake or meant.
const STRESSED: &str = "append to the energy a term that cancels this stress, such as `- mu * J.ln()`; or, where the rest state carries it \
                        on purpose, as that of a material declared `prestressed`, set `stress_free_at_rest: false`, as in \
                        `piola::contract!(gel: Gel::new(1e4, 1e6)?, stress_free_at_rest: false)`";

/// [`Rule::Moduli`].
pub(super) fn moduli(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    let rule = Rule::Moduli;
    let Some(stated) = material.stated_moduli() else {
        return Err(Violation::DoesNotApply { rule, lacks: "stated moduli" });
    };
    let mut judge = Judge::new(rule, settings.notation);
    let stretches = [1.0; 3];
    let tolerance = 64.0 * UNIT * stiffness(&material.blocks(stretches));
    let found = Moduli::at_rest(material);
    judge.compare(|| "shear modulus".into(), stretches, stated.mu, found.mu, tolerance)?;
    judge.compare(|| "first Lamé parameter".into(), stretches, stated.lambda, found.lambda, tolerance)?;
    judge.finding()
}
