//! Curves and dots in tenths of a pixel: the library of charts rounds coordinates to whole pixels.

use plotters::style::RGBColor;

/// Elements of SVG above a chart.
#[derive(Debug, Default)]
pub(super) struct Fine {
    elements: String,
}

impl Fine {
    /// A curve through points in pixels.
    pub(super) fn curve(&mut self, points: &[(f64, f64)], colour: RGBColor, width: u32) {
        let points = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>();
        let (points, colour) = (points.join(" "), hexadecimal(colour));
        self.elements += &format!(
            "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{points}\"/>\n"
        );
    }

    /// A dot around a point in pixels.
    pub(super) fn dot(&mut self, (x, y): (f64, f64), radius: u32, colour: RGBColor) {
        let colour = hexadecimal(colour);
        self.elements += &format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>\n");
    }

    /// The text of a chart with these elements above it.
    pub(super) fn above(self, mut svg: String) -> String {
        let end = svg.rfind("</svg>").unwrap_or(svg.len());
        svg.insert_str(end, &self.elements);
        svg
    }
}

fn hexadecimal(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_one_decimal() {
        let mut fine = Fine::default();
        fine.curve(&[(10.04, 20.06), (11.0, 1e3 / 3.0)], RGBColor(0, 114, 178), 2);
        fine.dot((1.25, 2.0), 3, RGBColor(0, 0, 0));
        let elements = "<polyline fill=\"none\" stroke=\"#0072B2\" stroke-width=\"2\" points=\"10.0,20.1 11.0,333.3\"/>\n\
                        <circle cx=\"1.2\" cy=\"2.0\" r=\"3\" fill=\"#000000\"/>\n";
        assert_eq!(fine.above("<svg>\n</svg>\n".to_owned()), format!("<svg>\n{elements}</svg>\n"));
    }
}
