//! Parameters for given small-strain moduli make the same material, stiffer or softer.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use piola::Inversion;
use piola::batch::Batch;
use piola::material::{MaterialError, Moduli};
use piola_materials::matching;
use piola_tests::declarations::slices;
use piola_tests::energies::{ENERGIES, Judged, Subject, find};

/// Roundings of a dozen operations in the moduli, magnified where λ is a difference.
const TOLERANCE: f64 = 1e-12;

/// Within the domains of all: gently sheared.
const F: [f64; 9] = [1.1, 0.2, 0.0, -0.1, 0.95, 0.1, 0.05, 0.0, 1.05];

/// Parameters of the energy for these moduli.
fn matched(energy: &Judged, wanted: Moduli) -> Result<Vec<Vec<f64>>, MaterialError> {
    let moduli = |values: &[&[f64]]| energy.subject(values, Inversion::Refuse).map(|subject| subject.moduli);
    matching(energy.description(), moduli, wanted)
}

fn subject(energy: &Judged, wanted: Moduli) -> Result<Subject, MaterialError> {
    energy.subject(&slices(&matched(energy, wanted)?), Inversion::Refuse)
}

fn stress(energy: &Judged, wanted: Moduli) -> Result<[f64; 9], Box<dyn std::error::Error>> {
    let material = subject(energy, wanted)?.double;
    let mut P = [0.0; 9];
    assert!(Batch::new(&*material).stresses(&F, &mut P)?.is_clean(), "{}", energy.name);
    Ok(P)
}

/// Energies with a narrower range of Poisson's ratio than others: what they reach, and the error's words.
const NARROW: [(&str, &[f64], &str); 5] = [
    ("arap", &[0.0], "ν = 0;"),
    ("blatz_ko", &[0.3, 0.45], "ν between 0 and 0.5;"),
    ("ciarlet_geymonat", &[0.3, 0.45], "ν between 0 and 0.5;"),
    ("symmetric_arap", &[0.0], "ν = 0;"),
    ("symmetric_dirichlet", &[0.0], "ν = 0;"),
];

/// Where the moduli are as wanted, stress follows Young's modulus at any strain.
#[test]
fn every_material_has_the_wanted_moduli_or_states_its_own() -> Result<(), Box<dyn std::error::Error>> {
    for energy in ENERGIES.iter() {
        let name = energy.name;
        for poisson in [-0.2, 0.0, 0.3, 0.45] {
            let wanted = |young| Moduli::from_young_poisson(young, poisson);
            let found = subject(energy, wanted(1e6)?);
            if let Some((_, reached, range)) = NARROW.iter().find(|narrow| narrow.0 == name)
                && !reached.contains(&poisson)
            {
                let error = found.err().map(|error| error.to_string()).unwrap_or_default();
                assert!(error.contains(range), "{name} at {poisson}: {error}");
                continue;
            }
            let moduli = found.map_err(|error| format!("{name} at {poisson}: {error}"))?.moduli;
            let errors = [moduli.young() / 1e6 - 1.0, moduli.poisson() - poisson];
            assert!(errors.iter().all(|error| error.abs() < TOLERANCE), "{name} at {poisson}: {moduli:?}");
            let (soft, stiff) = (stress(energy, wanted(1e6)?)?, stress(energy, wanted(3e6)?)?);
            let scale = stiff.iter().fold(0.0, |scale: f64, entry| scale.max(entry.abs()));
            for (soft, stiff) in soft.iter().zip(stiff) {
                let error = (3.0 * soft - stiff).abs() / scale;
                assert!(error < TOLERANCE, "{name} at {poisson}: {soft} {stiff}");
            }
        }
    }
    Ok(())
}

#[test]
fn impossible_moduli_are_refused() {
    let stvk = find("st_venant_kirchhoff").expect("in the catalogue");
    assert!(matched(stvk, Moduli { mu: -1.0, lambda: 1.0 }).is_err());
    assert!(matched(stvk, Moduli { mu: f64::NAN, lambda: 1.0 }).is_err());
}
