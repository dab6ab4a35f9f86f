//! Files as test machines, spreadsheets and papers have them, each with the readings that its numbers mean,
//! worked out by hand.

use std::path::Path;

use piola_laboratory::curve::Mode::{self, Equibiaxial, PureShear, SimpleShear, Uniaxial, Volumetric};
use piola_laboratory::data::{DataError, Measurements, ReadOptions};

const PSI: f64 = 6_894.757_293_168_361;

fn file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    let bytes = std::fs::read(path).expect("a file of this test");
    String::from_utf8(bytes).unwrap_or_else(|error| error.into_bytes().into_iter().map(char::from).collect())
}

/// Options in words, as on the command line: test, unit, column of the strain, column of the stress; empty
/// ones left out.
fn options([test, unit, strain, stress]: [&str; 4]) -> ReadOptions {
    ReadOptions {
        test: (!test.is_empty()).then(|| test.parse().expect("a test")),
        unit: (!unit.is_empty()).then(|| unit.parse().expect("a unit")),
        strain: (!strain.is_empty()).then(|| strain.into()),
        stress: (!stress.is_empty()).then(|| stress.into()),
    }
}

/// Reads a text; points are expected within roundings, and each of the words in the note.
#[track_caller]
fn check(text: &str, given: [&str; 4], expected: &[(Mode, f64, f64)], words: &[&str]) {
    let reading = Measurements::read_with(text, &options(given)).unwrap_or_else(|error| panic!("{error}"));
    let points = &reading.measurements.points;
    assert_eq!(points.len(), expected.len(), "{points:?}");
    for (point, &(mode, control, stress)) in points.iter().zip(expected) {
        let is_close = |found: f64, expected: f64| (found - expected).abs() <= 1e-14 * expected.abs();
        assert_eq!(point.mode, mode, "{}", reading.note);
        assert!(is_close(point.control, control) && is_close(point.stress, stress), "{point:?}");
    }
    for word in words {
        assert!(reading.note.contains(word), "`{word}` is not in: {}", reading.note);
    }
}

#[test]
fn headers_in_plain_form_need_no_choice() {
    check(
        &file("bluehill.csv"),
        ["uniaxial", "", "", ""],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.1, 0.12e6), (Uniaxial, 1.5, 0.4e6)],
        &[
            "`Tensile strain (%)` as nominal strain in %, `Tensile stress (MPa)` as nominal stress in MPa",
            "3 points of uniaxial, λ from 1 to 1.5",
            "left out: Time (s), Extension (mm), Load (N)",
            "lines left out above the header: 3",
        ],
    );
    let sheet = [(PureShear, 1.02, 23e3), (PureShear, 1.1, 101.5e3)];
    check(&file("testworks.txt"), ["planar", "", "", ""], &sheet, &["left out: Time", "above the header: 1"]);
    let biaxial = [(Equibiaxial, 1.1, 15.0 * PSI), (Equibiaxial, 1.5, 60.0 * PSI)];
    let sheet = "Stretch ratio\tNominal stress, psi\r\n1.1\t15\r\n1.5\t60\r\n";
    check(sheet, ["biaxial", "", "", ""], &biaxial, &["in psi"]);
    assert_eq!("Equi-Biaxial".parse::<Mode>(), Ok(Equibiaxial));
    let volumetric = [(Volumetric, 1.0, 0.0), (Volumetric, 0.999, -2e6)];
    check(&file("pressure.csv"), ["volumetric", "", "", ""], &volumetric, &["in bar"]);
    let [one, two, three] = [0.1_f64, 0.2, 0.3].map(f64::exp);
    check(
        ",mode,true_strain,true_stress_mpa\n0,UT,0.1,0.132\n1,EB,0.2,0.5\n2,PS,0.3,0.6\n",
        [""; 4],
        &[(Uniaxial, one, 0.132e6 / one), (Equibiaxial, two, 0.5e6 / two), (PureShear, three, 0.6e6 / three)],
        &[
            "nominal stress from true stress as of an incompressible solid",
            "1 point of uniaxial, λ from 1.105 to 1.105, stress from 119.4 kPa to 119.4 kPa, reversals: 0; 1 point of",
        ],
    );
    check(
        &file("modes.csv"),
        [""; 4],
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
    let compression = "compressive strain [-],compressive stress [kPa]\n0.5,400\n";
    let positive = ["`compressive stress [kPa]` as nominal stress in kPa, compression positive"];
    check(compression, UNIAXIAL, &[(Uniaxial, 0.5, -400e3)], &positive);
}

