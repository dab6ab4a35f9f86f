//! Real powers of I1b − 3 and its kind: the stiffness at rest must be finite.
//!
//! The stiffness of (I1b − 3)ⁿ goes with the strain to the power 2n − 2 (see [`excess`]): it is infinite at
//! rest for n < 1. Roots may still occur where a sum is smooth, as in ln(1 − √X) + √X = −X/2 − …, so the
//! stiffness itself is judged, at strains that are many orders of magnitude apart.
//!
//! [`excess`]: crate::algebra::excess

use super::finding::{Findings, Violation};
use super::samples::{CANDIDATES, candidates};
use crate::algebra::excess::has_squares;
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::interpret::{Memo, Point, evaluate_with};

/// Draws of the parameters, of which about 0.4 have an exponent below 1 if that is not excluded.
const DRAWS: usize = 24;

/// A direction of strain that changes I1b and I2b.
const DIRECTION: [f64; 3] = [1.0, -0.25, -0.75];

/// A strain, and one far below it.
const STRAINS: [f64; 2] = [1e-6, 1e-14];

/// The ratio of their stiffnesses that shows growth: that of an exponent of 0.99.
const GROWTH: f64 = 1.4;

/// Finds an energy whose stiffness grows without bound towards rest, given the second derivatives.
pub(crate) fn roughness(graph: &Graph, hessian: &[Id], findings: &mut Findings<'_>) {
    let source = findings.source;
    if !has_squares(graph, source.energy) {
        return;
    }
    let stiffness = |point: &Point, strain: f64| {
        let stretches = DIRECTION.map(|direction| 1.0 + strain * direction);
        let (point, mut memo) = (Point { stretches, ..point.clone() }, Memo::default());
        let entries = hessian.iter().map(|&entry| evaluate_with(graph, entry, &point, &mut memo).value.abs());
        entries
            .fold(0.0, |largest: f64, entry| if entry > largest || entry.is_nan() { entry } else { largest })
    };
    let points = candidates(source, 0x9FB2_1C65_1E98_DF25, 0..CANDIDATES);
    let mut good = points.filter(|point| source.is_good_at_rest(graph, point)).take(DRAWS);
    let grows = good.any(|point| {
        let [near, far] = STRAINS.map(|strain| stiffness(&point, strain));
        far.is_nan() || near.is_nan() || far > GROWTH * near
    });
    if grows {
        let is_power = |id: Id| match graph.node(id) {
            Node::Product(factors) => factors.iter().find(|(base, exponent)| {
                exponent.as_integer().is_none() && matches!(graph.node(*base), Node::Excess(..))
            }),
            _ => None,
        };
        let power = graph.reachable(&[source.energy]).into_iter().find_map(is_power).copied();
        findings.add(source.blamed_term(|_| false), Violation::Rough { power });
    }
}
