//! The promises of every material, stress at single points, in a batch and through a trait object, and
//! parameters that are written and read again.

use outside::Stiffening;
use piola::batch::Batch;
use piola::point::{Filter, evaluate};

type Result = std::result::Result<(), Box<dyn std::error::Error>>;

piola::contract!(stiffening: outside::stiffening()?);

/// A shear with some stretch.
const F: [[f64; 3]; 3] = [[1.2, 0.3, 0.0], [0.0, 0.9, 0.1], [0.0, 0.0, 1.1]];

/// Rounding errors that two ways of summing may differ by, as multiples of the largest stress: a few units of
/// rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

fn largest(stress: &[f64]) -> f64 {
    stress.iter().fold(0.0, |largest, entry| entry.abs().max(largest))
}

#[test]
fn a_boxed_material_is_that_of_its_type() -> Result {
    let typed = [
        evaluate(&outside::stiffening()?, &F, Filter::None),
        evaluate(&outside::matrix()?, &F, Filter::None),
    ];
    for (boxed, typed) in outside::boxed()?.iter().zip(typed) {
        assert_eq!(evaluate(&**boxed, &F, Filter::None), typed);
    }
    Ok(())
}

#[test]
fn a_batch_gives_the_stress_of_the_point() -> Result {
    for material in outside::boxed()? {
        let point = evaluate(&*material, &F, Filter::None).stress;
        let mut stress = [0.0; 9];
        let survey = Batch::new(&*material).stresses(F.as_flattened(), &mut stress)?;
        assert!(survey.is_clean());
        let scale = largest(&stress);
        for (one, other) in stress.iter().zip(point.as_flattened()) {
            assert!((one - other).abs() <= ROUNDING * scale, "{one} ≠ {other}");
        }
    }
    Ok(())
}

#[test]
fn a_material_is_read_as_it_was_written() -> Result {
    let written = outside::stiffening()?;
    let read: Stiffening = serde_json::from_str(&serde_json::to_string(&written)?)?;
    assert_eq!(read, written);
    let read = serde_json::from_str::<Stiffening>(r#"{"c10": 1e5, "c20": 1e4}"#);
    assert!(read.is_err_and(|error| error.to_string().contains("kappa")));
    Ok(())
}
