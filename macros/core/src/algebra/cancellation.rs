//! Sums that cancel far from rest: if an element is flat, a line, or huge.
//!
//! Near rest every energy cancels, and rounding of the deformation gradient alone explains what is lost. Far
//! from there nothing does. Papers write 1 + B with B = κ² (s − 1)/(s + κ)², which for s → 0 is s (2/κ + 1),
//! as the difference of two numbers near 1: at s = 1e-16 it has no digit. Over one denominator the numbers
//! that cancel do so as exact fractions,
//!
//! ```text
//! 1 + B = (s² + κ² s + 2 κ s)/(s + κ)²
//! ```
//!
//! and what is left has no cancellation. [`over_one_denominator`] does that where it helps, which is tried at
//! points; it changes no other sum. [`lossy`] finds the sums that cancel all the same, and matter.

use std::cell::RefCell;

use rustc_hash::FxHashMap;

use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::interpret::{Memo, Point, evaluate_with};
use crate::algebra::rational::Rational;
use crate::algebra::volume::rebuild;

/// Factors of a stretch, from near to far.
const FAR: [f64; 2] = [1e-3, 1e-6];

/// Largest cancellation that is accepted, at 1e-6 of a stretch: three of sixteen digits.
const BEARABLE: f64 = 1e3;

/// The least growth of a cancellation, from the first factor to the second, that is not by chance: a root of
/// the stretch grows by this much, a chance crossing of zero not at all.
const GROWTH: f64 = 30.0;

/// Nodes that are evaluated to find the sums that matter: a few tenths of a second.
const MOST_EVALUATED: usize = 10_000_000;

/// Points at which cancellation shows: two for each way out, the first one nearer to rest.
#[derive(Debug)]
pub struct Ways {
    ways: Vec<[Point; 2]>,
    /// Values of nodes at each of these points.
    values: RefCell<Vec<[Memo; 2]>>,
}

impl Ways {
    /// Paths to flat, thin and huge material from points near rest, where they are inside the domain.
    #[must_use]
    pub fn new(samples: &[Point], is_inside: impl Fn(&Point) -> bool) -> Self {
        let moved = |sample: &Point, chosen: [bool; 3], factor: f64| {
            let mut point = sample.clone();
            for (stretch, is_chosen) in point.stretches.iter_mut().zip(chosen) {
                *stretch = if is_chosen { stretch.abs() * factor } else { stretch.abs() };
            }
            point
        };
        // One stretch vanishes, or two, or one grows.
        let sets = [0b001, 0b010, 0b100, 0b011, 0b101, 0b110].map(|set| [0, 1, 2].map(|k| set >> k & 1 == 1));
        let shrinking =
            samples.iter().flat_map(|sample| sets.map(|set| FAR.map(|factor| moved(sample, set, factor))));
        let growing = samples.iter().flat_map(|sample| {
            [sets[0], sets[1], sets[2]].map(|set| FAR.map(|factor| moved(sample, set, 1.0 / factor)))
        });
        Self::through(shrinking.chain(growing).filter(|way| way.iter().all(&is_inside)).collect())
    }

    fn through(ways: Vec<[Point; 2]>) -> Self {
        let values = ways.iter().map(|_| Default::default()).collect();
        Self { ways, values: RefCell::new(values) }
    }

    /// Paths by invariants, for energies in which λ1, λ2, λ3 of the graph stand for I1, I2, J.
    #[must_use]
    pub fn by_invariants(&self) -> Self {
        let moved = |point: &Point| {
            let [l1, l2, l3] = point.stretches;
            let [a, b, c] = point.stretches.map(|l| l * l);
            Point { stretches: [a + b + c, a * b + b * c + c * a, l1 * l2 * l3], ..point.clone() }
        };
        Self::through(self.ways.iter().map(|way| way.each_ref().map(moved)).collect())
    }

    /// Paths on which the cancellation of a sum grows beyond the limit, each with its size at the end.
    fn cancelling<'a>(&'a self, graph: &'a Graph, sum: Id) -> impl Iterator<Item = (f64, &'a [Point; 2])> {
        self.ways.iter().enumerate().filter_map(move |(place, way)| {
            let mut values = self.values.borrow_mut();
            let [near, far] = [0, 1].map(|k| ratio(graph, sum, &way[k], &mut values[place][k]));
            (far > BEARABLE && far > GROWTH * near).then_some((far, way))
        })
    }

    /// The largest cancellation of a sum, 1 if none grows.
    fn worst(&self, graph: &Graph, sum: Id) -> f64 {
        self.cancelling(graph, sum).fold(1.0, |worst, (ratio, _)| worst.max(ratio))
    }
}

/// Ratio of the terms of a sum to the sum at a point; NaN if a term has no value.
fn ratio(graph: &Graph, sum: Id, point: &Point, memo: &mut Memo) -> f64 {
    let Node::Linear { constant, terms } = graph.node(sum) else { return 1.0 };
    let (mut value, mut size) = (constant.to_f64(), constant.to_f64().abs());
    for &(term, coefficient) in terms {
        let term = coefficient.to_f64() * evaluate_with(graph, term, point, memo).value;
        value += term;
        size += term.abs();
    }
    size / value.abs()
}

/// The energy with sums of fractions over one denominator, if the sum cancels and the numerator, multiplied
/// out, does not.
pub fn over_one_denominator(graph: &mut Graph, energy: Id, ways: &Ways) -> Id {
    rebuild(graph, energy, &mut FxHashMap::default(), &mut |graph, mapped| {
        joined(graph, mapped, ways).unwrap_or(mapped)
    })
}

