//! A panel: curves and points over two axes, with a line for each mode above them.

use std::ops::Range;

use piola::__private::message::number;
use plotters::prelude::*;

use super::picture::{self, Area, ChartError, FONT, failed};
use super::{Curve, Group};
use crate::curve::{Mode, Response};
use crate::data::{Agreement, Measurements, short as determined};

/// Pixels of a line of the legend.
const LINE: i32 = 20;

/// Colours of Okabe and Ito, which stay apart for all kinds of colour vision.
fn colour(mode: Mode) -> RGBColor {
    match mode {
        Mode::Uniaxial => RGBColor(0, 114, 178),
        Mode::Equibiaxial => RGBColor(213, 94, 0),
        Mode::PureShear => RGBColor(0, 158, 115),
        Mode::SimpleShear => RGBColor(204, 121, 167),
        Mode::Volumetric => RGBColor(230, 159, 0),
    }
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

    pub(super) fn draw(&self, area: &Area<'_>, above: &mut String) -> Result<(), ChartError> {
        let (legend, plot) = area.split_vertically(LINE * self.series.len() as i32 + 4);
        for (row, series) in self.series.iter().enumerate() {
            series.explain(&legend, LINE * row as i32 + LINE / 2)?;
        }

        let lines = || self.series.iter().flat_map(|series| series.strokes.iter().flatten());
        let marks = || self.series.iter().flat_map(|series| &series.marks);
        let across = range(lines().chain(marks()).map(|point| point.0))?;
        // A curve that runs away from the data leaves the panel.
        let up = match marks().next() {
            Some(_) => range(marks().map(|point| point.1))?,
            None => range(lines().map(|point| point.1))?,
        };
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
            let x = (x - across.start) / (across.end - across.start);
            let y = (y / scale - up.start) / (up.end - up.start);
            (left + x * (right - left), bottom + y * (top - bottom))
        };
        for series in &self.series {
            let colour = colour(series.mode);
            let parts =
                series.strokes.iter().flat_map(|stroke| stroke.split(|(_, y)| !up.contains(&(y / scale))));
            for part in parts.filter(|part| part.len() > 1) {
                *above += &picture::curve(&part.iter().map(in_pixels).collect::<Vec<_>>(), colour, 2);
            }
            for mark in &series.marks {
                *above += &picture::dot(in_pixels(mark), 3, colour);
            }
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
    let parts = curve.points.split(Result::is_err).filter(|part| !part.is_empty());
    let point = |point: &Response| (point.control, point.stress);
    parts.map(|part| part.iter().flatten().map(point).collect()).collect()
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
