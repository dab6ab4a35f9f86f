//! Mutated files of each format: no panic, no hang, no result that is not finite.
//!
//! 300 files of each format, or as many as the environment variable `PIOLA_MUTATIONS` gives. `PIOLA_BLESS=1`
//! writes the seed of the viewer's states anew, after their format has changed.

use std::any::Any;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use piola::__private::random::Random;
use piola_hostile::mutation::mutated;
use piola_hostile::{FORMATS, cube, seeds};
use piola_scenes::scene::HORSE;
use piola_scenes::settings::Settings;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;

/// Longer than any small file may take, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(2);

fn count() -> usize {
    std::env::var("PIOLA_MUTATIONS").map_or(300, |text| text.parse().expect("a number"))
}

#[track_caller]
fn check(name: &str) {
    let (_, judge) = FORMATS.iter().find(|(format, _)| *format == name).expect("a format");
    let mut files: Vec<_> =
        fs::read_dir(seeds(name)).expect("seeds").map(|file| file.expect("a file").path()).collect();
    files.sort();
    let files: Vec<_> = files.iter().map(|path| fs::read(path).expect("a seed")).collect();
    let scratch = tempfile::tempdir().expect("a scratch folder");
    for seed in &files {
        assert!(judge(scratch.path(), seed), "a seed of {name} is refused");
    }
    let mut random = Random::new(1);
    let mut taken = 0;
    for number in 0..count() {
        let bytes = mutated(&files[number % files.len()], &mut random);
        let begun = Instant::now();
        let verdict = catch_unwind(AssertUnwindSafe(|| judge(scratch.path(), &bytes)));
        let text = String::from_utf8_lossy(&bytes);
        match verdict {
            Ok(is_taken) => taken += usize::from(is_taken),
            Err(panic) => panic!("{name} {number}: {}\n{text}", message(&*panic)),
        }
        assert!(begun.elapsed() < PATIENCE, "{name} {number} takes {:?}\n{text}", begun.elapsed());
    }
    assert!(taken > 0 && taken < count(), "mutations of {name} are all alike: {taken} of {}", count());
}

fn message(panic: &dyn Any) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without a text")
}

macro_rules! formats {
    ($($name:ident),+) => {$(
        #[test]
        fn $name() {
            check(stringify!($name));
        }
    )+};
}

formats!(msh, tetgen, obj, csv, energy, state);

/// Seed of the viewer's states, which have checksums: a cube that is pulled, let go, and changed.
#[test]
fn seed_of_the_viewer() {
    if std::env::var_os("PIOLA_BLESS").is_none() {
        return;
    }
    let mut session =
        Session::new(Settings { files: Some(cube()), ..Settings::new(&HORSE) }).expect("a session");
    for act in [
        Act::Pull { drag: 1, vertex: 3, target: [1.0, 1.5, -0.25] },
        Act::Material { name: "gent".into(), as_stiff: true },
        Act::Parameter { name: "jm".into(), values: vec![50.0] },
        Act::TimeStep { seconds: 0.02 },
        Act::Save {},
        Act::Release { drag: 1 },
    ] {
        session.apply(&act).expect("an act");
        session.step().expect("a step");
    }
    session.state().write(&seeds("state").join("cube.json")).expect("a state");
}
