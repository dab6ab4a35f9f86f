//! Every scene leaves a complete folder and does what it promises.

use std::fs;

use serde_json::Value;

use crate::bad_input::tetrahedron;
use crate::{Folder, assert_contains};

/// Keys of every summary; `final_state` and `recovered` may be null.
const KEYS: &str = "scene material parameters shear_modulus bulk_modulus poisson tets nodes held size \
                    volume mass gravity materials surface_vertices frames \
                    frames_wanted ended failures warnings dt newton_iterations_mean inverted_at_start min_det_f \
                    max_distance_from_rest energy ms_per_step_median steps_per_second integrator steps newton";

/// Runs a scene and returns its summary, which may have `more` keys, having seen that everything is there and
/// every number finite.
#[track_caller]
fn check(arguments: &str, scene: &str, frames: u64, more: &str) -> Value {
    let folder = Folder::new();
    let (_, told) = folder.outputs(arguments);
    // No count of steps where there is no terminal.
    assert!(
        told.is_empty() || told.contains("the body is pulled until") && told.lines().count() == 1,
        "{told}"
    );
    let out = format!("out/{scene}");
    let summary = folder.summary(&out);
    let object = summary.as_object().expect("an object");
    // A body that is not back is looked at.
    let is_held = object["warnings"].to_string().contains("the body is pulled until");
    assert_eq!(object["final_state"].is_null(), is_held || object["recovered"] == true, "{summary}");
    let keys: Vec<&str> = KEYS.split(' ').chain(more.split_whitespace()).collect();
    assert_eq!(object.len(), keys.len() + 2, "{summary}");
    for key in keys {
        // What is not finite would be null.
        assert!(object.get(key).is_some_and(|value| !value.is_null()), "`{key}` in {summary}");
    }
    assert_eq!(object["scene"], scene);
    assert_eq!((&object["frames"], &object["frames_wanted"]), (&frames.into(), &frames.into()));
    assert_eq!((&object["ended"], &object["failures"]), (&"finished".into(), &Value::Array(vec![])));
    let files = folder.content(&out);
    let picture = &files["frames.png"];
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 20_000, "{} bytes", picture.len());
    for frame in 0..=frames {
        assert!(files[&format!("frame_{frame:04}.ply")].starts_with(b"ply\n"));
    }
    // Surfaces, picture, summary and state, and nothing else.
    assert_eq!(files.len() as u64, frames + 1 + 3);
    summary
}

/// A frame is made in more steps for a smaller tolerance, and in one of two stages where any error will do.
#[test]
fn a_tolerance_chooses_the_steps_of_time() {
    let run = |tolerance: &str| {
        let run = "run dinosaur --frames 2 --integrator sdirk2 --newton full --tolerance";
        let summary = check(&format!("{run} {tolerance}"), "dinosaur", 2, "tolerance");
        assert_eq!((&summary["integrator"], &summary["newton"]), (&"sdirk2".into(), &"full".into()));
        assert_eq!(summary["steps"]["unresolved"], 0, "{summary}");
        assert!(summary["newton_iterations_mean"].as_f64().is_some_and(|mean| mean >= 2.0), "{summary}");
        summary["steps"]["taken"].as_u64().expect("a count")
    };
    assert_eq!(run("1000"), 2);
    assert!(run("0.01") > 4);
}

#[test]
fn a_steady_pull_turns_elements_inside_out() {
    let summary = check("run dinosaur-overstretched --frames 60", "dinosaur-overstretched", 60, "");
    assert!(summary["min_det_f"].as_f64().is_some_and(|det| det < -0.1), "{summary}");
}

/// Runs a scene on a mesh in a folder; returns its output, with its warnings, and its summary.
#[track_caller]
fn run_on(folder: &Folder, mesh: &str, scene: &str, options: &str) -> (String, Value) {
    folder.write("body.msh", mesh);
    // Of an earlier run.
    let _ = fs::remove_dir_all(folder.path("out"));
    let (said, warned) =
        folder.outputs(&format!("run {scene} --mesh body.msh --frames 2 --out out {options}"));
    (said + &warned, folder.summary("out"))
}

