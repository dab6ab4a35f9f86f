//! Nanoseconds against errors, method by method: a sheet for each energy.

use super::Chart;
use super::panel::{BLUE, Color, GREEN, GREY, Line, Panel, Point, RGBColor, Series, VERMILION, sheet};
use crate::point::{ENERGIES, HARD, ORDINARY, OURS, OURS_AS_A_SCALAR, PointRow};

pub(super) fn draw(rows: &[PointRow]) -> Result<Vec<Chart>, String> {
    let mut charts = Vec::new();
    for (material, _) in ENERGIES {
        for (work, what) in
            [("tangent", "P and dP/dF"), ("projected", "P and the semidefinite projection of dP/dF")]
        {
            let of_sheet: Vec<&PointRow> =
                rows.iter().filter(|row| row.material == material && row.work == work).collect();
            let file = format!("point-{}-{work}.svg", file_name(material));
            charts.push(of(file, format!("{material}: {what}"), &of_sheet)?);
        }
    }
    Ok(charts)
}

fn of(file: String, title: String, rows: &[&PointRow]) -> Result<Chart, String> {
    let mut panels = Vec::new();
    for precision in ["f64", "f32"] {
        for (family, name) in [(ORDINARY, "ordinary F"), (HARD, "every hard family")] {
            let of_panel: Vec<&PointRow> = rows
                .iter()
                .copied()
                .filter(|row| row.precision == precision && row.family == family)
                .collect();
            panels.push(Panel {
                title: format!("{precision}, {name}"),
                x_axis: "nanoseconds per point",
                y_axis: "worst relative error",
                series: series(&best_settings(&of_panel)),
            });
        }
    }
    let note = "Left and down is better. Error: |X − X*| / (|X*| + sens). Each method with the setting of least error. \
                Vermilion: piola. Blue: other methods for any energy. Green: by invariants. Line: the front of those for any energy.";
    let caption =
        format!("{title}: time against the worst error, at ordinary and at hard deformation gradients");
    Ok(Chart { svg: sheet([1280, 1100], 2, &title, note, &panels)?, file, caption })
}

/// Row with the least worst error for each method; the fastest of equals.
pub(crate) fn best_settings<'a>(rows: &[&'a PointRow]) -> Vec<&'a PointRow> {
    let mut best: Vec<&PointRow> = Vec::new();
    for &row in rows {
        match best.iter_mut().find(|other| other.method == row.method) {
            None => best.push(row),
            Some(other) => {
                let key = |row: &PointRow| (row.worst_error, row.ns_per_element);
                if key(row) < key(other) {
                    *other = row;
                }
            }
        }
    }
    best
}

fn series(rows: &[&PointRow]) -> Vec<Series> {
    let point = |row: &PointRow| {
        let setting = if row.setting.is_empty() { String::new() } else { format!(" {}", row.setting) };
        Point { x: row.ns_per_element, y: row.worst_error, label: format!("{}{setting}", row.method) }
    };
    let ours = |row: &&PointRow| [OURS, OURS_AS_A_SCALAR].contains(&row.method);
    let group = |colour: RGBColor, of_group: &dyn Fn(&&PointRow) -> bool| Series {
        colour,
        mark: Some(colour.filled()),
        line: Line::None,
        points: rows.iter().copied().filter(of_group).map(point).collect(),
    };
    let mut front: Vec<&PointRow> =
        rows.iter().copied().filter(|row| row.is_general && row.is_on_front).collect();
    front.sort_by(|a, b| a.ns_per_element.total_cmp(&b.ns_per_element));
    let unlabelled = |row: &PointRow| Point { label: String::new(), ..point(row) };
    vec![
        Series {
            colour: GREY,
            mark: None,
            line: Line::Dashed,
            points: front.into_iter().map(unlabelled).collect(),
        },
        group(BLUE, &|row| row.is_general && !ours(row)),
        group(GREEN, &|row| !row.is_general),
        group(VERMILION, &ours),
    ]
}

/// Lower case, words joined by hyphens.
fn file_name(material: &str) -> String {
    let words = material.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-").to_lowercase()
}
