//! Wall time of trajectories against their errors: a sheet for each body.

use super::Chart;
use super::panel::{COLOURS, GREY, Line, Mark, Panel, Point, RGBColor, Series, sheet};
use super::point::file_name;
use super::time::colour;
use crate::data::StepRow;
use crate::steps::{INTEGRATORS, SINGLE, SINGLE_AXIS};

/// With a panel of their own beside the time step.
const AXES: [&str; 4] = ["newton", "filter", "solver", "precision"];

/// Error, in body heights or of the energy it had, from which on a body is lost.
const LOST: f64 = 10.0;

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
    // Of a body without a reference, how well it keeps its energy.
    let has_reference = rows.iter().any(|row| row.error > 0.0);
    let error = |row: &StepRow| match if has_reference { row.error } else { row.largest_energy_error } {
        lost if lost > LOST => f64::INFINITY,
        error => error,
    };
    let of = |axis: &str, setting: &str| -> Vec<&&StepRow> {
        rows.iter().filter(|row| row.axis == axis && row.setting == setting && error(row) > 0.0).collect()
    };
    let over_h = |setting: &str, mark, line| {
        let rows = of("h", setting);
        let label = |index: usize| {
            // The finest step has the name.
            if index + 1 == rows.len() { setting.to_owned() } else { String::new() }
        };
        let points = rows.iter().enumerate();
        let points =
            points.map(|(index, row)| Point { x: milliseconds(row), y: error(row), label: label(index) });
        Series { colour: colour(setting), mark, line, points: points.collect() }
    };
    let single = |setting: &str| {
        let points = of(SINGLE_AXIS, setting).into_iter();
        let points = points.map(|row| Point { x: milliseconds(row), y: error(row), label: String::new() });
        Series { colour: colour(setting), mark: Mark::Ring, line: Line::None, points: points.collect() }
    };
    let names = || INTEGRATORS.iter().map(|&(name, _)| name);
    let mut series: Vec<Series> = names().map(|name| over_h(name, Mark::Disc, Line::Solid)).collect();
    series.push(over_h(SINGLE, Mark::Ring, Line::Dashed));
    series.extend(names().map(single));
    series.push(Series {
        colour: RGBColor(0, 0, 0),
        mark: Mark::Ring,
        line: Line::Dashed,
        points: rows
            .iter()
            .filter(|row| row.axis == "tolerance")
            .map(|row| Point { x: milliseconds(row), y: error(row), label: row.setting.clone() })
            .collect(),
    });
    let longest = rows.iter().filter(|row| row.axis == "h").map(|row| row.h).fold(0.0, f64::max);
    let first = Panel {
        title: format!("integrators, h = 1/{:.0} s on the left, halved from mark to mark", 1.0 / longest),
        x_axis: "wall time, milliseconds per second of motion",
        y_axis: if has_reference {
            "error beside third order with far shorter steps, body heights"
        } else {
            "largest change of the energy, relative"
        },
        series,
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
    let mut panels = vec![first, second];
    // Of a body that is only followed over time steps there is nothing to compare.
    panels.retain(|panel| panel.series.iter().map(|series| series.points.len()).sum::<usize>() > 1);
    let mut note =
        "Left and down is better. Rings: one iteration of Newton's method for each minimisation.".to_owned();
    if panels.len() > 1 {
        note += " Right: vermilion Newton's stop, blue filter, green linear solver, purple precision of the point kernels.";
    }
    let columns = panels.len().max(1);
    let svg = sheet([640 * columns as u32, 660], columns, &title, &note, &panels)?;
    let caption = format!("{title}, over time step, Newton's method, filter, linear solver and precision");
    Ok(Chart { file: format!("steps-{}.svg", file_name(scene)), svg, caption })
}

/// Wall time for a second of motion.
fn milliseconds(row: &StepRow) -> f64 {
    1e3 * row.seconds / (row.steps as f64 * row.h)
}
