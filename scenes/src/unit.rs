//! Units of length in which meshes are drawn.

use serde::{Deserialize, Serialize};

/// Unit of the coordinates in the files of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum), value(rename_all = "lower"))]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// Micrometres.
    Um,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    #[default]
    M,
    /// Kilometres.
    Km,
    /// Inches.
    In,
    /// Feet.
    Ft,
}

impl Unit {
    /// Converts lengths in this unit to metres, rounded once for whole numbers: 12 mm are the number 0.012.
    pub(crate) fn convert(self, points: &mut [[f64; 3]]) {
        // Units below a metre are divided by: their sizes in metres would be rounded.
        let in_metres = |length: f64| match self {
            Self::Um => length / 1e6,
            Self::Mm => length / 1e3,
            Self::Cm => length / 1e2,
            Self::M => length,
            Self::Km => length * 1e3,
            Self::In => length * 254.0 / 1e4,
            Self::Ft => length * 3048.0 / 1e4,
        };
        points.as_flattened_mut().iter_mut().for_each(|x| *x = in_metres(*x));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_rounded_once() {
        let metres = [Unit::Um, Unit::Mm, Unit::Cm, Unit::M, Unit::Km, Unit::In, Unit::Ft].map(|unit| {
            let mut points = [[3.0, -7.0, 0.0]];
            unit.convert(&mut points);
            points[0]
        });
        let expected = [
            [3e-6, -7e-6, 0.0],
            [0.003, -0.007, 0.0],
            [0.03, -0.07, 0.0],
            [3.0, -7.0, 0.0],
            [3e3, -7e3, 0.0],
            [0.0762, -0.1778, 0.0],
            [0.9144, -2.1336, 0.0],
        ];
        assert_eq!(metres, expected);
    }
}
