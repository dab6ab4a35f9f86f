//! What the settings of the methods that have one do to their errors.

use super::Chart;
use super::panel::{BLUE, Line, Mark, Panel, Point, Series, VERMILION, sheet};
use crate::data::PointRow;
use crate::point::{HARD, ORDINARY, SWEPT};

/// Of the energy with powers, which no method finds easy.
const MATERIAL: &str = "Ogden, three terms";

pub(super) fn draw(rows: &[PointRow]) -> Result<Chart, String> {
    let panels: Vec<Panel> = SWEPT
        .iter()
        .map(|&(method, setting)| Panel {
            title: method.to_owned(),
            x_axis: setting,
            y_axis: "worst relative error",
            series: [("f64", Line::Solid, Mark::Disc), ("f32", Line::Dashed, Mark::Ring)]
                .into_iter()
                .flat_map(|(precision, line, mark)| {
                    [(ORDINARY, BLUE), (HARD, VERMILION)].map(|(family, colour)| Series {
                        colour,
                        mark,
                        line,
                        points: points(rows, method, precision, family),
                    })
                })
                .collect(),
        })
        .collect();
    let title = format!("No setting serves all: {MATERIAL}");
    let note = "Worst error over a setting. Blue: ordinary F. Vermilion: every hard family. Solid lines: f64. Dashed lines: f32.";
    let caption = "What thresholds, regularisations, steps and sweeps do to the worst error".to_owned();
    Ok(Chart { svg: sheet([1280, 820], 3, &title, note, &panels)?, file: "sweeps.svg".to_owned(), caption })
}

fn points(rows: &[PointRow], method: &str, precision: &str, family: &str) -> Vec<Point> {
    let mut points: Vec<Point> = rows
        .iter()
        .filter(|row| (row.material, row.method, row.work) == (MATERIAL, method, "tangent"))
        .filter(|row| (row.precision, row.family.as_str()) == (precision, family))
        .filter_map(|row| {
            Some(Point { x: row.setting.parse().ok()?, y: row.worst_error, label: String::new() })
        })
        .collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x));
    if let Some(last) = points.last_mut() {
        let name = if family == ORDINARY { "ordinary" } else { "hard" };
        last.label = format!("{name}, {precision}");
    }
    points
}
