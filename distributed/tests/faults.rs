//! Failures: every rank ends with a non-zero exit code, there is one clear message, and the last checkpoint
//! remains intact.

mod common;

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::{TestResult, checkpoint_in, command, finish, state_after};
use piola_distributed::error::Error;
use piola_distributed::part;
use piola_distributed::petsc::Library;
use piola_distributed::portion::Portion;
use piola_distributed::share::Share;
use piola_distributed::team::Team;
use piola_scenes::material::{MaterialPart, MaterialSpec, soft_moduli};

/// Checks that a run has failed with a message that contains these words once.
#[track_caller]
fn check_failure(output: &Output, expected: &str) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{text}");
    assert_eq!(text.matches(expected).count(), 1, "`{expected}` in: {text}");
}

#[test]
fn wrong_options_are_named_once() -> TestResult {
    for (ranks, options, expected) in [
        (3, "box --elemens 6", "--elemens"),
        (3, "box --elements 60 -ksp_typ cg", "PETSc does not use -ksp_typ:"),
        (3, "box --elements 60 -ksp_type nonsense", "piola-mpi: PETSc:"),
        (3, "box --elements 6 --newton-tolerance 2", "--newton-tolerance 2"),
        (3, "run no-such-scene", "there is no scene `no-such-scene`"),
        (3, "run horse --mesh no-such-file.msh", "no-such-file.msh"),
        (7, "box --elements 6", "7 ranks cannot share 6 elements"),
        (
            3,
            "run horse --frames 1 --dt 0.1 --resume --out no-such-folder",
            "cannot continue from no-such-folder",
        ),
    ] {
        check_failure(&finish(command(ranks, options))?, expected);
    }
    Ok(())
}

#[test]
fn a_run_continues_with_other_ranks() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let [whole, parts] = ["whole", "parts"].map(|name| scratch.path().join(name));
    let solved = "run dinosaur --newton full --newton-tolerance 1e-12 --filter clamp --integrator sdirk2";
    let expected = state_after(1, &format!("{solved} --frames 9"), &whole)?;
    let mut found = None;
    for (ranks, frames, how) in [(3, 3, ""), (2, 6, "--resume"), (4, 9, "--resume")] {
        let options = format!("{solved} --frames {frames} {how}");
        found = Some(state_after(ranks, &options, &parts)?);
    }
    let found = found.ok_or("three runs")?;
    for (found, expected) in found.positions.as_flattened().iter().zip(expected.positions.as_flattened()) {
        assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
    }
    // Other options, and a damaged checkpoint, are refused.
    let other = format!("{solved} --gravity 1 --frames 12 --resume --out {}", parts.display());
    check_failure(&finish(command(2, &other))?, "its setting `gravity` was 0.0, and is 1.0 now");
    let damaged = parts.join("checkpoint.piola");
    let mut bytes = fs::read(&damaged)?;
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    fs::write(&damaged, bytes)?;
    let again = format!("{solved} --frames 12 --resume --out {}", parts.display());
    check_failure(&finish(command(2, &again))?, "it is damaged");
    Ok(())
}

/// Processes started by a process, and their descendants.
fn descendants(parent: u32) -> Vec<u32> {
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").into_iter().flatten().flatten() {
        let Some(process) = entry.file_name().to_str().and_then(|name| name.parse::<u32>().ok()) else {
            continue;
        };
        let stat = fs::read_to_string(entry.path().join("stat")).unwrap_or_default();
        // State and parent follow the name, which may contain any characters.
        let words = stat.rsplit(')').next().map(|rest| rest.split_whitespace().collect::<Vec<_>>());
        if words.and_then(|words| words.get(1)?.parse::<u32>().ok()) == Some(parent) {
            found.push(process);
            found.extend(descendants(process));
        }
    }
    found
}