/// Sizes, volumes and numbers of nodes are by numpy; the last block is of steel, with its density in t/mm³.
#[test]
fn what_will_be_run_is_printed_before_it_runs() {
    let folder = Folder::new();
    folder.write("block.msh", BLOCK);
    let block = "scramble --amplitude 0 --gravity 9.81 --pin :,:0,: --mesh block.msh --density";
    let size = "scramble: 96 tetrahedra, 45 nodes, 15 of them held\n  0.02 m along x, 0.02 m along y, 0.04 m along z; \
                1.6e-5 m³";
    let horse = "horse: 2646 tetrahedra, 787 nodes, 22 of them held\n  2.5123 m along x, 1.9211 m along y, 0.88668 m \
                 along z; 0.71164 m³, 711.64 kg\n  gravity 0 m/s² along y, which points upwards\n  rotated_linear ";
    let dinosaur = "dinosaur: 1031 tetrahedra, 347 nodes, 10 of them held\n  3.3466 m along x, 2.0772 m along y, 1.154 m \
                    along z; 1.0563 m³, 1056.3 kg\n";
    for (run, expected, is_odd) in [
        ("horse", horse, false),
        ("dinosaur", dinosaur, false),
        (&format!("{block} 1000")[..], &format!("{size}, 0.016 kg\n  gravity -9.81 m/s² along y")[..], false),
        (&format!("{block} 7.85e-9")[..], &format!("{size}, 1.256e-13 kg")[..], true),
    ] {
        let (said, warned) = folder.outputs(&format!("run {run} --frames 1"));
        assert!(said.starts_with(expected), "{said}");
        assert_eq!(warned.contains("kg/m³; is that meant?"), is_odd, "{warned}");
    }
    assert_contains(&folder.answer("run --help"), &["y points upwards", "along -y"]);
}

/// The deflection is by linear elasticity on this mesh, in numpy; strains are about a per cent at most.
#[test]
fn groups_of_a_mesh_have_materials_of_their_own() {
    let folder = Folder::new();
    let run = |options: &str| {
        let options = format!("--amplitude 0 --gravity 9.81 {options}");
        run_on(&folder, BLOCK, "scramble", &options)
    };
    let words = ["groups of the mesh: `soft`, `stiff`", "no node is held, and the body falls"];
    assert_contains(&run("").0, &words);
    let (said, summary) = run("--pin soft --pin stiff");
    assert_contains(&said, &["all 45 nodes are held, and nothing can move"]);
    assert!(summary["recovered"].is_null() && !said.contains("recovered"), "{said}");
    // Its boundary, without three nodes inside.
    assert!(summary["surface_vertices"] == 42 && summary["max_distance_from_rest"] == 0.0, "{summary}");
    let parts = "--part soft=rotated_linear;mu=3e5;lambda=6e5 --part stiff=rotated_linear;mu=3e6;lambda=6e6";
    let (said, summary) = run(&format!("--pin :,:,:0 {parts};density=3000"));
    assert_contains(&said, &["groups of the mesh: `soft`;", "groups of the mesh: `stiff`;"]);
    let end = &summary["final_state"]["max_distance_from_rest"];
    for (found, expected) in [(&summary["mass"], 0.032), (end, 0.0095159)] {
        let error = found.as_f64().expect("a number") / expected - 1.0;
        assert!(error.abs() < 0.01, "{error}: {summary}");
    }
    // Energy densities 3μ + 9λ/2 of a point, of three tetrahedra in each group.
    folder.answer(&format!("run point --mesh body.msh --frames 1 --vtu {parts}"));
    let energies = ["AAAAAEB3S0EAAAAAQHdLQQAAAABAd0tB", "AAAAAIgqgUEAAAAAiCqBQQAAAACIKoFB"];
    let file = |name: &str| folder.read(&format!("out/point/{name}"));
    assert_contains(&file("frame_0000.vtu"), &energies);
    for field in ["displacement", "velocity", "det F", "stretches", "energy density"] {
        assert_contains(&file("frame_0001.vtu"), &[&format!("Name=\"{field}\"")]);
    }
    assert_contains(&file("frames.pvd"), &["file=\"frame_0000.vtu\"", "file=\"frame_0001.vtu\""]);
    let message = folder.refusal("run horse --mesh body.msh --part hard=rotated_linear");
    assert_contains(&message, &["no group `hard`", "soft, stiff"]);
}

