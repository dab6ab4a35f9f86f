//! The rule on rotations of space and of the rest shape, and on equal stretches.

#![expect(non_snake_case, reason = "F, P, Q, W as in the literature")]

use super::{Judge, UNIT, Verdict, gradient_name, hessian_name, stiffness, stress_scale};
use crate::material::PAIRS;
use crate::point::matrix::multiply;
use crate::point::{Matrix3, evaluate_energy, evaluate_stress};

/// [`Isotropy`](super::Rule::Isotropy).
pub(super) fn isotropy(judge: &mut Judge<'_>) -> Verdict {
    for stretches in judge.samples() {
        let (Q, W) = (judge.random.rotation(), judge.random.rotation());
        rotated(judge, stretches, &Q, &W)?;
        for equal in [[stretches[0], stretches[0], stretches[2]], [stretches[0], stretches[1], stretches[1]]]
        {
            if judge.material.admits(equal) {
                interchangeable(judge, equal)?;
            }
        }
    }
    Ok(())
}

/// Energy and stress at Q diag(λ) W against those at diag(λ), which need no decomposition.
fn rotated(judge: &mut Judge<'_>, stretches: [f64; 3], Q: &Matrix3<f64>, W: &Matrix3<f64>) -> Verdict {
    let material = judge.material;
    let F = multiply(&multiply(Q, &diagonal(stretches)), W);
    let blocks = material.blocks(stretches);
    let scale = stress_scale(&blocks, stretches);
    // The product and the decomposition represent F to some 30 u, and each of the rotations Q, W is one to a
    // few u.
    let tolerance = 100.0 * UNIT * scale;
    let expected = material.energy(stretches);
    let energy_tolerance = tolerance * stretches[0] + 100.0 * UNIT * expected.abs();
    let found = evaluate_energy(material, &F).energy;
    judge.compare(|| "energy after a rotation".into(), stretches, found, expected, energy_tolerance)?;
    let found = evaluate_stress(material, &F).stress;
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
fn interchangeable(judge: &mut Judge<'_>, stretches: [f64; 3]) -> Verdict {
    let blocks = judge.material.blocks(stretches);
    let tolerance = 100.0 * UNIT * stress_scale(&blocks, stretches);
    let curvature = 100.0 * UNIT * stiffness(&blocks);
    for (i, j) in PAIRS {
        if stretches[i] != stretches[j] {
            continue;
        }
        judge.compare(|| gradient_name(j), stretches, blocks.gradient[j], blocks.gradient[i], tolerance)?;
        // ψjj and ψii, then ψjk and ψik: entry 5 − i of the Hessian is that of the pair without i.
        for (entry, other) in [(j, i), (5 - i, 5 - j)] {
            let (found, expected) = (blocks.hessian[entry], blocks.hessian[other]);
            judge.compare(|| hessian_name(entry), stretches, found, expected, curvature)?;
        }
    }
    Ok(())
}

pub(super) fn diagonal(d: [f64; 3]) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}
