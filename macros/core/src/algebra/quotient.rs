//! Flip and twist quotients without cancellation.
//!
//! For the derivative g = ψᵢ of an isotropic energy, with x = λi and y = λj,
//!
//! ```text
//! flip   (ψi − ψj)/(x − y) = (g − σg)/(x − σx),   σ: x ↔ y
//! twist  (ψi + ψj)/(x + y) = (g − τg)/(x − τx),   τ: x → −y, y → −x, for the part of g that is odd in (x, y)
//! ```
//!
//! For a reflection R let De = (e − Re)/(x − Rx). Like a derivative, D is computed from the structure of e,
//! and nothing is ever divided by the gap x − Rx:
//!
//! | e        | De                                                           |
//! |----------|--------------------------------------------------------------|
//! | Re = e   | 0, and a factor s with Rs = s comes out: D(sf) = s Df        |
//! | x, y, z  | 1, −1 (σ) or 1 (τ), 0                                        |
//! | f + g    | Df + Dg                                                      |
//! | f g      | Df g + Rf Dg or Df Rg + f Dg, after taking out symmetric factors like xy |
//! | φ(f)     | φ[f, Rf] Df with the divided difference φ[a, b]              |
//!
//! Equal stretches need no branch: the limit is what the formula gives. A part that is not odd in (x, y) has
//! a pole at x + y = 0; there the numerator ψi + ψj does not cancel and the plain quotient is accurate.

use rustc_hash::FxHashMap;

use crate::algebra::divided;
use crate::algebra::expr::{Exponent, Function, Graph, Id, Node, Stretch};
use crate::algebra::extension;
use crate::algebra::interpret::{Estimate, Memo, Point, evaluate_with};
use crate::algebra::rational::Rational;

/// A reflection of two stretches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reflection {
    /// σ: λi ↔ λj.
    Flip(Stretch, Stretch),
    /// τ: λi → −λj, λj → −λi.
    Twist(Stretch, Stretch),
}

/// Quotients, each computed once.
#[derive(Debug)]
pub struct Quotients<'a> {
    /// Points of the domain at which parities are decided.
    samples: &'a [Point],
    memo: FxHashMap<(Id, Reflection), Id>,
    /// Values at each sample, by its index, as it is and with two stretches negated.
    values: FxHashMap<(usize, Negated), Memo>,
    /// Values where the second of two stretches is [`FLAT`] times the first.
    flat_values: FxHashMap<(usize, Stretch, Stretch), Memo>,
}

/// The pair of stretches whose signs are changed, if any.
type Negated = Option<(Stretch, Stretch)>;

/// Noise threshold: three orders of magnitude above rounding errors, eleven below a term that is really
/// there.
const NOISE: f64 = 1e-12;

/// Ratio of stretches at which terms that cancel on flat elements are detected.
const FLAT: f64 = 1e-6;

/// Largest accepted ratio of the terms of a product rule to their sum: a digit and a half.
const BEARABLE: f64 = 32.0;

/// The largest degree of a product of sums that is multiplied out to separate odd from even terms.
const LARGEST_EXPANDED_POWER: i64 = 4;

impl<'a> Quotients<'a> {
    /// Decides parities at the given points, which must lie in the domain of the energy.
    #[must_use]
    pub fn new(samples: &'a [Point]) -> Self {
        Self {
            samples,
            memo: FxHashMap::default(),
            values: FxHashMap::default(),
            flat_values: FxHashMap::default(),
        }
    }

    /// The twist quotient D⁺ij from ψi, and true if it has a pole at λi + λj = 0. With `positive`, all
    /// stretches are positive and there is none.
    pub fn twist(
        &mut self,
        graph: &mut Graph,
        gradient: Id,
        i: Stretch,
        j: Stretch,
        positive: bool,
    ) -> (Id, bool) {
        let (odd, rest) = self.split(graph, gradient, i, j, positive);
        let removable = self.quotient(graph, odd, Reflection::Twist(i, j));
        if graph.is_zero(rest) {
            return (removable, false);
        }
        let mirrored = reflect(graph, rest, Reflection::Flip(i, j));
        let numerator = graph.add(rest, mirrored);
        let (x, y) = (graph.stretch(i), graph.stretch(j));
        let sum = graph.add(x, y);
        let plain =
            if positive { graph.div(numerator, sum) } else { graph.leaf(Node::PoleQuotient(numerator, sum)) };
        (graph.add(removable, plain), !positive)
    }

