//! Hostile files: for each reader of piola, a judge who takes any bytes, and mutations of good files.
//!
//! A judge feeds bytes to the reader and lets the program work with what it has read, for a step or a chart.
//! For any bytes there is no panic, no message without a word or with control characters of the file in it,
//! and nothing infinite or NaN among results. `tests/mutations.rs` calls the judges with mutated seeds, and
//! `fuzz/` with what libFuzzer thinks of.

#![expect(non_snake_case, reason = "F as in the literature")]

pub mod mutation;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use piola::Inversion;
use piola::material::Form;
use piola::point::{Filter, Matrix3, evaluate};
use piola_declare::Energy;
use piola_laboratory::chart::{self, Curve};
use piola_laboratory::curve::{Volume, sweep};
use piola_laboratory::data::{Measurements, ReadOptions};
use piola_scenes::material::MaterialSpec;
use piola_scenes::output::seal;
use piola_scenes::run::{Course, Output};
use piola_scenes::scene::{HORSE, STRETCH};
use piola_scenes::settings::{Files, Settings};
use piola_viewer::session::Session;
use piola_viewer::state::State;
use serde_json::Value;
use serde_json::value::RawValue;

/// Feeds bytes to a reader, in a folder for files; whether it has taken them.
///
/// Panics if the reader or what follows it does what it must not do.
pub type Judge = fn(&Path, &[u8]) -> bool;

/// Every kind of file that piola reads: the name of the folder with its seeds, and its judge.
pub const FORMATS: [(&str, Judge); 6] =
    [("msh", msh), ("tetgen", tetgen), ("obj", obj), ("csv", csv), ("energy", energy), ("state", state)];

/// The folder with the seeds of a format.
#[must_use]
pub fn seeds(format: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(format)
}

/// Tetrahedra of Gmsh; where they are refused, without the other elements, in a scene that is measured.
pub fn msh(scratch: &Path, bytes: &[u8]) -> bool {
    let files = Files { mesh: write(scratch, "body.msh", bytes), surface: None };
    let settings = Settings { only_tetrahedra: true, ..Settings::new(&STRETCH) };
    play(Settings::new(&HORSE), scratch, files.clone()) || play(settings, scratch, files)
}

/// Tetrahedra of TetGen: nodes, a line `# elements`, elements.
pub fn tetgen(scratch: &Path, bytes: &[u8]) -> bool {
    const BORDER: &[u8] = b"# elements\n";
    let at = bytes.windows(BORDER.len()).position(|window| window == BORDER);
    let (nodes, elements) = bytes.split_at(at.unwrap_or(bytes.len()));
    write(scratch, "body.node", nodes);
    let mesh = write(scratch, "body.ele", elements);
    play(Settings::new(&HORSE), scratch, Files { mesh, surface: None })
}

/// A surface in a cube of tetrahedra.
pub fn obj(scratch: &Path, bytes: &[u8]) -> bool {
    let surface = write(scratch, "skin.obj", bytes);
    play(Settings::new(&HORSE), scratch, Files { surface: Some(surface), ..cube() })
}

/// Measured points, with the curves of a material in a chart.
pub fn csv(_: &Path, bytes: &[u8]) -> bool {
    let (test, unit) = (Some("uniaxial".parse().expect("a test")), Some("MPa".parse().expect("a unit")));
    let options = ReadOptions { test, unit, ..ReadOptions::default() };
    let data = match Measurements::read_with(&String::from_utf8_lossy(bytes), &options) {
        Ok(reading) => {
            let note = reading.note;
            assert!(!note.is_empty() && !note.chars().any(char::is_control), "{note:?}");
            reading.measurements
        }
        Err(error) => return refused(&error),
    };
    let _ = (data.check_curves(), data.cycle(2));
    let specimen = MaterialSpec::typical("gent").and_then(|gent| gent.interpreted()).expect("a material");
    let curves: Vec<_> = data
        .modes()
        .map(|mode| {
            let controls: Vec<_> = data.of(mode).map(|point| point.control).collect();
            Curve { mode, points: sweep(&specimen, mode, Volume::Free, &controls) }
        })
        .collect();
    for response in curves.iter().flat_map(|curve| &curve.points) {
        match response {
            Ok(response) => assert!(response.stress.is_finite(), "{response:?}"),
            Err(error) => check_message(error),
        }
    }
    let agreement = data.agreement(&specimen, Volume::Free);
    let compared = agreement.as_ref().ok().map(|agreement| (&data, agreement));
    match chart::draw("gent", "typical", &curves, compared) {
        Ok(svg) => assert!(!svg.contains("NaN") && !svg.contains("\"inf"), "{svg}"),
        Err(error) => check_message(&error),
    }
    true
}

