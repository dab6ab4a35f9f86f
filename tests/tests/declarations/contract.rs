//! The contract for every energy, unextended and extended: that of the compiled material where this build has
//! it, else that of the interpreted one. What they compute on lanes is judged by `batch.rs`.

use piola::Material;
use piola::contract::{Settings, Violations, check_without_lanes};
use piola::material::{Declared, MaterialError};
use piola_materials::Visitor;
use piola_tests::declarations::{Sample, Values, slices};

const EPSILON: f64 = 0.3;

/// Parameters in addition to the typical ones, where another choice takes another way through the energy.
const FURTHER: [(&str, &[&[f64]]); 10] = [
    // A power between 0 and 1 is concave, and so is its extension.
    ("ogden", &[&[1e5], &[0.5], &[1e6]]),
    // Powers that are not whole, of either sign, and those that can be extended.
    ("storakers", &[&[1e5, 3e4], &[1.7, -2.3], &[0.4, 0.7]]),
    ("storakers", &[&[1e5, 3e4], &[2.3, 4.7], &[0.4, 0.7]]),
    // A foam with a Poisson's ratio of 0.
    ("storakers", &[&[1e5, 3e4], &[1.7, -2.3], &[0.0, 1e-14]]),
    ("isochoric_ogden", &[&[6.3e5, 1.2e3, -1e4], &[1.3, 5.0, -2.0], &[2e7]]),
    ("isochoric_ogden", &[&[3.5e5], &[2.3], &[2e7]]),
    ("lopez_pamies", &[&[3e5, 1e3], &[0.7, 2.6], &[2e7]]),
    ("lopez_pamies", &[&[3e5, 1e3], &[1.3, 2.6], &[2e7]]),
    // Softening.
    ("knowles", &[&[3e5], &[0.1], &[0.4], &[2e7]]),
    // Chains so short that they lock just beyond the sampled range.
    ("gent", &[&[3.5e5], &[16.0], &[3.1e6]]),
];

struct Contract(Settings);

impl Contract {
    fn of(&self, material: &impl Material) -> Result<(), Violations> {
        check_without_lanes(material, &self.0).map(|_| ())
    }
}

impl Visitor for Contract {
    type Output = Result<(), Violations>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        self.of(&material)
    }
}

fn settings(sample: &Sample) -> Settings {
    let default = Settings::default();
    let range = match sample.judged.name {
        // Beyond, the exponential amplifies rounding errors by its exponent.
        "fung" | "veronda_westmann" => (0.5, 1.6),
        _ => sample.text.numbers("range").map_or(default.range, |[low, high]| (low, high)),
    };
    // Interpreted with dual numbers, long energies take seconds.
    let few = if sample.is_of_catalogue { default.points } else { 16 };
    let points = sample.text.numbers("points").map_or(few, |[points]| points as usize);
    let stress_free_at_rest = !sample.text.source.contains("prestressed");
    Settings { points, range, stress_free_at_rest, ..default }
}

/// Says what each of the materials breaks, not only the first.
pub(crate) fn judge(sample: &Sample) {
    let further = FURTHER.iter().filter(|(name, _)| *name == sample.judged.name);
    let further = further.map(|(_, values)| values.iter().map(|list| list.to_vec()).collect::<Values>());
    let epsilon = sample.text.numbers("epsilon").map_or(EPSILON, |[epsilon]| epsilon);
    let energy = &sample.judged.energy;
    let mut broken = String::new();
    for values in sample.values().into_iter().chain(further) {
        for inversion in sample.judged.inversions(epsilon) {
            let contract = Contract(settings(sample));
            let verdict = match sample.judged.compiled {
                Some(entry) => entry.visit(&slices(&values), inversion, contract),
                None => energy.material(&slices(&values), inversion).map(|material| contract.of(&material)),
            };
            match verdict {
                Ok(Ok(())) => {}
                Ok(Err(violations)) => broken += &format!("{values:?} {inversion:?}:\n{violations}\n"),
                // Typical parameters can be extended wherever the energy can; some of the others may not.
                Err(MaterialError::DoesNotRestore { .. }) if !sample.is_typical(&values) => {}
                Err(error) => broken += &format!("{values:?} {inversion:?}: {error}\n"),
            }
        }
    }
    let expected: Vec<_> = sample.text.remarks("breaks").collect();
    assert!(broken.is_empty() == expected.is_empty(), "\n{broken}");
    assert!(
        expected.iter().all(|expected| broken.contains(expected)),
        "{broken}\nlacks some of {expected:?}"
    );
}
