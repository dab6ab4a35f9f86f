//! Share of bodies that recover their shape, by scene, body, energy and Newton's method, as Markdown on
//! standard output.
//!
//! ```sh
//! cargo bench -p piola-speed --features report --bench recovery -- --seeds 100 --amplitude 0.3 0.5 1 2 box
//! ```
//!
//! A body is back from the frame on from which every node stays within a thousandth of the body's height. All
//! energies have E = 1 MPa and ν = 0.45. Of a body that is not back, the last column says where it rests, and
//! with which seeds.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::error::Error;
use std::sync::Arc;

use clap::Parser;
use rayon::prelude::*;

use piola_scenes::geometry::Geometry;
use piola_scenes::material::{MaterialSpec, soft_moduli};
use piola_scenes::output::{FinalPlace, Newton};
use piola_scenes::recovery_trial::{TrialOutcome, run_trial};
use piola_scenes::scene::{Amplitude, Body, HORSE, INSIDE_OUT, POINT, SCRAMBLE, Scene, Start};
use piola_scenes::settings::Settings;

const MATERIALS: [&str; 5] =
    ["rotated linear", "fixed corotated", "stable neo-Hookean", "Ogden", "st_venant_kirchhoff"];

/// Differences of energies err by some roundings; slopes judge what is below them.
const RISE: f64 = 1e-12;

/// Maximum number of bodies that are not back for which the seeds are named.
const NAMED: usize = 5;

/// Titles of the columns behind the first one.
const HEADER: &str = "body | energy | start inside out | recovered | frames, median (most) | elsewhere |
|---|---|---|---:|---:|---:|---|";

#[derive(Parser)]
struct Options {
    /// Number of random starts of each kind, from seed 1.
    #[arg(long, default_value_t = 100)]
    seeds: u64,

    /// Largest displacements of nodes: mean edge lengths, or `box`.
    #[arg(long, num_args = 1.., default_values = ["0.3", "0.5", "1", "2", "box"])]
    amplitude: Vec<Amplitude>,

    /// Accuracy of each step.
    #[arg(long, value_enum, num_args = 1.., default_values = ["single", "full"])]
    newton: Vec<Newton>,

    /// Argument that `cargo bench` adds.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let options = Options::parse();
    for newton in options.newton {
        let name = match newton {
            Newton::Single => "one Newton iteration per step",
            Newton::Full => "full Newton",
        };
        println!("## Scrambled, {name}\n\n| A | {HEADER}");
        for &amplitude in &options.amplitude {
            for body in [Body::HORSE, Body::DINOSAUR] {
                for material in &MATERIALS[..4] {
                    let seeds = (1..=options.seeds).map(|seed| Start::Scrambled { seed, amplitude });
                    let outcomes = play(&SCRAMBLE, body, material, newton, seeds.collect())?;
                    let amplitude = match amplitude {
                        Amplitude::Edges(number) => number.to_string(),
                        Amplitude::Box => "box".to_owned(),
                    };
                    println!("| {amplitude} | {} | {material} | {} |", body.name, cells(&outcomes));
                }
            }
        }
        println!("\n## One start each, {name}\n\n| scene | {HEADER}");
        for (scene, body) in [
            (&INSIDE_OUT, Body::HORSE),
            (&INSIDE_OUT, Body::DINOSAUR),
            (&POINT, Body::HORSE),
            (&POINT, Body::DINOSAUR),
            (&HORSE, Body::HORSE),
        ] {
            for material in MATERIALS {
                let outcomes = play(scene, body, material, newton, vec![scene.start])?;
                println!("| {} | {} | {material} | {} |", scene.name, body.name, cells(&outcomes));
            }
        }
        println!();
    }
    Ok(())
}

/// Plays a scene from each of these starts, as many at once as there are cores.
fn play(
    scene: &'static Scene,
    body: Body,
    material: &str,
    newton: Newton,
    starts: Vec<Start>,
) -> Result<Vec<TrialOutcome>, Box<dyn Error + Send + Sync>> {
    let material = MaterialSpec::matching(material, soft_moduli());
    let described = Settings { body, material, newton, ..Settings::new(scene) };
    let geometry = Arc::new(Geometry::load(&described)?);
    let trial = |start| -> Result<TrialOutcome, Box<dyn Error + Send + Sync>> {
        let outcome = run_trial(Settings { start, ..described.clone() }, geometry.clone())?;
        assert!(outcome.finite, "a position is not finite: {outcome:?}");
        assert!(outcome.largest_rise <= RISE, "the objective of a step has risen: {outcome:?}");
        Ok(outcome)
    };
    starts.into_par_iter().map(trial).collect()
}

/// The cells behind the first three.
fn cells(outcomes: &[TrialOutcome]) -> String {
    let inverted: usize = outcomes.iter().map(|outcome| outcome.inverted_at_start).sum();
    let inverted = inverted as f64 / outcomes.len() as f64;
    let mut frames: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.recovered).collect();
    frames.sort_unstable();
    let taken = frames.last().map(|last| format!("{} ({last})", frames[frames.len() / 2]));
    let places = [
        FinalPlace::StableElsewhere,
        FinalPlace::UndecidedElsewhere,
        FinalPlace::Saddle,
        FinalPlace::NotAtRest,
        FinalPlace::Rest,
    ];
    let elsewhere = places.into_iter().filter_map(|place| {
        // By their numbers, which are the seeds.
        let there = |outcome: &TrialOutcome| outcome.final_state.is_some_and(|state| state.place == place);
        let numbers: Vec<String> = (1..)
            .zip(outcomes)
            .filter(|(_, one)| there(one))
            .map(|(number, _)| format!("{number}"))
            .collect();
        let first = numbers[..numbers.len().min(NAMED)].join(", ");
        let more = if numbers.len() > NAMED { ", …" } else { "" };
        let seeds = if numbers.len() == 1 { "seed" } else { "seeds" };
        (!numbers.is_empty()).then(|| format!("{} {place} ({seeds} {first}{more})", numbers.len()))
    });
    format!(
        "{inverted:.1} | {} of {} | {} | {}",
        frames.len(),
        outcomes.len(),
        taken.unwrap_or_default(),
        elsewhere.collect::<Vec<_>>().join("; ")
    )
}
