//! The command `piola`: runs scenes, shows them in a browser, lists materials and puts them on the bench.
//!
//! Other programs can use [`render`], which draws a deforming surface in software, and [`view`], which plays
//! a scene for a page in a browser, where it can be pulled with the mouse. Scenes themselves are in
//! `piola-scenes`, which knows nothing of this crate.

mod bench;
mod command;
pub mod error;
mod materials;
mod picture;
pub mod render;
mod value;
pub mod view;

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use piola_scenes::run::run;

use command::{Cli, Command, Run, View};
use error::Error;
use picture::{PICTURE_FILE, Picture};
use view::Viewer;

/// Parses the command line and obeys it; returns the exit status, 2 if the command line makes no sense.
#[must_use]
pub fn main() -> ExitCode {
    let result = match Cli::parse().command {
        None => play(Run::parse_from(["piola"])),
        Some(Command::Run(arguments)) => play(*arguments),
        Some(Command::View(arguments)) => serve(*arguments),
        Some(Command::Materials) => {
            say(materials::pages());
            Ok(())
        }
        Some(Command::Curve(curve)) => curve.run().map(say),
        Some(Command::Fit(fit)) => fit.run().map(say),
        Some(Command::Check(check)) => check.run().map(say),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}{}", error.remedy());
            ExitCode::from(error.exit_code())
        }
    }
}

fn play(arguments: Run) -> Result<(), Error> {
    let (settings, output) = arguments.settings()?;
    // The bar goes to standard error, and nowhere if that is no terminal.
    let bar = ProgressBar::new(settings.frames as u64).with_message(settings.scene.name);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} steps") {
        bar.set_style(style);
    }
    let mut picture = Picture::new(&settings);
    let result = run(&settings, &output, &mut |snapshot| {
        bar.set_position(snapshot.frame as u64);
        picture.add(snapshot);
    });
    bar.finish_and_clear();
    let mut finished = result?;
    let picture = picture.draw(&finished.geometry, &settings);
    finished.folder.write(PICTURE_FILE, |file| picture.write_png(file).map_err(Into::into))?;
    finished.folder.publish()?;
    say(finished.summary);
    say(format_args!("  surfaces, frames.png and summary.json are in {}", output.folder.display()));
    Ok(())
}

fn serve(arguments: View) -> Result<(), Error> {
    let viewer = Viewer::start(arguments.options()?)?;
    say(format_args!("http://{}/ shows the scene; Ctrl-C ends it", viewer.address()));
    viewer.wait();
    Ok(())
}

/// Writes a text without its last line end, and a line end, to standard output; a reader who has gone away is
/// no failure.
fn say(text: impl Display) {
    let _ = writeln!(io::stdout(), "{}", text.to_string().trim_end_matches('\n'));
}
