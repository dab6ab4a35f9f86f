//! Files as test machines, spreadsheets, finite-element programs and papers have them, each with the readings
//! that its numbers mean, worked out by hand.

use std::path::Path;

use piola_laboratory::curve::Mode::{self, Equibiaxial, PureShear, SimpleShear, Uniaxial, Volumetric};
use piola_laboratory::data::{DataError, Measurements, ReadOptions, Reading, Test, decoded};

fn file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    decoded(&std::fs::read(path).expect("a file of this test")).into_owned()
}

/// Options by words, empty ones left out.
fn options(test: &str, unit: &str) -> ReadOptions {
    let mut options = ReadOptions::default();
    options.test = (!test.is_empty()).then(|| test.parse().expect("a test"));
    options.unit = (!unit.is_empty()).then(|| unit.parse().expect("a unit"));
    options
}

/// Reads a file; points are expected within roundings, and each of the words in the note.
#[track_caller]
fn check(name: &str, [test, unit]: [&str; 2], expected: &[(Mode, f64, f64)], words: &[&str]) {
    let reading = Measurements::read_with(&file(name), &options(test, unit));
    let Reading { measurements, .. } = reading.as_ref().unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(measurements.points.len(), expected.len(), "{name}: {measurements:?}");
    for (point, &(mode, control, stress)) in measurements.points.iter().zip(expected) {
        let is_close = |found: f64, expected: f64| (found - expected).abs() <= 1e-14 * expected.abs();
        assert_eq!(point.mode, mode, "{name}");
        assert!(is_close(point.control, control) && is_close(point.stress, stress), "{name}: {point:?}");
    }
    let note = reading.map(|reading| reading.to_string()).unwrap_or_default();
    for word in words {
        assert!(note.contains(word), "{name}: `{word}` is not in: {note}");
    }
}

#[test]
fn files_of_test_machines() {
    check(
        "bluehill.csv",
        ["uniaxial", ""],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.1, 0.12e6), (Uniaxial, 1.5, 0.4e6)],
        &[
            "`Tensile strain (%)` as nominal strain in %, `Tensile stress (MPa)` as nominal stress in MPa",
            "3 points of uniaxial",
            "left out: Time (s), Extension (mm), Load (N)",
            "3 lines above the header left out",
        ],
    );
    check(
        "bluehill_units_row.csv",
        ["compression", ""],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 0.9, -25e3), (Uniaxial, 0.8, -60e3)],
        &["`Compressive stress` as nominal stress in kPa, compression positive"],
    );
    check(
        "testxpert.csv",
        ["uniaxial", ""],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.125, 0.15e6), (Uniaxial, 2.0, 0.55e6)],
        &["`Dehnung` as nominal strain in %", "separated by semicolons and decimal commas", "Prüfzeit"],
    );
    check(
        "testworks.txt",
        ["planar", ""],
        &[(PureShear, 1.02, 23e3), (PureShear, 1.1, 101.5e3)],
        &["separated by tabs", "Crosshead"],
    );
}

#[test]
fn files_of_finite_element_programs() {
    let deck: &[(Mode, f64, f64)] = &[
        (Uniaxial, 1.038, 0.054e6),
        (Uniaxial, 1.1338, 0.152e6),
        (Equibiaxial, 1.02, 0.089e6),
        (Equibiaxial, 1.14, 0.255e6),
        (PureShear, 1.069, 0.055e6),
        (SimpleShear, 0.25, 0.06e6),
        (Volumetric, 0.999, -2e6),
    ];
    check("abaqus.inp", ["", "Pa"], deck, &["`nominal stress` as nominal stress in Pa", "columns after"]);
    check("ansys.csv", ["UT", ""], &[(Uniaxial, 1.1, 120e3), (Uniaxial, 1.5, 4e5)], &[]);
    let (one, two) = (0.1_f64.exp(), 0.5_f64.exp());
    check(
        "mcalibration.txt",
        ["equi-biaxial", ""],
        &[(Equibiaxial, 1.0, 0.0), (Equibiaxial, one, 0.132e6 / one), (Equibiaxial, two, 0.66e6 / two)],
        &["nominal stress from true stress as of an incompressible solid", "left out: Time"],
    );
    check("polymerfem.csv", ["tension", ""], &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.1, 0.12e6)], &["Time"]);
}

