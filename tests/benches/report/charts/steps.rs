//! Wall time of trajectories against their errors: a sheet for each body.

use super::Chart;
use super::panel::{
    BLUE, COLOURS, GREEN, GREY, Line, Mark, PURPLE, Panel, Point, RGBColor, Series, VERMILION, sheet,
};
use super::point::file_name;
use crate::data::StepRow;
use crate::steps::{FULL, SECOND_ORDER, SINGLE, THIRD_ORDER};

/// With a panel of their own beside the time step.
const AXES: [&str; 4] = ["newton", "filter", "solver", "precision"];

pub(super) fn draw(rows: &[StepRow]) -> Result<Vec<Chart>, String> {
    let mut scenes: Vec<&str> = Vec::new();
    for row in rows {
        if !scenes.contains(&row.scene) {
            scenes.push(row.scene);
        }
    }
    scenes.into_iter().map(|scene| of(scene, rows)).collect()
}

fn of(scene: &str, rows: &[StepRow]) -> Result<Chart, String> {
    let rows: Vec<&StepRow> =
        rows.iter().filter(|row| row.scene == scene && row.seconds.is_finite()).collect();
    let over_h = |setting: &str, colour: RGBColor, line| Series {
        colour,
        mark: Mark::Disc,
        line,
        points: rows
            .iter()
            .filter(|row| row.axis == "h" && row.setting == setting)
            .map(|row| {
                let label = format!("h = 1/{:.0} s", 1.0 / row.h);
                Point { x: milliseconds(row), y: row.error, label }
            })
            .collect(),
    };
    let first = Panel {
        title: "time steps: blue implicit Euler, vermilion one iteration, green second order, purple third"
            .to_owned(),
        x_axis: "wall time, milliseconds per second of motion",
        y_axis: "error beside third order with h/16, body heights",
        series: vec![
            over_h(FULL, BLUE, Line::Solid),
            over_h(SINGLE, VERMILION, Line::Dashed),
            over_h(SECOND_ORDER, GREEN, Line::Solid),
            over_h(THIRD_ORDER, PURPLE, Line::Solid),
        ],
    };
    let of_axis = |(axis, colour): (&str, RGBColor)| Series {
        colour,
        mark: Mark::Disc,
        line: Line::None,
        points: rows
            .iter()
            .filter(|row| row.axis == axis && row.algebraic_error > 0.0)
            .map(|row| Point { x: milliseconds(row), y: row.algebraic_error, label: row.setting.clone() })
            .collect(),
    };
    let mut series: Vec<Series> = AXES.into_iter().zip(COLOURS).map(of_axis).collect();
    series.push(Series {
        colour: GREY,
        mark: Mark::Ring,
        line: Line::None,
        points: rows
            .iter()
            .filter(|row| row.axis == "h" && row.setting == SINGLE && row.algebraic_error > 0.0)
            .map(|row| Point { x: milliseconds(row), y: row.algebraic_error, label: SINGLE.to_owned() })
            .collect(),
    });
    let second = Panel {
        title: "how far each step is solved, at h = 1/30 s".to_owned(),
        x_axis: "wall time, milliseconds per second of motion",
        y_axis: "distance from the same steps solved to rounding, body heights",
        series,
    };
    let title = format!("Trajectory of the {scene}: wall time against error");
    let note = "Left and down is better. Right: vermilion Newton's stop, blue filter, green linear solver, purple precision of the \
                point kernels.";
    let mut panels = vec![first, second];
    // Of a body that is only followed over time steps there is nothing to compare.
    panels.retain(|panel| panel.series.iter().map(|series| series.points.len()).sum::<usize>() > 1);
    let svg = sheet([1280, 620], 2, &title, note, &panels)?;
    let caption = format!("{title}, over time step, Newton's method, filter, linear solver and precision");
    Ok(Chart { file: format!("steps-{}.svg", file_name(scene)), svg, caption })
}

/// Wall time for a second of motion.
fn milliseconds(row: &StepRow) -> f64 {
    1e3 * row.seconds / (row.steps as f64 * row.h)
}
