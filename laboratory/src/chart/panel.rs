//! A panel: curves and points over two axes, with a line for each mode above them.

use std::fmt;
use std::ops::Range;

use piola::__private::message::number;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::fine::Fine;
use super::{Curve, Group};
use crate::curve::Mode;
use crate::data::{Agreement, Measurements, short as determined};

pub(super) const FONT: &str = "sans-serif";
pub(super) const GREY: RGBColor = RGBColor(90, 90, 90);
/// Pixels of a line of the legend.
const LINE: i32 = 20;

/// Colours of Okabe and Ito, which stay apart for all kinds of colour vision.
pub(super) fn colour(mode: Mode) -> RGBColor {
    match mode {
        Mode::Uniaxial => RGBColor(0, 114, 178),
        Mode::Equibiaxial => RGBColor(213, 94, 0),
        Mode::PureShear => RGBColor(0, 158, 115),
        Mode::SimpleShear => RGBColor(204, 121, 167),
        Mode::Volumetric => RGBColor(230, 159, 0),
    }
}

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Reason why there is no chart.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ChartError(pub(super) String);

/// The message of a chart without a point.
pub(super) const EMPTY: &str = "there is no point to draw: the material has no stress at any of them";

pub(super) fn failed(error: impl fmt::Display) -> ChartError {
    ChartError(format!("the chart cannot be drawn: {error}"))
}

/// Writes a text at one side of a place, at its height.
pub(super) fn write(
    area: &Area<'_>,
    text: &str,
    place: (i32, i32),
    side: HPos,
    size: i32,
    colour: &RGBColor,
) -> Result<(), ChartError> {
    let style = (FONT, size).into_font().color(colour).pos(Pos::new(side, VPos::Center));
    area.draw(&Text::new(text.to_owned(), place, style)).map_err(failed)
}

/// The rest of an area below a title and a note of this many pixels.
pub(super) fn head<'a>(
    root: &Area<'a>,
    title: &str,
    note: &str,
    height: u32,
) -> Result<Area<'a>, ChartError> {
    root.fill(&WHITE).map_err(failed)?;
    let (head, below) = root.split_vertically(height);
    head.draw(&Text::new(title.to_owned(), (20, 12), (FONT, 20).into_font())).map_err(failed)?;
    head.draw(&Text::new(note.to_owned(), (20, 40), (FONT, 14).into_font().color(&GREY))).map_err(failed)?;
    Ok(below)
}

pub(super) struct Panel<'a> {
    group: &'a Group,
    series: Vec<Series>,
}

/// A mode's curve and measured points: control and stress, Pa.
struct Series {
    mode: Mode,
    /// The parts between gaps.
    strokes: Vec<Vec<(f64, f64)>>,
    marks: Vec<(f64, f64)>,
    determination: Option<f64>,
}

impl<'a> Panel<'a> {
    /// `None` where nothing of the group is to be drawn.
    pub(super) fn of(
        group: &'a Group,
        curves: &[Curve],
        data: Option<(&Measurements, &Agreement)>,
    ) -> Option<Self> {
        let series = group.modes.iter().map(|&mode| {
            let curves = curves.iter().filter(|curve| curve.mode == mode);
            let points = data.into_iter().flat_map(|(data, _)| data.of(mode));
            let agreement =
                data.and_then(|(_, agreement)| agreement.modes.iter().find(|(of, _)| *of == mode));
            Series {
                mode,
                strokes: curves.flat_map(strokes).collect(),
                marks: points.map(|point| (point.control, point.stress)).collect(),
                determination: agreement.and_then(|(_, determination)| *determination),
            }
        });
        let is_used = |series: &Series| !series.strokes.is_empty() || !series.marks.is_empty();
        let series: Vec<_> = series.filter(is_used).collect();
        (!series.is_empty()).then_some(Self { group, series })
    }

