//! A panel: marks and lines over two logarithmic axes, with labels next to the marks.

use std::fmt::Display;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
pub(crate) use plotters::style::{Color, RGBColor, ShapeStyle};

/// Colours of Okabe and Ito, which stay apart for all kinds of colour vision.
pub(crate) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(crate) const GREY: RGBColor = RGBColor(90, 90, 90);

pub(super) const FONT: &str = "sans-serif";
/// Height of a label, pixels.
pub(super) const LINE: i32 = 14;

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x_axis: &'static str,
    pub(crate) y_axis: &'static str,
    pub(crate) series: Vec<Series>,
}

/// Marks that belong together.
pub(crate) struct Series {
    pub(crate) colour: RGBColor,
    pub(crate) mark: Option<ShapeStyle>,
    pub(crate) line: Line,
    pub(crate) points: Vec<Point>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Line {
    None,
    Solid,
    Dashed,
}

/// Place and label of a mark; an error that is NaN goes to the upper edge.
#[derive(Clone)]
pub(crate) struct Point {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) label: String,
}

/// Draws panels in rows of `columns`, below a title and a line that explains.
pub(crate) fn sheet(
    [width, height]: [u32; 2],
    columns: usize,
    title: &str,
    note: &str,
    panels: &[Panel],
) -> Result<String, String> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (width, height)).into_drawing_area();
        let below = headed(&root, title, note)?;
        let areas = below.split_evenly((panels.len().div_ceil(columns), columns));
        for (panel, area) in panels.iter().zip(&areas) {
            panel.draw(area)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

/// Area that remains below a title and a note.
pub(crate) fn headed<'a>(root: &Area<'a>, title: &str, note: &str) -> Result<Area<'a>, String> {
    root.fill(&WHITE).map_err(failed)?;
    let text = |size: f64, colour: RGBColor| (FONT, size).into_font().color(&colour);
    root.draw(&Text::new(title.to_owned(), (20, 14), text(22.0, BLACK))).map_err(failed)?;
    root.draw(&Text::new(note.to_owned(), (20, 44), text(14.0, GREY))).map_err(failed)?;
    Ok(root.margin(66, 10, 10, 10))
}

pub(crate) fn failed(error: impl Display) -> String {
    format!("a chart cannot be drawn: {error}")
}

impl Panel {
    fn draw(&self, area: &Area<'_>) -> Result<(), String> {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let x_range = range(points().map(|point| point.x), 0.05, 0.45);
        let y_range = range(points().map(|point| point.y), 0.05, 0.05);
        let is_lost = points().any(|point| !point.y.is_finite());
        // A band at the upper edge for NaN.
        let ceiling = y_range.end;
        let top = if is_lost { ceiling * (ceiling / y_range.start).powf(0.08) } else { ceiling };
        let lost = (ceiling * top).sqrt();
        let place = |point: &Point| (point.x, if point.y.is_finite() { point.y } else { lost });

        let mut chart = ChartBuilder::on(area)
            .margin(8)
            .caption(&self.title, (FONT, 17))
            .x_label_area_size(42)
            .y_label_area_size(66)
            .build_cartesian_2d((x_range.start..x_range.end).log_scale(), (y_range.start..top).log_scale())
            .map_err(failed)?;
        let small = (FONT, 13).into_font();
        chart
            .configure_mesh()
            .light_line_style(RGBColor(244, 244, 244))
            .bold_line_style(RGBColor(225, 225, 225))
            .x_labels(5)
            .x_desc(self.x_axis)
            .y_desc(self.y_axis)
            .axis_desc_style((FONT, 14))
            .label_style(small.clone())
            .x_label_formatter(&|x| short(*x))
            .y_label_formatter(&|y| if *y > ceiling { String::new() } else { short(*y) })
            .draw()
            .map_err(failed)?;
        if is_lost {
            let edge = [(x_range.start, ceiling), (x_range.end, ceiling)];
            chart.draw_series([PathElement::new(edge, GREY.mix(0.5))]).map_err(failed)?;
            let style = small.color(&BLACK).pos(Pos::new(HPos::Right, VPos::Center));
            let note = EmptyElement::at((x_range.start, lost)) + Text::new("∞ or NaN", (-6, 0), style);
            chart.draw_series([note]).map_err(failed)?;
        }
        let (mut labels, mut marks) = (Vec::new(), Vec::new());
        for series in &self.series {
            let places: Vec<_> = series.points.iter().map(place).collect();
            let stroke = series.colour.stroke_width(2);
            match series.line {
                Line::None => {}
                Line::Solid => {
                    chart.draw_series([PathElement::new(places.clone(), stroke)]).map_err(failed)?;
                }
                Line::Dashed => {
                    let dashes = DashedLineSeries::new(places.clone(), 6, 4, stroke);
                    chart.draw_series(dashes).map_err(failed)?;
                }
            }
            if let Some(style) = series.mark {
                let marks = places.iter().map(|&place| Circle::new(place, 4, style));
                chart.draw_series(marks).map_err(failed)?;
            }
            for (point, &place) in series.points.iter().zip(&places) {
                if series.mark.is_some() {
                    marks.push(chart.backend_coord(&place));
                }
                if !point.label.is_empty() {
                    let (x, y) = chart.backend_coord(&place);
                    labels.push(Label { place, x, y, text: &point.label, colour: series.colour });
                }
            }
        }
        let (left, lowest) = chart.backend_coord(&(x_range.start, y_range.start));
        let (_, highest) = chart.backend_coord(&(x_range.start, top));
        for (label, y, is_left) in spread(&mut labels, &marks, left, highest..lowest) {
            let (side, across) = if is_left { (HPos::Right, -10) } else { (HPos::Left, 10) };
            let style = (FONT, 13).into_font().color(&label.colour).pos(Pos::new(side, VPos::Center));
            let shift = y - label.y;
            if shift.abs() > LINE {
                let leader = EmptyElement::at(label.place)
                    + PathElement::new([(0, 0), (across, shift)], label.colour.mix(0.5));
                chart.draw_series([leader]).map_err(failed)?;
            }
            let text =
                EmptyElement::at(label.place) + Text::new(label.text.to_owned(), (across, shift), style);
            chart.draw_series([text]).map_err(failed)?;
        }
        Ok(())
    }
}