#[test]
fn headers_name_a_quantity_and_its_unit() {
    #[track_caller]
    fn read(strain: &str, stress: &str, expected: (f64, f64)) {
        check(&format!("{strain};{stress}\n2;3\n"), UNIAXIAL, &[(Uniaxial, expected.0, expected.1)], &[]);
    }
    for stretch in ["stretch", "λ", "Stretch ratio", " stretch_ratio "] {
        read(stretch, "stress_Pa", (2.0, 3.0));
    }
    for strain in ["Strain [%]", "strain %", "Nominal strain (percent)", "tensile_strain_%"] {
        read(strain, "stress_Pa", (1.02, 3.0));
    }
    read("Strain (mm/mm)", "Stress / kPa", (3.0, 3e3));
    read("Strain (μϵ)", "Stress [N/mm²]", (1.0 + 2e-6, 3e6));
    read("true_strain", "nominal_stress_MPa", (2f64.exp(), 3e6));
    read("stretch", "Tensile stress, MPa", (2.0, 3e6));
    read("stretch", "Cauchy stress [psi]", (2.0, 1.5 * PSI));
    for (strain, stress) in [
        ("Shear strain γ", "stress_Pa"),
        ("strain [MPa]", "stress_Pa"),
        ("strain", "max stress_Pa"),
        ("strain", "stress [mPa]"),
    ] {
        refuse(&format!("{strain};{stress}\n2;3\n"), UNIAXIAL, 1, &["no header is a str"]);
    }
}

#[test]
fn other_columns_are_chosen_by_name_or_number() {
    let tension = [(Uniaxial, 1.1, 0.12e6), (Uniaxial, 1.5, 0.4e6)];
    // The units from the row below, and from the header. The file is in Latin-1.
    check(
        &file("testxpert.csv"),
        ["uniaxial", "", "dehnung", "Spannung"],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.125, 0.15e6), (Uniaxial, 2.0, 0.55e6)],
        &["`Dehnung` as nominal strain in %", "decimal commas", "Prüfzeit"],
    );
    check(
        &file("excel_german.csv"),
        ["uniaxial", "", "Nenndehnung [%]", "Nennspannung [N/mm²]"],
        &tension,
        &["`Nennspannung [N/mm²]` as nominal stress in MPa", "left out: Versuch"],
    );
    // Two specimens, each below a header with a name in brackets and its unit in the next row.
    let specimen = [(Uniaxial, 1.0, 0.0), (Uniaxial, 0.9, -25e3), (Uniaxial, 0.8, -60e3)];
    for chosen in ["Compressive strain (Displacement)=compressive strain", ""] {
        check(
            &file("bluehill_units_row.csv").repeat(2),
            ["uniaxial", "", chosen, ""],
            &specimen.repeat(2),
            &["nominal stress in kPa, compression positive", "reversals: 2", "as headers that return: 2"],
        );
    }
    check(
        &file("treloar_kgf.txt"),
        ["uniaxial", "", "1=stretch", "2=stress [kgf/cm2]"],
        &[(Uniaxial, 1.0, 0.0), (Uniaxial, 1.12, 1.4 * 98_066.5), (Uniaxial, 1.24, 2.3 * 98_066.5)],
        &["`column 1` as stretch", "lines left out above the header: 2"],
    );
    check(
        &file("plotdigitizer.csv"),
        ["PS", "MPa", "1=stretch", "2"],
        &[(PureShear, 1.0023, 1100.0), (PureShear, 1.5011, 401_300.0), (PureShear, 2.9987, 850_200.0)],
        &["`column 1` as stretch, `column 2` as nominal stress in MPa"],
    );
    let two = "strain 1 [%];strain 2 [%];stress_kPa\n10;7;120\n50;30;400\n";
    check(two, ["uniaxial", "", "1", ""], &tension, &["left out: strain 2 [%]"]);
    check(two, ["uniaxial", "", "strain 1 [%]", "3"], &tension, &[]);
}