#[test]
fn tables_of_papers_and_databases() {
    const PSI: f64 = 6_894.757_293_168_361;
    check(
        "matweb.txt",
        ["uniaxial", ""],
        &[(Uniaxial, 1.25, 100.0 * PSI / 1.25), (Uniaxial, 2.0, 400.0 * PSI / 2.0)],
        &["`True stress (psi)` as true stress in psi"],
    );
    check(
        "treloar_kgf.txt",
        ["uniaxial", ""],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.12, 1.4 * 98_066.5), (Uniaxial, 1.24, 2.3 * 98_066.5)],
        &["`λ` as stretch", "a line above the header left out"],
    );
    check(
        "plotdigitizer.csv",
        ["PS", "MPa"],
        &[(PureShear, 1.0023, 1100.0), (PureShear, 1.5011, 401_300.0), (PureShear, 2.9987, 850_200.0)],
        &["`column 1` as stretch, `column 2` as nominal stress in MPa"],
    );
    check(
        "plotdigitizer_comma.csv",
        ["ET", "kPa"],
        &[(Equibiaxial, 1.0023, 1.1), (Equibiaxial, 1.5011, 401.3)],
        &["semicolons and decimal commas"],
    );
    check(
        "shear.csv",
        ["simple shear", ""],
        &[(SimpleShear, 0.0, 0.0), (SimpleShear, 0.25, 60e3)],
        &["shear"],
    );
    check("pressure.csv", ["volumetric", ""], &[(Volumetric, 1.0, 0.0), (Volumetric, 0.999, -2e6)], &["bar"]);
}

#[test]
fn files_of_spreadsheets_and_programs() {
    check(
        "excel_german.csv",
        ["uniaxial", ""],
        &[(Uniaxial, 1.1, 0.12e6), (Uniaxial, 1.5, 0.4e6)],
        &["`Nennspannung [N/mm²]` as nominal stress in MPa", "left out: Versuch"],
    );
    const PSI: f64 = 6_894.757_293_168_361;
    check(
        "excel_unicode.txt",
        ["biaxial", ""],
        &[(Equibiaxial, 1.1, 15.0 * PSI), (Equibiaxial, 1.5, 60.0 * PSI)],
        &["separated by tabs"],
    );
    let [one, two, three] = [0.1_f64, 0.2, 0.3].map(f64::exp);
    check(
        "pandas.csv",
        ["", ""],
        &[(Uniaxial, one, 0.132e6 / one), (Equibiaxial, two, 0.5e6 / two), (PureShear, three, 0.6e6 / three)],
        &["1 point of uniaxial, 1 point of equibiaxial, 1 point of pure_shear"],
    );
    check(
        "modes.csv",
        ["", ""],
        &[
            (Uniaxial, 1.1, 120e3),
            (Uniaxial, 0.9, -150e3),
            (Equibiaxial, 1.1, 220e3),
            (PureShear, 1.1, 160e3),
            (SimpleShear, 0.25, 60e3),
            (Volumetric, 0.99, -2e6),
        ],
        &[],
    );
    check("percent_cells.csv", ["uniaxial", ""], &[(Uniaxial, 1.05, 60e3), (Uniaxial, 1.1, 120e3)], &[]);
}

