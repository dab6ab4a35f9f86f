//! Wall time of a motion against its error.

use super::Chart;
use super::panel::{BLUE, Color, GREEN, Line, PURPLE, Panel, Point, Series, VERMILION, sheet};
use crate::steps::{INTEGRATORS, SINGLE, StepRow};

pub(super) fn draw(rows: &[StepRow]) -> Result<Chart, String> {
    let names = INTEGRATORS.map(|(name, _)| name);
    let place = |row: &StepRow| Point { x: row.milliseconds(), y: row.error, label: row.setting.to_owned() };
    let over_h = |setting: &str, colour, mark, line| {
        let of_setting = rows.iter().filter(|row| row.setting == setting);
        let mut points: Vec<Point> = of_setting.map(place).collect();
        // The finest step has the name.
        let all_but_last = points.len().saturating_sub(1);
        points[..all_but_last].iter_mut().for_each(|point| point.label.clear());
        Series { colour, mark: Some(mark), line, points }
    };
    let colours = [VERMILION, GREEN, PURPLE];
    let mut series: Vec<Series> = names
        .into_iter()
        .zip(colours)
        .map(|(name, colour)| over_h(name, colour, colour.filled(), Line::Solid))
        .collect();
    series.push(over_h(SINGLE, VERMILION, VERMILION.stroke_width(2), Line::Dashed));
    let others = rows.iter().skip(1).filter(|row| row.setting != SINGLE && !names.contains(&row.setting));
    let points = others.map(place).collect();
    series.push(Series { colour: BLUE, mark: Some(BLUE.filled()), line: Line::None, points });
    let panel = Panel {
        title: "h = 1/15 s on the left, halved from mark to mark; blue: h = 1/30 s".to_owned(),
        x_axis: "wall time, milliseconds per second of motion",
        y_axis: "error relative to third order with far shorter steps, body heights",
        series,
    };
    let title = "Rubber dinosaur let go: wall time against error";
    let note = "Left and down is better. Rings: one iteration of Newton's method.";
    let svg = sheet([640, 660], 1, title, note, &[panel])?;
    let caption = format!("{title}, over time step, integrator, filter and linear solver");
    Ok(Chart { file: "steps.svg".to_owned(), svg, caption })
}
