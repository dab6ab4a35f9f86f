//! The contract for every material of the catalogue with its typical parameters, unextended and extended:
//! that of the compiled material where this build has it, else that of the interpreted one.
//! What they compute on lanes is judged by `reference.rs` and `bits.rs`.

use piola::contract::{Settings, Violations, check_without_lanes};
use piola::material::{Declared, MaterialError};
use piola::{Inversion, Material};
use piola_materials::Visitor;
use piola_tests::energies::{ENERGIES, Judged, find};

const EPSILON: f64 = 0.3;
const EXTEND: Inversion = Inversion::Extend { epsilon: EPSILON };

/// Parameters in addition to the typical ones, where another choice takes another way through the energy.
const FURTHER: [(&str, &[&[f64]]); 9] = [
    // A power between 0 and 1 is concave, and so is its extension.
    ("ogden", &[&[1e5], &[0.5], &[1e6]]),
    // Powers that are not whole, of either sign, and those that can be extended.
    ("storakers", &[&[1e5, 3e4], &[1.7, -2.3], &[0.4, 0.7]]),
    ("storakers", &[&[1e5, 3e4], &[2.3, 4.7], &[0.4, 0.7]]),
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

fn settings(name: &str) -> Settings {
    let default = Settings::default();
    let range = match name {
        // Beyond, the exponential amplifies rounding errors by its exponent.
        "fung" | "veronda_westmann" => (0.5, 1.6),
        _ => default.range,
    };
    Settings { range, ..default }
}

/// Says what each of the materials breaks, not only the first.
#[track_caller]
fn keep<'a>(materials: impl Iterator<Item = (&'a Judged, Vec<&'a [f64]>)>, inversion: Inversion) {
    let mut broken = String::new();
    for (energy, values) in materials {
        let settings = settings(energy.name);
        let verdict = match energy.compiled {
            Some(entry) => entry.visit(&values, inversion, Contract(settings)),
            None => {
                energy.energy.material(&values, inversion).map(|material| Contract(settings).of(&material))
            }
        };
        match verdict {
            Ok(Ok(())) => {}
            Ok(Err(violations)) => broken += &format!("{} {values:?}:\n{violations}\n", energy.name),
            Err(error) => broken += &format!("{} {values:?}: {error}\n", energy.name),
        }
    }
    assert!(broken.is_empty(), "\n{broken}");
}

fn all() -> impl Iterator<Item = (&'static Judged, Vec<&'static [f64]>)> {
    let further = FURTHER.map(|(name, values)| (find(name).expect("in the catalogue"), values.to_vec()));
    ENERGIES.iter().map(|energy| (energy, energy.typical())).chain(further)
}

fn restores(Judged { energy, .. }: &Judged, values: &[&[f64]]) -> bool {
    !matches!(energy.material(values, EXTEND), Err(MaterialError::DoesNotRestore { .. }))
}

#[test]
fn every_material_keeps_the_contract() {
    keep(all(), Inversion::Refuse);
}

#[test]
fn every_extended_material_keeps_the_contract() {
    // The typical parameters can be extended wherever the energy can; of the further ones, some may not.
    keep(all().filter(|(energy, values)| energy.description().extends && restores(energy, values)), EXTEND);
}
