//! Measures speed against error and writes what it found: `cargo speed-report`.
//!
//! Into `target/report/`: charts, a page that tells what they mean, and all numbers as `report.json`. With
//! `--quick` in less than two minutes, from fewer repeats and smaller bodies. Nothing else should run on the
//! machine.
//!
//! * [`point`]: P and dP/dF by many methods, nanoseconds against errors at reference cases of 25 digits;
//! * [`steps`]: trajectories of bodies held and free, wall time against the error of a much finer one;
//! * [`growth`]: time and memory of a step against the number of elements.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, SystemTime};

use clap::{Parser, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use piola::lanes::Backend;
use piola_speed::{Effort, processor};
use piola_tests::cases::Case;

mod charts;
mod data;
mod files;
mod growth;
mod page;
mod point;
mod steps;

use data::Report;

/// Every byte that is allocated, and the most at a time.
#[global_allocator]
static MEMORY: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;

/// Measures speed against error and writes charts, a page and the numbers.
#[derive(Parser)]
#[command(name = "cargo speed-report")]
struct Arguments {
    /// Fewer repeats and smaller bodies: less than two minutes
    #[arg(long)]
    quick: bool,
    /// Only these sections; the others are left out of the report
    #[arg(long, value_enum, value_delimiter = ',')]
    only: Vec<Section>,
    /// Trajectories of these bodies only
    #[arg(long, value_enum, value_delimiter = ',')]
    bodies: Vec<steps::Body>,
    /// Measure nothing, and make charts and page again from the numbers of the run before
    #[arg(long, conflicts_with_all = ["quick", "only", "bodies"])]
    redraw: bool,
    /// What `cargo bench` adds
    #[arg(long, hide = true)]
    bench: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Section {
    Point,
    Steps,
    Growth,
}

/// Where the report goes.
fn folder() -> PathBuf {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    workspace.canonicalize().unwrap_or(workspace).join("target/report")
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match make(&arguments) {
        Ok(()) => {
            println!("{}", folder().join(files::PAGE).display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Measures all that is asked for, then writes: a run that fails leaves the files of the one before.
fn make(arguments: &Arguments) -> Result<(), String> {
    let asked = |section| arguments.only.is_empty() || arguments.only.contains(&section);
    let folder = files::Folder::prepare(&folder())?;
    if arguments.redraw {
        return folder.write(&folder.read()?);
    }
    let mut report = Report {
        machine: processor(),
        back_end: Backend::best().to_string(),
        commit: files::commit(),
        time: SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_secs(),
        rows: Vec::new(),
        steps: Vec::new(),
        histories: Vec::new(),
        adaptive: Vec::new(),
        growth: Vec::new(),
    };
    if asked(Section::Point) {
        let cases = cases()?;
        let progress = bar("point", point::count(&cases));
        report.rows = point::rows(&cases, effort(arguments.quick), &progress)?;
        progress.finish_and_clear();
    }
    if asked(Section::Steps) {
        let plan = steps::plan(arguments.quick, &arguments.bodies);
        let progress = bar("steps", steps::count(&plan));
        let measured = steps::measure(&plan, &progress)?;
        (report.steps, report.histories, report.adaptive) =
            (measured.rows, measured.histories, measured.frames);
        progress.finish_and_clear();
    }
    if asked(Section::Growth) {
        let plan = growth::plan(arguments.quick);
        let progress = bar("growth", plan.len() as u64);
        report.growth = growth::rows(&plan, &MEMORY, &progress)?;
        progress.finish_and_clear();
    }
    folder.write(&report)
}

fn effort(is_quick: bool) -> Effort {
    let (repeats, at_most) = if is_quick { (5, 2) } else { (41, 100) };
    Effort { repeats, at_least: Duration::from_micros(30), at_most: Duration::from_millis(at_most) }
}

/// The cases of `tests/reference` whose energies take part.
fn cases() -> Result<Vec<Case>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut cases = Case::read(&folder.join("cases.json"))?;
    cases.extend(Case::read(&folder.join("cases-ordinary.json"))?);
    Ok(cases)
}

fn bar(section: &'static str, length: u64) -> ProgressBar {
    const TEMPLATE: &str = "{prefix:7} {bar:40} {pos}/{len} {elapsed} {msg}";
    let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style).with_prefix(section)
}
