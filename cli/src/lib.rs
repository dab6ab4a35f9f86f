//! The command `piola`: runs scenes, shows them in a browser, lists materials and puts them on the bench.
//!
//! Other programs can use [`render`], which draws a deforming surface in software, and `piola-scenes`,
//! `piola-viewer` and `piola-laboratory`, which are independent of this crate.

mod bench;
mod command;
mod contract;
mod declare;
mod emit;
mod error;
mod materials;
mod picture;
pub mod render;
mod signals;
mod view;

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use piola::__private::message::printable;
use piola_scenes::error::Error as SceneError;
use piola_scenes::output::{Ended, Summary};
use piola_scenes::run::Course;

use command::{Cli, Command, Run, View};
use error::Error;

/// Parses the command line and runs the command; returns the exit status: 2 if the command line is invalid, 1
/// if something failed on the way, and 128 with the number of a signal that has ended a run.
#[must_use]
pub fn main() -> ExitCode {
    let command = match Cli::try_parse() {
        Ok(Cli { command }) => command.unwrap_or_else(|| Command::Run(Box::new(Run::parse_from(["piola"])))),
        Err(error) => {
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            return if heard(error.print()).is_ok() { code.into() } else { ExitCode::FAILURE };
        }
    };
    let result = match command {
        Command::Run(arguments) => play(*arguments),
        Command::View(arguments) => serve(*arguments).map(|()| ExitCode::SUCCESS),
        Command::Materials { name } => materials::pages(name.as_deref()).map_err(Error::from).and_then(say),
        Command::Curve(curve) => curve.run().and_then(say),
        Command::Fit(fit) => fit.run().and_then(say),
        Command::Check(check) => check.run().and_then(say),
        Command::Declare(declare) => declare.run().and_then(say),
        Command::Emit(emit) => emit.run().and_then(say),
        Command::Contract(contract) => contract.run().and_then(say),
    };
    result.unwrap_or_else(|error| {
        let message = format!("error: {error}{}", error.remedy());
        match error.has_lines() {
            true => message.lines().for_each(warn),
            false => warn(message),
        }
        ExitCode::from(error.exit_code())
    })
}

/// Runs a scene, after an overview; the count of its steps goes to standard error if that is a terminal.
fn play(arguments: Run) -> Result<ExitCode, Error> {
    let (settings, output) = arguments.settings()?;
    let signal = signals::listen().map_err(Error::system("listen to signals"))?;
    let is_shown = io::stderr().is_terminal();
    let course = Course::open(&settings, &output)?;
    // If this cannot be written, neither can the report at the end, which is then an error.
    let _ = say(format_args!("{}: {}", settings.scene.name, course.play.overview));
    course.play.overview.warnings.iter().for_each(warn_of);
    let warned = course.play.overview.warnings.len();
    let result = course.play(&mut |frame| {
        if is_shown {
            let (scene, frames) = (settings.scene.name, settings.frames);
            let _ = write!(io::stderr(), "\r{scene}: {frame} of {frames} steps");
        }
        signal().is_some()
    });
    if is_shown {
        let _ = write!(io::stderr(), "\r\x1b[K");
    }
    let mut finished = match (result, signal()) {
        (Err(error @ SceneError::Interrupted), Some(code)) => {
            warn(format_args!("error: {error}"));
            return Ok(code.into());
        }
        (result, _) => result?,
    };
    picture::add(&mut finished, &settings);
    report(&finished.close()?, warned, &output.folder, signal())
}

/// Prints the results of a run, without the first warnings, and returns the exit status.
fn report(summary: &Summary, warned: usize, folder: &Path, signal: Option<u8>) -> Result<ExitCode, Error> {
    let place = folder.display();
    say(format_args!("{summary}\n  surfaces, frames.png and summary.json are in {place}"))?;
    summary.body.warnings.iter().skip(warned).for_each(warn_of);
    let again = format!("; the same command with --out {place} --resume continues from there");
    let frames = summary.frames;
    match summary.ended {
        Ended::Interrupted => warn(format_args!("interrupted after {frames} steps{again}")),
        Ended::Failed => warn(format_args!("error: {}{again}", summary.failures.join("; "))),
        Ended::Finished if summary.failures.is_empty() => return Ok(ExitCode::SUCCESS),
        Ended::Finished => warn(format_args!("error: {}", summary.failures.join("; "))),
    }
    Ok(signal.filter(|_| summary.ended == Ended::Interrupted).map_or(ExitCode::FAILURE, ExitCode::from))
}

fn serve(arguments: View) -> Result<(), Error> {
    let (session, port, save) = arguments.session()?;
    let overview = session.play().overview.clone();
    let server = view::open(session, port, save)?;
    say(format_args!("{} shows the scene; Ctrl-C ends it\n{overview}", server.url()))?;
    overview.warnings.iter().for_each(warn_of);
    server.run();
    Ok(())
}

/// Writes a text without its last line end, and a line end, to standard output.
fn say(text: impl Display) -> Result<ExitCode, Error> {
    let mut out = io::stdout().lock();
    let said = writeln!(out, "{}", text.to_string().trim_end_matches('\n')).and_then(|()| out.flush());
    heard(said).map(|()| ExitCode::SUCCESS).map_err(Error::system("write to standard output"))
}

/// Ignores the error of a closed reader, such as `head`.
fn heard(said: io::Result<()>) -> io::Result<()> {
    match said {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        said => said,
    }
}

fn warn_of(warning: &String) {
    let kind = if warning.starts_with("note: ") { "" } else { "warning: " };
    warn(format_args!("{kind}{warning}"));
}

/// Writes a line to standard error, if it is open, with control characters of file names and contents
/// escaped.
fn warn(line: impl Display) {
    let _ = writeln!(io::stderr(), "{}", printable(&line.to_string()));
}
