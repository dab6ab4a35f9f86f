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

#[test]
fn stress_follows_young_at_any_strain() -> Result<(), Box<dyn std::error::Error>> {
    for energy in ENERGIES.iter() {
        let soft = stress(energy, Moduli::from_young_poisson(1e6, 0.45)?)?;
        let stiff = stress(energy, Moduli::from_young_poisson(3e6, 0.45)?)?;
        let scale = stiff.iter().fold(0.0, |scale: f64, entry| scale.max(entry.abs()));
        for (soft, stiff) in soft.iter().zip(stiff) {
            assert!((3.0 * soft - stiff).abs() < TOLERANCE * scale, "{}: {soft} {stiff}", energy.name);
        }
    }
    Ok(())
}

#[test]
fn every_material_is_as_stiff_as_asked_and_a_volumetric_parameter_brings_poisson_about()
-> Result<(), Box<dyn std::error::Error>> {
    let without = [
        "arap",
        "blatz_ko",
        "fung",
        "levinson_burgess",
        "mips",
        "storakers",
        "symmetric_arap",
        "symmetric_dirichlet",
    ];
    for energy in ENERGIES.iter() {
        let found = subject(energy, Moduli::from_young_poisson(1e6, 0.45)?)?.moduli;
        assert!((found.young() / 1e6 - 1.0).abs() < TOLERANCE, "{}: {found:?}", energy.name);
        let matches = (found.poisson() - 0.45).abs() < TOLERANCE;
        assert_eq!(matches, !without.contains(&energy.name), "{}: {found:?}", energy.name);
    }
    let stvk =
        matched(find("st_venant_kirchhoff").expect("in the catalogue"), Moduli { mu: 3.0, lambda: 5.0 })?;
    assert!((stvk[0][0] - 3.0).abs() < TOLERANCE && (stvk[1][0] - 5.0).abs() < TOLERANCE, "{stvk:?}");
    Ok(())
}

#[test]
fn impossible_moduli_are_refused() {
    let stvk = find("st_venant_kirchhoff").expect("in the catalogue");
    assert!(matched(stvk, Moduli { mu: -1.0, lambda: 1.0 }).is_err());
    assert!(matched(stvk, Moduli { mu: f64::NAN, lambda: 1.0 }).is_err());
}
