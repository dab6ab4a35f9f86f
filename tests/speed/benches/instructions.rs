//! Counts the instructions of every kernel with callgrind, which no other program on the machine disturbs.
//!
//! `cargo bench -p piola-speed --features f32 --bench instructions` prints them; with `-- --check` it
//! compares them with the committed ones of this compiler's version, `tests/speed/instructions/rustc-*.txt`,
//! and fails where a kernel has grown by more than 2 %; with `-- --bless` it writes those. Where valgrind or
//! AVX2 is missing it says so and checks nothing.
//!
//! Instructions are not time. But where nothing but the code has changed, more of them are a reason to
//! measure.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::{env, fs};

use piola::batch::{Batch, Kernels, Layout};
use piola::lanes::Backend;
use piola::point::Filter;
use piola_speed::{Arrays, Decompositions, IN_CACHE, Task, materials};

/// Factor by which a kernel may grow.
const SLACK: f64 = 1.02;

/// Argument with which callgrind runs the program.
const COUNTED: &str = "--counted";

fn main() -> ExitCode {
    // `cargo bench` adds an argument of its own.
    let argument = env::args().skip(1).find(|argument| argument != "--bench").unwrap_or_default();
    if argument == COUNTED {
        for (_, mut kernel) in kernels() {
            // The first call of a thread makes its workspace.
            kernel();
            counted_by_callgrind(&mut kernel);
        }
        return ExitCode::SUCCESS;
    }
    match run(&argument) {
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

fn run(argument: &str) -> Result<String, String> {
    if let Some(missing) = missing() {
        return Ok(format!("nothing counted: {missing}"));
    }
    let path = table_of_this_compiler()?;
    let at_path = |error: std::io::Error| format!("{}: {error}", path.display());
    match argument {
        "" => Ok(to_table(&count()?)),
        "--bless" => {
            fs::write(&path, to_table(&count()?)).map_err(at_path)?;
            Ok(format!("wrote {}", path.display()))
        }
        "--check" if !path.exists() => {
            Ok(format!("nothing counted: there is no {}; --bless writes it", path.display()))
        }
        "--check" => compare(&fs::read_to_string(&path).map_err(at_path)?, &count()?),
        other => Err(format!("{other}: --check, --bless or nothing")),
    }
}

/// Missing prerequisite of counting.
fn missing() -> Option<&'static str> {
    let mut version = Command::new("valgrind");
    let version = version.arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    if !version.is_ok_and(|status| status.success()) {
        Some("valgrind is not installed")
    } else if !Backend::available().any(|backend| backend.name() == "AVX2") {
        Some("the processor has no AVX2")
    } else {
        None
    }
}

fn table_of_this_compiler() -> Result<PathBuf, String> {
    let output =
        Command::new("rustc").arg("--version").output().map_err(|error| format!("rustc: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let version = text.split_whitespace().nth(1).unwrap_or_default();
    let version = version.rsplit_once('.').map(|(minor, _)| minor);
    let version = version.ok_or_else(|| format!("rustc --version says {text:?}"))?;
    Ok(Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("instructions/rustc-{version}.txt")))
}

/// A kernel on [`IN_CACHE`] points.
type Call = Box<dyn FnMut()>;

/// All that is counted, by name and in this order. Under valgrind the best back end is AVX2.
fn kernels() -> Vec<(String, Call)> {
    let mut kernels = Vec::new();
    for backend in Backend::available().filter(|backend| backend.name() != "AVX-512") {
        kernels_in::<f64>(backend, &mut kernels);
        kernels_in::<f32>(backend, &mut kernels);
    }
    kernels
}

fn kernels_in<E: Kernels>(backend: Backend, kernels: &mut Vec<(String, Call)>) {
    let mut push = |kernel: &str, material: &str, call: Call| {
        let format = std::any::type_name::<E>();
        kernels.push((format!("{:<8} {format} {kernel:<25} {material:<17}", backend.name()), call));
    };
    for (name, is_signed) in [("svd", false), ("svd_signed_by_determinant", true)] {
        let mut decompositions = Decompositions::<E>::default();
        push(name, "", Box::new(move || decompositions.run(backend, is_signed)));
    }
    for task in Task::ALL {
        for &filter in task.filters() {
            for (name, energy) in materials::<E>() {
                let mut arrays = Arrays::new(task, Layout::Lines, IN_CACHE);
                let call =
                    move || arrays.run(&Batch::new(&*energy).with_backend(backend).with_filter(filter));
                let mark = if filter == Filter::Clamp { " +C" } else { "" };
                push(&format!("{}{mark}", task.name()), name, Box::new(call));
            }
        }
    }
}

/// Function that callgrind identifies by its name: instructions inside count.
#[inline(never)]
fn counted_by_callgrind(call: &mut dyn FnMut()) {
    call();
    // Or the call would be a jump, and callgrind never see the end of this function.
    black_box(IN_CACHE);
}

/// Instructions per point of each kernel.
type Counts = Vec<(String, f64)>;

fn count() -> Result<Counts, String> {
    let program = env::current_exe().map_err(|error| error.to_string())?;
    let folder = program.with_extension("callgrind");
    let at_folder = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(at_folder)?;
    }
    fs::create_dir_all(&folder).map_err(at_folder)?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["-q", "--tool=callgrind", "--collect-atstart=no"]);
    // Only what is inside counts, and each time it returns the count is written and starts anew.
    let function = concat!(module_path!(), "::counted_by_callgrind");
    valgrind.args([format!("--toggle-collect={function}"), format!("--dump-after={function}")]);
    valgrind.arg(format!("--callgrind-out-file={}", folder.join("out").display()));
    let status =
        valgrind.arg(&program).arg(COUNTED).status().map_err(|error| format!("valgrind: {error}"))?;
    if !status.success() {
        return Err(format!("valgrind: {status}"));
    }
    let counted = kernels().into_iter().enumerate().map(|(k, (name, _))| {
        let path = folder.join(format!("out.{}", k + 1));
        let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let total = text.lines().find_map(|line| line.strip_prefix("summary:"));
        let total = total.and_then(|total| total.trim().parse::<f64>().ok());
        let total = total.ok_or_else(|| format!("{}: no total", path.display()))?;
        Ok((name, total / IN_CACHE as f64))
    });
    counted.collect()
}

fn to_table(counts: &Counts) -> String {
    let lines = counts.iter().map(|(name, count)| format!("{name} {count:8.1}\n"));
    "# Instructions per point: back end, format, kernel (+C: clamped), energy.\n".to_owned()
        + &lines.collect::<String>()
}

fn compare(table: &str, counted: &Counts) -> Result<String, String> {
    let others = || "other kernels than those of the table; --bless writes it anew".to_owned();
    let lines: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
    if lines.len() != counted.len() {
        return Err(others());
    }
    let (mut grown, mut shrunk) = (String::new(), 0);
    for (line, (name, now)) in lines.into_iter().zip(counted) {
        let before = line.strip_prefix(name.as_str()).ok_or_else(others)?.trim();
        let before: f64 = before.parse().map_err(|error| format!("{line}: {error}"))?;
        if *now > before * SLACK {
            grown += &format!("{}: {before:.1} before, {now:.1} now\n", name.trim_end());
        }
        shrunk += usize::from(now * SLACK < before);
    }
    if grown.is_empty() {
        let note = if shrunk > 0 { "; --bless keeps what others have gained" } else { "" };
        Ok(format!(
            "{} kernels, none grown by more than 2 %, {shrunk} shrunk by as much{note}",
            counted.len()
        ))
    } else {
        Err(format!("grown by more than 2 % (--bless accepts it):\n{grown}"))
    }
}
