//! Materials on the bench: `piola curve`, `piola fit` and `piola check`.

use std::fs;
use std::path::Path;

use crate::{Folder, assert_contains};

#[test]
fn treloars_rubber_by_ogdens_parameters() {
    let folder = Folder::new();
    let ogdens = "--param mu=0.63e6,0.0012e6,-0.01e6 --param alpha=1.3,5,-2";
    let text =
        folder.answer(&format!("curve ogden --incompressible --data treloar --svg ogden.svg {ogdens}"));
    let agreement = ["uniaxial 0.97591", "equibiaxial 0.99761", "pure_shear 0.99759", "all 0.98288"];
    assert_contains(&text, &agreement);
    assert_contains(&text, &["measured/Pa"]);
    let words = ["R² = 0.97591", "stretch λ", "nominal stress (MPa)", "ogden, incompressible"];
    assert_contains(&folder.read("ogden.svg"), &words);
    assert_eq!(folder.content("").len(), 1, "nothing else is left");
}

#[test]
fn curves_say_where_they_end() {
    let curve = "curve gent --param jm=5 --to 4 --mode uniaxial,simple_shear,volumetric";
    let text = Folder::new().answer(curve);
    assert_contains(&text, &["no lateral stretch makes the sides free", "P12/Pa", "mean stress/Pa"]);
    assert_contains(&text, &["--param mu=330000 --param jm=5 --param kappa=2e7"]);
}

#[test]
fn fitted_parameters_can_be_pasted() {
    let folder = Folder::new();
    let text = folder.answer("fit yeoh --data treloar --svg yeoh.svg --starts 3");
    // What the catalogue's typical parameters are rounded from.
    assert_contains(&text, &["--param c1=185", "kappa=2e7", "held: the data do not determine it"]);
    assert!(folder.path("yeoh.svg").exists());
    let agreement = |text: &str| {
        let (_, after) = text.split_once("uniaxial 0.").expect("R²");
        after.lines().next().map(str::to_owned)
    };
    let options = text.lines().find(|line| line.trim().starts_with("--param")).expect("options");
    let again = folder.answer(&format!("curve yeoh --incompressible --data treloar {options}"));
    assert_eq!(agreement(&again), agreement(&text));
}

#[test]
fn data_of_ones_own_are_fitted_as_they_ask_for() {
    let folder = Folder::new();
    // ∂ψ/∂J = κ (J − 1): with a volumetric test the volume is free.
    let text = "# by hand\nmode,stretch,nominal_stress_kPa\nvolumetric,0.9,-200\nvolumetric,1.1,200\nvolumetric,1.05,100\n";
    folder.write("bulk.csv", text);
    let text = folder.answer("fit yeoh --data bulk.csv --hold c2");
    assert_contains(&text, &["kappa=2000000\n", " held\n", "held: the data do not determine it"]);
    // The same file under the curve that goes through it.
    let text = folder.answer("curve yeoh --data bulk.csv --param kappa=2000000");
    assert_contains(&text, &["volumetric 1.00000"]);
}

/// The text of a file of the laboratory's tests, which is copied to the folder.
fn of_the_laboratory(folder: &Folder, name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../laboratory/tests/data").join(name);
    let text = fs::read_to_string(path).expect(name);
    folder.write(name, &text);
    text
}

