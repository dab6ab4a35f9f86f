//! The rule on rotations of space and of the rest shape, and on equal stretches.

#![expect(non_snake_case, reason = "F, P, Q, W as in the literature")]

use super::subject::{Subject, at_samples, energy, stress};
use super::{Finding, Judge, Rule, Settings, UNIT, Violation, gradient_name, stiffness, stress_scale};
use crate::material::PAIRS;
use crate::point::Matrix3;
use crate::point::matrix::multiply;

/// [`Rule::Isotropy`].
pub(super) fn isotropy(material: &dyn Subject, settings: &Settings) -> Result<Finding, Violation> {
    at_samples(Rule::Isotropy, material, settings, |judge, stretches, random| {
        rotated(judge, material, stretches, &random.rotation(), &random.rotation())?;
        for equal in [[stretches[0], stretches[0], stretches[2]], [stretches[0], stretches[1], stretches[1]]]
        {
            if material.admits(equal) {
                interchangeable(judge, material, equal)?;
            }
        }
        Ok(())
    })
}

/// Energy and stress at Q diag(λ) W against those at diag(λ), which need no decomposition.
fn rotated(
    judge: &mut Judge,
    material: &dyn Subject,
    stretches: [f64; 3],
    Q: &Matrix3<f64>,
    W: &Matrix3<f64>,
) -> Result<(), Violation> {
    let F = multiply(&multiply(Q, &diagonal(stretches)), W);
    let blocks = material.blocks(stretches);
    let scale = stress_scale(&blocks, stretches);
    // The product and the decomposition represent F to some 30 u, and each of the rotations Q, W is one to a
    // few u.
    let tolerance = 100.0 * UNIT * scale;
    let expected = material.energy(stretches);
    let energy_tolerance = tolerance * stretches[0] + 100.0 * UNIT * expected.abs();
    let found = energy(material, &F);
    judge.compare(|| "energy after a rotation".into(), stretches, found, expected, energy_tolerance)?;
    let found = stress(material, &F);
    let expected = multiply(&multiply(Q, &diagonal(blocks.gradient)), W);
    for i in 0..3 {
        for j in 0..3 {
            let name = || format!("entry ({}, {}) of the stress after a rotation", i + 1, j + 1);
            judge.compare(name, stretches, found[i][j], expected[i][j], tolerance)?;
        }
    }
    Ok(())
}

/// First and second derivatives by two equal stretches agree, and so do their mixed ones with the third.
fn interchangeable(judge: &mut Judge, material: &dyn Subject, stretches: [f64; 3]) -> Result<(), Violation> {
    let blocks = material.blocks(stretches);
    let mixed = |i: usize, j: usize| {
        let pair = PAIRS.iter().position(|&pair| pair == (i.min(j), i.max(j)));
        pair.map_or(f64::NAN, |pair| blocks.hessian[3 + pair])
    };
    let tolerance = 100.0 * UNIT * stress_scale(&blocks, stretches);
    let curvature = 100.0 * UNIT * stiffness(&blocks);
    for (i, j) in PAIRS {
        if stretches[i] != stretches[j] {
            continue;
        }
        let k = 3 - i - j;
        judge.compare(|| gradient_name(j), stretches, blocks.gradient[j], blocks.gradient[i], tolerance)?;
        let name = || format!("second derivative of the energy by stretch {}", j + 1);
        judge.compare(name, stretches, blocks.hessian[j], blocks.hessian[i], curvature)?;
        let name = || format!("second derivative of the energy by stretches {} and {}", j + 1, k + 1);
        judge.compare(name, stretches, mixed(j, k), mixed(i, k), curvature)?;
    }
    Ok(())
}

pub(super) fn diagonal(d: [f64; 3]) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}