    pub(super) fn draw(&self, area: &Area<'_>, fine: &mut Fine) -> Result<(), ChartError> {
        let (legend, plot) = area.split_vertically(LINE * self.series.len() as i32 + 4);
        for (row, series) in self.series.iter().enumerate() {
            series.explain(&legend, LINE * row as i32 + LINE / 2)?;
        }

        let lines = || self.series.iter().flat_map(|series| series.strokes.iter().flatten());
        let marks = || self.series.iter().flat_map(|series| &series.marks);
        let across = range(lines().chain(marks()).map(|point| point.0))?;
        // A curve that runs away from the data leaves the panel.
        let up = if marks().next().is_some() {
            range(marks().map(|point| point.1))
        } else {
            range(lines().map(|p| p.1))
        }?;
        let (unit, scale) = unit(up.start.abs().max(up.end.abs()));
        let up = up.start / scale..up.end / scale;

        let mut chart = ChartBuilder::on(&plot)
            .margin(10)
            .x_label_area_size(46)
            .y_label_area_size(70)
            .build_cartesian_2d(across.clone(), up.clone())
            .map_err(failed)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .bold_line_style(RGBColor(228, 228, 228))
            .x_labels(8)
            .y_labels(8)
            .x_desc(self.group.control)
            .y_desc(format!("{} ({unit})", self.group.stress))
            .axis_desc_style((FONT, 15))
            .label_style((FONT, 13))
            .x_label_formatter(&|x| short(*x, across.end - across.start))
            .y_label_formatter(&|y| short(*y, up.end - up.start))
            .draw()
            .map_err(failed)?;
        let ends = [(across.start, up.start), (across.end, up.end)].map(|end| chart.backend_coord(&end));
        let [(left, bottom), (right, top)] = ends.map(|(x, y)| (f64::from(x), f64::from(y)));
        let in_pixels = |&(x, y): &(f64, f64)| {
            let (x, y) =
                ((x - across.start) / (across.end - across.start), (y - up.start) / (up.end - up.start));
            (left + x * (right - left), bottom + y * (top - bottom))
        };
        for series in &self.series {
            let colour = colour(series.mode);
            for stroke in &series.strokes {
                for part in stroke
                    .iter()
                    .map(|&(x, y)| (x, y / scale))
                    .collect::<Vec<_>>()
                    .split(|(_, y)| !up.contains(y))
                {
                    if part.len() > 1 {
                        fine.curve(&part.iter().map(in_pixels).collect::<Vec<_>>(), colour, 2);
                    }
                }
            }
            series.marks.iter().for_each(|&(x, y)| fine.dot(in_pixels(&(x, y / scale)), 3, colour));
        }
        Ok(())
    }
}

impl Series {
    /// A line of the legend at this height.
    fn explain(&self, legend: &Area<'_>, y: i32) -> Result<(), ChartError> {
        const LEFT: i32 = 80;
        let colour = colour(self.mode);
        if !self.strokes.is_empty() {
            let line = PathElement::new([(LEFT, y), (LEFT + 28, y)], colour.stroke_width(2));
            legend.draw(&line).map_err(failed)?;
        }
        if !self.marks.is_empty() {
            legend.draw(&Circle::new((LEFT + 14, y), 3, colour.filled())).map_err(failed)?;
        }
        let mut text = self.mode.name().replace('_', " ");
        if let Some(determination) = self.determination {
            text += &format!(", R² = {}", determined(determination));
        }
        legend.draw(&Text::new(text, (LEFT + 38, y - 6), (FONT, 15).into_font())).map_err(failed)
    }
}

/// The parts of a curve between the points that are missing.
fn strokes(curve: &Curve) -> Vec<Vec<(f64, f64)>> {
    let parts = curve.points.split(|point| point.is_err());
    let part = |part: &[Result<_, _>]| {
        let points =
            part.iter().flatten().map(|point: &crate::curve::Response| (point.control, point.stress));
        points.collect::<Vec<_>>()
    };
    parts.map(part).filter(|part| !part.is_empty()).collect()
}

/// Size of the greatest number on an axis.
const MOST: f64 = 1e100;

/// Range from a little below the least number to a little above the greatest. Between ticks that are equal up
/// to rounding the library of charts would search for others forever.
fn range(numbers: impl Iterator<Item = f64>) -> Result<Range<f64>, ChartError> {
    let (from, to) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), x| {
        if x.is_nan() || least.is_nan() { (f64::NAN, f64::NAN) } else { (x.min(least), x.max(greatest)) }
    });
    let largest = from.abs().max(to.abs());
    if largest.is_nan() || largest > MOST {
        return Err(ChartError(format!(
            "an axis of the chart would have to be from {} to {}; its ends must be at most {MOST:e} in size",
            number(from),
            number(to)
        )));
    }
    let (size, least_size) = (to - from, 1e-9 * largest);
    let margin = match size > least_size {
        true => 0.04 * size,
        false if largest > 0.0 => 0.5 * largest,
        false => 1.0,
    };
    Ok(from - margin..to + margin)
}

/// A unit in which stresses up to this one, Pa, have few digits before the point, and its size in Pa.
fn unit(greatest: f64) -> (&'static str, f64) {
    match greatest {
        1e9.. => ("GPa", 1e9),
        1e5.. => ("MPa", 1e6),
        1e2.. => ("kPa", 1e3),
        _ => ("Pa", 1.0),
    }
}

/// A number at a tick of an axis of this length.
fn short(x: f64, length: f64) -> String {
    let digits = (1.0 - length.log10()).ceil().max(0.0);
    if digits > 6.0 || length >= 1e6 {
        return format!("{x:.2e}");
    }
    let text = format!("{x:.0$}", digits as usize);
    // No minus before zero.
    if text.trim_start_matches(['-', '0', '.']).is_empty() { "0".into() } else { text }
}