/// With other separators, decimals and ends of lines, and the mark of UTF-8.
#[test]
fn tables_of_all_systems_are_read() -> Result<(), DataError> {
    let whole = Measurements::read(&file("gent.csv"))?;
    assert_eq!(whole.points.len(), 25);
    for (separator, decimal, end) in
        [(";", ",", "\r\n"), ("\t", ".", "\n"), ("\t", ",", "\r"), ("  ", ".", "\n")]
    {
        let text = file("gent.csv").replace('.', "|").replace(',', separator).replace('|', decimal);
        let text = format!("\u{feff}# by hand\n{text}").replace('\n', end);
        assert_eq!(Measurements::read(&text).as_ref(), Ok(&whole), "{separator:?} {decimal} {end:?}");
    }
    Ok(())
}

/// What may mean two things is asked about, with the line and what to write.
#[track_caller]
fn refuse(text: &str, given: [&str; 4], line: u64, words: &[&str]) {
    let error = Measurements::read_with(text, &options(given)).expect_err("a question");
    assert_eq!(error.line, line, "{error}");
    for word in words {
        assert!(error.to_string().contains(word), "`{word}` is not in: {error}");
    }
}

const UNIAXIAL: [&str; 4] = ["uniaxial", "", "", ""];

#[test]
fn numbers_that_cannot_be_stretches_are_asked_about() {
    let stretch =
        |rows: &str, words: &[&str]| refuse(&format!("stretch,stress_MPa\n{rows}"), UNIAXIAL, 2, words);
    stretch("10,0.1\n20,0.2\n50,0.4\n", &["percent", "strain [%]", "stretch [-]"]);
    stretch("5,0.1\n10,0.15\n50,0.4\n", &["from 5 to 50", "percent"]);
    stretch("0.1,0.1\n0.5,0.4\n", &["λ = 0.1", "is the number a strain"]);
    stretch("0,0\n0.1,0.1\n", &["stretch is 0", "`strain`"]);
    stretch("0.12,0.14\n0.24,0.23\n6.6,6.3\n", &["λ = 0.12", "strain"]);
    stretch("1.1,-0.1\n1.5,-0.4\n", &["λ = 1.1", "another sign"]);
    stretch("-1.1,1\n", &["-1.1", "positive"]);
    let strain = "strain,stress [MPa]\n";
    refuse(&format!("{strain}10,0.1\n20,0.2\n"), UNIAXIAL, 2, &["`strain`", "percent", "strain [-]"]);
    refuse(&format!("{strain}-10,-0.1\n-20,-0.2\n"), UNIAXIAL, 2, &["percent"]);
    let compression = "compressive strain,compressive stress [MPa]\n-0.1,-0.1\n-0.2,-0.2\n";
    refuse(compression, UNIAXIAL, 2, &["λ = 1.1", "is a compression"]);
    // As large as that, if a unit says so; small scatter about rest; slack of a compression.
    for text in [
        "stretch [-],stress [MPa]\n10,0.1\n23,0.2\n",
        "strain [%],stress [MPa]\n1000,0.1\n2300,0.2\n",
        "stretch,stress [MPa]\n0.999,0.001\n1.001,-0.001\n1.1,0.1\n7.6,6.3\n",
        "stretch,stress [MPa]\n0.99,0.001\n0.5,-0.6\n",
        "stretch,stress [MPa]\n1.5,0.4\n2,0.6\n1.5,0.3\n1.05,-0.03\n",
    ] {
        assert!(Measurements::read_with(text, &options(UNIAXIAL)).is_ok(), "{text}");
    }
}

