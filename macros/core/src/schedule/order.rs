//! The order in which the factors of a product are multiplied: such that no partial product leaves the range
//! of the number format when the product does not.
//!
//! A product of high degree leaves the range soonest, so factors are taken such that the degree of the
//! partial product stays near zero. With I1 y^(−2/3) z^(−2/3) x^(−8/3), of degree −2, the powers of stretches
//! alone would be of degree −4.
//!
//! Ties go to the factor whose partial product occurs in the most other products, because it is computed once
//! for all of them.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::degrees::{Degree, Degrees, power, sum};
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// A base with an exponent, one of those into which [`parts`] takes powers.
type Factor = (Id, Exponent);

/// Data for the order: degrees, and the products of a program.
pub(super) struct Order<'d> {
    degrees: &'d mut Degrees,
    /// The factors of each product, the n-th of one kind with the index of the set of products that have n or
    /// more of it.
    products: FxHashMap<Id, Vec<(Factor, usize)>>,
    sets: Vec<Set>,
    all: Set,
}

/// A set of products of a program, a bit for each.
type Set = Vec<u64>;

impl<'d> Order<'d> {
    /// The order for the products among these nodes.
    pub(super) fn of(graph: &Graph, degrees: &'d mut Degrees, reachable: &[Id]) -> Self {
        let factors = |&id: &Id| match graph.node(id) {
            Node::Product(factors) => Some((id, apart(factors))),
            _ => None,
        };
        let found: Vec<_> = reachable.iter().filter_map(factors).collect();
        let words = found.len().div_ceil(64);
        let (mut products, mut sets) = (FxHashMap::default(), Vec::new());
        let mut places: FxHashMap<(Factor, usize), usize> = FxHashMap::default();
        for (product, (id, factors)) in found.into_iter().enumerate() {
            let mut placed: Vec<(Factor, usize)> = Vec::with_capacity(factors.len());
            for factor in factors {
                let earlier = placed.iter().filter(|other| other.0 == factor).count();
                let place = *places.entry((factor, earlier)).or_insert_with(|| {
                    sets.push(vec![0; words]);
                    sets.len() - 1
                });
                sets[place][product / 64] |= 1 << (product % 64);
                placed.push((factor, place));
            }
            products.insert(id, placed);
        }
        Self { degrees, products, sets, all: vec![u64::MAX; words] }
    }

    /// The factors of a product in the order of multiplication, parameters first.
    pub(super) fn balanced(&mut self, graph: &Graph, product: Id) -> Vec<Factor> {
        let mut left = Vec::new();
        for &(factor, place) in self.products.get(&product).into_iter().flatten() {
            left.push((factor, place, power(self.degrees.of(graph, factor.0), factor.1)));
        }
        let mut order: Vec<Factor> = Vec::with_capacity(left.len());
        let mut total = [0.0; 2];
        // The products that contain the partial product.
        let mut alike = self.all.clone();
        while !left.is_empty() {
            let size = |[low, high]: Degree| (total[0] + low).abs() + (total[1] + high).abs();
            let smallest = left.iter().map(|&(.., degree)| size(degree)).fold(f64::INFINITY, f64::min);
            // Of the factors with the smallest size, the first of the most shared.
            let candidates = left.iter().enumerate().filter(|&(k, &(factor, _, degree))| {
                size(degree) <= smallest && left[..k].iter().all(|other| other.0 != factor)
            });
            let best = candidates.min_by_key(|&(_, &(_, place, _))| {
                let sharing = alike.iter().zip(&self.sets[place]);
                Reverse(sharing.map(|(a, b)| (a & b).count_ones()).sum::<u32>())
            });
            // If a degree is NaN, the first factor is taken.
            let k = best.map_or(0, |(k, _)| k);
            let (factor, place, degree) = left.remove(k);
            total = sum(total, degree);
            order.push(factor);
            alike.iter_mut().zip(&self.sets[place]).for_each(|(a, b)| *a &= b);
        }
        order
    }
}

/// Powers split into factors that stay in range: x^(−7/3) may leave it although x^(−1/3) and x^(−1) do not.
fn apart(factors: &[Factor]) -> Vec<Factor> {
    let mut apart = Vec::with_capacity(factors.len());
    for &(base, exponent) in factors {
        let Some((fraction, whole)) = parts(exponent) else {
            apart.push((base, exponent));
            continue;
        };
        if !fraction.is_zero() {
            apart.push((base, Exponent::rational(fraction)));
        }
        let unit = (base, Exponent::integer(whole.signum()));
        (0..whole.unsigned_abs()).for_each(|_| apart.push(unit));
    }
    apart
}

/// A rational exponent as a fraction between −1 and 1 and a whole number.
fn parts(exponent: Exponent) -> Option<(Rational, i64)> {
    if let Some(whole) = exponent.as_integer() {
        return Some((Rational::ZERO, whole));
    }
    let Exponent { real: None, rational } = exponent else { return None };
    let whole = i64::try_from(rational.numerator() / rational.denominator()).ok()?;
    Some((rational.checked_add(Rational::integer(-whole))?, whole))
}
