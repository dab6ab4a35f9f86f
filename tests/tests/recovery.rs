//! Scrambled and collapsed bodies find their shape again; the bench `recovery` makes the whole table.

use piola_scenes::energy::{Energy, soft};
use piola_scenes::error::Error;
use piola_scenes::geometry::Geometry;
use piola_scenes::output::{Newton, Place};
use piola_scenes::scene::{Amplitude, Body, INSIDE_OUT, POINT, SCRAMBLE, Scene, Start, body};
use piola_scenes::settings::Settings;
use piola_scenes::trial::{Outcome, attempt};

/// Differences of energies err by some roundings; slopes judge what is below them.
const RISE: f64 = 1e-12;

fn play(
    scene: &'static Scene,
    body: Body,
    material: &str,
    start: Start,
    newton: Newton,
) -> Result<Outcome, Error> {
    let energy = Energy::like(material, soft());
    let settings = Settings { body, energy, start, newton, ..Settings::of(scene) };
    let outcome = attempt(&settings, &Geometry::load(&settings)?)?;
    let what = format!("{} {} {material}: {outcome:?}", scene.name, body.name);
    assert!(outcome.finite && outcome.largest_rise <= RISE, "{what}");
    // Whoever is stuck is certified: at rest, and known to be stable or not.
    assert_ne!(outcome.standing.map(|standing| standing.place), Some(Place::NotAtRest), "{what}");
    Ok(outcome)
}

#[test]
fn scrambled_bodies_recover() -> Result<(), Error> {
    for body in [body::HORSE, body::DINOSAUR] {
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
        (body::HORSE, "rotated linear"),
        (body::DINOSAUR, "rotated linear"),
        (body::HORSE, "fixed corotated"),
        (body::DINOSAUR, "fixed corotated"),
        (body::DINOSAUR, "Ogden"),
    ] {
        let outcome = play(&POINT, body, material, POINT.start, Newton::Single)?;
        assert!(outcome.recovered.is_some(), "{} {material}: {outcome:?}", body.name);
    }
    Ok(())
}

#[test]
fn what_is_inside_out_turns_if_its_energy_knows() -> Result<(), Error> {
    for body in [body::HORSE, body::DINOSAUR] {
        let neo_hookean = play(&INSIDE_OUT, body, "stable neo-Hookean", INSIDE_OUT.start, Newton::Single)?;
        assert!(neo_hookean.recovered.is_some(), "{}: {neo_hookean:?}", body.name);
        let kirchhoff = play(&INSIDE_OUT, body, "st_venant_kirchhoff", INSIDE_OUT.start, Newton::Single)?;
        assert!(kirchhoff.recovered.is_none(), "{}: {kirchhoff:?}", body.name);
        let standing = kirchhoff.standing.expect("it is not back");
        assert_eq!((standing.place, standing.stress_free), (Place::StableElsewhere, true), "{standing:?}");
    }
    Ok(())
}
