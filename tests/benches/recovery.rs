//! Which bodies find their shape again, by scene, body, energy and Newton's method, as Markdown on standard
//! output.
//!
//! ```sh
//! cargo bench -p piola-tests --bench recovery -- --seeds 100 --amplitude 0.3 0.5 1 2 box
//! ```
//!
//! A body is back from the frame on from which every node stays within a thousandth of the body's height. All
//! energies have E = 1 MPa and ν = 0.45. Of a body that is not back, the last column says where it rests, and
//! with which seeds. A last table has what other ways back gain where many bodies are lost.
//!
//! ```sh
//! cargo bench -p piola-tests --bench recovery -- --integrators
//! ```
//!
//! makes another table alone: from which frame on three bodies are back with other integrators.

use std::error::Error;
use std::fmt;
use std::io::{self, Write};

use clap::Parser;
use rayon::prelude::*;

use piola::point::Filter;
use piola::step::{Filtering, Integrator, NewtonSettings};
use piola_scenes::geometry::Geometry;
use piola_scenes::material::{MaterialSpec, soft_moduli};
use piola_scenes::measure;
use piola_scenes::output::{FinalPlace, Newton, Summary};
use piola_scenes::play::Play;
use piola_scenes::recovery_trial::{TrialOutcome, continue_trial};
use piola_scenes::scene::{
    Amplitude, Body, DINOSAUR_OVERSTRETCHED, HORSE, INSIDE_OUT, POINT, SCRAMBLE, Scene, Start,
};
use piola_scenes::settings::Settings;

const MATERIALS: [&str; 5] =
    ["rotated linear", "fixed corotated", "stable neo-Hookean", "Ogden", "st_venant_kirchhoff"];

/// Differences of energies err by some roundings; slopes judge what is below them.
const RISE: f64 = 1e-12;