/// Parameters and scatter by numpy: of a published file in the shapes in which people have it; of a first and
/// a second loading; of noise near rest; of a table in kgf/cm²; of a foam with μ = 12 kPa, α = 6, β → 0.
#[test]
fn readings_are_weighted_and_chosen_as_asked() {
    let folder = Folder::new();
    let files = ["gent_raw.csv", "kgf.txt", "foam.inp", "cycles.csv", "noise.csv", "gent.csv"];
    let [bare, kgf, deck, ..] = files.map(|name| of_the_laboratory(&folder, name));
    let headless = bare.lines().skip(1).map(|line| line.replace(',', ";").replace('.', ",") + "\r\n");
    folder.write("headless.csv", headless.collect::<String>());
    folder.write("square.txt", format!("stretch\tnominal stress [kgf/cm^2]\n{kgf}"));
    folder.write("round.txt", format!("stretch\tnominal stress (kgf/cm2)\n{kgf}"));
    let (_, rows) = deck.split_once("*Uniaxial Test Data\n").expect("a block");
    folder.write("foam.csv", format!("stress [MPa],strain,lateral strain\n{rows}"));
    folder.write("stretch.csv", "strain,stress [kPa]\n1,0\n1.5,200\n2,350\n");
    folder.write("book.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0");
    let fit = |material: &str, data: &str| format!("fit {material} --mode uniaxial --data {data}");
    for (data, words) in [
        ("cycles.csv", "cycles.csv: uniaxial turns 3 times, and scatters by 10 %"),
        ("cycles.csv --cycle 3", "there is no cycle 3 of uniaxial; they are counted from 1 to 2"),
        ("cycles.csv --cycle 0", "there is no cycle 0"),
        ("square.txt --data noise.csv", "square.txt, noise.csv: uniaxial turns 2 times"),
        ("foam.inp", "foam.inp:8: this is an input deck"),
        ("stretch.csv", "stretch.csv: uniaxial begins with 0 Pa at λ = 2, far from rest"),
        ("book.xls", "book.xls:1: this is UTF-16, or not text but an archive, as spreadsheets are"),
    ] {
        assert_contains(&folder.refusal(&fit("neo_hookean", data)), &[words]);
    }
    for (data, found) in [
        ("gent.csv", ["λ from 1 to 7.61, stress from 0 Pa to 6.3 MPa, reversals: 0", "mu=382201.5 "]),
        ("gent_raw.csv --unit MPa", ["`stress` as nominal stress in MPa", "mu=382201.5 "]),
        ("headless.csv --unit MPa --strain 1=stretch --stress 2", ["decimal commas", "mu=382201.5 "]),
        ("cycles.csv --cycle first", ["21 of 80 points used", "mu=100000 "]),
        ("cycles.csv --cycle 2", ["stress from 0 Pa to 175 kPa, reversals: 3", "mu=85000"]),
        ("noise.csv", ["with 56 % of the sum of squares: uniaxial 1.0166, uniaxial 1.0025;", "mu=25406.08"]),
        ("noise.csv --floor 0.05", ["by relative differences, floor 0.05", "mu=29852.79"]),
        ("noise.csv --absolute", ["by absolute differences", "mu=29970.64"]),
        ("kgf.txt --strain 1=stretch --stress 2 --unit kgf/cm2", ["in kgf/cm2", "mu=400000 "]),
        ("square.txt", ["in kgf/cm2", "mu=400000 "]),
        ("round.txt", ["in kgf/cm2", "mu=400000 "]),
    ] {
        assert_contains(&folder.answer(&fit("neo_hookean --starts 0", data)), &found);
    }
    let foam = folder.answer(&fit("storakers --compressible --param beta=1e-6 --hold beta", "foam.csv"));
    assert_contains(&foam, &["left out: lateral strain", "mu=1199", "alpha=5.99"]);
}

#[test]
fn files_of_several_tests_are_read_together() {
    let folder = Folder::new();
    folder.write("ut.csv", "Strain [%],Stress [MPa]\n50,0.4\n100,0.6\n");
    folder.write("ps.txt", "stretch stress\n1.5 450\n2 700\n");
    let curve = |data: &str| folder.answer(&format!("curve yeoh --incompressible {data}"));
    let text = curve("--data ut.csv --mode uniaxial --data ps.txt --mode planar --unit kPa");
    assert_contains(&text, &["2 points of uniaxial", "2 points of pure_shear", "7.00000e5"]);
    assert_contains(&text, &["\nuniaxial\n", "\npure_shear\n"]);
    // Of a file that names its tests, those that are asked for.
    let text = folder.answer("fit yeoh --data treloar --mode EB --starts 0");
    assert!(text.contains("17 of 56 points used, by --mode") && !text.contains("pure_shear 0."), "{text}");
    // Together with a file that names none.
    let text = curve("--data treloar --data ut.csv --mode uniaxial");
    assert_contains(&text, &["25 of 56 points used, by --mode", "2 points of uniaxial", "6.00000e5"]);
}

#[test]
fn single_points_are_a_table() {
    let folder = Folder::new();
    // P = μ (λ − 1/λ²)
    let text = folder.answer("curve neo_hookean --incompressible --param mu=1MPa --mode uniaxial --at 2");
    let stress = text.lines().last().and_then(|row| row.split_whitespace().nth(1));
    assert_eq!(stress, Some("1.75000e6"), "{text}");
    // A foam whose Poisson's ratio is 0: P = 2μ/α (λ^(α − 1) − 1/λ)
    let foam = "--param mu=12kPa --param alpha=6 --param beta=0";
    let text = folder.answer(&format!("curve storakers {foam} --mode uniaxial --at 0.7"));
    assert_contains(&text, &["ν = 0\n", "-5.04201e3"]);
    let text = folder.answer("curve gent --mode uniaxial --at 1.1,1.2");
    assert_eq!(text.lines().filter(|row| row.trim().starts_with("1.")).count(), 2, "{text}");
    let text = folder.answer("curve gent --mode uniaxial --at 1.00001,1.00002");
    assert_contains(&text, &["\n   1.00001 ", "\n   1.00002 "]);
}

