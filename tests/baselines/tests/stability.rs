//! The committed `STABILITY.md` agrees with the computation, and lists no result of ours beyond the bound.
//! `PIOLA_BLESS=1` writes it anew.

use std::path::Path;

use piola_baselines::stability::{BOUND, document};

/// Columns of a row: its name, the number of cases, and nine errors.
const COLUMNS: usize = 11;

/// Those of piola among the columns.
const OURS: std::ops::Range<usize> = 2..5;

/// Largest change of an error by another processor or another platform's ln, exp and pow: units up to the
/// bound, and above it one in the exponent of ten, as the document says.
const MOVED: f64 = 2.0;

/// Lines of a document as cells; a line that is not a row of a table is a single one.
fn rows(text: &str) -> Vec<Vec<&str>> {
    let cells = |line| str::trim_matches(line, '|').split('|').map(str::trim).collect();
    text.lines().map(cells).collect()
}

/// An error as it is written: units of u (‖X‖ + sens) up to the bound, a power of ten, ∞; `None` for –.
fn error(cell: &str) -> Option<f64> {
    match cell.split(' ').next().unwrap_or_default() {
        "–" => None,
        "∞" => Some(f64::INFINITY),
        number => Some(number.parse().unwrap_or_else(|_| panic!("`{cell}` is not an error"))),
    }
}

/// True if both agree on one column, except for what depends on the machine.
fn agree(committed: &str, computed: &str, column: usize) -> bool {
    if committed == computed {
        return true;
    }
    // With fused multiplications the other methods meet 0/0 and the edge of their switches at other cases.
    if !OURS.contains(&column) && cfg!(any(target_feature = "fma", not(target_arch = "x86_64"))) {
        return true;
    }
    match (error(committed), error(computed)) {
        (Some(old), Some(new)) if old == new => true,
        (Some(old), Some(new)) if old.max(new) <= BOUND => (old - new).abs() <= MOVED,
        (Some(old), Some(new)) => old.max(new) / old.min(new).max(BOUND) <= 10.0,
        _ => false,
    }
}

#[test]
fn the_table_is_what_is_computed_and_ours_keeps_the_bound() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../STABILITY.md");
    let computed = document().expect("the reference cases");
    if std::env::var_os("PIOLA_BLESS").is_some() {
        std::fs::write(&path, &computed).expect("STABILITY.md");
    }
    let committed = std::fs::read_to_string(path).expect("STABILITY.md");
    let (committed, computed) = (rows(&committed), rows(&computed));
    let mut differences = Vec::new();
    let mut judged = 0;
    for (line, (old, new)) in committed.iter().zip(&computed).enumerate() {
        let is_row = new.len() == COLUMNS && new[1].parse::<u32>().is_ok();
        let same = if is_row && old.len() == COLUMNS {
            judged += 1;
            old[..2] == new[..2] && (2..COLUMNS).all(|column| agree(old[column], new[column], column))
        } else {
            old == new
        };
        if !same {
            differences.push(format!("line {}:\n- {}\n+ {}", line + 1, old.join(" | "), new.join(" | ")));
        }
        for cell in OURS.filter(|_| is_row).map(|column| new[column]) {
            assert!(error(cell).is_none_or(|error| error <= BOUND), "{cell} is beyond the bound: {new:?}");
        }
    }
    assert!(
        differences.is_empty() && committed.len() == computed.len(),
        "STABILITY.md has {} lines, computed were {}; PIOLA_BLESS=1 writes it anew.\n{}",
        committed.len(),
        computed.len(),
        differences.join("\n")
    );
    assert!(judged >= 300, "{judged} rows");
}
