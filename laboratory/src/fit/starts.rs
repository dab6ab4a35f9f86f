//! Starting points of descents.

use piola::__private::random::Random;

use super::FitSettings;
use super::outcome::Standing;

/// The greatest factor between a random number and the one given.
const SPREAD: f64 = 10.0;
/// Draws for each descent; those that the energy refuses begin none.
const DRAWS: usize = 20;

/// The values given, then random ones: the free numbers multiplied by factors between 1/10 and 10, evenly by
/// their logarithms, and once in four with the other sign.
pub(super) fn around<'a>(
    values: &'a [f64],
    held: &'a [Option<Standing>],
    settings: &FitSettings,
) -> impl Iterator<Item = Vec<f64>> + 'a {
    let mut random = Random::new(settings.seed);
    let mut draw = move || {
        let other = |(&value, standing): (&f64, &Option<Standing>)| {
            let factor = SPREAD.powf(random.uniform(-1.0, 1.0));
            let sign = if random.once_in(4) { -1.0 } else { 1.0 };
            if standing.is_none() { sign * factor * value } else { value }
        };
        values.iter().zip(held).map(other).collect()
    };
    std::iter::once(values.to_vec()).chain((0..settings.restarts * DRAWS).map(move |_| draw()))
}

/// The values given, free numbers that are zero being 1: about zero nothing else is random, and a factor that
/// is zero hides others.
pub(super) fn without_zeros(values: &[f64], held: &[Option<Standing>]) -> Vec<f64> {
    let other = |(&value, standing): (&f64, &Option<Standing>)| {
        if value == 0.0 && standing.is_none() { 1.0 } else { value }
    };
    values.iter().zip(held).map(other).collect()
}
