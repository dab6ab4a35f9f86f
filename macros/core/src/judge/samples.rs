//! Points of the domain for tests of an energy.

use std::rc::Rc;

use super::finding::Finding;
use super::source::{Source, at_rest};
use crate::algebra::diff::Differentiator;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::interpret::{Estimate, Memo, Point, evaluate, evaluate_with};
use crate::read::domain::Volume;

/// Number of points at which identities are tested. One would do with probability 1; several refute bad luck.
const SAMPLES: usize = 6;

/// Number of points where exponents are drawn, which decide on the parity of a power: all of them even would
/// be bad luck.
const SAMPLES_OF_EXPONENTS: usize = 24;

/// Whole exponents that are drawn are below this.
const EXPONENTS: f64 = 5.0;

/// Candidates tried for [`SAMPLES`] admissible points: enough for parameters that must be in order, and for
/// decades of them up to 10⁹. Most are refused by the conditions alone, in microseconds.
pub(crate) const CANDIDATES: usize = 20_000;

/// Candidates before this one have positive parameters.
pub(crate) const POSITIVE: usize = CANDIDATES / 20;

/// Fewer samples than this prove nothing.
const FEWEST: usize = 2;

/// Longest list in samples: further entries are like the ones before.
const LONGEST: usize = 8;

/// Rounding errors of a few hundred operations, relative to the magnitudes that enter, stay below this.
const NOISE: f64 = 1e-12;

/// Points of the domain at which the energy and its derivatives are finite.
///
/// # Errors
/// The finding that there are none.
pub(crate) fn samples(graph: &mut Graph, source: &Source<'_>) -> Result<Vec<Point>, Finding> {
    let &Source { declaration, energy, .. } = source;
    let gradient = Differentiator::default().by_stretch(graph, energy, 0);
    let attempts = if graph.is_full() { 0 } else { CANDIDATES };
    let mut found = Vec::new();
    let mut excludes_rest = None;
    let wanted = if declaration.has_whole_exponents() { SAMPLES_OF_EXPONENTS } else { SAMPLES };
    for point in candidates(source, 0x9E37_79B9_7F4A_7C15, 0..attempts) {
        let holds = |id: Id, point: &Point| evaluate(graph, id, point).value > 0.0;
        if !source.admissible.iter().all(|&id| holds(id, &point)) {
            continue;
        }
        let rest = at_rest(&point);
        if let Some(k) = source.bounds.iter().position(|&id| !holds(id, &rest)) {
            excludes_rest = Some(k);
            continue;
        }
        let mut memo = Memo::default();
        let mut is_finite = |id| evaluate_with(graph, id, &point, &mut memo).value.is_finite();
        if source.is_inside(graph, &point) && is_finite(energy) && is_finite(gradient) {
            found.push(point);
        }
        if found.len() == wanted {
            return Ok(found);
        }
    }
    if found.len() >= FEWEST {
        return Ok(found);
    }
    Err(match excludes_rest.and_then(|k| declaration.bounds().nth(k)) {
        Some(condition) => Finding::new(
            condition,
            "this excludes the rest state λ1 = λ2 = λ3 = 1, where every body starts: widen the domain",
        ),
        None => Finding::new(
            &declaration.name,
            "no parameters were found for which this energy is finite near rest: check its domain \
             and `admissible(…)`",
        ),
    })
}

/// Points with stretches near rest and parameters over ever more decades, negative ones from [`POSITIVE`] on.
pub(crate) fn candidates(
    source: &Source<'_>,
    seed: u64,
    attempts: impl Iterator<Item = usize>,
) -> impl Iterator<Item = Point> {
    let declaration = source.declaration;
    let lengths = declaration.lengths.iter().map(|length| length.stated().unwrap_or(3).min(LONGEST));
    let lengths: Vec<usize> = lengths.collect();
    let entries = declaration.parameters.iter().map(|parameter| {
        let number = parameter.length().map_or(1, |k| lengths[k]);
        (number, parameter.is_whole)
    });
    let entries: Vec<_> = entries.collect();
    let has_negative = source.volume != Volume::Positive;
    let mut random = Random(seed);
    attempts.map(move |attempt| {
        let decades = 1.0 + 15.0 * attempt as f64 / CANDIDATES as f64;
        let mut value = |is_whole| {
            if is_whole {
                return (EXPONENTS * random.unit()).floor();
            }
            let magnitude = 10f64.powf(decades * (random.unit() - 0.4));
            if attempt > POSITIVE && random.unit() < 0.3 { -magnitude } else { magnitude }
        };
        let mut list = |&(number, is_whole): &(usize, bool)| (0..number).map(|_| value(is_whole)).collect();
        let parameters = Rc::new(entries.iter().map(&mut list).collect());
        let mut stretches = [0, 1, 2].map(|_| 0.6 + 0.9 * random.unit());
        if has_negative && attempt % 2 == 1 {
            stretches[2] = -stretches[2];
        }
        Point { stretches, parameters, lengths: lengths.clone(), epsilon: 0.5 }
    })
}

/// Candidates that are good at rest, with all entries of each list replaced by its first one, so that a
/// condition on their sum holds for each.
pub(crate) fn draws(
    graph: &Graph,
    source: &Source<'_>,
    seed: u64,
    attempts: std::ops::Range<usize>,
) -> impl Iterator<Item = Point> {
    let with_equal_entries = |mut point: Point| {
        for entries in Rc::make_mut(&mut point.parameters) {
            let first = entries.first().copied().unwrap_or_default();
            entries.fill(first);
        }
        point
    };
    let points = candidates(source, seed, attempts).map(with_equal_entries);
    points.filter(move |point| source.is_good_at_rest(graph, point))
}

/// True if a value is zero up to rounding.
pub(crate) fn is_zero(Estimate { value, magnitude }: Estimate) -> bool {
    value.abs() <= NOISE * magnitude
}

/// True if a value is negative beyond rounding.
pub(crate) fn is_negative(Estimate { value, magnitude }: Estimate) -> bool {
    value < -NOISE * magnitude
}

/// SplitMix64: Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, 2014.
struct Random(u64);

impl Random {
    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}