#[test]
fn columns_that_are_not_clear_are_listed() {
    refuse(
        "1.1,0.1\n1.2,0.2\n",
        ["uniaxial", "MPa", "", ""],
        1,
        &["no header", "1 `1.1`, 2 `0.1`", "--strain"],
    );
    refuse("Load (N),Extension (mm)\n1,0.1\n", UNIAXIAL, 1, &["1 `Load (N)`", "cross-section"]);
    refuse("strain,strain_%,stress_Pa\n0.1,10,1\n", UNIAXIAL, 1, &["`strain` and `strain_%` are both"]);
    refuse("true strain,stress_Pa\n0.1,1\n", UNIAXIAL, 1, &["`true stress` or a `nominal stress`"]);
    refuse("strain [%],stress_Pa\nmm/mm,Pa\n0.1,1\n", UNIAXIAL, 1, &["1 `strain [%]`"]);
    refuse("Strain (1),Stress (True)\n-,Pa\n0.1,1\n", UNIAXIAL, 1, &["no header is a stress"]);
    refuse("mode,stretch,nominal_stress_stone\n", [""; 4], 1, &["nominal_stress_stone", "--stress"]);
    refuse("# by hand\nmode,angle,stress_Pa\n", [""; 4], 2, &["no header is a stretch", "2 `angle`"]);
    for header in ["Strain [mstrain]", "Strain (Strain 1)", "Tensile % strain"] {
        let text = format!("{header},Stress [MPa]\n0.5,0.1\n1,0.2\n");
        refuse(&text, UNIAXIAL, 1, &[header, "strain [%]"]);
        refuse(&text, ["uniaxial", "", header, ""], 1, &["has no known unit"]);
        let chosen = format!("{header}=strain [%]");
        assert!(Measurements::read_with(&text, &options(["uniaxial", "", &chosen, ""])).is_ok());
    }
    let text = "strain,stress [MPa]\n0.1,0.1\n";
    refuse(text, ["uniaxial", "", "Dehnung", ""], 1, &["no column `Dehnung`", "2 `stress [MPa]`"]);
    refuse(text, ["uniaxial", "", "3", ""], 1, &["no column `3`"]);
    refuse(text, ["uniaxial", "", "1", "0"], 2, &["no column `0`"]);
    // A table in the middle of rows would drop those above.
    refuse("strain,load\n0.1,1\nstrain,stress_Pa\n0.1,1\n", UNIAXIAL, 1, &["2 `load`"]);
}

