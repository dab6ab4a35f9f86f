//! The rules on derivatives to rounding, where difference quotients leave a truncation: by dual numbers, and
//! by strains near rest.

use super::dual::Dual;
use super::subject::{Subject, at_samples};
use super::{Finding, Rule, Settings, UNIT, Violation, gradient_name, hessian_name, stiffness, stress_scale};

/// The entries ψ11, ψ22, ψ33, ψ12, ψ13, ψ23 as pairs of stretches.
pub(super) const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// [`Rule::DualNumbers`].
pub(super) fn dual_numbers(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::DualNumbers, material, settings, |judge, stretches, _| {
        let blocks = material.blocks(stretches);
        let gradient = material.gradient(stretches);
        let first = 100.0 * UNIT * stress_scale(&blocks, stretches);
        let second = 100.0 * UNIT * stiffness(&blocks);
        let lines = [0, 1, 2].map(|k| Dual::along(stretches, k));
        for k in 0..3 {
            let expected = material.dual_energy(lines[k]).slope;
            for (method, found) in [("gradient", gradient[k]), ("blocks", blocks.gradient[k])] {
                let name = || format!("{}, as `{method}` gives it", gradient_name(k));
                judge.compare(name, stretches, found, expected, first)?;
            }
        }
        let rows = lines.map(|line| material.dual_gradient(line));
        for (entry, (i, j)) in ENTRIES.into_iter().enumerate() {
            for expected in [rows[i][j].slope, rows[j][i].slope] {
                let found = blocks.hessian[entry];
                judge.compare(|| hessian_name(entry), stretches, found, expected, second)?;
            }
        }
        Ok(())
    })
}

/// [`Rule::Strains`].
pub(super) fn strains(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Strains, material, settings, |judge, stretches, _| {
        if stretches[2] <= 0.0 {
            return Ok(());
        }
        for exponent in 0..=16 {
            let factor = if exponent == 16 { 0.0 } else { 10f64.powi(-exponent) };
            let strains = stretches.map(|l| factor * (l - 1.0));
            let stretches = strains.map(|s| 1.0 + s);
            if !material.admits(stretches) {
                continue;
            }
            let found = material.gradient_at_strains(strains);
            let expected = material.gradient(stretches);
            let tolerance = 100.0 * UNIT * stress_scale(&material.blocks(stretches), stretches);
            for k in 0..3 {
                let name = || format!("{}, from the strain {:e}", gradient_name(k), strains[k]);
                judge.compare(name, stretches, found[k], expected[k], tolerance)?;
            }
        }
        Ok(())
    })
}
