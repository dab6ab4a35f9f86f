//! Measures speed against error and writes what it found: `cargo speed-report`.
//!
//! Into `target/report/`: charts, a page with every table, and all numbers as `report.json`. With
//! `--quick` in less than two minutes, from fewer repeats and smaller bodies. Nothing else should run on the
//! machine.
//!
//! * [`point`]: P and dP/dF by many methods, nanoseconds against errors at reference cases of 25 digits;
//! * [`steps`]: a motion by integrators and solvers, wall time against the distance from a much finer one;
//! * [`growth`]: time and memory of a step against the number of elements;
//! * [`table`]: with `--table`, nanoseconds of points and batches, printed and nothing else.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::path::Path;
use std::process::{Command, ExitCode};
use std::time::Duration;
use std::{error, fs};

use clap::{Parser, ValueEnum};
use piola::lanes::Backend;
use piola_speed::{Effort, processor};
use serde::Serialize;

mod charts;
mod growth;
mod markdown;
mod page;
mod point;
mod steps;
mod table;

type Outcome<T> = Result<T, Box<dyn error::Error + Send + Sync>>;

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
    /// Prints a table of nanoseconds for points and batches of three energies instead of a report
    #[arg(long, conflicts_with = "only")]
    table: bool,
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

/// All results of the report. A value that is not finite is `null` in JSON.
#[derive(Serialize)]
struct Report {
    machine: String,
    /// Instructions of the lanes.
    back_end: String,
    /// Commit of the sources, if they are a Git checkout.
    commit: Option<String>,
    rows: Vec<point::PointRow>,
    steps: Vec<steps::StepRow>,
    growth: Vec<growth::GrowthRow>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let made = if arguments.table {
        table::print(effort(arguments.quick), commit().as_deref())
    } else {
        make(&arguments)
    };
    match made {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Measures all that is asked for, then writes it and prints the path of the page: a run that fails leaves
/// the files of the one before.
fn make(arguments: &Arguments) -> Outcome<()> {
    let asked = |section| arguments.only.is_empty() || arguments.only.contains(&section);
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = workspace.canonicalize().unwrap_or(workspace).join("target/report");
    // Before anything is measured in vain.
    fs::create_dir_all(&folder)?;
    let (effort, is_quick) = (effort(arguments.quick), arguments.quick);
    let report = Report {
        machine: processor(),
        back_end: Backend::best().to_string(),
        commit: commit(),
        rows: asked(Section::Point).then(|| point::rows(effort)).transpose()?.unwrap_or_default(),
        steps: asked(Section::Steps).then(|| steps::rows(is_quick)).transpose()?.unwrap_or_default(),
        growth: asked(Section::Growth)
            .then(|| growth::rows(is_quick, &MEMORY))
            .transpose()?
            .unwrap_or_default(),
    };
    let charts = charts::draw(&report)?;
    for chart in &charts {
        fs::write(folder.join(&chart.file), &chart.svg)?;
    }
    fs::write(folder.join("report.json"), serde_json::to_string_pretty(&report)?)?;
    let page = folder.join("report.md");
    fs::write(&page, page::tell(&report, &charts))?;
    println!("{}", page.display());
    Ok(())
}

/// The commit that is checked out, where there is Git and a checkout; with a mark where files differ from it.
fn commit() -> Option<String> {
    let describe = ["describe", "--always", "--dirty", "--abbrev=12"];
    let output = Command::new("git").current_dir(env!("CARGO_MANIFEST_DIR")).args(describe).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

fn effort(is_quick: bool) -> Effort {
    let (repeats, at_most) = if is_quick { (5, 2) } else { (41, 100) };
    Effort { repeats, at_least: Duration::from_micros(30), at_most: Duration::from_millis(at_most) }
}
