//! The rule on derivatives by dual numbers: to rounding, where difference quotients leave a truncation.

use super::dual::Dual;
use super::evaluation::{blocks_at, energy_at, gradient_at};
use super::samples::at_samples;
use super::{Finding, Rule, Settings, UNIT, Violation, gradient_name, hessian_name, stiffness, stress_scale};
use crate::material::Material;

/// The entries ψ11, ψ22, ψ33, ψ12, ψ13, ψ23 as pairs of stretches.
pub(super) const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Derivatives by dual numbers: `energy` gives the ψi of `gradient` and `blocks`, and `gradient` the ψij,
/// either way round.
///
/// Both the energy and its derivatives are sums of terms no larger than the tangent, with tens of roundings.
///
/// # Errors
/// [`Violation`]: the first that is found.
pub fn dual_numbers(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::DualNumbers, material, settings, |judge, stretches, _| {
        let blocks = blocks_at(material, stretches);
        let gradient = gradient_at(material, stretches);
        let first = 100.0 * UNIT * stress_scale(&blocks, stretches);
        let second = 100.0 * UNIT * stiffness(&blocks);
        let lines = [0, 1, 2].map(|k| Dual::along(stretches, k));
        for k in 0..3 {
            let expected = energy_at(material, lines[k]).slope;
            for (method, found) in [("gradient", gradient[k]), ("blocks", blocks.gradient[k])] {
                let name = || format!("{}, as `{method}` gives it", gradient_name(k));
                judge.compare(name, stretches, found, expected, first)?;
            }
        }
        let rows = lines.map(|line| gradient_at(material, line));
        for (entry, (i, j)) in ENTRIES.into_iter().enumerate() {
            for expected in [rows[i][j].slope, rows[j][i].slope] {
                let found = blocks.hessian[entry];
                judge.compare(|| hessian_name(entry), stretches, found, expected, second)?;
            }
        }
        Ok(())
    })
}
