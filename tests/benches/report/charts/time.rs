//! Curves over time: energy and angular momentum of free bodies, and steps that follow from their error.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Chart;
use super::panel::{Area, COLOURS, FONT, LINE, RGBColor, failed, headed};
use super::point::file_name;
use crate::data::{AdaptiveRow, HistoryInstant, HistoryRow};
use crate::steps::adaptive::NOTED;
use crate::steps::{INTEGRATORS, SINGLE};

/// Of an integrator, the same on all charts.
pub(super) fn colour(setting: &str) -> RGBColor {
    // The dashes of one iteration are those of its own integrator.
    let name = if setting == SINGLE { INTEGRATORS[0].0 } else { setting };
    let index = INTEGRATORS.iter().position(|&(other, _)| other == name).unwrap_or(0);
    COLOURS.get(index).copied().unwrap_or(RGBColor(0, 0, 0))
}

/// Lines over time.
struct Panel {
    title: &'static str,
    scale: Scale,
    curves: Vec<Curve>,
}

/// Of the upright axis.
#[derive(Clone, Copy)]
enum Scale {
    /// Between these; what is above is cut off.
    Linear(f64, f64),
    /// From the least number of the curves, or this if it is larger, to the largest.
    Logarithmic(f64),
}

struct Curve {
    label: String,
    colour: RGBColor,
    /// Time, s, and what is shown.
    points: Vec<[f64; 2]>,
}

/// Energy and angular momentum of each free body.
pub(super) fn draw_histories(rows: &[HistoryRow]) -> Result<Vec<Chart>, String> {
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene).collect();
    scenes.dedup();
    let of = |scene: &&str| {
        let rows = || rows.iter().filter(|row| row.scene == *scene);
        let curves = |number: fn(&HistoryInstant) -> f64| -> Vec<Curve> {
            let curve = |row: &HistoryRow| Curve {
                label: row.setting.clone(),
                colour: colour(&row.setting),
                points: row.instants.iter().map(|at| [at.time, number(at)]).collect(),
            };
            rows().filter(|row| row.setting != SINGLE).map(curve).collect()
        };
        let panels = [
            Panel {
                title: "energy, relative to that before the first step",
                scale: Scale::Linear(0.0, 1.4),
                curves: curves(|at| at.energy),
            },
            Panel {
                title: "change of the angular momentum, relative",
                scale: Scale::Logarithmic(1e-16),
                curves: curves(|at| at.angular_momentum_error),
            },
        ];
        let title = format!("Energy and angular momentum over time: {scene}");
        let note = "Nothing acts on the body from outside: both should stay. h = 1/30 s, Newton's method to the end.";
        let svg = sheet([1280, 560], &title, note, &panels)?;
        let file = format!("momenta-{}.svg", file_name(scene));
        Ok(Chart { file, svg, caption: format!("{title}, for each integrator") })
    };
    scenes.iter().map(of).collect()
}

/// Step sizes, errors and work of the dinosaur's frames.
pub(super) fn draw_adaptive(rows: &[AdaptiveRow]) -> Result<Chart, String> {
    let curves = |number: fn(&AdaptiveRow) -> f64| -> Vec<Curve> {
        let curve = |(&tolerance, &colour): (&f64, &RGBColor)| Curve {
            label: format!("tolerance {tolerance}"),
            colour,
            points: rows
                .iter()
                .filter(|row| row.tolerance == tolerance)
                .map(|row| [row.time, number(row)])
                .collect(),
        };
        NOTED.iter().zip(&COLOURS).map(curve).collect()
    };
    let panels = [
        Panel {
            title: "shortest step of each frame, s",
            scale: Scale::Logarithmic(0.0),
            curves: curves(|row| row.shortest),
        },
        Panel {
            title: "estimated error, body heights per second",
            scale: Scale::Logarithmic(1e-6),
            curves: curves(|row| row.error),
        },
        Panel {
            title: "iterations of Newton's method in a frame",
            scale: Scale::Logarithmic(0.0),
            curves: curves(|row| row.newton_iterations as f64),
        },
    ];
    let title = "Dinosaur: steps of time that follow from their error".to_owned();
    let note = "SDIRK2, Newton's method to the end. Frames of 1/30 s; the head is let go after 2 s.";
    let svg = sheet([1280, 500], &title, note, &panels)?;
    Ok(Chart { file: "tolerance-dinosaur.svg".to_owned(), svg, caption: title })
}