/// Of so many bodies that are not back the seeds are named.
const NAMED: usize = 5;

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
    newton: Vec<Newton>,

    /// How far they are scrambled for the comparison of ways back.
    #[arg(long, num_args = 0.., default_values = ["1", "2", "box"])]
    ways: Vec<Amplitude>,

    /// Other integrators at three scenes, and nothing else.
    #[arg(long)]
    integrators: bool,

    /// What `cargo bench` adds.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let options = Options::parse();
    let mut page = io::stdout().lock();
    if options.integrators {
        return compare_integrators(&mut page);
    }
    for newton in options.newton {
        let name = match newton {
            Newton::Single => "one Newton iteration per step",
            Newton::Full => "full Newton",
        };
        writeln!(page, "## Scrambled, {name}\n")?;
        writeln!(
            page,
            "| A | body | energy | start inside out | recovered | frames, median (most) | elsewhere |"
        )?;
        writeln!(page, "|---|---|---|---:|---:|---:|---|")?;
        for &amplitude in &options.amplitude {
            for body in [Body::HORSE, Body::DINOSAUR] {
                for material in &MATERIALS[..4] {
                    let seeds = (1..=options.seeds).map(|seed| Start::Scrambled { seed, amplitude });
                    let outcomes = play(&SCRAMBLE, body, material, Way::Plain(newton), seeds.collect())?;
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
            (&INSIDE_OUT, &[Body::HORSE, Body::DINOSAUR][..]),
            (&POINT, &[Body::HORSE, Body::DINOSAUR]),
            (&HORSE, &[Body::HORSE]),
        ] {
            for &body in bodies {
                for material in MATERIALS {
                    let outcomes = play(scene, body, material, Way::Plain(newton), vec![scene.start])?;
                    let row = Row(&outcomes);
                    writeln!(page, "| {} | {} | {material} | {row} |", scene.name, body.name)?;
                    page.flush()?;
                }
            }
        }
        writeln!(page)?;
    }
    if !options.ways.is_empty() {
        write!(page, "## Ways back, of {} each\n\n| A | body | energy |", options.seeds)?;
        WAYS.iter().try_for_each(|(name, _)| write!(page, " {name} |"))?;
        writeln!(page, "\n|---|---|---|{}", "---:|".repeat(WAYS.len()))?;
        for &amplitude in &options.ways {
            for body in [Body::HORSE, Body::DINOSAUR] {
                for material in &MATERIALS[..4] {
                    write!(page, "| {amplitude} | {} | {material} |", body.name)?;
                    for (_, way) in WAYS {
                        let seeds = (1..=options.seeds).map(|seed| Start::Scrambled { seed, amplitude });
                        let outcomes = play(&SCRAMBLE, body, material, *way, seeds.collect())?;
                        let recovered = outcomes.iter().filter(|outcome| outcome.recovered.is_some()).count();
                        write!(page, " {recovered} |")?;
                        page.flush()?;
                    }
                    writeln!(page)?;
                }
            }
        }
    }
    Ok(())
}

/// With how many steps a frame, for each of which an integrator is tried.
const INTEGRATORS: [(&str, Integrator, usize); 5] = [
    ("implicit Euler", Integrator::ImplicitEuler, 1),
    ("SDIRK2", Integrator::Sdirk2, 1),
    ("SDIRK3", Integrator::Sdirk3, 1),
    ("implicit Euler", Integrator::ImplicitEuler, 8),
    ("SDIRK2", Integrator::Sdirk2, 8),
];

/// Writes from which frame on each body is back with each integrator.
fn compare_integrators(page: &mut impl Write) -> Result<(), Box<dyn Error + Send + Sync>> {
    writeln!(
        page,
        "| scene | Newton | integrator | steps a frame | back from frame on | smallest det F | after 150 frames |"
    )?;
    writeln!(page, "|---|---|---|---:|---:|---:|---:|")?;
    for scene in [&HORSE, &DINOSAUR_OVERSTRETCHED, &SCRAMBLE] {
        for newton in [Newton::Single, Newton::Full] {
            // Shorter steps show how fast the damping of a scene is by itself.
            let is_long = scene.name != SCRAMBLE.name && newton == Newton::Single;
            let is_shown = |steps: usize| steps == 1 || is_long;
            for (name, integrator, steps) in INTEGRATORS.into_iter().filter(|&(.., steps)| is_shown(steps)) {
                let way = way_back(scene, newton, integrator, steps)?;
                let newton = if newton == Newton::Single { "one iteration" } else { "full" };
                writeln!(page, "| `{}` | {newton} | {name} | {steps} | {way} |", scene.name)?;
                page.flush()?;
            }
        }
    }
    Ok(())
}

/// How a body has come back.
struct WayBack {
    /// The frame from which on it is near rest.
    frame: Option<usize>,
    min_det_f: f64,
    /// Distance from rest after 150 frames, body heights.
    distance: f64,
}

/// Follows a body for as many frames as the scene has, and 300 at least.
fn way_back(
    scene: &'static Scene,
    newton: Newton,
    integrator: Integrator,
    steps: usize,
) -> Result<WayBack, Box<dyn Error + Send + Sync>> {
    let settings = Settings::new(scene).with_newton(newton).with_integrator(integrator);
    let settings = settings.with_dt(scene.dt / steps as f64);
    let geometry = Geometry::load(&settings)?;
    let mut play = Play::new(&settings, &geometry)?;
    let mut way = WayBack { frame: None, min_det_f: f64::INFINITY, distance: f64::NAN };
    for frame in 1..=scene.frames.max(300) {
        for _ in 0..steps {
            way.min_det_f = way.min_det_f.min(play.step()?.min_det);
        }
        let simulation = play.simulation();
        let pinned = simulation.pinned().len();
        let distance = measure::distance_from_rest(&geometry.mesh, simulation.positions(), pinned);
        if distance > Summary::RECOVERED {
            way.frame = None;
        } else {
            way.frame.get_or_insert(frame);
        }
        if frame == 150 {
            way.distance = distance;
        }
    }
    Ok(way)
}

impl fmt::Display for WayBack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { frame, min_det_f, distance } = self;
        let frame = frame.map_or_else(|| "–".to_owned(), |frame| frame.to_string());
        write!(f, "{frame} | {min_det_f:.2} | {distance:.1e}")
    }
}

