//! Writes `tests/STABILITY.md`, or with `--check` says whether it is what would be written.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::path::Path;
use std::process::ExitCode;

use piola_tests::cases::Case;
use piola_tests::stability::report;

fn main() -> ExitCode {
    let check = std::env::args().skip(1).any(|argument| argument == "--check");
    match run(check) {
        Ok(message) => {
            println!("{message}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(check: bool) -> Result<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut cases = Vec::new();
    for name in ["cases.json", "cases-more.json"] {
        let path = folder.join("reference").join(name);
        if path.exists() {
            cases.extend(Case::read(&path)?);
        }
    }
    let report = report(&cases)?;
    let path = folder.join("STABILITY.md");
    let message = |error: std::io::Error| format!("{}: {error}", path.display());
    if check {
        let committed = std::fs::read_to_string(&path).map_err(message)?;
        let differing = committed.lines().zip(report.lines()).find(|(old, new)| old != new);
        return match differing {
            Some((old, new)) => Err(format!("{} differs\n- {old}\n+ {new}", path.display())),
            None if committed != report => Err(format!("{} has another length", path.display())),
            None => Ok(format!("{} is up to date", path.display())),
        };
    }
    std::fs::write(&path, report).map_err(message)?;
    Ok(format!("wrote {}: {} cases", path.display(), cases.len()))
}