/// The text of an energy, and the material that it makes.
pub fn energy(_: &Path, bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let energy = match Energy::from_text(text) {
        Ok(energy) => energy,
        Err(mistakes) => {
            let shown = mistakes.to_string();
            let is_plain = |c: char| !c.is_control() || c == '\n';
            assert!(!shown.is_empty() && shown.chars().all(is_plain), "control characters in {shown:?}");
            return false;
        }
    };
    let curve = [0.5, -1e5, 1.0, 0.0, 2.0, 1e5];
    let values = energy.description().parameters.iter().map(|parameter| match parameter.form {
        Form::Points | Form::Function => &curve[..],
        _ => &[2.0],
    });
    let values: Vec<&[f64]> = values.collect();
    for inversion in [Inversion::Refuse, Inversion::Extend { epsilon: 0.1 }] {
        match energy.material(&values, inversion) {
            Err(error) => check_message(&error),
            Ok(material) => {
                for F in [[1.0, 1.0, 1.0], [1.2, 1.1, 0.7], [2.0, 1.0, -0.1]] {
                    let F: Matrix3<f64> = [[F[0], 0.1, 0.0], [0.0, F[1], 0.0], [0.0, 0.0, F[2]]];
                    let point = evaluate(&material, &F, Filter::None);
                    let is_finite = point.stress.as_flattened().iter().all(|entry| entry.is_finite());
                    assert!(is_finite || !point.status.is_clean(), "{point:?}");
                }
            }
        }
    }
    true
}

/// A state of the viewer, as it is or sealed anew.
pub fn state(scratch: &Path, bytes: &[u8]) -> bool {
    let Some(text) = sealed(bytes) else { return false };
    let state = match State::parse(&text, scratch) {
        Ok(state) => state.with_files(Some(cube())),
        Err(error) => return refused(&error),
    };
    let mut session = match Session::resume(state) {
        Ok(session) => session,
        Err(error) => return refused(&error),
    };
    match session.step() {
        Ok(_) => {
            let positions = session.play().simulation.positions().as_flattened();
            assert!(positions.iter().all(|x| x.is_finite()), "a step has led out of the world");
            assert!(session.play().clock.time().is_finite());
        }
        Err(error) => check_message(&error),
    }
    true
}

/// A cube of tetrahedra, which states are of.
#[must_use]
pub fn cube() -> Files {
    Files { mesh: seeds("msh").join("cube-4.1.msh"), surface: None }
}

/// The text with a checksum that belongs to it, so that more than the checksum is tested: if it is JSON its
/// content is sealed again, unless the first byte of the text is `!`.
fn sealed(bytes: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(bytes).ok()?;
    if let Some(as_it_is) = text.strip_prefix('!') {
        return Some(as_it_is.into());
    }
    let again = || {
        let line: std::collections::BTreeMap<String, &RawValue> = serde_json::from_str(text).ok()?;
        String::from_utf8(seal(line.get("content")?).ok()?).ok()
    };
    Some(again().unwrap_or_else(|| text.into()))
}

fn write(scratch: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = scratch.join(name);
    fs::write(&path, bytes).expect("a file in a scratch folder");
    path
}

/// Plays a step of a body with all files of a run.
fn play(settings: Settings, scratch: &Path, files: Files) -> bool {
    let settings = Settings { files: Some(files), frames: 1, ..settings };
    // Of an earlier run.
    let _ = fs::remove_dir_all(scratch.join("out"));
    let output = Output { folder: scratch.join("out"), vtu: true, resume: false };
    let finished = match Course::open(&settings, &output).and_then(|course| course.play(&mut |_| false)) {
        Ok(finished) => finished,
        Err(error) => return refused(&error),
    };
    let summary = serde_json::to_value(&finished.summary).expect("JSON");
    for (name, value) in summary.as_object().expect("an object") {
        // In JSON, what is not finite is null; a body at rest is not examined, and not all should recover.
        assert!(*value != Value::Null || name == "final_state" || name == "recovered", "{summary}");
    }
    let mut reading = summary["reading"].as_object().into_iter().flatten();
    assert!(reading.all(|(_, value)| value.is_f64()), "{summary}");
    let surface = finished.surface_in(1).expect("a surface");
    assert!(surface.as_flattened().iter().all(|x| x.is_finite()), "{surface:?}");
    finished.close().unwrap_or_else(|error| panic!("{error}"));
    true
}

/// Not taken, with a message that is fit to be read.
fn refused(error: &dyn Error) -> bool {
    check_message(error);
    false
}

fn check_message(error: &dyn Error) {
    let message = error.to_string();
    assert!(!message.is_empty(), "{error:?}");
    assert!(!message.chars().any(char::is_control), "control characters in {message:?}");
}