/// The published file with its test in each row, and its two columns with the test as an option.
#[test]
fn a_bare_table_is_read_as_the_canonical_one() -> Result<(), DataError> {
    let whole = Measurements::read(&file("gent.csv"))?;
    assert_eq!(whole.points.len(), 25);
    let bare = file("gent_raw.csv");
    assert_eq!(Measurements::read_with(&bare, &options("uniaxial", "MPa"))?.measurements, whole);
    let headless = bare.lines().skip(1).collect::<Vec<_>>().join("\n");
    assert_eq!(Measurements::read_with(&headless, &options("uniaxial", "MPa"))?.measurements, whole);
    // With other separators, decimals and ends of lines.
    for (separator, decimal, end) in
        [(";", ",", "\r\n"), ("\t", ".", "\n"), ("\t", ",", "\r"), ("  ", ".", "\n")]
    {
        let text = file("gent.csv").replace('.', "|").replace(',', separator).replace('|', decimal);
        let read = Measurements::read(&text.replace('\n', end));
        assert_eq!(read.as_ref(), Ok(&whole), "{separator:?} {decimal} {end:?}");
    }
    Ok(())
}

/// What may mean two things is asked about, with the line and what to write.
#[track_caller]
fn refuse(text: &str, [test, unit]: [&str; 2], line: u64, words: &[&str]) {
    let error = Measurements::read_with(text, &options(test, unit)).expect_err("a question");
    assert_eq!(error.line, line, "{error}");
    for word in words {
        assert!(error.to_string().contains(word), "`{word}` is not in: {error}");
    }
}

#[test]
fn numbers_that_cannot_be_stretches_are_asked_about() {
    let stretch = "stretch,stress_MPa\n";
    let uniaxial = ["uniaxial", ""];
    refuse(
        &format!("{stretch}10,0.1\n20,0.2\n50,0.4\n"),
        uniaxial,
        2,
        &["percent", "strain [%]", "stretch [-]"],
    );
    refuse(&format!("{stretch}5,0.1\n10,0.15\n50,0.4\n"), uniaxial, 2, &["from 5 to 50", "percent"]);
    refuse(&format!("{stretch}0.1,0.1\n0.5,0.4\n"), uniaxial, 2, &["λ = 0.1", "is the number a strain"]);
    refuse(&format!("{stretch}0,0\n0.1,0.1\n"), uniaxial, 2, &["stretch is 0", "`strain`"]);
    refuse(&format!("{stretch}0.12,0.14\n0.24,0.23\n6.6,6.3\n"), uniaxial, 2, &["λ = 0.12", "strain"]);
    refuse(&format!("{stretch}1.1,-0.1\n1.5,-0.4\n"), uniaxial, 2, &["λ = 1.1", "another sign"]);
    refuse(&format!("{stretch}0.9,0.1\n0.5,0.4\n"), ["planar", ""], 2, &["compression"]);
    refuse("10,0.1\n50,0.4\n", ["uniaxial", "MPa"], 1, &["`column 1`", "percent"]);
    refuse("strain,stress [MPa]\n10,0.1\n20,0.2\n", uniaxial, 2, &["`strain`", "percent", "strain [-]"]);
    refuse("strain,stress [MPa]\n-10,-0.1\n-20,-0.2\n", uniaxial, 2, &["percent"]);
    refuse(
        "strain,stress [MPa]\n0.1,0.1\n0.2,0.2\n",
        ["compression", ""],
        2,
        &["compression reaches λ = 1.1"],
    );
    refuse("shear strain,stress [MPa]\n10,0.1\n20,0.2\n", ["simple shear", ""], 2, &["percent"]);
    // As large as that, if a unit says so; small scatter about rest; slack of a compression.
    for text in [
        "stretch [-],stress [MPa]\n10,0.1\n23,0.2\n",
        "strain [%],stress [MPa]\n1000,0.1\n2300,0.2\n",
        "stretch,stress [MPa]\n0.999,0.001\n1.001,-0.001\n1.1,0.1\n7.6,6.3\n",
        "stretch,stress [MPa]\n0.99,0.001\n0.5,-0.6\n",
        "stretch,stress [MPa]\n1.5,0.4\n2,0.6\n1.5,0.3\n1.05,-0.03\n",
    ] {
        assert!(Measurements::read_with(text, &options("uniaxial", "")).is_ok(), "{text}");
    }
}

