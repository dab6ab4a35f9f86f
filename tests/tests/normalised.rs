//! Energies normalised to a Young's modulus and a Poisson's ratio: the whole contract, and a tensile test
//! that finds both.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::batch::Batch;
use piola::material::{Declared, MaterialError, Moduli, Normalised, PerPoint};
use piola::{Inversion, Material};
use piola_materials::{Arap, Gent, MooneyRivlin, find};

const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.45;

fn arap() -> Result<Normalised<Arap>, MaterialError> {
    Arap::new(1.0)?.normalised_to(YOUNG, POISSON)
}

fn gent() -> Result<Normalised<Gent>, MaterialError> {
    let extended = Gent::new(3.3e5, 108.0, 1e5)?.with_inversion(Inversion::Extend { epsilon: 0.2 })?;
    extended.normalised_to(YOUNG, POISSON)
}

fn mooney_rivlin() -> Result<Normalised<MooneyRivlin>, MaterialError> {
    MooneyRivlin::new(1.8e5, 3.4e3, 1e5)?.normalised_to(YOUNG, POISSON)
}

mod keep_the_contract {
    use super::*;

    piola::contract!(normalised_arap: arap()?);
    piola::contract!(normalised_gent: gent()?);
    piola::contract!(normalised_mooney_rivlin: mooney_rivlin()?);
}

/// Pulls by a strain and lets go of the sides: P1/s and −s2/s differ from E and ν by as much as the strain.
#[track_caller]
fn check_tensile_test(material: &impl Material) {
    let strain = 1e-6;
    let mut lateral = 0.0;
    // The error of a step with the tangent at rest is the strain times that of the one before.
    let [_, h22, _, _, _, h23] = material.blocks([1.0f64; 3]).hessian;
    for _ in 0..4 {
        lateral -= material.gradient_at_strains([strain, lateral, lateral])[1] / (h22 + h23);
    }
    let [along, across, _] = material.gradient_at_strains([strain, lateral, lateral]);
    assert!(across.abs() <= 1e-9 * along, "{across} beside {along}");
    // Third derivatives of these energies are below a hundred times their second ones.
    assert!((along / strain / YOUNG - 1.0).abs() <= 100.0 * strain, "E is {}", along / strain);
    assert!((-lateral / strain - POISSON).abs() <= 100.0 * strain, "ν is {}", -lateral / strain);
}

#[test]
fn a_tensile_test_finds_what_was_stated() -> Result<(), MaterialError> {
    check_tensile_test(&arap()?);
    check_tensile_test(&gent()?);
    check_tensile_test(&mooney_rivlin()?);
    Ok(())
}

#[test]
fn a_batch_may_have_a_normalised_material_for_each_point() -> Result<(), Box<dyn std::error::Error>> {
    let materials = [
        Gent::new(3.3e5, 108.0, 1e5)?.normalised_to(1e6, 0.4)?,
        Gent::new(1.0, 30.0, 1.0)?.normalised_to(2e5, 0.49)?,
        Gent::new(5.0, 50.0, 5.0)?.normalised_to(3e7, 0.45)?,
    ];
    let F = [1.2, 0.1, 0.0, -0.2, 0.9, 0.3, 0.1, 0.0, 1.1].repeat(materials.len());
    let mut together = vec![0.0; F.len()];
    Batch::new(&PerPoint::new(&materials)?).stresses(&F, &mut together)?;
    for (k, material) in materials.iter().enumerate() {
        let (mut alone, part) = (vec![0.0; 9], 9 * k..9 * (k + 1));
        Batch::new(material).stresses(&F[part.clone()], &mut alone)?;
        assert_eq!(&together[part], alone);
    }
    Ok(())
}

#[test]
fn softer_in_volume_than_the_energy_itself_is_refused() {
    let stiff = MooneyRivlin::new(1.8e5, 3.4e3, 2e7).expect("admissible");
    let error = stiff.normalised_to(1e6, 0.3).expect_err("its own ratio is 0.49");
    assert!(matches!(error, MaterialError::BelowOwnPoisson { poisson: 0.3, lowest } if lowest > 0.49));
    assert!(error.to_string().contains("Entry::matching"), "{error}");
    // What the message says.
    let entry = find("mooney_rivlin").expect("in the catalogue");
    let soft = Moduli::from_young_poisson(1e6, 0.3).expect("elastic");
    let matching = entry.matching(soft).expect("a soft one");
    let values: Vec<&[f64]> = matching.iter().map(Vec::as_slice).collect();
    let soft = MooneyRivlin::from_values(&values, Inversion::Refuse).expect("admissible");
    assert!(soft.normalised_to(1e6, 0.3).is_ok());
}
