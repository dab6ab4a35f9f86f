//! The program `piola-mpi`.

use std::env;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use piola_distributed::command::{Cli, Command, split};
use piola_distributed::error::Error;
use piola_distributed::petsc::Library;
use piola_distributed::run::{TITLES, run, sag, statics};
use piola_distributed::team::Team;

/// Time that a rank waits before it ends all ranks because of its error: rank 0 may report the same error.
const PATIENCE: Duration = Duration::from_secs(2);

#[expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]
fn main() -> ExitCode {
    let (own, petsc) = split(env::args());
    // Before MPI runs: help and errors in options of piola-mpi need no ranks.
    let parsed = Cli::try_parse_from(own);
    let help = parsed.as_ref().err().filter(|error| !error.use_stderr());
    let library = match Library::start(&petsc) {
        Ok(library) => library,
        Err(error) => {
            eprintln!("piola-mpi: {error}");
            return ExitCode::FAILURE;
        }
    };
    let team = Team::new(&library);
    let is_first = team.rank == 0;
    if let Some(help) = help {
        if is_first {
            print!("{help}");
        }
        return ExitCode::SUCCESS;
    }
    let cli = match parsed {
        Ok(cli) => cli,
        Err(error) => {
            if is_first {
                eprint!("{error}");
            }
            return ExitCode::from(2);
        }
    };
    // A rank that panics cannot inform the others.
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        report(panic);
        std::process::abort();
    }));
    match play(&team, &cli.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.is_common() => {
            if is_first {
                eprintln!("piola-mpi: {error}");
            }
            ExitCode::FAILURE
        }
        Err(error) => {
            if !is_first {
                std::thread::sleep(PATIENCE);
            }
            eprintln!("piola-mpi: {error}");
            team.abort()
        }
    }
}

#[expect(clippy::print_stdout, reason = "a command line tool")]
fn play(team: &Team, command: &Command) -> Result<(), Error> {
    let threads = match command {
        Command::Box(options) => options.solver.threads,
        Command::Statics(options) => options.solver.threads,
        Command::Run(options) => options.body.solver.threads,
    };
    // This thread is one of the pool, so that a single thread does not wait for another one.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).use_current_thread().build_global();
    team.agree(pool.map_err(|error| Error::usage(format!("--threads {threads}: {error}"))))?;
    let summary = match command {
        Command::Box(options) => {
            let line = sag(team, options)?;
            if team.rank == 0 {
                println!("{TITLES}\n{line}");
            }
            return Ok(());
        }
        Command::Statics(options) => statics(team, options)?,
        Command::Run(options) => run(team, options)?,
    };
    if team.rank == 0 {
        println!("{summary}");
    }
    match summary.failures.first() {
        None => Ok(()),
        Some(failure) => Err(Error::OnRank { rank: 0, message: failure.clone() }),
    }
}
