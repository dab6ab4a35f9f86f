//! Materials on the bench: `piola curve` and `piola fit`.

use std::fs;
use std::path::Path;
use std::process::Command;

#[track_caller]
fn piola(folder: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    let output = command.current_dir(folder).args(arguments).output().expect("the command starts");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

const OGDENS: [&str; 4] = ["--param", "mu=0.63e6,0.0012e6,-0.01e6", "--param", "alpha=1.3,5,-2"];

#[test]
fn treloars_rubber_by_ogdens_parameters() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mut arguments = vec!["curve", "ogden", "--incompressible", "--data", "treloar", "--svg", "ogden.svg"];
    arguments.extend(OGDENS);
    let text = piola(folder.path(), &arguments);
    for word in
        ["uniaxial 0.97591", "equibiaxial 0.99761", "pure_shear 0.99759", "all 0.98288", "measured/Pa"]
    {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
    let svg = fs::read_to_string(folder.path().join("ogden.svg")).expect("a chart");
    for word in ["R² = 0.97591", "stretch λ", "nominal stress (MPa)", "ogden, incompressible"] {
        assert!(svg.contains(word), "`{word}` is not in the chart");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing else is left");
}

#[test]
fn curves_say_where_they_end() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let arguments =
        ["curve", "gent", "--param", "jm=5", "--to", "4", "--mode", "uniaxial,simple_shear,volumetric"];
    let text = piola(folder.path(), &arguments);
    assert!(text.contains("no lateral stretch makes the sides free"), "{text}");
    assert!(text.contains("P12/Pa") && text.contains("mean stress/Pa"), "{text}");
    assert!(text.contains("--param mu=330000 --param jm=5 --param kappa=2e7"), "{text}");
}

#[test]
fn fitted_parameters_can_be_pasted() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text =
        piola(folder.path(), &["fit", "yeoh", "--data", "treloar", "--svg", "yeoh.svg", "--starts", "3"]);
    // What the catalogue's typical parameters are rounded from.
    assert!(text.contains("--param c1=185") && text.contains("kappa=2e7"), "{text}");
    assert!(text.contains("held: the data do not determine it"), "{text}");
    assert!(folder.path().join("yeoh.svg").exists());
    let agreement = |text: &str| {
        let (_, after) = text.split_once("uniaxial 0.").expect("R²");
        after.lines().next().map(str::to_owned)
    };
    let options = text.lines().find(|line| line.trim().starts_with("--param")).expect("options");
    let mut arguments = vec!["curve", "yeoh", "--incompressible", "--data", "treloar"];
    arguments.extend(options.split_whitespace());
    assert_eq!(agreement(&piola(folder.path(), &arguments)), agreement(&text));
}

#[test]
fn data_of_ones_own_are_fitted_as_they_ask_for() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    // ∂ψ/∂J = κ (J − 1): with a volumetric test the volume is free.
    let text = "# by hand\nmode,stretch,nominal_stress_kPa\nvolumetric,0.9,-200\nvolumetric,1.1,200\nvolumetric,1.05,100\n";
    fs::write(folder.path().join("bulk.csv"), text).expect("a scratch file");
    let text = piola(folder.path(), &["fit", "yeoh", "--data", "bulk.csv", "--hold", "c2"]);
    assert!(text.contains("kappa=2000000\n") && text.contains(" held\n"), "{text}");
    assert!(text.contains("held: the data do not determine it"), "{text}");
    // The same file under the curve that goes through it.
    let text = piola(folder.path(), &["curve", "yeoh", "--data", "bulk.csv", "--param", "kappa=2000000"]);
    assert!(text.contains("volumetric 1.00000"), "{text}");
}

