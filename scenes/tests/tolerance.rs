//! Steps chosen by a tolerance, in both scenes: what a frame adds to the error of the motion.
//!
//! A scene is played to a state, and the frame after it made twice: to the tolerance, and by third order to a
//! small part of it. The error is judged relative to that, not relative to a motion from the start: of the
//! horse, which begins with all nodes in a plane, motions end a body height apart however short their steps
//! are.
//!
//! One frame of each scene, or frames all along, which take minutes:
//! `PIOLA_LONG=1 cargo test --release -p piola-scenes --test tolerance -- --nocapture`.

use piola_bodies::step::Integrator;
use piola_scenes::geometry::Geometry;
use piola_scenes::output::{Newton, StepCounts};
use piola_scenes::play::Play;
use piola_scenes::scene::{DINOSAUR, HORSE, Scene};
use piola_scenes::settings::Settings;

/// A scene after some of its frames.
fn after(scene: &'static Scene, frames: usize) -> Play {
    let settings = Settings::new(scene);
    let geometry = Geometry::load(&settings).expect("the body of the scene");
    let mut play = Play::new(settings, geometry).expect("a scene that plays");
    for _ in 0..frames {
        play.step().expect("a frame");
    }
    play
}

/// The positions after the next frame, made to a tolerance, body heights per second, and the steps of it.
fn frame(now: &Play, integrator: Integrator, tolerance: f64) -> (Vec<[f64; 3]>, StepCounts) {
    let (newton, tolerance) = (Newton::Full, Some(tolerance));
    let settings = Settings { integrator, newton, tolerance, ..now.settings.clone() };
    let mut play = Play::new(settings, now.geometry.clone()).expect("a scene that plays");
    let (positions, velocities) = (now.simulation.positions(), now.simulation.velocities());
    play.resume(now.clock, positions, velocities).expect("a state of the body");
    play.step().expect("a frame");
    (play.simulation.positions().to_vec(), play.steps)
}

/// Errors of the next frame for some tolerances, each over what the tolerance allows.
#[expect(clippy::print_stderr, reason = "the figures that documents quote")]
fn ratios(now: &Play, tolerances: &[f64]) -> Vec<f64> {
    let finest = tolerances.iter().copied().fold(f64::INFINITY, f64::min);
    let (reference, steps) = frame(now, Integrator::Sdirk3, finest / 20.0);
    assert_eq!(steps.unresolved, 0, "the reference");
    let allowed = now.settings.dt * now.height;
    let ratio = |&tolerance: &f64| {
        let (positions, steps) = frame(now, Integrator::Sdirk2, tolerance);
        let pairs = positions.iter().zip(&reference);
        let distances = pairs.map(|(x, y)| (0..3).map(|c| (x[c] - y[c]).powi(2)).sum::<f64>().sqrt());
        let ratio = distances.fold(0.0, f64::max) / (tolerance * allowed);
        eprintln!(
            "{} after frame {}: tolerance {tolerance}, {} steps, {ratio:.2} of the error allowed",
            now.settings.scene.name, now.clock.frame, steps.taken
        );
        ratio
    };
    tolerances.iter().map(ratio).collect()
}

#[test]
fn frames_err_by_no_more_than_three_times_their_tolerance() {
    let (of_dinosaur, of_horse, tolerances) = match std::env::var_os("PIOLA_LONG") {
        None => (&[62][..], &[10][..], &[0.3, 0.1][..]),
        Some(_) => (&[30, 60, 62, 66, 75, 90][..], &[4, 6, 8, 10, 12, 15][..], &[0.3, 0.1, 0.03][..]),
    };
    for (scene, states) in [(&DINOSAUR, of_dinosaur), (&HORSE, of_horse)] {
        for &frames in states {
            let ratios = ratios(&after(scene, frames), tolerances);
            assert!(
                ratios.iter().all(|&ratio| ratio <= 3.0),
                "{} after frame {frames}: {ratios:?}",
                scene.name
            );
        }
    }
}