/// How a body is brought back.
#[derive(Clone, Copy)]
enum Way {
    /// By its scene.
    Plain(Newton),
    /// With one Newton iteration per step and this filter.
    Filtered(Filtering),
    /// From a start shrunk towards its middle to this share.
    Shrunk(f64),
    /// As a solid of another energy first, for two seconds, with full Newton.
    First(&'static str),
}

const WAYS: &[(&str, Way)] = &[
    ("one iteration, clamped", Way::Plain(Newton::Single)),
    ("absolute", Way::Filtered(Filtering::Always(Filter::Absolute))),
    ("full Newton", Way::Plain(Newton::Full)),
    ("shrunk to a tenth", Way::Shrunk(0.1)),
    ("shrunk to a point", Way::Shrunk(0.0)),
    ("rotated linear first", Way::First("rotated linear")),
];

impl Way {
    /// A scene at its start, on this way.
    fn begin(self, described: &Settings, geometry: &Geometry) -> Result<Play, Box<dyn Error + Send + Sync>> {
        let newton = if let Self::Plain(newton) = self { newton } else { described.newton };
        let mut play = Play::new(&described.clone().with_newton(newton), geometry)?;
        match self {
            Self::Plain(_) => {}
            Self::Filtered(filtering) => {
                let newton = NewtonSettings::single().with_filtering(filtering);
                play.set_step_settings(play.simulation().settings().with_newton(newton))?;
            }
            Self::Shrunk(share) => {
                let bounds = geometry.mesh.bounds();
                let middle: [f64; 3] = std::array::from_fn(|c| 0.5 * (bounds.min[c] + bounds.max[c]));
                let shrink = |x: &[f64; 3]| std::array::from_fn(|c| middle[c] + share * (x[c] - middle[c]));
                let positions: Vec<_> = play.simulation().positions().iter().map(shrink).collect();
                play.simulation_mut().set_positions(&positions)?;
            }
            Self::First(material) => {
                let material = MaterialSpec::matching(material, soft_moduli());
                let settings = described.clone().with_material(material).with_newton(Newton::Full);
                let mut first = Play::new(&settings, geometry)?;
                for _ in 0..(2.0 / settings.dt) as usize {
                    first.step()?;
                }
                play.simulation_mut().set_positions(first.simulation().positions())?;
            }
        }
        Ok(play)
    }
}

/// Plays a scene from each of these starts, as many at once as there are cores.
fn play(
    scene: &'static Scene,
    body: Body,
    material: &str,
    way: Way,
    starts: Vec<Start>,
) -> Result<Vec<TrialOutcome>, Box<dyn Error + Send + Sync>> {
    let material = MaterialSpec::matching(material, soft_moduli());
    let described = Settings::new(scene).with_body(body).with_material(material);
    let geometry = Geometry::load(&described)?;
    let outcomes: Result<_, Box<dyn Error + Send + Sync>> = starts
        .into_par_iter()
        .map(|start| {
            let play = way.begin(&described.clone().with_start(start), &geometry)?;
            Ok(continue_trial(play, described.frames, &geometry)?)
        })
        .collect();
    let outcomes: Vec<TrialOutcome> = outcomes?;
    for outcome in &outcomes {
        assert!(outcome.finite, "a position is not finite: {outcome:?}");
        assert!(outcome.largest_rise <= RISE, "the objective of a step has risen: {outcome:?}");
    }
    Ok(outcomes)
}

/// What some outcomes have in common.
struct Row<'a>(&'a [TrialOutcome]);

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
        let places = [
            FinalPlace::StableElsewhere,
            FinalPlace::UndecidedElsewhere,
            FinalPlace::Saddle,
            FinalPlace::NotAtRest,
            FinalPlace::Rest,
        ];
        let mut separator = "";
        for place in places {
            // By their numbers, which are the seeds.
            let there = |outcome: &TrialOutcome| {
                outcome.final_state.is_some_and(|final_state| final_state.place == place)
            };
            let numbers: Vec<_> = (1..).zip(*outcomes).filter(|(_, outcome)| there(outcome)).collect();
            if !numbers.is_empty() {
                let first: Vec<_> =
                    numbers.iter().take(NAMED).map(|(number, _)| format!("{number}")).collect();
                let more = if numbers.len() > NAMED { ", …" } else { "" };
                write!(f, "{separator}{} {place} ({}{more})", numbers.len(), first.join(", "))?;
                separator = "; ";
            }
        }
        Ok(())
    }
}
