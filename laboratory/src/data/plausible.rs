//! Plausibility of measurements: strains under `stretch`, percent without a word, signs of compression.

use piola::__private::message::{number, quoted};

use super::fault::DataError;
use super::heading::{Heading, Quantity};
use super::measured::Measured;
use super::options::Test;
use crate::curve::Mode;

/// Stretches that are unlikely for rubber: numbers that are all beyond the first, or some beyond the second,
/// are strains in percent unless their header has a unit.
const FAR: (f64, f64) = (8.0, 20.0);
/// Strains that are noise or slack: this value, or a tenth of the greatest if that is less.
const SMALL: f64 = 0.02;

/// Refuses points of a table, with line and test of each, that are unlikely to be what their header names.
pub(super) fn check(points: &[Measured], rows: &[(u64, Test)], column: &Heading) -> Result<(), DataError> {
    for mode in Mode::ALL {
        let points: Vec<_> = points.iter().zip(rows).filter(|(point, _)| point.mode == mode).collect();
        let strain = |point: &Measured| point.control - mode.rest();
        let greatest = |size: &dyn Fn(&Measured) -> f64| {
            points.iter().map(|(point, _)| size(point).abs()).fold(0.0, f64::max)
        };
        let (range, peak) = (greatest(&strain), greatest(&|point| point.stress));
        let is_pulled = points.iter().all(|(point, _)| point.stress > -0.01 * peak);
        if column.unit.is_none() && mode != Mode::Volumetric {
            let mut controls = points.iter().filter(|(point, _)| strain(point).abs() > SMALL);
            let least = controls.clone().map(|(point, _)| point.control).fold(f64::INFINITY, f64::min);
            let most = controls.clone().map(|(point, _)| point.control).fold(0.0, f64::max);
            if let Some((_, (line, _))) = controls.next()
                && (least > FAR.0 || most > FAR.1)
            {
                let is_stretch = column.quantity == Quantity::Stretch;
                let mistake = format!(
                    "`{}` of {mode} makes {} from {} to {}: are the numbers percent? Then write `strain [%]`; if they are \
                     as large as that, `{}`",
                    quoted(&column.text),
                    mode.letter(),
                    number(least),
                    number(most),
                    if is_stretch { "stretch [-]" } else { "strain [-]" }
                );
                return Err(DataError::at(*line, mistake));
            }
        }
        for &(point, &(line, test)) in &points {
            let &Measured { control, stress, .. } = point;
            let strain = strain(point);
            // Unloaded rubber has some stress of the other sign. Where no stress is one of compression,
            // a little tells strains under `stretch`.
            let noise = if strain < 0.0 && is_pulled { 0.01 } else { 0.1 };
            if strain.abs() <= SMALL.min(0.1 * range) || stress.abs() <= noise * peak {
                continue;
            }
            let question = if (test.is_compression || column.is_compressive) && strain > 0.0 {
                ", but the test is a compression"
            } else if (strain > 0.0) != (stress > 0.0) {
                ", of another sign than its strain; is the number a strain, or a compression?"
            } else {
                continue;
            };
            let mistake = format!(
                "{mode} {} = {} has a stress of {} Pa{question}: a strain is written under `strain` or `strain [%]`, a \
                 compression with negative strain and stress or under `compressive strain` and `compressive stress`",
                mode.letter(),
                number(control),
                number(stress)
            );
            return Err(DataError::at(line, mistake));
        }
    }
    Ok(())
}