    /// The quotient De. For e = ψi and a flip, De is D⁻ij.
    pub fn quotient(&mut self, graph: &mut Graph, e: Id, reflection: Reflection) -> Id {
        once!(
            self.memo,
            (e, reflection),
            if graph.is_full() || reflect(graph, e, reflection) == e {
                graph.integer(0)
            } else {
                self.rule(graph, e, reflection)
            }
        )
    }

    fn rule(&mut self, graph: &mut Graph, e: Id, reflection: Reflection) -> Id {
        match graph.node(e).clone() {
            Node::Stretch(k) => graph.integer(sign(reflection, k)),
            Node::Linear { terms, .. } => {
                let terms: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.quotient(graph, term, reflection), c)).collect();
                graph.linear(Rational::ZERO, &terms)
            }
            Node::Sum(length, body) => {
                let inner = self.quotient(graph, body, reflection);
                graph.sum(length, inner)
            }
            Node::Excess(squares, _) => self.quotient(graph, squares, reflection),
            Node::Accurate(_, written) => self.quotient(graph, written, reflection),
            Node::Product(factors) => self.product_rule(graph, &factors, reflection),
            Node::Apply(function, a) => self.chain_rule(graph, function, a, reflection),
            Node::Extended(function, order, k) => {
                let Reflection::Flip(i, j) = reflection else { return undefined(graph) };
                let quotient = extended_quotient(graph, function, order, i, j);
                graph.scale(quotient, Rational::integer(sign(reflection, k)))
            }
            _ => undefined(graph),
        }
    }

    fn chain_rule(&mut self, graph: &mut Graph, function: Function, a: Id, reflection: Reflection) -> Id {
        let inner = self.quotient(graph, a, reflection);
        let b = reflect(graph, a, reflection);
        let outer = divided::quotient(graph, function, a, b);
        graph.mul(outer, inner)
    }

    fn product_rule(&mut self, graph: &mut Graph, factors: &[(Id, Exponent)], reflection: Reflection) -> Id {
        let (symmetric, rest) = take_out_symmetric(graph, factors, reflection);
        let quotient = match rest[..] {
            [] => graph.integer(0),
            [(base, exponent)] => self.chain_rule(graph, Function::Power(exponent), base, reflection),
            [(base, exponent), ref others @ ..] => match take_out_slope_pair(graph, &rest, reflection) {
                Some(SlopePair { pair, quotient, others }) => {
                    let g = graph.product(&others);
                    self.leibniz(graph, (pair, quotient), g, reflection)
                }
                None => {
                    let (f, g) = (graph.power(base, exponent), graph.product(others));
                    let df = self.quotient(graph, f, reflection);
                    self.leibniz(graph, (f, df), g, reflection)
                }
            },
        };
        graph.mul(symmetric, quotient)
    }

    /// The product rule D(fg) = Df g + Rf Dg = Df Rg + f Dg.
    ///
    /// Both are exact at small gaps. At wide ones the terms of either may be far larger than their sum, as
    /// where f falls and g grows towards a stretch that vanishes: then the other has the values of f and g at
    /// the other end.
    fn leibniz(&mut self, graph: &mut Graph, (f, df): (Id, Id), g: Id, reflection: Reflection) -> Id {
        let dg = self.quotient(graph, g, reflection);
        let [f_mirrored, g_mirrored] = [f, g].map(|part| reflect(graph, part, reflection));
        let mut terms = [graph.mul(df, g), multiply_pieces(graph, f_mirrored, dg)];
        if self.cancellation(graph, terms, reflection) > BEARABLE {
            let other = [graph.mul(df, g_mirrored), multiply_pieces(graph, f, dg)];
            if self.cancellation(graph, other, reflection) <= BEARABLE {
                terms = other;
            }
        }
        graph.add(terms[0], terms[1])
    }

    /// Cancellation of two terms if one stretch of the reflection is far below the other: their size relative
    /// to their sum, the median over the samples.
    fn cancellation(&mut self, graph: &Graph, terms: [Id; 2], reflection: Reflection) -> f64 {
        let (Reflection::Flip(i, j) | Reflection::Twist(i, j)) = reflection;
        let mut factors: Vec<f64> = Vec::with_capacity(self.samples.len());
        for (k, sample) in self.samples.iter().enumerate() {
            let mut point = sample.clone();
            point.stretches[j] = point.stretches[i].abs() * FLAT;
            let memo = self.flat_values.entry((k, i, j)).or_default();
            let [a, b] = terms.map(|term| evaluate_with(graph, term, &point, memo).value);
            factors.push(a.abs().max(b.abs()) / (a + b).abs());
        }
        // A point that overflows, or is outside the domain, decides nothing.
        factors.retain(|factor| factor.is_finite());
        factors.sort_by(f64::total_cmp);
        factors.get(factors.len() / 2).copied().unwrap_or(1.0)
    }

    /// Splits into a part that is odd under (λi, λj) → (−λi, −λj) and a rest that is not. With `positive`,
    /// there is no pole.
    fn split(&mut self, graph: &mut Graph, e: Id, i: Stretch, j: Stretch, positive: bool) -> (Id, Id) {
        let zero = graph.integer(0);
        match self.parity(graph, e, i, j) {
            Parity::Odd => return (e, zero),
            Parity::Even => return (zero, e),
            Parity::None => {}
        }
        match graph.node(e).clone() {
            Node::Linear { constant, terms } => {
                let (mut odd, mut rest) = (Vec::new(), Vec::new());
                for (term, coefficient) in terms {
                    let (o, r) = self.split(graph, term, i, j, positive);
                    odd.push((o, coefficient));
                    rest.push((r, coefficient));
                }
                (graph.linear(Rational::ZERO, &odd), graph.linear(constant, &rest))
            }
            Node::Sum(length, body) => {
                let (odd, rest) = self.split(graph, body, i, j, positive);
                // Without a pole, the sums that the gradient needs anyway.
                if positive && !graph.is_zero(rest) {
                    return (zero, e);
                }
                (graph.sum(length, odd), graph.sum(length, rest))
            }
            Node::Product(factors) => {
                let mut mixed_sums = factors;
                mixed_sums.retain(|&(base, _)| {
                    matches!(graph.node(base), Node::Linear { .. })
                        && self.parity(graph, base, i, j) == Parity::None
                });
                let powers = mixed_sums.iter().map(|(_, exponent)| exponent.as_integer().filter(|&n| n > 0));
                let total: Option<i64> = powers.sum();
                let (Some(1..=LARGEST_EXPANDED_POWER), Some(&(sum, _))) = (total, mixed_sums.first()) else {
                    return (zero, e);
                };
                let others = graph.div(e, sum);
                let (odd, rest) = self.split(graph, sum, i, j, positive);
                if graph.is_zero(odd) || graph.is_zero(rest) {
                    return (zero, e);
                }
                let [(o1, r1), (o2, r2)] = [odd, rest].map(|part| {
                    let term = graph.mul(part, others);
                    self.split(graph, term, i, j, positive)
                });
                (graph.add(o1, o2), graph.add(r1, r2))
            }
            _ => (zero, e),
        }
    }

    /// The parity of an expression, decided numerically, relative to what rounding could hide: a normal form
    /// would miss identities. The body of a sum is evaluated for its first entry, which stands for all.
    ///
    /// A sum is odd if the rest without its odd terms is: next to an exponential of 10¹⁶, a term that is not
    /// odd would look like its noise.
    fn parity(&mut self, graph: &Graph, e: Id, i: Stretch, j: Stretch) -> Parity {
        let found = self.parity_as_a_whole(graph, e, i, j);
        let Node::Linear { constant, terms } = graph.node(e) else { return found };
        if found != Parity::Odd || terms.len() < 2 {
            return found;
        }
        let mut others = terms.clone();
        others.retain(|&(term, _)| self.parity_as_a_whole(graph, term, i, j) != Parity::Odd);
        let is_odd = (0..self.samples.len()).all(|k| {
            let (mut sum, mut magnitude) = (2.0 * constant.to_f64(), 2.0 * constant.to_f64().abs());
            for &(term, coefficient) in &others {
                let (here, there) = self.mirrored(graph, term, k, (i, j));
                sum += coefficient.to_f64() * (here.value + there.value);
                magnitude += coefficient.to_f64().abs() * (here.magnitude + there.magnitude);
            }
            sum.abs() <= NOISE * magnitude
        });
        if is_odd { Parity::Odd } else { Parity::None }
    }

    /// Values at a sample, and with two stretches of opposite sign.
    fn mirrored(
        &mut self,
        graph: &Graph,
        e: Id,
        sample: usize,
        (i, j): (Stretch, Stretch),
    ) -> (Estimate, Estimate) {
        let point = &self.samples[sample];
        let mut mirrored = point.clone();
        mirrored.stretches[i] = -point.stretches[i];
        mirrored.stretches[j] = -point.stretches[j];
        let here = evaluate_with(graph, e, point, self.values.entry((sample, None)).or_default());
        let there =
            evaluate_with(graph, e, &mirrored, self.values.entry((sample, Some((i, j)))).or_default());
        (here, there)
    }

    fn parity_as_a_whole(&mut self, graph: &Graph, e: Id, i: Stretch, j: Stretch) -> Parity {
        let (mut odd, mut even) = (true, true);
        for k in 0..self.samples.len() {
            let (here, there) = self.mirrored(graph, e, k, (i, j));
            let noise = NOISE * (here.magnitude + there.magnitude);
            // Written so that NaN, as from a real power of a negative number, is neither odd nor even; nor is
            // a value that overflows, as the exponential of an extended function may at a negative stretch.
            odd &= noise.is_finite() && (here.value + there.value).abs() <= noise;
            even &= noise.is_finite() && (here.value - there.value).abs() <= noise;
        }
        match (odd, even) {
            (true, false) => Parity::Odd,
            (false, true) => Parity::Even,
            // A term that vanishes everywhere is harmless on either side.
            (true, true) => Parity::Odd,
            (false, false) => Parity::None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parity {
    Odd,
    Even,
    None,
}

/// The reflected expression Re.
pub fn reflect(graph: &mut Graph, e: Id, reflection: Reflection) -> Id {
    let mut stretches = [0, 1, 2].map(|k| graph.stretch(k));
    match reflection {
        Reflection::Flip(i, j) => stretches.swap(i, j),
        Reflection::Twist(i, j) => {
            (stretches[i], stretches[j]) = (graph.neg(stretches[j]), graph.neg(stretches[i]));
        }
    }
    graph.substitute(e, stretches)
}

fn sign(reflection: Reflection, k: Stretch) -> i64 {
    match reflection {
        Reflection::Flip(i, j) => i64::from(k == i) - i64::from(k == j),
        Reflection::Twist(i, j) => i64::from(k == i || k == j),
    }
}

/// Separates a factor s with Rs = s from the others: symmetric factors, common powers of x and y, mirror
/// pairs f·Rf.
fn take_out_symmetric(
    graph: &mut Graph,
    factors: &[(Id, Exponent)],
    reflection: Reflection,
) -> (Id, Vec<(Id, Exponent)>) {
    let (Reflection::Flip(i, j) | Reflection::Twist(i, j)) = reflection;
    let (x, y) = (graph.stretch(i), graph.stretch(j));
    let exponent_of = |base: Id| factors.iter().find(|factor| factor.0 == base).map(|factor| factor.1);

    let mut symmetric = Vec::new();
    let mut rest = Vec::new();
    match (exponent_of(x), exponent_of(y)) {
        (Some(p), Some(q)) if p.real == q.real => {
            let common = Exponent { real: p.real, rational: p.rational.min(q.rational) };
            symmetric.extend([(x, common), (y, common)]);
            for (base, exponent) in [(x, p), (y, q)] {
                let excess = exponent.rational.checked_add(common.rational.negated());
                rest.extend(excess.filter(|r| !r.is_zero()).map(|r| (base, Exponent::rational(r))));
            }
        }
        (p, q) => {
            rest.extend(p.map(|p| (x, p)));
            rest.extend(q.map(|q| (y, q)));
        }
    }
    let mut unpaired: Vec<(Id, Exponent)> = Vec::new();
    for &(base, exponent) in factors.iter().filter(|factor| factor.0 != x && factor.0 != y) {
        let mirrored = reflect(graph, base, reflection);
        if mirrored == base {
            symmetric.push((base, exponent));
        } else if let Some(k) = unpaired.iter().position(|&partner| partner == (mirrored, exponent)) {
            symmetric.extend([unpaired.remove(k), (base, exponent)]);
        } else {
            unpaired.push((base, exponent));
        }
    }
    rest.extend(unpaired);
    (graph.product(&symmetric), rest)
}

/// Divided difference of an extended function between λi and λj: exact, as the mean of its pieces' divided
/// differences over the fractions of the interval above and below ε.
fn extended_quotient(graph: &mut Graph, function: Function, order: u8, i: Stretch, j: Stretch) -> Id {
    let [wi, wj] = [i, j].map(|k| graph.leaf(Node::Above(k)));
    let above = extension::derivative_quotient(graph, function, order, wi, wj);
    let epsilon = graph.leaf(Node::Epsilon);
    // The polynomial T = φ + φ′d + ½φ″d², φ and its derivatives at ε, has T[d, e] = φ′ + ½φ″(d + e), T′[d, e]
    // = φ″.
    let below = match order {
        0 => {
            let [di, dj] = [i, j].map(|k| graph.leaf(Node::Below(k)));
            let slope = extension::derivative(graph, function, 1, epsilon);
            let curvature = extension::derivative(graph, function, 2, epsilon);
            let sum = graph.add(di, dj);
            let bend = graph.mul(curvature, sum);
            let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
            graph.linear(Rational::ZERO, &[(slope, Rational::ONE), (bend, half)])
        }
        1 => extension::derivative(graph, function, 2, epsilon),
        _ => graph.integer(0),
    };
    let [above_share, below_share] =
        [Node::ShareAbove(i, j), Node::ShareBelow(i, j)].map(|share| graph.leaf(share));
    let (above, below) = (graph.mul(above_share, above), graph.mul(below_share, below));
    graph.add(above, below)
}

/// A factor times a quotient. The quotient of an extended function is a sum over the pieces above and below
/// ε, each of which is multiplied by the factor: λ times a piece in λ⁻² stays in range even if the piece does
/// not.
fn multiply_pieces(graph: &mut Graph, factor: Id, quotient: Id) -> Id {
    let Node::Linear { constant, terms } = graph.node(quotient).clone() else {
        return graph.mul(factor, quotient);
    };
    let is_piece = |&(term, _): &(Id, Rational)| {
        let (_, factors) = graph.factors(term);
        factors
            .iter()
            .any(|&(base, _)| matches!(graph.node(base), Node::ShareAbove(..) | Node::ShareBelow(..)))
    };
    if !constant.is_zero() || !terms.iter().all(is_piece) {
        return graph.mul(factor, quotient);
    }
    let terms: Vec<_> = terms.into_iter().map(|(term, c)| (graph.mul(factor, term), c)).collect();
    graph.linear(Rational::ZERO, &terms)
}

/// A pair φ′(x) φ(y) of an extended power φ, taken out of a product.
struct SlopePair {
    pair: Id,
    quotient: Id,
    others: Vec<(Id, Exponent)>,
}

/// Finds a pair φ′(x) φ(y) among the factors.
///
/// Such pairs make up the derivative of φ(λ1) φ(λ2) φ(λ3), the extension of J^r. By the product rule the
/// quotient would subtract terms that are larger by a power of x/y.
fn take_out_slope_pair(
    graph: &mut Graph,
    factors: &[(Id, Exponent)],
    reflection: Reflection,
) -> Option<SlopePair> {
    let Reflection::Flip(i, j) = reflection else { return None };
    for &(slope, exponent) in factors.iter().filter(|factor| factor.1 == Exponent::ONE) {
        let Node::Extended(Function::Power(r), 1, k) = *graph.node(slope) else { continue };
        if k != i && k != j {
            continue;
        }
        let other = if k == i { j } else { i };
        let value = graph.leaf(Node::Extended(Function::Power(r), 0, other));
        if !factors.contains(&(value, exponent)) {
            continue;
        }
        let others =
            factors.iter().copied().filter(|factor| factor.0 != slope && factor.0 != value).collect();
        let quotient = slope_pair_quotient(graph, r, i, j);
        let quotient = graph.scale(quotient, Rational::integer(sign(reflection, k)));
        return Some(SlopePair { pair: graph.mul(slope, value), quotient, others });
    }
    None
}

/// The quotient (φ′(x) φ(y) − φ′(y) φ(x))/(x − y) for x = λi, y = λj and an extended power φ(λ) = λ^r.
///
/// The product rule gives it in two ways, with the values at either stretch. The one with the smaller φ is
/// accurate: stretches are ordered, x ≥ |y|, so it is the one at y for r > 0 and at x for r < 0.
fn slope_pair_quotient(graph: &mut Graph, exponent: Exponent, i: Stretch, j: Stretch) -> Id {
    let extended =
        |graph: &mut Graph, order, k| graph.leaf(Node::Extended(Function::Power(exponent), order, k));
    let [value, slope] = [0, 1].map(|order| extended_quotient(graph, Function::Power(exponent), order, i, j));
    let by = |graph: &mut Graph, k| {
        let (at, slope_at) = (extended(graph, 0, k), extended(graph, 1, k));
        let (left, right) = (graph.mul(slope, at), graph.mul(value, slope_at));
        graph.sub(left, right)
    };
    if exponent.real.is_none() {
        return by(graph, if exponent.rational.is_negative() { i } else { j });
    }
    let r = graph.exponent_value(exponent);
    let (negative, positive) = (by(graph, i), by(graph, j));
    graph.leaf(Node::WhereNegative(r, negative, positive))
}

/// NaN for nodes without a rule, which no energy reaches: it would be noticed.
fn undefined(graph: &mut Graph) -> Id {
    graph.leaf(Node::Float(f64::NAN.to_bits()))
}
