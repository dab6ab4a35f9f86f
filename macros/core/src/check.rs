//! What can be said of an energy before any parameter is known: it is isotropic, and free of stress at rest.
//!
//! Decided by evaluation at random points with random parameters, relative to what rounding could hide. A normal form
//! would call (x + y)² and x² + 2xy + y² different.

use syn::spanned::Spanned;

use crate::diagnostics::Diagnostics;
use crate::diff::Differentiator;
use crate::expr::{Graph, Id, Node};
use crate::formula::formula;
use crate::interpret::{Point, Value, evaluate};
use crate::parse::Declaration;
use crate::rational::Rational;

/// Number of points at which identities are tested. One would do with probability 1; several refute bad luck.
const SAMPLES: usize = 6;

/// Candidates tried for [`SAMPLES`] admissible points: enough for parameters that must be in order, and for decades of
/// them up to 10⁹. Most are refused by the conditions alone, in microseconds.
const CANDIDATES: usize = 20_000;

/// Fewer samples than this say nothing.
const FEWEST: usize = 2;

/// Rounding errors of a few hundred operations, relative to the magnitudes that enter, stay below this.
const NOISE: f64 = 1e-12;

/// Points of the domain at which the energy and its derivatives are finite.
pub fn samples(
    graph: &mut Graph,
    declaration: &Declaration,
    energy: Id,
    bounds: &[Id],
    admissible: &[Id],
    positive: bool,
    diagnostics: &mut Diagnostics,
) -> Vec<Point> {
    let gradient = Differentiator::default().derivative(graph, energy, 0);
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut found = Vec::new();
    let mut excluded_rest = 0;
    for attempt in 0..CANDIDATES {
        let point = candidate(declaration, &mut random, attempt, positive);
        let holds = |ids: &[Id], point: &Point| ids.iter().all(|&id| evaluate(graph, id, point).value > 0.0);
        if !holds(admissible, &point) {
            continue;
        }
        let rest = Point { stretches: [1.0; 3], ..point.clone() };
        if !holds(bounds, &rest) {
            excluded_rest += 1;
            continue;
        }
        let is_finite = |id| evaluate(graph, id, &point).value.is_finite();
        if holds(bounds, &point) && is_finite(energy) && is_finite(gradient) {
            found.push(point);
        }
        if found.len() == SAMPLES {
            return found;
        }
    }
    if found.len() >= FEWEST {
        return found;
    }
    if excluded_rest > 0 {
        let span = declaration.options.domain.first().map_or(declaration.name.span(), Spanned::span);
        diagnostics
            .error(span, "the domain excludes the rest state λ1 = λ2 = λ3 = 1, where every body starts");
    } else {
        diagnostics.error(
            declaration.name.span(),
            "no parameters were found for which this energy is finite near rest: check its domain and `admissible(…)`",
        );
    }
    Vec::new()
}

fn candidate(declaration: &Declaration, random: &mut Random, attempt: usize, positive: bool) -> Point {
    let lengths: Vec<usize> = declaration
        .lengths
        .iter()
        .map(|length| match length {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(literal), .. }) => {
                literal.base10_parse().unwrap_or(3)
            }
            _ => 3,
        })
        .collect();
    // Parameters over ever more decades, negative ones from the second round on.
    let decades = 1.0 + 15.0 * attempt as f64 / CANDIDATES as f64;
    let mut value = || {
        let magnitude = 10f64.powf(decades * (random.unit() - 0.4));
        if attempt > CANDIDATES / 20 && random.unit() < 0.3 { -magnitude } else { magnitude }
    };
    let parameters = declaration
        .parameters
        .iter()
        .map(|parameter| {
            (0..parameter.length().map_or(1, |length| lengths[length])).map(|_| value()).collect()
        })
        .collect();
    let mut stretches = [0, 1, 2].map(|_| 0.6 + 0.9 * random.unit());
    if !positive && attempt % 2 == 1 {
        stretches[2] = -stretches[2];
    }
    Point { stretches, parameters, lengths, epsilon: 0.5 }
}

/// ψ must not change when two stretches are exchanged.
pub fn isotropy(
    graph: &mut Graph,
    declaration: &Declaration,
    energy: Id,
    samples: &[Point],
    diagnostics: &mut Diagnostics,
) {
    for (i, j) in [(0, 1), (1, 2)] {
        let asymmetric = |id: Id| {
            samples.iter().any(|point| {
                let mut swapped = point.clone();
                swapped.stretches.swap(i, j);
                differ(evaluate(graph, id, point), evaluate(graph, id, &swapped))
            })
        };
        if !asymmetric(energy) {
            continue;
        }
        // Terms that cancel each other's asymmetry are innocent; a single guilty one can be named.
        let terms = match graph.node(energy).clone() {
            Node::Linear { terms, .. } => terms.into_iter().map(|(term, _)| term).collect(),
            _ => vec![energy],
        };
        let guilty: Vec<_> = terms.into_iter().filter(|&term| asymmetric(term)).collect();
        let names = &declaration.stretches;
        let hint = match guilty[..] {
            [term] => format!("the term `{}` does", formula(graph, declaration, term)),
            _ => "its terms do".to_owned(),
        };
        diagnostics.error(
            declaration.body.span(),
            format!(
                "an isotropic energy does not change when `{}` and `{}` are exchanged, but {hint}",
                names[i], names[j]
            ),
        );
        return;
    }
}

/// ψ1 must vanish at λ = 1.
pub fn rest(
    graph: &mut Graph,
    declaration: &Declaration,
    gradient: Id,
    samples: &[Point],
    diagnostics: &mut Diagnostics,
) {
    let one = graph.constant(Rational::ONE);
    let stress = graph.substitute(gradient, [one; 3]);
    let is_stressed = samples.iter().any(|point| {
        let rest = Point { stretches: [1.0; 3], ..point.clone() };
        let Value { magnitude, .. } = evaluate(graph, gradient, &rest);
        let Value { value, .. } = evaluate(graph, stress, &rest);
        let within = value.abs() <= NOISE * magnitude;
        !within // NaN is a mistake too
    });
    if is_stressed {
        diagnostics.error(
            declaration.body.span(),
            format!(
                "the rest state carries the stress ψ1(1, 1, 1) = {}: add a term that cancels it, such as a multiple of \
                 `J.ln()`, or say `prestressed` in the attribute",
                formula(graph, declaration, stress)
            ),
        );
    }
}

fn differ(a: Value, b: Value) -> bool {
    let within = (a.value - b.value).abs() <= NOISE * (a.magnitude + b.magnitude);
    !within // NaN differs
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