struct Label<'a> {
    place: (f64, f64),
    /// Pixels.
    x: i32,
    y: i32,
    text: &'a str,
    colour: RGBColor,
}

/// The labels, each with its height in pixels and true if it is to the left of its mark: none over another or
/// over a mark, each as near to its mark as those before it leave room.
fn spread<'a>(
    labels: &'a mut [Label<'a>],
    marks: &[(i32, i32)],
    left: i32,
    heights: Range<i32>,
) -> Vec<(&'a Label<'a>, i32, bool)> {
    labels.sort_by_key(|label| (label.y, label.x));
    let mut taken: Vec<[Range<i32>; 2]> = marks.iter().map(|&(x, y)| [x..x + 1, y - 4..y + 4]).collect();
    let placed = labels.iter().map(|label| {
        // Roughly. Its own mark, and those over it, are at its side.
        let width = 16 + 7 * label.text.chars().count() as i32;
        let frame = |(y, is_left): (i32, bool)| {
            let across = if is_left { label.x - width..label.x - 4 } else { label.x + 5..label.x + width };
            [across, y - LINE / 2..y + LINE / 2]
        };
        let is_free = |&spot: &(i32, bool)| {
            let [x, y] = frame(spot);
            let is_clear = |[a, b]: &[Range<i32>; 2]| {
                a.end <= x.start || x.end <= a.start || b.end <= y.start || y.end <= b.start
            };
            let is_inside = heights.start + 6 < spot.0 && spot.0 < heights.end - 4 && left < x.start;
            is_inside && taken.iter().all(is_clear)
        };
        let beside = |is_left: bool, steps: Range<i32>| {
            steps.flat_map(move |k| [(label.y + 3 * k, is_left), (label.y - 3 * k, is_left)])
        };
        let mut spots = beside(false, 0..8).chain(beside(true, 0..8)).chain(beside(false, 8..60));
        let spot = spots.find(is_free).unwrap_or((label.y, false));
        taken.push(frame(spot));
        (label, spot.0, spot.1)
    });
    placed.collect()
}

/// Range from below the least finite number to above the greatest, by these shares of the decades between
/// them; two decades at least, so that the axis has numbers.
fn range(numbers: impl Iterator<Item = f64>, below: f64, above: f64) -> Range<f64> {
    let finite = numbers.filter(|x| x.is_finite() && *x > 0.0);
    let (least, greatest) = finite.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    if least > greatest {
        return 0.1..10.0;
    }
    let missing = 0.5 * (2.0 - (greatest / least).log10()).max(0.0);
    let decades = (greatest / least).log10().max(2.0);
    let (below, above) = (missing + below * decades, missing + above * decades);
    least * 10f64.powf(-below)..greatest * 10f64.powf(above)
}

pub(crate) fn short(x: f64) -> String {
    let exponent = x.log10();
    if (-2.0..4.0).contains(&exponent) {
        format!("{}", (x * 1000.0).round() / 1000.0)
    } else if (exponent - exponent.round()).abs() < 1e-6 {
        format!("1e{}", exponent.round())
    } else {
        format!("{x:.0e}")
    }
}