#[test]
fn strains_in_unknown_units_are_asked_about() {
    for unit in ["[10^-3]", "[10⁻³]", "(x10-6)", "[mstrain]", "(mε)", "[% of L0]", "x 10^3"] {
        let text = format!("Strain {unit},Stress [MPa]\n0.5,0.1\n1,0.2\n");
        let found = unit.trim_matches(['[', ']', '(', ')']);
        refuse(&text, ["uniaxial", ""], 1, &[found, "is not known", "`strain [%]`"]);
    }
    let uniaxial = ["uniaxial", ""];
    refuse("Tensile % strain,Stress [MPa]\n1,0.1\n", uniaxial, 1, &["`Tensile % strain`", "`strain [%]`"]);
    refuse("Strain (1) [mstrain],Stress [MPa]\n1,0.1\n", uniaxial, 1, &["`mstrain`"]);
    refuse("Strain,Stress\nmstrain,MPa\n1,0.1\n", uniaxial, 1, &["`mstrain`"]);
}

/// Tables whose meaning is in small marks.
#[test]
fn marks_beside_the_numbers() {
    #[track_caller]
    fn check(text: &str, unit: &str, words: &[&str]) {
        let reading = Measurements::read_with(text, &options("uniaxial", unit)).expect("a table");
        let points = &reading.measurements.points;
        let stresses: Vec<_> = points.iter().map(|point| (point.mode, point.control, point.stress)).collect();
        assert_eq!(stresses, [(Uniaxial, 1.1, 0.12e6), (Uniaxial, 1.5, 0.4e6)], "{text}");
        for word in words {
            assert!(reading.to_string().contains(word), "`{word}` is not in: {reading}");
        }
    }
    for header in ["strain", "strain [-]", "strain [%]", "strain [‰]"] {
        check(&format!("{header},stress_kPa\n10%,120\n50 %,400\n"), "", &[]);
    }
    let compression = "compressive strain [-],compressive stress [kPa]\n50%,400\n";
    let read = Measurements::read_with(compression, &options("uniaxial", "")).expect("a table");
    assert_eq!(read.measurements.points[0].control, 0.5);
    check("** UNIAXIAL TEST DATA\nstretch,stress_kPa\n1.1,120\n1.5,400\n", "", &[]);
    // Of spreadsheets.
    check("sep=;\n1.1;120\n1.5;400\n", "kPa", &["semicolons"]);
    check("\"SEP=\t\"\r\n1,1\t120\r\n1,5\t400\r\n", "kPa", &["tabs and decimal commas"]);
    check("sep=,\nstretch,stress_kPa\n1.1,120\n1.5,400\n", "", &[]);
    // Numbers of specimens.
    for name in ["Test", "Type", "Experiment"] {
        let text = format!("{name},stretch,stress_kPa\n1,1.1,120\n2,1.5,400\n");
        check(&text, "", &[&format!("left out: {name}")]);
        refuse(&text, ["", ""], 2, &["`1`"]);
    }
    // A mistyped test among others is none of them.
    refuse("mode,stretch,stress_Pa\nuniaxal,1.1,1\nUT,1.2,2\n", ["uniaxial", ""], 2, &["`uniaxal`"]);
}

