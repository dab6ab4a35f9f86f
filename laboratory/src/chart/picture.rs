//! What pictures have in common: their SVG, title and note, and curves and dots in tenths of a pixel,
//! as the library of charts rounds coordinates to whole pixels.

use std::fmt;

use plotters::coord::Shift;
use plotters::prelude::*;

pub(super) const FONT: &str = "sans-serif";
const GREY: RGBColor = RGBColor(90, 90, 90);
/// Pixels for title and note.
pub(super) const HEAD: u32 = 62;

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Reason why there is no chart.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ChartError(pub(super) String);

pub(super) fn failed(error: impl fmt::Display) -> ChartError {
    ChartError(format!("the chart cannot be drawn: {error}"))
}

/// The SVG text of a picture of this size, with the [`curve`]s and [`dot`]s that `draw` adds to a text above
/// what it draws into an area.
pub(super) fn picture(
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>, &mut String) -> Result<(), ChartError>,
) -> Result<String, ChartError> {
    let (mut svg, mut above) = (String::new(), String::new());
    {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        draw(&root, &mut above)?;
        root.present().map_err(failed)?;
    }
    let end = svg.rfind("</svg>").unwrap_or(svg.len());
    svg.insert_str(end, &above);
    Ok(svg)
}

/// The rest of an area below a title and a note.
pub(super) fn head<'a>(root: &Area<'a>, title: &str, note: &str) -> Result<Area<'a>, ChartError> {
    let (head, below) = root.split_vertically(HEAD);
    head.draw(&Text::new(title.to_owned(), (20, 12), (FONT, 20).into_font())).map_err(failed)?;
    head.draw(&Text::new(note.to_owned(), (20, 40), (FONT, 14).into_font().color(&GREY))).map_err(failed)?;
    Ok(below)
}

/// A curve through points in pixels.
pub(super) fn curve(points: &[(f64, f64)], colour: RGBColor, width: u32) -> String {
    let points = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>();
    let (points, colour) = (points.join(" "), hexadecimal(colour));
    format!("<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{points}\"/>\n")
}

/// A dot around a point in pixels.
pub(super) fn dot((x, y): (f64, f64), radius: u32, colour: RGBColor) -> String {
    let colour = hexadecimal(colour);
    format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>\n")
}

fn hexadecimal(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_one_decimal() -> Result<(), ChartError> {
        let elements = "<polyline fill=\"none\" stroke=\"#0072B2\" stroke-width=\"2\" points=\"10.0,20.1 11.0,333.3\"/>\n\
                        <circle cx=\"1.2\" cy=\"2.0\" r=\"3\" fill=\"#000000\"/>\n";
        let svg = picture((10, 10), |_, above| {
            *above += &curve(&[(10.04, 20.06), (11.0, 1e3 / 3.0)], RGBColor(0, 114, 178), 2);
            *above += &dot((1.25, 2.0), 3, BLACK);
            Ok(())
        })?;
        assert!(svg.trim_end().ends_with(&format!("{elements}</svg>")), "{svg}");
        Ok(())
    }
}
