//! The rule on derivatives by dual numbers: to rounding, where difference quotients leave a truncation.

use super::dual::Dual;
use super::samples::at_samples;
use super::subject::Subject;
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
