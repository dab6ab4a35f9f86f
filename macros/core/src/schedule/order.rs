//! In which order the factors of a product are multiplied: such that no part of it leaves the range of the numbers when the
//! product does not.
//!
//! A product of high degree leaves the range soonest, so factors are taken such that the degree of what has been multiplied
//! stays near zero. With I1 y^(−2/3) z^(−2/3) x^(−8/3), of degree −2, the powers of stretches alone would be of degree −4.
//!
//! Among factors that are equally good, the one is taken with which what has been multiplied is a part of the most products of
//! the program: such a part is computed once for all of them.

use super::degrees::{Degree, Degrees, power, sum};
use crate::expr::{Exponent, Graph, Id, Node};
use crate::hash::HashMap;
use crate::rational::Rational;

/// A base with an exponent, one of those into which [`parts`] takes powers.
type Factor = (Id, Exponent);

/// What decides on the order: degrees, and the products of a program.
pub(super) struct Order {
    degrees: Degrees,
    /// The products that have a factor once or more, twice or more, and so on.
    with_factor: HashMap<Factor, Vec<Set>>,
    /// All products.
    all: Set,
}

/// Products of a program, each by a bit.
type Set = Vec<u64>;

impl Order {
    /// For products among these nodes.
    pub(super) fn of(graph: &Graph, reachable: &[Id]) -> Self {
        let factors = |&id: &Id| match graph.node(id) {
            Node::Product(factors) => Some(apart(factors)),
            _ => None,
        };
        let products: Vec<_> = reachable.iter().filter_map(factors).collect();
        let words = products.len().div_ceil(64);
        let mut with_factor: HashMap<Factor, Vec<Set>> = HashMap::default();
        for (product, factors) in products.iter().enumerate() {
            for (k, factor) in factors.iter().enumerate() {
                let earlier = factors[..k].iter().filter(|&other| other == factor).count();
                let sets = with_factor.entry(*factor).or_default();
                if sets.len() == earlier {
                    sets.push(vec![0; words]);
                }
                sets[earlier][product / 64] |= 1 << (product % 64);
            }
        }
        Self { degrees: Degrees::default(), with_factor, all: vec![u64::MAX; words] }
    }

    /// The factors in the order of multiplication, parameters first.
    pub(super) fn balanced(&mut self, graph: &Graph, factors: &[Factor]) -> Vec<Factor> {
        let mut left: Vec<(Degree, Factor)> = Vec::new();
        for factor @ (base, exponent) in apart(factors) {
            left.push((power(self.degrees.of(graph, base), exponent), factor));
        }
        let mut order: Vec<Factor> = Vec::new();
        let mut total = [0.0; 2];
        // The products of which what has been multiplied is a part.
        let mut alike = self.all.clone();
        while !left.is_empty() {
            let size = |[low, high]: Degree| (total[0] + low).abs() + (total[1] + high).abs();
            let smallest = left.iter().map(|&(degrees, _)| size(degrees)).fold(f64::INFINITY, f64::min);
            // The first of the most shared of the smallest.
            let mut best: Option<(usize, u32, Set)> = None;
            for (k, &(degrees, factor)) in left.iter().enumerate() {
                if size(degrees) > smallest || left[..k].iter().any(|other| other.1 == factor) {
                    continue;
                }
                let earlier = order.iter().filter(|&&other| other == factor).count();
                let set = self.with_factor.get(&factor).and_then(|sets| sets.get(earlier));
                let sharing: Set = alike.iter().zip(set.into_iter().flatten()).map(|(a, b)| a & b).collect();
                let number = sharing.iter().map(|word| word.count_ones()).sum();
                if best.as_ref().is_none_or(|&(_, most, _)| number > most) {
                    best = Some((k, number, sharing));
                }
            }
            // A degree that is no number is as good as any.
            let (k, _, sharing) = best.unwrap_or_default();
            let (degrees, factor) = left.remove(k);
            total = sum(total, degrees);
            order.push(factor);
            alike = sharing;
        }
        order
    }
}

/// Factors such that no power of one base leaves the range when their product does not.
fn apart(factors: &[Factor]) -> Vec<Factor> {
    let apart = |&(base, exponent): &Factor| parts(exponent).into_iter().map(move |part| (base, part));
    factors.iter().flat_map(apart).collect()
}

/// x^(−7/3) may leave the range where x^(−1/3) and x^(−1) do not.
fn parts(exponent: Exponent) -> Vec<Exponent> {
    let Exponent { real, rational } = exponent;
    let Ok(mut whole) = i64::try_from(rational.numerator() / rational.denominator()) else {
        return vec![exponent];
    };
    let fraction = rational.checked_add(Rational::integer(-whole));
    let (None, Some(fraction)) = (real, fraction) else { return vec![exponent] };
    let mut parts = Vec::new();
    if !fraction.is_zero() {
        parts.push(Exponent::rational(fraction));
    }
    while whole != 0 {
        let part = whole.signum();
        parts.push(Exponent::integer(part));
        whole -= part;
    }
    parts
}