#[test]
fn elements_that_are_left_out_are_in_the_warnings() {
    let mesh = BLOCK.replace("$Elements\n96\n", "$Elements\n97\n97 6 0 1 2 3 10 11 12\n");
    let (said, summary) = run_on(&Folder::new(), &mesh, "horse", "--only-tetrahedra");
    let warning = "only linear tetrahedra are read; left out of the body, which lacks their volume: 1 prism";
    assert!(said.contains(&format!("warning: {warning}")), "{said}");
    assert_eq!((&summary["tets"], &summary["warnings"][0]), (&96.into(), &warning.into()));
}

/// A block with nodes at one height between the marks.
#[test]
fn a_reading_that_finds_no_nodes_says_so() {
    let (said, summary) = run_on(&Folder::new(), BLOCK, "stretch", "");
    let missing = "no stretch was measured: between the marks, nodes lie at fewer than two heights";
    assert_eq!(said.matches(missing).count(), 2, "in the text and as a warning: {said}");
    assert!(!said.contains("NaN"), "{said}");
    assert!(summary["warnings"][0].as_str().is_some_and(|text| text.starts_with(missing)), "{summary}");
    let reading = summary["reading"].as_object().expect("a reading");
    assert!(reading.len() == 1 && reading["nominal_stress"].is_f64(), "{summary}");
}

/// A block of 2 × 2 × 4 cm in two groups, lower and upper by z.
const BLOCK: &str = include_str!("twomaterials.msh");

#[test]
fn a_mesh_in_millimetres_is_the_body_in_metres() {
    let folder = Folder::new();
    let surface = |mesh: &str, options: &str| {
        let (said, _) = run_on(&folder, mesh, "horse", options);
        (said, fs::read(folder.path("out/frame_0002.ply")).expect("a surface"))
    };
    let (said, metres) = surface(BLOCK, "");
    assert!(!said.contains("warning"), "{said}");
    // Coordinates are 0.01 to 0.04.
    let in_mm = (1..5).fold(BLOCK.to_owned(), |text, k| text.replace(&format!("0.0{k}"), &format!("{k}0")));
    for (mesh, unit) in [(&in_mm, "mm"), (&BLOCK.replace("0.0", ""), "cm")] {
        let (said, other) = surface(mesh, &format!("--unit {unit}"));
        assert!(!said.contains("warning") && other == metres, "{unit}: {said}");
        assert_contains(&said, &["0.02 m along x, 0.02 m along y, 0.04 m along z; 1.6e-5 m³, 0.016 kg\n"]);
    }
    let (said, _) = surface(&in_mm, "");
    assert_contains(&said, &["  20 m along x, 20 m along y, 40 m along z; "]);
    assert!(said.contains("warning: the body is 40 m long") && said.contains("--unit mm"), "{said}");
    let (said, _) = surface(&BLOCK.replace("0.0", "0.0000"), "");
    assert!(said.contains("warning: the body is 0.00004 m long"), "{said}");
}

#[test]
fn a_reversed_tetrahedron_and_a_pull_that_finds_no_node_are_told() {
    // The head of a dinosaur is above and in front, where this corner is not.
    let run = |nodes| run_on(&Folder::new(), &tetrahedron(nodes), "dinosaur", "--gravity 9.81");
    let ((_, right), (said, turned)) = (run([1, 2, 3, 4]), run([1, 3, 2, 4]));
    assert!(said.contains("warning: no node of the body lies where the scene pulls"), "{said}");
    assert!(said.contains("\nnote: 1 tetrahedra of the file have"), "{said}");
    assert_eq!(right["energy"], turned["energy"]);
    assert!(right["energy"].as_f64() > Some(0.0), "{right}");
}

