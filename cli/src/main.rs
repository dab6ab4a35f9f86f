//! The command `piola`: runs scenes, shows them in a browser, lists materials and puts them on the bench.

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};

use piola_cli::view::Viewer;
use piola_scenes::energy;
use piola_scenes::error::Error;
use piola_scenes::run::run;

mod command;
mod laboratory;
mod picture;

use command::{Cli, Command, Run, View};
use picture::{PICTURE_FILE, Picture};

fn main() -> ExitCode {
    // A command line that makes no sense ends here, with status 2.
    let result = match Cli::parse().command {
        None => play(Run::parse_from(["piola"])),
        Some(Command::Run(arguments)) => play(*arguments),
        Some(Command::View(arguments)) => view(*arguments),
        Some(Command::Materials) => {
            energy::pages().for_each(say);
            Ok(())
        }
        Some(Command::Curve(arguments)) => {
            arguments.settings().and_then(|settings| laboratory::curve(&settings)).map(table)
        }
        Some(Command::Fit(arguments)) => {
            arguments.settings().and_then(|settings| laboratory::fit(&settings)).map(table)
        }
        Some(Command::Check(arguments)) => {
            arguments.settings().and_then(|settings| laboratory::check(&settings)).map(table)
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn play(arguments: Run) -> Result<(), Error> {
    let (settings, output) = arguments.settings()?;
    // The bar goes to standard error, and nowhere where that is no terminal.
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

fn view(arguments: View) -> Result<(), Error> {
    let viewer = Viewer::start(arguments.options()?)?;
    say(format_args!("http://{}/ shows the scene; Ctrl-C ends it", viewer.address()));
    viewer.wait();
    Ok(())
}

/// Writes what ends its last line itself.
fn table(what: impl Display) {
    say(what.to_string().trim_end());
}

/// Writes to standard output; a reader who has gone away is no failure.
fn say(what: impl Display) {
    let _ = writeln!(io::stdout(), "{what}");
}
