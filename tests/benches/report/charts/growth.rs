//! Time and memory of a step against the number of elements.

use super::Chart;
use super::panel::{COLOURS, Line, Mark, Panel, Point, Series, sheet};
use crate::data::GrowthRow;
use crate::growth::slope;

pub(super) fn draw(rows: &[GrowthRow]) -> Result<Chart, String> {
    let panel = |title: &str, y_axis, value: fn(&GrowthRow) -> f64, threads: &[usize]| Panel {
        title: title.to_owned(),
        x_axis: "elements",
        y_axis,
        series: series(rows, value, threads),
    };
    let panels = [
        panel("time", "seconds per step", |row| row.seconds_per_step, &[1, 2]),
        panel("memory", "bytes at most", |row| row.peak_bytes, &[1]),
    ];
    let title = "A step of a box of rubber: time and memory against its size";
    let note = "A step of 1/100 s, one iteration of Newton's method. Dashed: two threads. CG: conjugate gradients to that residual. \
                CSR: so, on compressed rows. n^k: growth at the end.";
    let svg = sheet([1280, 620], 2, title, note, &panels)?;
    let caption = "Time and memory of a step from a thousand to a million elements".to_owned();
    Ok(Chart { file: "growth.svg".to_owned(), svg, caption })
}

fn series(rows: &[GrowthRow], value: fn(&GrowthRow) -> f64, threads: &[usize]) -> Vec<Series> {
    let mut solvers: Vec<&str> = Vec::new();
    for row in rows {
        if !solvers.contains(&row.solver) {
            solvers.push(row.solver);
        }
    }
    let mut all = Vec::new();
    for (solver, colour) in solvers.into_iter().zip(COLOURS) {
        for &threads in threads {
            let of_series: Vec<&GrowthRow> = rows
                .iter()
                .filter(|row| row.solver == solver && row.threads == threads && row.stopped.is_none())
                .collect();
            let mut points: Vec<Point> = of_series
                .iter()
                .map(|row| Point { x: row.elements as f64, y: value(row), label: String::new() })
                .collect();
            if let Some(last) = points.last_mut() {
                let exponent =
                    slope(&of_series, value).map_or(String::new(), |slope| format!(", n^{slope:.2}"));
                let threads = if threads == 1 { "" } else { ", 2 threads" };
                last.label = format!("{solver}{threads}{exponent}");
            }
            let line = if threads == 1 { Line::Solid } else { Line::Dashed };
            all.push(Series { colour, mark: Mark::Disc, line, points });
        }
    }
    all
}