#[test]
fn horse_stands_up_again() {
    let summary = check("run horse", "horse", 150, "");
    assert_eq!((&summary["tets"], &summary["nodes"]), (&2646.into(), &787.into()));
    assert_eq!(summary["newton_iterations_mean"], 1.0);
    assert_eq!((&summary["integrator"], &summary["newton"]), (&"implicit_euler".into(), &"single".into()));
    assert!(summary["min_det_f"].as_f64().is_some_and(|det| det < 1e-12), "flattened: {summary}");
    assert_eq!(summary["recovered"], true, "{summary}");
}

#[test]
fn dinosaur_comes_back_after_it_is_let_go() {
    // Released at 2 s, which is frame 60.
    let summary = check("run dinosaur", "dinosaur", 360, "");
    assert_eq!(summary["recovered"], true, "{summary}");
}

#[test]
fn a_twisted_bar_unwinds() {
    let summary = check("run twist", "twist", 300, "");
    assert_eq!(summary["recovered"], true, "{summary}");
    // Wound up for two seconds, which the summary of an earlier frame shows.
    let wound = check("run twist --frames 60", "twist", 60, "");
    assert!(wound["max_distance_from_rest"].as_f64().is_some_and(|distance| distance > 0.1), "{wound}");
}

#[test]
fn rubber_is_stretched_as_its_energy_says() {
    let summary = check("run stretch", "stretch", 240, "reading");
    let read = |name: &str| summary["reading"][name].as_f64().expect("a number");
    assert!((6.5..8.0).contains(&read("stretch")), "{summary}");
    // The bar is not quite uniform between its marks: half a per cent at rest. It is still a little in
    // motion, too.
    let error = read("nominal_stress") / read("uniaxial_stress") - 1.0;
    assert!(error.abs() < 0.01, "{error}: {summary}");
}

#[test]
fn a_scrambled_body_finds_its_shape() {
    let summary = check("run scramble --body dinosaur --seed 3 --amplitude 0.5", "scramble", 300, "");
    assert_eq!(summary["tets"], 1031);
    assert!(summary["inverted_at_start"].as_u64().is_some_and(|count| count > 10), "{summary}");
    assert_eq!(summary["recovered"], true, "{summary}");
}

#[test]
fn a_point_without_forces_is_called_a_saddle() {
    // Not by `check`: pictures of a point are smaller than it expects.
    let folder = Folder::new();
    folder.answer("run point --material st_venant_kirchhoff --body dinosaur --frames 1");
    let summary = folder.summary("out/point");
    let end = &summary["final_state"];
    assert_eq!((&end["place"], &end["stress_free"]), (&"saddle".into(), &true.into()), "{summary}");
    // It is still a point.
    assert!(end["smallest_sum"].as_f64().is_some_and(|sum| sum < 1e-12), "{summary}");
}

#[test]
fn another_material_is_as_stiff_as_that_of_the_scene() {
    let summary = check("run horse --material st_venant_kirchhoff --frames 1", "horse", 1, "");
    let value = |name: &str| summary["parameters"][name][0].as_f64().expect("a number");
    // E = 1 MPa and ν = 0.45; a dozen roundings.
    assert!((value("mu") * 2.9 / 1e6 - 1.0).abs() < 1e-14, "{summary}");
    assert!((value("lambda") * 1.45 * 0.1 / 0.45e6 - 1.0).abs() < 1e-14, "{summary}");
    for (scene, material) in [("horse", "blatz_ko"), ("twist", "ogden")] {
        let summary = check(&format!("run {scene} --material {material} --frames 1"), scene, 1, "");
        let value = |name: &str| summary[name].as_f64().expect("a number");
        let errors = [value("shear_modulus") * 2.9 / 1e6 - 1.0, value("poisson") - 0.45];
        assert!(errors.iter().all(|error| error.abs() < 1e-14), "{errors:?}");
    }
    assert_contains(&Folder::new().refusal("run horse --material arap"), &["arap: E = 1.0", "and ν = 0;"]);
}

#[test]
fn materials_are_described() {
    let text = Folder::new().answer("materials");
    assert_contains(&text, &["ψ = ", "domain", "typical", "small strain", "Ogden", "mu", "Pa"]);
}