/// A sum of fractions as one fraction, if that avoids a cancellation.
fn joined(graph: &mut Graph, sum: Id, ways: &Ways) -> Option<Id> {
    let Node::Linear { constant, terms } = graph.node(sum).clone() else { return None };
    let mut denominator: Vec<(Id, Exponent)> = Vec::new();
    for &(term, _) in &terms {
        for (base, exponent) in graph.factors(term).1 {
            let is_sum = matches!(graph.node(base), Node::Linear { .. });
            let Some(n @ ..0) = exponent.as_integer().filter(|_| is_sum) else { continue };
            let power = Exponent::rational(Rational::integer(-n));
            match denominator.iter_mut().find(|factor| factor.0 == base) {
                Some(factor) if factor.1.as_integer() < Some(-n) => factor.1 = power,
                Some(_) => {}
                None => denominator.push((base, power)),
            }
        }
    }
    if denominator.is_empty() {
        return None;
    }
    let before = ways.worst(graph, sum);
    if before == 1.0 {
        return None;
    }
    let earlier = graph.overflowed();
    let denominator = graph.product(&denominator);
    let mut numerator = vec![(denominator, constant)];
    numerator.extend(terms.into_iter().map(|(term, c)| (graph.mul(term, denominator), c)));
    let numerator = graph.linear(Rational::ZERO, &numerator);
    let numerator = expand_products(graph, numerator);
    if graph.overflowed() != earlier {
        // Failed trials are not mistakes.
        graph.take_overflow();
        return None;
    }
    (ways.worst(graph, numerator) * BEARABLE < before).then(|| graph.div(numerator, denominator))
}

/// Sums in an energy that cancel far from rest, so that its first or second derivatives lose digits there.
///
/// A sum may cancel without harm, next to larger ones. So each is changed by a fraction of its terms, as
/// rounding would: it matters if the derivatives change by more than a hundred times that fraction of
/// themselves and of what they change by with the stretches.
#[must_use]
pub fn lossy(graph: &Graph, energy: Id, derivatives: [&[Id]; 2], ways: &Ways) -> Vec<Id> {
    /// Relative change far above rounding, far below the values at the first point of a path.
    const CHANGE: f64 = 1.0 / (1u64 << 36) as f64;
    /// Number of roundings below which a change does not matter.
    const UNNOTICED: f64 = 100.0;
    let values = |derivatives: &[Id], point: &Point, mut memo: Memo| -> Vec<f64> {
        derivatives.iter().map(|&id| evaluate_with(graph, id, point, &mut memo).value).collect()
    };
    let distance =
        |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    let matters = |derivatives: &[Id], sum: Id, point: &Point| {
        let exact = values(derivatives, point, Memo::default());
        let mut memo = Memo::default();
        let mut estimate = evaluate_with(graph, sum, point, &mut memo);
        estimate.value += CHANGE * ratio(graph, sum, point, &mut memo) * estimate.value.abs();
        let changed = values(derivatives, point, Memo::of(sum, estimate));
        let by_stretches: f64 = (0..3)
            .map(|k| {
                let mut moved = point.clone();
                moved.stretches[k] *= 1.0 + CHANGE;
                distance(&values(derivatives, &moved, Memo::default()), &exact)
            })
            .sum();
        let size = exact.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        distance(&changed, &exact) > UNNOTICED * (CHANGE * size + by_stretches)
    };
    // Nodes that may still be evaluated: what is beyond is not tried.
    let each =
        5 * derivatives.map(|derivatives| graph.reachable(derivatives).len()).into_iter().sum::<usize>();
    let mut budget = MOST_EVALUATED;
    let mut can_matter = |sum: Id, point: &Point| {
        budget = budget.saturating_sub(each);
        budget > 0 && derivatives.iter().any(|derivatives| matters(derivatives, sum, point))
    };
    let sums =
        graph.reachable(&[energy]).into_iter().filter(|&id| matches!(graph.node(id), Node::Linear { .. }));
    sums.filter(|&sum| ways.cancelling(graph, sum).any(|(_, [point, _])| can_matter(sum, point))).collect()
}

#[cfg(test)]
mod tests {
    use quote::quote;

    /// Sums that cancel in an energy, with the constants of its fractions joined where that helps.
    fn found(energy: proc_macro2::TokenStream) -> Vec<String> {
        let item = quote! {
            fn E([l1, l2, l3]: [f64; 3], mu: f64, kappa: f64, k: f64) -> f64 { #energy }
        };
        let attribute = quote!(domain(J > 0.0), admissible(mu > 0.0, kappa > 0.0, k > 0.0), prestressed);
        let (declaration, mut model) = crate::analyse(attribute, item).unwrap();
        let sums = model.lossy.clone();
        sums.into_iter().map(|sum| crate::printer::formula(&mut model.graph, &declaration, sum)).collect()
    }

    #[test]
    fn sums_of_fractions_are_joined_where_they_cancel() {
        let printed = quote! {
            let s1 = (l1 / J.cbrt()).powi(2);
            let s2 = (l2 / J.cbrt()).powi(2);
            let s3 = (l3 / J.cbrt()).powi(2);
            let b1 = k.powi(2) * (s1 - 1.0) / (s1 + k).powi(2);
            let b2 = k.powi(2) * (s2 - 1.0) / (s2 + k).powi(2);
            let b3 = k.powi(2) * (s3 - 1.0) / (s3 + k).powi(2);
            let logarithms = (1.0 + b1).ln() + (1.0 + b2).ln() + (1.0 + b3).ln();
            mu * (I1b - logarithms) + kappa * (J - 1.0).powi(2)
        };
        assert_eq!(found(printed), [""; 0]);
        // By invariants too, from which stress may be computed.
        let saturating = quote! { mu * (I1 - k * (1.0 - I1 / (I1 + k)).ln()) + kappa * (J - 1.0).powi(2) };
        assert_eq!(found(saturating), [""; 0]);
    }
}