#[test]
fn a_test_with_points_at_rest_alone_has_the_curve_of_one_without() {
    let folder = Folder::new();
    folder.write("rest.csv", "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.6\nplanar,1,0\n");
    let text = folder.answer("curve gent --data rest.csv --mode uniaxial,planar");
    let (_, sheet) = text.split_once("\npure_shear\n").expect("a table");
    assert_contains(sheet, &["\n    0.5000 ", "\n    3.0000 "]);
}

#[test]
fn poissons_ratio_is_said_and_an_odd_one_warned_of() {
    let folder = Folder::new();
    let mixed = "--param mu=0.4MPa --param kappa=1e5";
    let warning = "warning: Poisson's ratio of the material is -0.3571: it grows thicker when it is pulled";
    for command in [
        "curve isochoric_neo_hookean --at 1",
        "curve isochoric_neo_hookean --at 1 --incompressible",
        "contract isochoric_neo_hookean",
        "check isochoric_neo_hookean --resolution 3",
    ] {
        assert_contains(&folder.answer(&format!("{command} {mixed}")), &[warning]);
        let text = folder.answer(command);
        assert!(text.contains("ν = 0.49") && !text.contains("warning: Poisson"), "{command}: {text}");
    }
    let text = folder.answer("fit yeoh --data treloar --starts 0");
    assert_contains(&text, &["ν = 0.49", "the volume is kept"]);
    let run = format!("run stretch --frames 1 --material isochoric_neo_hookean --out run {mixed}");
    let (said, errors) = folder.outputs(&run);
    assert_contains(&said, &["; at rest μ = 400 kPa, K = 100 kPa, ν = -0.3571\n"]);
    assert_contains(&errors, &[warning]);
    let summary = folder.summary("run");
    for (key, value) in [("shear_modulus", 4e5), ("bulk_modulus", 1e5), ("poisson", -5.0 / 14.0)] {
        let found = summary[key].as_f64().expect(key);
        assert!((found / value - 1.0).abs() < 1e-12, "{key} is {found}");
    }
}

/// D1 of Abaqus and CalculiX: K = 2/D1, and 0 for a volume that is kept.
#[test]
fn compressibilities_have_units() {
    let curve = "curve --at 1 --energy 'C10*(I1b - 3) + (J - 1)^2/D1' --param C10=0.2MPa --param D1=0.1/MPa";
    let folder = Folder::new();
    assert_contains(&folder.answer(curve), &["μ = 400 kPa, K = 20 MPa, ν = 0.4901"]);
    // Ogden's energy in the notation of Abaqus: 315, 630 and 375 MPa by mpmath, uniaxial to pure shear.
    let kept = "curve --at 2 --energy 'sum(p, 2*mu[p]/alpha[p]^2*(l1bar^alpha[p] + l2bar^alpha[p] + l3bar^alpha[p] \
                - 3)) + (J - 1)^2/D1' --param mu=160MPa,40MPa,0 --param alpha=2,-2,1 --param D1=0";
    let text = folder.answer(&format!("{kept} --incompressible"));
    assert_contains(&text, &["--param D1=0\n", "μ = 200 MPa; the volume is kept\n"]);
    assert_contains(&text, &["3.15000e8", "6.30000e8", "3.75000e8"]);
    assert_contains(&folder.refusal(kept), &["as a compressibility of 0 does"]);
}

#[test]
fn rubbers_are_ranked_and_those_without_a_fit_named() {
    let folder = Folder::new();
    let text = "mode,stretch,nominal_stress_MPa\nuniaxial,2,0.6\nuniaxial,4,1.2\nuniaxial,6,2.5\n\
                equibiaxial,2,0.8\nequibiaxial,3,1.2\n";
    folder.write("few.csv", text);
    let text = folder.answer("curve all --data few.csv");
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
    assert_contains(&text, &["gent_thomas", "equibiaxial", "R²/n", "stability", "kept"]);
}

#[test]
fn a_material_is_checked() {
    let folder = Folder::new();
    let (text, errors) = folder.outputs("check st_venant_kirchhoff --resolution 9 --svg map.svg");
    assert_eq!(errors, "");
    // Steel, with its typical parameters, and where an oblique wave stands still under confined compression.
    let words = ["StVenantKirchhoff mu=8.1e10 lambda=1.2e11", "μ = 81 GPa", "strong ellipticity", "0.7043"];
    assert_contains(&text, &words);
    let map = folder.read("map.svg");
    assert!(map.starts_with("<svg") && map.trim_end().ends_with("</svg>"));
    assert_contains(&map, &[words[0], "λ1", "λ2", "plane strain", "constant volume", "Hill lost"]);
    assert_eq!(folder.content("").len(), 1, "the map and nothing else");
}