#[test]
fn what_is_missing_or_twofold_is_named() {
    refuse("", [""; 4], 1, &["no table", "mode,stretch,nominal_stress_MPa"]);
    refuse("# nothing\n", [""; 4], 1, &["no table"]);
    for text in ["PK\u{3}\u{4}\0\0xl/workbook.xml", "ÿþ1\0;\0", "ÐÏ\u{11}à¡±\u{1a}á\0\0"] {
        refuse(text, [""; 4], 1, &["UTF-16", "spreadsheet", "CSV"]);
    }
    refuse("strain,stress\n0.1,0.1\n", UNIAXIAL, 1, &["`stress` names no unit", "--unit MPa"]);
    refuse("1.1,0.1\n", ["uniaxial", "", "1=stretch", "2"], 1, &["`column 2`", "--unit MPa"]);
    refuse(
        "strain;stress_Pa\n0,1;100\n0.2;200\n",
        UNIAXIAL,
        3,
        &["`0.2`", "decimals of this file have a comma"],
    );
    refuse("strain;stress_Pa\n0,1;1.000,5\n", UNIAXIAL, 2, &["`1.000,5`", "thousands"]);
    refuse("strain;stress_Pa\n1;100\n2;1,234\n", UNIAXIAL, 3, &["`1,234` may be 1234 or 1.234", "point"]);
    refuse("strain;stress_Pa\n1,125;-12,345\n", UNIAXIAL, 2, &["`1,125` may be 1125 or 1.125"]);
    check("strain;stress_Pa\n0,125;1,234\n", UNIAXIAL, &[(Uniaxial, 1.125, 1.234)], &["decimal commas"]);
    refuse("strain,stress_Pa\n0,1,1,2\n0,2,2,3\n", UNIAXIAL, 2, &["4 fields", "2", "semicolons"]);
    refuse("strain,stress_Pa\n\"0,1\",1\n", UNIAXIAL, 2, &["`0,1`", "not a number"]);
    refuse("strain,stress_Pa\n0.1,\n", UNIAXIAL, 2, &["`` under `stress_Pa`"]);
    refuse("stretch,pressure [MPa]\n1.1,1\n", UNIAXIAL, 2, &["`pressure [MPa]`", "uniaxial"]);
    refuse("volume ratio,stress_Pa\n1.1,1\n", UNIAXIAL, 2, &["`volume ratio`", "uniaxial"]);
    let rows = |rows: &str, line, words: &[&str]| {
        refuse(&format!("mode,stretch,nominal_stress_MPa\n{rows}"), [""; 4], line, words);
    };
    rows("", 1, &["uniaxial,1.5,0.37"]);
    rows("uniaxial,1,0\n", 1, &["no point but rest"]);
    rows("# twist\ntorsion,1,0\n", 3, &["`torsion`", "`pure_shear`"]);
    rows("shear,1.1,1\n", 2, &["`shear`", "pure_shear", "simple_shear"]);
    rows("Uniaxial compression,0.9,1\n", 2, &["a compression is `uniaxial`, with negative strain"]);
    rows("uniaxial,1,0\n\nuniaxial,2\n", 4, &["2 fields", "3"]);
    rows("uniaxial,1.1,1e999\n", 2, &["1e999", "`nominal_stress_MPa`"]);
    // 1e303 MPa is infinite in Pa, 1e-320 MPa a subnormal number.
    rows("uniaxial,3,1e303\n", 2, &["stress in Pa is inf", "at most 1e100 Pa"]);
    rows("uniaxial,3,-1e200\n", 2, &["stress in Pa is -1e206", "unit right"]);
    rows("uniaxial,3,1e-320\n", 2, &["at least 1e-100 Pa"]);
    for (mode, control) in [("uniaxial", "1e-7"), ("volumetric", "1e7"), ("simple_shear", "-1e300")] {
        rows(&format!("{mode},{control},1\n"), 2, &[&format!("is {control};"), "at most 1e6"]);
    }
    let edge =
        "mode,stretch [-],stress_MPa\nuniaxial,1e6,1e94\nsimple_shear,-1e6,0\nequibiaxial,1e-6,-1e-105\n";
    assert_eq!(Measurements::read(edge).map(|read| read.points.len()), Ok(3));
}

#[test]
fn cycles_are_chosen_and_scatter_is_no_second_curve() -> Result<(), DataError> {
    let read = |rows: &str| Measurements::read(&format!("mode,stretch,nominal_stress_Pa\n{rows}"));
    // Two specimens that begin next to rest.
    let two = read("uniaxial,1.5,4\nuniaxial,2,6\nuniaxial,1.2,1\nuniaxial,1.8,3\n")?;
    for (cycle, points) in [(1, 0..2), (2, 2..4)] {
        assert_eq!(two.cycle(cycle), Ok(Measurements { points: two.points[points].to_vec() }));
    }
    // Noise, a wrong reading, rest out of order, tension and compression, a preload.
    let wrong = file("gent.csv").replace("4.03,1.21", "4.03,2.61");
    for text in [&file("noise.csv"), &wrong] {
        assert_eq!(Measurements::read(text)?.check_curves(), Ok(()));
    }
    assert_eq!(read("uniaxial,2,3\nuniaxial,1,0\nuniaxial,0.5,-9\nuniaxial,1.5,2\n")?.check_curves(), Ok(()));
    assert_eq!(read("uniaxial,1,1\nuniaxial,1.5,5\nuniaxial,2,10\n")?.check_curves(), Ok(()));
    Ok(())
}

/// A file that nobody wrote by hand takes no longer than it is.
#[test]
fn large_files_take_time_in_proportion() {
    let rows = "1.5,0.4\n".repeat(200_000);
    let read = Measurements::read_with(&format!("stretch,stress_MPa\n{rows}"), &options(UNIAXIAL));
    assert_eq!(read.map(|read| read.measurements.points.len()), Ok(200_000));
    for text in
        ["a,b\n".repeat(200_000), ",".repeat(1_000_000), "(\n".repeat(200_000), "\"".repeat(1_000_000)]
    {
        assert!(Measurements::read(&text).is_err());
    }
}