/// The numbers of a published file in the shapes in which people have it.
#[test]
fn data_say_what_they_are_or_are_told_by_options() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let at = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("../laboratory/tests/data").join(name);
    let whole = fs::read_to_string(at("gent.csv")).expect("a file of the laboratory's tests");
    let bare = fs::read_to_string(at("gent_raw.csv")).expect("a file of the laboratory's tests");
    let headless = bare.lines().skip(1).map(|line| line.replace(',', ";").replace('.', ",") + "\r\n");
    fs::write(folder.path().join("whole.csv"), whole).expect("a scratch file");
    fs::write(folder.path().join("bare.csv"), bare.clone()).expect("a scratch file");
    fs::write(folder.path().join("headless.csv"), headless.collect::<String>()).expect("a scratch file");
    let fit = |data: &[&str]| {
        let text = piola(folder.path(), &[&["fit", "gent", "--starts", "0", "--data"], data].concat());
        let line =
            |word: &str| text.lines().find(|line| line.trim().starts_with(word)).expect("a line").to_owned();
        (line("read"), line("--param"), line("R²"))
    };
    let (read, options, agreement) = fit(&["whole.csv"]);
    let expected = "whole.csv: `stretch` as stretch, `nominal_stress_MPa` as nominal stress in MPa; 25 points of uniaxial, \
                    λ from 1 to 7.61";
    assert!(read.ends_with(expected), "{read}");
    for (file, columns, said) in [
        ("bare.csv", &[][..], "`stress` as nominal stress in MPa"),
        ("headless.csv", &["--strain", "1=stretch", "--stress", "2"], "decimal commas"),
    ] {
        let (read, again, agreement_again) =
            fit(&[&[file, "--mode", "UT", "--unit", "MPa"], columns].concat());
        assert!(read.contains(said), "{read}");
        assert_eq!((again, agreement_again), (options.clone(), agreement.clone()), "{file}");
    }
}

#[test]
fn files_of_several_tests_are_read_together() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    fs::write(folder.path().join("ut.csv"), "Strain [%],Stress [MPa]\n50,0.4\n100,0.6\n").expect("a file");
    fs::write(folder.path().join("ps.txt"), "stretch stress\n1.5 450\n2 700\n").expect("a file");
    let files =
        ["--data", "ut.csv", "--mode", "uniaxial", "--data", "ps.txt", "--mode", "planar", "--unit", "kPa"];
    let text = piola(folder.path(), &[&["curve", "yeoh", "--incompressible"], &files[..]].concat());
    for word in
        ["2 points of uniaxial", "2 points of pure_shear", "\nuniaxial\n", "\npure_shear\n", "7.00000e5"]
    {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
    // Of a file that names its tests, those that are asked for.
    let text = piola(folder.path(), &["fit", "yeoh", "--data", "treloar", "--mode", "EB", "--starts", "0"]);
    assert!(text.contains("17 of 56 points used, by --mode") && !text.contains("pure_shear 0."), "{text}");
    // Together with a file that names none.
    let files = ["--data", "treloar", "--data", "ut.csv", "--mode", "uniaxial"];
    let text = piola(folder.path(), &[&["curve", "yeoh", "--incompressible"], &files[..]].concat());
    for word in ["25 of 56 points used, by --mode", "2 points of uniaxial", "6.00000e5"] {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
}

#[test]
fn a_single_point_is_a_table() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text = piola(
        folder.path(),
        &[
            "curve",
            "neo_hookean",
            "--incompressible",
            "--param",
            "mu=1MPa",
            "--at",
            "2",
            "--mode",
            "uniaxial",
        ],
    );
    // P = μ (λ − 1/λ²)
    assert_eq!(
        text.lines().last().map(|row| row.split_whitespace().nth(1)),
        Some(Some("1.75000e6")),
        "{text}"
    );
    let text = piola(folder.path(), &["curve", "gent", "--at", "1.1,1.2", "--mode", "uniaxial"]);
    assert_eq!(text.lines().filter(|row| row.trim().starts_with("1.")).count(), 2, "{text}");
    let text = piola(folder.path(), &["curve", "gent", "--at", "1.00001,1.00002", "--mode", "uniaxial"]);
    assert!(text.contains("\n   1.00001 ") && text.contains("\n   1.00002 "), "{text}");
}

#[test]
fn a_test_with_points_at_rest_alone_has_the_curve_of_one_without() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text = "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.6\nplanar,1,0\n";
    fs::write(folder.path().join("rest.csv"), text).expect("a scratch file");
    let text = piola(folder.path(), &["curve", "gent", "--data", "rest.csv", "--mode", "uniaxial,planar"]);
    let (_, sheet) = text.split_once("\npure_shear\n").expect("a table");
    assert!(sheet.contains("\n    0.5000 ") && sheet.contains("\n    3.0000 "), "{text}");
}

