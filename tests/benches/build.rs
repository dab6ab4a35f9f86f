//! What a material costs whoever builds it: clean builds of crates outside the workspace, against one of
//! `syn` and `quote`.
//!
//! `cargo bench -p piola-tests --bench build` in the profile `dev`, with `-- --release` in `release`. The
//! crates they need must be on this machine, as they are once the workspace has been built. Times are medians
//! of three, on a machine that should do nothing else.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, io};

/// Clean builds of each crate, one after the other so that what slows the machine slows all of them.
const ROUNDS: usize = 3;

/// The crates: what each is for, its dependencies and its source. All others are compared with the first.
const SUBJECTS: [(&str, &str, &str); 6] = [
    ("syn and quote", "syn = { version = \"3.0\", features = [\"full\"] }\nquote = \"1.0\"\n", ""),
    ("the macro", "piola-macros = { path = \"ROOT/macros\" }\n", ""),
    ("piola", "piola = { path = \"ROOT/runtime\" }\n", ""),
    ("piola, one material", "piola = { path = \"ROOT/runtime\" }\n", MATERIAL),
    ("… and batches", "piola = { path = \"ROOT/runtime\", features = [\"batch\"] }\n", MATERIAL),
    ("… and bodies", "piola = { path = \"ROOT/runtime\", features = [\"system\"] }\n", MATERIAL),
];

const MATERIAL: &str = "
/// Compressible neo-Hookean solid.
#[piola::material(domain(J > 0.0), admissible(mu > 0.0), extend)]
pub fn Rubber(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus, Pa.
    mu: f64,
    /// First Lamé parameter, Pa.
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}
";

fn main() -> ExitCode {
    let is_release = env::args().any(|argument| argument == "--release");
    match times(is_release) {
        Ok(times) => {
            println!("clean build, {}", if is_release { "release" } else { "dev" });
            let reference = median(&times[0]);
            for ((name, ..), times) in SUBJECTS.iter().zip(&times) {
                let time = median(times);
                let ratio = time.as_secs_f64() / reference.as_secs_f64();
                println!("{name:20} {:7.2} s {ratio:6.2}", time.as_secs_f64());
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn times(is_release: bool) -> Result<Vec<Vec<Duration>>, String> {
    let folders: Vec<_> = (0..SUBJECTS.len()).map(folder).collect();
    for (folder, (name, dependencies, source)) in folders.iter().zip(SUBJECTS) {
        write(folder, dependencies, source).map_err(|error| format!("{name}: {error}"))?;
    }
    let mut times = vec![Vec::new(); SUBJECTS.len()];
    for _ in 0..ROUNDS {
        for (folder, times) in folders.iter().zip(&mut times) {
            times.push(build(folder, is_release)?);
        }
    }
    Ok(times)
}

/// Of the crate with this index among the subjects.
fn folder(index: usize) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("build-{index}"))
}

/// A package of its own, with the versions that the workspace has.
fn write(folder: &Path, dependencies: &str, source: &str) -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let dependencies = dependencies.replace("ROOT", &root.display().to_string());
    let package = "[package]\nname = \"downstream\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
    fs::create_dir_all(folder.join("src"))?;
    fs::write(
        folder.join("Cargo.toml"),
        format!("{package}\n[workspace]\n\n[dependencies]\n{dependencies}"),
    )?;
    fs::write(folder.join("src/lib.rs"), format!("//! Downstream.\n{source}"))?;
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).map(drop)
}

fn build(folder: &Path, is_release: bool) -> Result<Duration, String> {
    let in_folder = |error: io::Error| format!("{}: {error}", folder.display());
    let target = folder.join("target");
    if target.exists() {
        fs::remove_dir_all(&target).map_err(in_folder)?;
    }
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--offline", "--quiet"]).args(is_release.then_some("--release"));
    cargo.arg("--target-dir").arg(&target).current_dir(folder).stdout(Stdio::null());
    let start = Instant::now();
    let status = cargo.status().map_err(in_folder)?;
    if status.success() { Ok(start.elapsed()) } else { Err(format!("{}: {status}", folder.display())) }
}

fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort();
    sorted[sorted.len() / 2]
}
