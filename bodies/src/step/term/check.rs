//! Comparison of an energy with its derivatives, by differences along lines.

use std::convert::identity;

use piola::__private::message::number;
use piola::__private::random::Random;
use piola::lanes::Real;
use thiserror::Error;

use crate::step::line_search::MARGIN;

use super::{EnergyChange, NodeBlocks, Term};

/// Derivative of a term that does not fit its energy, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct TermViolation(String);

/// Compares the gradient of a term, at each node, with differences of its energy, and its second derivatives
/// with differences of its gradient, in a test by the author of the term.
///
/// `positions` are those of every node, m, where the term acts. They are displaced by a hundredth of the
/// largest distance from the first node, and by smaller steps. With `is_filtered` the second derivatives may
/// exceed the differences, as those without negative eigenvalues do.
///
/// # Errors
/// [`TermViolation`] for a derivative that does not fit, or positions at which nothing can be compared.
pub fn check_term(term: &dyn Term, positions: &[[f64; 3]], is_filtered: bool) -> Result<(), TermViolation> {
    let (x, nodes) = (positions, positions.len());
    let [mut d, mut to, mut gradient, mut curved] = [(); 4].map(|()| vec![[0.0; 3]; nodes]);
    let mut blocks = NodeBlocks::default();
    blocks.begin(nodes);
    if term.energy(x).is_some_and(f64::is_finite) {
        term.add_second_derivatives(x, &mut blocks);
        term.add_gradient(x, &mut gradient);
    }
    if blocks.blocks.is_empty() && gradient.as_flattened().iter().all(|&g| g == 0.0) {
        let message = "the term does not act at these positions, or has no energy there; choose others";
        return Err(TermViolation(message.into()));
    }
    let span = x.as_flattened().iter().enumerate().map(|(k, c)| (c - x[0][k % 3]).abs()).fold(0.0, f64::max);
    let reach = if span > 0.0 { 0.01 * span } else { 0.01 };
    for k in 0..3 * nodes {
        let (node, c) = (k / 3, k % 3);
        d.fill([0.0; 3]);
        d[node][c] = reach;
        let contradicted = contradiction(x, (&d, 1.0), [&mut to, &mut gradient], identity, |to, gradient| {
            term.change(x, to).inspect(|_| term.add_gradient(to, gradient))
        });
        if let Some(slopes) = contradicted {
            let [own, found] = slopes.map(|slope| number(slope / reach));
            return Err(TermViolation(format!(
                "the gradient at node {node} (from 0) along {} is {own} N, but the energy changes by {found} \
                 J/m",
                ["x", "y", "z"][c]
            )));
        }
    }
    let mut random = Random::new(1);
    for _ in 0..8 {
        d.as_flattened_mut().iter_mut().for_each(|d| *d = reach * random.uniform(-1.0, 1.0));
        let mut start = None;
        let contradicted = contradiction(x, (&d, 1.0), [&mut to, &mut curved], identity, |to, curved| {
            term.energy(to)?;
            gradient.fill([0.0; 3]);
            term.add_gradient(to, &mut gradient);
            blocks.begin(nodes);
            term.add_second_derivatives(to, &mut blocks);
            blocks.add_product(&d, curved);
            let [slope, size] = sums(&gradient, &d);
            let difference = slope - *start.get_or_insert(slope);
            Some(EnergyChange { difference, noise: 20.0 * f64::UNIT_ROUNDOFF * size })
        });
        if let Some(curvatures) = contradicted.filter(|[own, found]| !(is_filtered && own >= found)) {
            let [own, found] = curvatures.map(number);
            return Err(TermViolation(format!(
                "the second derivatives K give dᵀK d = {own} J for a displacement d along which the gradient \
                 grows by {found} J"
            )));
        }
    }
    Ok(())
}

/// Mean slope of an energy over a step along d, at most `longest`, and its difference quotient, if these
/// disagree.
///
/// `evaluate` returns the change of the energy from x to a position, `None` outside its domain, and adds the
/// gradient there; `total` adds numbers of all machines. Position and gradient are memory.
///
/// The mean of a slope that is continuous, or jumps once, is as close to the mean of both ends as these are
/// to each other, unless it rises and falls within the step. Hence both directions and two lengths must
/// disagree.
pub(crate) fn contradiction(
    x: &[[f64; 3]],
    (d, longest): (&[[f64; 3]], f64),
    [position, gradient]: [&mut [[f64; 3]]; 2],
    total: impl Fn([f64; 4]) -> [f64; 4],
    mut evaluate: impl FnMut(&[[f64; 3]], &mut [[f64; 3]]) -> Option<EnergyChange>,
) -> Option<[f64; 2]> {
    let mut along = |step: f64| {
        for node in 0..x.len() {
            position[node] = std::array::from_fn(|c| x[node][c] + step * d[node][c]);
        }
        gradient.fill([0.0; 3]);
        let change = evaluate(position, gradient);
        let own = change.map_or([1.0, 0.0, 0.0, 0.0], |EnergyChange { difference, noise }| {
            let ([_, at_x], [slope, along_d]) = (sums(gradient, x), sums(gradient, d));
            // Positions and the slope are rounded, too.
            let rounding = 4.0 * f64::UNIT_ROUNDOFF * (at_x + step.abs() * along_d);
            [0.0, difference, noise + rounding, slope]
        });
        let [refused, difference, noise, slope] = total(own);
        (refused == 0.0).then_some((difference, noise, slope))
    };
    let (.., start) = along(0.0)?;
    let mut disagree = |step: f64| {
        let (difference, noise, end) = along(step)?;
        let mean = 0.5 * (start + end);
        let allowed = (step * (end - start)).abs() + MARGIN * noise;
        // Nothing fits NaN.
        let fits = (difference - step * mean).abs() <= allowed;
        (!fits).then_some([mean, difference / step])
    };
    let mut before = None;
    [1.0, 1.0 / 64.0, 2e-4, 4e-6].into_iter().find_map(|step| {
        let step = step * longest;
        let found = disagree(-step).and_then(|_| disagree(step));
        std::mem::replace(&mut before, found).and(found)
    })
}

/// Σ a b and Σ |a b| over the coordinates.
fn sums(a: &[[f64; 3]], b: &[[f64; 3]]) -> [f64; 2] {
    let products = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b);
    products.fold([0.0; 2], |[sum, size], product| [sum + product, size + product.abs()])
}