#[test]
fn poissons_ratio_is_said_and_an_odd_one_warned_of() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mixed = ["--param", "mu=0.4MPa", "--param", "kappa=1e5"];
    let warning = "warning: Poisson's ratio of the material is -0.3571: it grows thicker when it is pulled";
    for command in [
        &["curve", "isochoric_neo_hookean", "--at", "1"][..],
        &["curve", "isochoric_neo_hookean", "--at", "1", "--incompressible"],
        &["contract", "isochoric_neo_hookean"],
        &["check", "isochoric_neo_hookean", "--resolution", "3"],
    ] {
        let text = piola(folder.path(), &[command, &mixed[..]].concat());
        assert!(text.contains(warning), "{command:?}: {text}");
        let text = piola(folder.path(), command);
        assert!(text.contains("ν = 0.49") && !text.contains("warning: Poisson"), "{command:?}: {text}");
    }
    let text = piola(folder.path(), &["fit", "yeoh", "--data", "treloar", "--starts", "0"]);
    assert!(text.contains("ν = 0.49") && text.contains("the volume is kept"), "{text}");
    let run = ["run", "stretch", "--frames", "1", "--material", "isochoric_neo_hookean", "--out", "run"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    let output =
        command.current_dir(folder.path()).args(run).args(mixed).output().expect("the command starts");
    let (said, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(
        said.contains("\n  at rest  μ = 400 kPa, K = 100 kPa, ν = -0.3571\n") && errors.contains(warning),
        "{said}{errors}"
    );
    let summary = fs::read_to_string(folder.path().join("run/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    for (key, value) in [("shear_modulus", 4e5), ("bulk_modulus", 1e5), ("poisson", -5.0 / 14.0)] {
        let found = summary[key].as_f64().expect(key);
        assert!((found / value - 1.0).abs() < 1e-12, "{key} is {found}");
    }
}

/// D1 of Abaqus and CalculiX: K = 2/D1.
#[test]
fn compressibilities_have_units() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let energy = "C10*(I1b - 3) + (J - 1)^2/D1";
    let curve = ["curve", "--at", "1", "--energy", energy, "--param", "C10=0.2MPa", "--param", "D1=0.1/MPa"];
    assert!(piola(folder.path(), &curve).contains("μ = 400 kPa, K = 20 MPa, ν = 0.4901"));
}

#[test]
fn a_foam_is_not_fitted_as_rubber_unsaid() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mut arguments = vec!["fit", "storakers", "--data", "treloar", "--starts", "0"];
    let text = piola(folder.path(), &arguments);
    assert!(
        text.contains("Poisson's ratio at small strain is 0.25; to fit the solid that will move"),
        "{text}"
    );
    assert!(text.contains("(`--compressible`,"), "{text}");
    arguments.push("--compressible");
    let text = piola(folder.path(), &arguments);
    assert!(!text.contains("the volume was kept"), "{text}");
}

#[test]
fn rubbers_are_ranked_and_those_without_a_fit_named() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let text = "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.6\nuniaxial,4,1.2\nuniaxial,6,2.5\n\
                equibiaxial,2,0.8\nequibiaxial,3,1.2\n";
    fs::write(folder.path().join("few.csv"), text).expect("a scratch file");
    let text = piola(folder.path(), &["curve", "all", "--data", "few.csv", "--svg", "few.svg"]);
    let (_, table) = text.split_once("stability\n").expect("a table");
    let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split_whitespace().collect()).collect();
    let (failed, ranked): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row.get(1) == Some(&"not"));
    let refused = failed.iter().find(|row| row[0] == "ogden").expect("6 parameters, 5 points");
    assert!(refused.join(" ").contains("5 points cannot determine 6 parameters"), "{text}");
    assert_eq!(rows.len(), piola_materials::DECLARATIONS.iter().filter(|rubber| rubber.is_rubber).count());

    let number = |row: &[&str], column: usize| row[column].parse::<f64>().expect("a number");
    assert!(
        ranked.len() > 20 && ranked.is_sorted_by(|one, other| number(one, 2) >= number(other, 2)),
        "{text}"
    );
    for row in &ranked {
        // Both are rounded to five digits.
        let share = number(row, 2) / number(row, 1);
        assert!((number(row, 5) - share).abs() < 1e-5, "{row:?}");
    }
    let svg = fs::read_to_string(folder.path().join("few.svg")).expect("a chart");
    for word in ["gent_thomas", "equibiaxial", "R²/n", "stability", "kept"] {
        assert!(svg.contains(word), "`{word}` is not in the chart");
    }
}