fn sheet(size: [u32; 2], title: &str, note: &str, panels: &[Panel]) -> Result<String, String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (size[0], size[1])).into_drawing_area();
        let below = headed(&root, title, note)?;
        for (panel, area) in panels.iter().zip(&below.split_evenly((1, panels.len()))) {
            panel.draw(area)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

impl Panel {
    fn draw(&self, area: &Area<'_>) -> Result<(), String> {
        let is_logarithmic = matches!(self.scale, Scale::Logarithmic(_));
        let [low, high] = self.range();
        let end =
            self.curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]).fold(0.0, f64::max);
        let mut chart = ChartBuilder::on(area)
            .margin(8)
            .margin_right(130)
            .caption(self.title, (FONT, 16))
            .x_label_area_size(42)
            .y_label_area_size(60)
            .build_cartesian_2d(0.0..end, low..high)
            .map_err(failed)?;
        let number = |y: &f64| if is_logarithmic { power(*y) } else { plain(*y) };
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .bold_line_style(RGBColor(225, 225, 225))
            .x_labels(6)
            .y_labels(9)
            .x_desc("time, s")
            .axis_desc_style((FONT, 14))
            .label_style((FONT, 13))
            .y_label_formatter(&number)
            .draw()
            .map_err(failed)?;
        let mut ends = Vec::new();
        for curve in &self.curves {
            let place = |&[time, y]: &[f64; 2]| (time, self.place(y).clamp(low, high));
            let points: Vec<(f64, f64)> = curve.points.iter().map(place).collect();
            if let Some(last) = points.last() {
                ends.push((chart.backend_coord(last), curve));
            }
            chart.draw_series([PathElement::new(points, curve.colour.stroke_width(2))]).map_err(failed)?;
        }
        // From above: none nearer to the one above it than a line, and then from below.
        let (_, bottom) = chart.backend_coord(&(end, low));
        ends.sort_by_key(|&((_, y), _)| y);
        let mut heights: Vec<i32> = ends.iter().map(|&((_, y), _)| y).collect();
        for index in 1..heights.len() {
            heights[index] = heights[index].max(heights[index - 1] + LINE);
        }
        let mut room = bottom;
        for height in heights.iter_mut().rev() {
            *height = (*height).min(room);
            room = *height - LINE;
        }
        let root = area.strip_coord_spec();
        let (left, above) = root.get_base_pixel();
        for (((x, _), curve), y) in ends.into_iter().zip(heights) {
            let style = (FONT, 13).into_font().color(&curve.colour).pos(Pos::new(HPos::Left, VPos::Center));
            let text = Text::new(curve.label.clone(), (x + 6 - left, y - above), style);
            root.draw(&text).map_err(failed)?;
        }
        Ok(())
    }

    /// Where a number is on the upright axis.
    fn place(&self, y: f64) -> f64 {
        match self.scale {
            Scale::Linear(..) => y,
            Scale::Logarithmic(least) => y.max(least).log10(),
        }
    }

    fn range(&self) -> [f64; 2] {
        match self.scale {
            Scale::Linear(low, high) => [low, high],
            Scale::Logarithmic(least) => {
                let numbers = self.curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
                let positive = numbers.filter(|y| *y > least && y.is_finite());
                let places = positive.map(f64::log10);
                let [low, high] = places
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
                if low > high { [-1.0, 1.0] } else { [low.floor(), high.ceil().max(low.floor() + 1.0)] }
            }
        }
    }
}

/// The number of which this is the decimal logarithm.
fn power(y: f64) -> String {
    let digits = if (y - y.round()).abs() < 1e-6 { 0 } else { 1 };
    format!("{:.digits$e}", 10f64.powf(y))
}

fn plain(y: f64) -> String {
    format!("{}", (y * 100.0).round() / 100.0)
}