#[test]
fn what_is_missing_or_twofold_is_named() {
    let uniaxial = ["uniaxial", ""];
    refuse("strain,stress [MPa]\n0.1,0.1\n", ["", ""], 1, &["no column `mode`", "--mode uniaxial"]);
    refuse("strain,stress\n0.1,0.1\n", uniaxial, 1, &["`stress` names no unit", "--unit MPa"]);
    refuse("strain,stress [mPa]\n0.1,0.1\n", uniaxial, 1, &["names no unit"]);
    refuse("strain,stress [mN/m²]\n0.1,0.1\n", uniaxial, 1, &["names no unit"]);
    refuse("1.1,0.1\n1.2,0.2\n", uniaxial, 1, &["`column 2`", "--unit MPa"]);
    refuse("1.1,0.1,3\n1.2,0.2,3\n", ["uniaxial", "MPa"], 1, &["3 columns", "true stress"]);
    refuse("X,Y\n1.1,0.1\n", ["uniaxial", "MPa"], 1, &["`X,Y`", "stretch or strain", "`volume ratio`"]);
    refuse("Load (N),Extension (mm)\n1,0.1\n", uniaxial, 1, &["Load (N)", "cross-section", "length at rest"]);
    refuse("Extension (mm),Stress (MPa)\n1,0.1\n", uniaxial, 1, &["Extension (mm)", "length at rest"]);
    refuse(
        "strain 1,strain 2,stress_Pa\n0.1,0.1,1\n",
        uniaxial,
        1,
        &["`strain 1`", "`strain 2`", "keep one"],
    );
    refuse("true strain,stress_Pa\n0.1,1\n", uniaxial, 1, &["true stress, or a nominal one"]);
    refuse("strain [%],stress_Pa\nmm/mm,Pa\n0.1,1\n", uniaxial, 1, &["`strain [%]`", "`mm/mm`", "keep one"]);
    refuse("strain;stress_Pa\n0,1;100\n0.2;200\n", uniaxial, 3, &["`0.2`", "one mark"]);
    refuse("strain;stress_Pa\n0,1;1.000,5\n", uniaxial, 2, &["`1.000,5`", "thousands"]);
    refuse("strain,stress_Pa\n1,\"1,234\"\n2,\"2,345\"\n", uniaxial, 2, &["`1,234`", "thousands"]);
    refuse("strain,stress_Pa\n0,1,1,2\n0,2,2,3\n", uniaxial, 2, &["4 fields", "2", "decimals with a point"]);
    refuse("strain,stress_Pa\n0.1,\n", uniaxial, 2, &["`` under `stress_Pa`"]);
    refuse("strain,stress_Pa\n0.1,5%\n", uniaxial, 2, &["`5%`"]);
    refuse("mode,stretch,stress_Pa\nshear,1.1,1\n", ["", ""], 2, &["`shear`", "pure_shear", "simple_shear"]);
    refuse("volume ratio,stress_Pa\n1.1,1\n", uniaxial, 2, &["`volume ratio`", "uniaxial"]);
    refuse("stretch,pressure [MPa]\n1.1,1\n", uniaxial, 2, &["`pressure [MPa]`", "uniaxial"]);
    refuse("*UNIAXIAL TEST DATA\n1.0, 0.1\n", ["", ""], 1, &["--unit"]);
    refuse("*COMBINED TEST DATA\n1.0, 0.1\n", ["", "Pa"], 1, &["`COMBINED`"]);
    refuse("PK\u{3}\u{4}\0\0xl/workbook.xml", ["", ""], 1, &["spreadsheet", "CSV"]);
}

#[test]
fn names_of_tests() {
    for (mode, names) in [
        (Uniaxial, ["UT", "tension", "Uniaxial test", "uniaxial compression"]),
        (Equibiaxial, ["ET", "EB", "Equi-Biaxial", "biaxial tension"]),
        (PureShear, ["PS", "planar", "Planar tension", "pure shear"]),
        (SimpleShear, ["SS", "simple shear", "Simple_Shear", "simple-shear"]),
        (Volumetric, ["hydrostatic", "Volumetric", "volumetric compression", "vol"]),
    ] {
        for name in names {
            let expected = Test { mode, is_compression: name.contains("compression") };
            assert_eq!(name.parse(), Ok(expected), "{name}");
        }
    }
}

/// A file that nobody wrote by hand takes no longer than it is.
#[test]
fn large_files_take_time_in_proportion() {
    let rows = "1.5,0.4\n".repeat(200_000);
    let read = Measurements::read_with(&format!("stretch,stress_MPa\n{rows}"), &options("uniaxial", ""));
    assert_eq!(read.map(|read| read.measurements.points.len()), Ok(200_000));
    for text in
        ["a,b\n".repeat(200_000), ",".repeat(1_000_000), "(\n".repeat(200_000), "\"".repeat(1_000_000)]
    {
        assert!(Measurements::read(&text).is_err());
    }
}
