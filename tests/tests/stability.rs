//! The committed `STABILITY.md` tells of every material, and of no result of ours beyond the bound.

use std::collections::BTreeSet;
use std::path::Path;

use piola_tests::cases::Case;

#[test]
fn the_table_is_complete_and_ours_keeps_the_bound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(folder.join("STABILITY.md")).expect("STABILITY.md");
    let cases = Case::read(&folder.join("reference/cases.json")).expect("the reference cases");

    let mut formats = 0;
    for format in ["f64", "f32"] {
        let heading = |name: &str| format!("## {name}, {format}\n");
        assert!(text.contains(&heading("Summary")), "a summary for {format}");
        let materials: BTreeSet<&str> = cases
            .iter()
            .filter(|case| format == "f64" || case.f32_exact)
            .map(|case| case.material.as_str())
            .collect();
        for material in materials {
            assert!(text.contains(&heading(material)), "a table for {material}, {format}");
            formats += 1;
        }
    }
    assert!(formats >= 34, "17 materials in two formats");

    let mut rows = 0;
    for line in text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| material")) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if cells[1] == "family" {
            continue;
        }
        assert_eq!(cells.len(), 13, "name, cases and nine errors: {line}");
        for ours in &cells[3..6] {
            let error = ours.split(' ').next().unwrap_or_default();
            // What is beyond the bound is written as a power of ten or ∞; – stands where nothing fits the format.
            let bounded = error == "–" || error.parse().is_ok_and(|units: u32| units <= 30);
            assert!(bounded, "{error} in {line}");
        }
        rows += 1;
    }
    assert!(rows >= 300, "{rows} rows");
}
