//! Which bodies find their shape again, by scene, body, energy and Newton's method, as Markdown on standard output.
//!
//! ```sh
//! cargo bench -p piola-tests --bench recovery -- --seeds 100 --amplitude 0.3 0.5 1 2 box
//! ```
//!
//! A body is back from the frame on from which every node stays within a thousandth of the body's height. All energies
//! have E = 1 MPa and ν = 0.45. Of a body that is not back, the last column says where it rests.

use std::error::Error;
use std::fmt;
use std::io::{self, Write};

use clap::{Parser, ValueEnum};
use rayon::prelude::*;

use piola_scenes::energy::{Energy, soft};
use piola_scenes::geometry::Geometry;
use piola_scenes::output::{Newton, Place};
use piola_scenes::scene::{Amplitude, Body, HORSE, INSIDE_OUT, POINT, SCRAMBLE, Scene, Start, body};
use piola_scenes::settings::Settings;
use piola_scenes::trial::{Outcome, attempt};

const MATERIALS: [&str; 5] =
    ["rotated linear", "fixed corotated", "stable neo-Hookean", "Ogden", "Saint Venant–Kirchhoff"];

/// Differences of energies err by some roundings; slopes judge what is below them.
const RISE: f64 = 1e-12;

#[derive(Parser)]
struct Options {
    /// How many random starts of each kind, from seed 1.
    #[arg(long, default_value_t = 100)]
    seeds: u64,

    /// How far nodes are scrambled: mean edge lengths, or `box`.
    #[arg(long, num_args = 1.., default_values = ["0.3", "0.5", "1", "2", "box"])]
    amplitude: Vec<Amplitude>,

    /// How far each step is solved.
    #[arg(long, value_enum, num_args = 1.., default_values = ["single", "full"])]
    newton: Vec<Mode>,

    /// What `cargo bench` adds.
    #[arg(long, hide = true)]
    bench: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Mode {
    Single,
    Full,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let mut page = io::stdout().lock();
    for mode in options.newton {
        let (newton, name) = match mode {
            Mode::Single => (Newton::Single, "one Newton iteration per step"),
            Mode::Full => (Newton::Full, "full Newton"),
        };
        writeln!(page, "## Scrambled, {name}\n")?;
        writeln!(
            page,
            "| A | body | energy | start inside out | recovered | frames, median (most) | elsewhere |"
        )?;
        writeln!(page, "|---|---|---|---:|---:|---:|---|")?;
        for &amplitude in &options.amplitude {
            for body in [body::HORSE, body::DINOSAUR] {
                for material in &MATERIALS[..4] {
                    let seeds = (1..=options.seeds).map(|seed| Start::Scrambled { seed, amplitude });
                    let outcomes = play(&SCRAMBLE, body, material, newton, seeds.collect())?;
                    let row = Row(&outcomes);
                    writeln!(page, "| {amplitude} | {} | {material} | {row} |", body.name)?;
                    page.flush()?;
                }
            }
        }
        writeln!(page, "\n## One start each, {name}\n")?;
        writeln!(
            page,
            "| scene | body | energy | start inside out | recovered | frames, median (most) | elsewhere |"
        )?;
        writeln!(page, "|---|---|---|---:|---:|---:|---|")?;
        for (scene, bodies) in [
            (&INSIDE_OUT, &[body::HORSE, body::DINOSAUR][..]),
            (&POINT, &[body::HORSE, body::DINOSAUR]),
            (&HORSE, &[body::HORSE]),
        ] {
            for &body in bodies {
                for material in MATERIALS {
                    let outcomes = play(scene, body, material, newton, vec![scene.start])?;
                    let row = Row(&outcomes);
                    writeln!(page, "| {} | {} | {material} | {row} |", scene.name, body.name)?;
                    page.flush()?;
                }
            }
        }
        writeln!(page)?;
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
) -> Result<Vec<Outcome>, piola_scenes::error::Error> {
    let described = Settings { body, energy: Energy::like(material, soft()), newton, ..Settings::of(scene) };
    let geometry = Geometry::load(&described)?;
    let outcomes: Result<Vec<_>, _> = starts
        .into_par_iter()
        .map(|start| attempt(&Settings { start, ..described.clone() }, &geometry))
        .collect();
    let outcomes = outcomes?;
    for outcome in &outcomes {
        assert!(outcome.finite, "a position is not finite: {outcome:?}");
        assert!(outcome.largest_rise <= RISE, "the objective of a step has risen: {outcome:?}");
    }
    Ok(outcomes)
}

/// What some outcomes have in common.
struct Row<'a>(&'a [Outcome]);

impl fmt::Display for Row<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(outcomes) = self;
        let inverted: usize = outcomes.iter().map(|outcome| outcome.inverted_at_start).sum();
        let mut frames: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.recovered).collect();
        frames.sort_unstable();
        write!(
            f,
            "{:.1} | {} of {} | ",
            inverted as f64 / outcomes.len() as f64,
            frames.len(),
            outcomes.len()
        )?;
        if let Some(last) = frames.last() {
            write!(f, "{} ({last})", frames[frames.len() / 2])?;
        }
        f.write_str(" | ")?;
        let places =
            [Place::StableElsewhere, Place::UndecidedElsewhere, Place::Saddle, Place::NotAtRest, Place::Rest];
        let mut separator = "";
        for place in places {
            let standings = outcomes.iter().filter_map(|outcome| outcome.standing);
            let count = standings.filter(|standing| standing.place == place).count();
            if count > 0 {
                write!(f, "{separator}{count} {place}")?;
                separator = "; ";
            }
        }
        Ok(())
    }
}