#[test]
fn a_killed_rank_ends_all_and_leaves_a_checkpoint() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let folder = scratch.path().join("run");
    let options = format!("run dinosaur --frames 100000 --checkpoint-every 1 --out {}", folder.display());
    let mut child = command(3, &options).stdin(Stdio::null()).spawn()?;
    let begun = Instant::now();
    while !folder.join("checkpoint.piola").exists() {
        assert!(begun.elapsed() < Duration::from_secs(120), "no checkpoint");
        std::thread::sleep(Duration::from_millis(10));
    }
    let ranks = descendants(child.id());
    let victim = *ranks.last().ok_or("no ranks")?;
    assert!(Command::new("kill").args(["-9", &victim.to_string()]).status()?.success());
    let killed = Instant::now();
    while child.try_wait()?.is_none() {
        assert!(killed.elapsed() < Duration::from_secs(60), "the other ranks hang");
        std::thread::sleep(Duration::from_millis(10));
    }
    let output = child.wait_with_output()?;
    assert!(!output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("signal 9"), "{output:?}");
    let more = checkpoint_in(&folder)?.about.frame + 1;
    let state = state_after(2, &format!("run dinosaur --frames {more} --resume"), &folder)?;
    assert_eq!(state.about.frame, more);
    Ok(())
}

/// Runs in a separate name space, in which a small disk can be mounted.
#[test]
fn a_full_disk_ends_the_run_and_leaves_the_checkpoint() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let disk = scratch.path().join("disk");
    fs::create_dir(&disk)?;
    let user = if fs::metadata(scratch.path())?.uid() == 0 { "-m" } else { "-rm" };
    let run = |frames: usize, how: &str| {
        let options = format!("run dinosaur --frames {frames} {how} --out {}", disk.display());
        let run = command(2, &options);
        let arguments: Vec<_> = run.get_args().map(|word| word.to_string_lossy().into_owned()).collect();
        format!("mpirun {}", arguments.join(" "))
    };
    let keep = scratch.path().display();
    let script = format!(
        "mount -t tmpfs -o size=200k none {0} || exit 77\n\
         {1} && cp {0}/checkpoint.piola {keep}/before || exit 78\n\
         dd if=/dev/zero of={0}/ballast bs=1k 2>/dev/null\n\
         {2}\n\
         code=$?; cp {0}/checkpoint.piola {keep}/after; exit $code",
        disk.display(),
        run(2, ""),
        run(4, "--resume"),
    );
    let mut shell = Command::new("unshare");
    shell.args([user, "sh", "-c", &script]);
    shell.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    shell.stdout(Stdio::piped()).stderr(Stdio::piped());
    let output = finish(shell)?;
    if output.status.code() == Some(77) {
        println!("not checked: no disk can be mounted here");
        return Ok(());
    }
    assert_ne!(output.status.code(), Some(78), "{}", String::from_utf8_lossy(&output.stderr));
    check_failure(&output, "checkpoint.piola: No space left on device");
    assert_eq!(fs::read(scratch.path().join("before"))?, fs::read(scratch.path().join("after"))?);
    Ok(())
}

/// Runs the test `elements_are_judged_on_their_rank` of this program on four ranks.
#[test]
fn an_inverted_element_on_rank_3_ends_all_ranks() -> TestResult {
    let mut run = Command::new("mpirun");
    run.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    run.args(["--oversubscribe", "-n", "4"]).arg(std::env::current_exe()?);
    run.args(["--exact", "elements_are_judged_on_their_rank", "--nocapture"]).env("PIOLA_IS_A_RANK", "1");
    run.stdout(Stdio::piped()).stderr(Stdio::piped());
    let output = finish(run)?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&output.stdout).matches("rank 3 has refused").count(), 4);
    Ok(())
}

/// Runs as a rank of the test above: every rank receives the tag of the inverted element on rank 3.
#[test]
fn elements_are_judged_on_their_rank() -> TestResult {
    if std::env::var_os("PIOLA_IS_A_RANK").is_none() {
        return Ok(());
    }
    let library = Library::start(&[])?;
    let team = Team::new(&library);
    let material = MaterialSpec::matching("neo-Hookean", soft_moduli());
    let parts = [MaterialPart { group: None, material, density: 1000.0 }];
    let share = Share::of(&team, Portion::of_cube(&team, 4, 1.0))?;
    let first = share.elements.first().map_or(0, |&(_, tag, _)| tag as usize);
    let tag = team.all(first)[3] as u64;
    let mut portion = Portion::of_cube(&team, 4, 1.0);
    portion.elements.iter_mut().filter(|element| element[4] == tag).for_each(|element| element.swap(0, 1));
    let share = Share::of(&team, portion)?;
    match team.agree(part::body(&share, &parts)) {
        Err(Error::OnRank { rank, message }) => {
            assert!(message.contains(&format!("negative volume: {tag};")), "{message}");
            println!("rank {rank} has refused element {tag}");
        }
        other => return Err(format!("no rank has refused: {:?}", other.map(|_| ())).into()),
    }
    Ok(())
}
