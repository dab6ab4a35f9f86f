//! What a testing machine reads from a specimen.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use piola::batch::{Batch, Energy};
use piola::mesh::TetMesh;
use piola::step::Simulation;

use crate::measure;
use crate::output::Reading;

/// Reads an upright specimen between two marks, in shares of its height.
#[must_use]
pub fn read(mesh: &TetMesh, simulation: &Simulation, marks: [f64; 2], material: &dyn Energy<f64>) -> Reading {
    let bounds = mesh.bounds();
    let height = bounds.size()[1];
    let marks = marks.map(|share| bounds.min[1] + share * height);
    let positions = simulation.positions();
    let stretch = measure::upright_stretch(&mesh.positions, positions, marks);
    let upwards = simulation
        .pulls()
        .iter()
        .map(|pull| pull.stiffness * (pull.target[1] - pull.anchor.position(positions)[1]));
    let cross_section = measure::total_volume(&mesh.positions, &mesh.tets) / height;
    Reading {
        stretch,
        nominal_stress: upwards.sum::<f64>() / cross_section,
        uniaxial_stress: uniaxial_stress(material, stretch).unwrap_or(f64::NAN),
    }
}

/// Nominal stress, Pa, of a bar with this stretch along it and no stress across.
///
/// `None` where no stretch across between a thousandth and a thousand times that of constant volume frees the sides
/// of stress.
#[must_use]
pub fn uniaxial_stress(material: &dyn Energy<f64>, stretch: f64) -> Option<f64> {
    let stresses = |across: f64| {
        let F = [across, 0.0, 0.0, 0.0, stretch, 0.0, 0.0, 0.0, across];
        let mut P = [0.0; 9];
        let survey = Batch::new(material).stresses(&F, &mut P).ok()?;
        (survey.refused == 0 && survey.nonfinite == 0).then_some([P[0], P[4]])
    };
    let presses = |across: f64| stresses(across).map(|[P, _]| P < 0.0);
    // A side that is pressed outwards is too narrow.
    let isochoric = stretch.powf(-0.5);
    let (mut narrow, mut wide) = (isochoric, isochoric);
    while presses(narrow) == Some(false) && narrow > 1e-3 * isochoric {
        narrow /= 1.1;
    }
    while presses(wide) == Some(true) && wide < 1e3 * isochoric {
        wide *= 1.1;
    }
    if presses(narrow) != Some(true) || presses(wide) != Some(false) {
        return None;
    }
    // Halved until nothing lies between.
    loop {
        let middle = 0.5 * (narrow + wide);
        if middle <= narrow || middle >= wide {
            return stresses(middle).map(|[_, P]| P);
        }
        if presses(middle)? { narrow = middle } else { wide = middle }
    }
}

#[cfg(test)]
mod tests {
    use piola_materials::{NeoHookean, RotatedLinear};

    use super::*;

    #[test]
    fn soft_sides_of_a_linear_material_follow_poisson() -> Result<(), piola::material::Inadmissible> {
        // Without rotations linear elasticity is exact: P = E (λ − 1).
        let moduli = piola::material::Moduli::from_young_poisson(1e6, 0.3)?;
        let linear = RotatedLinear::new(moduli.mu, moduli.lambda)?;
        let stress = uniaxial_stress(&linear, 1.2).unwrap_or(f64::NAN);
        assert!((stress - 2e5).abs() < 1e-9 * 2e5, "{stress}");
        Ok(())
    }

    #[test]
    fn a_nearly_incompressible_solid_follows_the_textbook() -> Result<(), piola::material::Inadmissible> {
        // P = μ (λ − 1/λ²) for λ/μ → ∞, with an error of the order of μ/λ.
        let rubber = NeoHookean::new(1.0, 1e6)?;
        for stretch in [0.5, 2.0, 5.0_f64] {
            let expected = stretch - stretch.powi(-2);
            let stress = uniaxial_stress(&rubber, stretch).unwrap_or(f64::NAN);
            assert!((stress - expected).abs() < 1e-5 * expected.abs(), "{stress} {expected}");
        }
        assert_eq!(uniaxial_stress(&rubber, -1.0), None);
        Ok(())
    }
}
