//! Scrambled and collapsed bodies find their shape again; the bench `recovery` makes the whole table.

use piola_scenes::error::Error;
use piola_scenes::geometry::Geometry;
use piola_scenes::material::{MaterialSpec, soft_moduli};
use piola_scenes::output::{FinalPlace, Newton};
use piola_scenes::recovery_trial::{TrialOutcome, run_trial};
use piola_scenes::scene::{Amplitude, Body, INSIDE_OUT, POINT, SCRAMBLE, Scene, Start};
use piola_scenes::settings::Settings;

/// Differences of energies err by some roundings; slopes judge what is below them.
const RISE: f64 = 1e-12;

fn play(
    scene: &'static Scene,
    body: Body,
    material: &str,
    start: Start,
    newton: Newton,
) -> Result<TrialOutcome, Error> {
    let spec = MaterialSpec::matching(material, soft_moduli());
    let settings = Settings { body, material: spec, start, newton, ..Settings::new(scene) };
    let geometry = Geometry::load(&settings)?;
    let outcome = run_trial(settings, geometry)?;
    let what = format!("{} {} {material}: {outcome:?}", scene.name, body.name);
    assert!(outcome.finite && outcome.largest_rise <= RISE, "{what}");
    // Whoever is stuck is certified: at rest, and known to be stable or not.
    assert_ne!(
        outcome.final_state.map(|final_state| final_state.place),
        Some(FinalPlace::NotAtRest),
        "{what}"
    );
    Ok(outcome)
}

#[test]
fn scrambled_bodies_recover() -> Result<(), Error> {
    for body in [Body::HORSE, Body::DINOSAUR] {
        for material in ["rotated linear", "fixed corotated", "stable neo-Hookean", "Ogden"] {
            for (seed, newton) in [(1, Newton::Single), (2, Newton::Full)] {
                let start = Start::Scrambled { seed, amplitude: Amplitude::Edges(0.3) };
                let outcome = play(&SCRAMBLE, body, material, start, newton)?;
                assert!(outcome.recovered.is_some(), "{} {material}: {outcome:?}", body.name);
            }
        }
    }
    Ok(())
}

#[test]
fn bodies_unfold_from_a_point() -> Result<(), Error> {
    for (body, material) in [
        (Body::HORSE, "rotated linear"),
        (Body::DINOSAUR, "rotated linear"),
        (Body::HORSE, "fixed corotated"),
        (Body::DINOSAUR, "fixed corotated"),
        (Body::DINOSAUR, "Ogden"),
    ] {
        let outcome = play(&POINT, body, material, POINT.start, Newton::Single)?;
        assert!(outcome.recovered.is_some(), "{} {material}: {outcome:?}", body.name);
    }
    Ok(())
}

#[test]
fn what_is_inside_out_turns_if_its_energy_knows() -> Result<(), Error> {
    for body in [Body::HORSE, Body::DINOSAUR] {
        let neo_hookean = play(&INSIDE_OUT, body, "stable neo-Hookean", INSIDE_OUT.start, Newton::Single)?;
        assert!(neo_hookean.recovered.is_some(), "{}: {neo_hookean:?}", body.name);
        let kirchhoff = play(&INSIDE_OUT, body, "st_venant_kirchhoff", INSIDE_OUT.start, Newton::Single)?;
        assert!(kirchhoff.recovered.is_none(), "{}: {kirchhoff:?}", body.name);
        let final_state = kirchhoff.final_state.expect("it is not back");
        assert_eq!(
            (final_state.place, final_state.stress_free),
            (FinalPlace::StableElsewhere, true),
            "{final_state:?}"
        );
    }
    Ok(())
}
