//! Stress of a sum, at single points and through a trait object.

use piola::batch::{Batch, Energy};
use piola::point::{Filter, evaluate};
use piola_materials::NeoHookean;

type Result = std::result::Result<(), Box<dyn std::error::Error>>;

/// A shear with some stretch.
const F: [[f64; 3]; 3] = [[1.2, 0.3, 0.0], [0.0, 0.9, 0.1], [0.0, 0.0, 1.1]];

/// Rounding errors that two ways of summing may differ by, as multiples of the largest stress: a few units of
/// rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

fn largest(stress: &[f64]) -> f64 {
    stress.iter().fold(0.0, |largest, entry| entry.abs().max(largest))
}

#[test]
fn the_stress_of_a_sum_is_the_sum_of_stresses() -> Result {
    let [sum, first, second] = [
        evaluate(&outside::sum()?, &F, Filter::None),
        evaluate(&NeoHookean::new(3.8e5, 2e7)?, &F, Filter::None),
        evaluate(&outside::stiffening()?, &F, Filter::None),
    ]
    .map(|point| point.stress);
    let scale = largest(first.as_flattened()) + largest(second.as_flattened());
    for i in 0..3 {
        for j in 0..3 {
            let expected = first[i][j] + second[i][j];
            assert!((sum[i][j] - expected).abs() <= ROUNDING * scale, "P{i}{j}: {} ≠ {expected}", sum[i][j]);
        }
    }
    Ok(())
}

#[test]
fn a_boxed_material_gives_the_stress_of_its_type() -> Result {
    let boxed: [Box<dyn Energy<f64>>; 2] = [Box::new(outside::stiffening()?), Box::new(outside::sum()?)];
    let typed =
        [evaluate(&outside::stiffening()?, &F, Filter::None), evaluate(&outside::sum()?, &F, Filter::None)];
    for (boxed, typed) in boxed.iter().zip(typed) {
        let mut stress = [0.0; 9];
        let survey = Batch::new(&**boxed).stresses(F.as_flattened(), &mut stress)?;
        assert!(survey.is_clean());
        let scale = largest(&stress);
        for (one, other) in stress.iter().zip(typed.stress.as_flattened()) {
            assert!((one - other).abs() <= ROUNDING * scale, "{one} ≠ {other}");
        }
    }
    Ok(())
}
