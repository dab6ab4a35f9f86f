//! What can be said of an energy before any parameter is known: it is isotropic, and at rest it is free of stress and resists
//! shear.
//!
//! Decided by evaluation at random points with random parameters, relative to what rounding could hide. A normal form
//! would call (x + y)² and x² + 2xy + y² different.

use quote::ToTokens;
use syn::Expr;

use crate::algebra::diff::Differentiator;
use crate::algebra::expand::expand;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::interpret::{Point, Value, evaluate};
use crate::algebra::rational::Rational;
use crate::algebra::simplify::simplify;
use crate::judge::culprit::{culprit, holder};
use crate::printer::source::{factor, source};
use crate::read::diagnostics::Diagnostics;
use crate::read::domain::Volume;
use crate::read::parse::{Declaration, identifiers};
use crate::read::resolve::{self, Nodes};
use crate::read::spelling::list;

mod arguments;
mod collapsed;
mod culprit;
mod mistakes;

use arguments::Remedy;
use mistakes::Mistakes;

/// Number of points at which identities are tested. One would do with probability 1; several refute bad luck.
const SAMPLES: usize = 6;

/// Candidates tried for [`SAMPLES`] admissible points: enough for parameters that must be in order, and for decades of
/// them up to 10⁹. Most are refused by the conditions alone, in microseconds.
const CANDIDATES: usize = 20_000;

/// Fewer samples than this say nothing.
const FEWEST: usize = 2;

/// Entries of a list beyond these are like those before.
const LONGEST: usize = 8;

/// Rounding errors of a few hundred operations, relative to the magnitudes that enter, stay below this.
const NOISE: f64 = 1e-12;

/// The longest term, in bytes, that a message quotes: what is longer is better read where it stands.
const QUOTABLE: usize = 40;

/// What the checks need of a declaration whose names are understood.
pub struct Written<'a> {
    /// The tokens.
    pub declaration: &'a Declaration,
    /// What each expression of the body stands for.
    pub nodes: Nodes,
    /// The energy as written.
    pub energy: Id,
    /// Expressions that are positive inside the domain, J apart, in the order of `bounds`.
    pub bounds: &'a [Id],
    /// Expressions of parameters that are positive.
    pub admissible: &'a [Id],
    /// The volumes of the domain.
    pub volume: Volume,
}

impl Written<'_> {
    /// The term that alone breaks a rule, or all of them.
    fn culprit(&self, mut breaks: impl FnMut(Id) -> bool) -> Option<&Expr> {
        culprit(&self.declaration.body, |part| self.nodes.of(part).is_some_and(&mut breaks))
    }

    /// The smallest part that alone holds something, or all of them.
    fn holder(&self, mut holds: impl FnMut(Id) -> bool) -> Option<&Expr> {
        holder(&self.declaration.body, |part| self.nodes.of(part).is_some_and(&mut holds))
    }
}

/// Points of the domain at which the energy and its derivatives are finite.
pub fn samples(graph: &mut Graph, written: &Written<'_>, diagnostics: &mut Diagnostics) -> Vec<Point> {
    let &Written { declaration, energy, volume, .. } = written;
    let gradient = Differentiator::default().by_stretch(graph, energy, 0);
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut found = Vec::new();
    let mut excludes_rest = None;
    for attempt in 0..CANDIDATES {
        let point = candidate(declaration, &mut random, attempt, volume);
        let holds = |id: Id, point: &Point| evaluate(graph, id, point).value > 0.0;
        if !written.admissible.iter().all(|&id| holds(id, &point)) {
            continue;
        }
        let rest = at_rest(&point);
        if let Some(k) = written.bounds.iter().position(|&id| !holds(id, &rest)) {
            excludes_rest = Some(k);
            continue;
        }
        let is_finite = |id| evaluate(graph, id, &point).value.is_finite();
        if written.bounds.iter().all(|&id| holds(id, &point)) && is_finite(energy) && is_finite(gradient) {
            found.push(point);
        }
        if found.len() == SAMPLES {
            return found;
        }
    }
    if found.len() >= FEWEST {
        return found;
    }
    match excludes_rest.and_then(|k| declaration.bounds().nth(k)) {
        Some(condition) => diagnostics.error(
            condition,
            "this excludes the rest state λ1 = λ2 = λ3 = 1, where every body starts: widen the domain",
        ),
        None => diagnostics.error(
            &declaration.name,
            "no parameters were found for which this energy is finite near rest: check its domain and `admissible(…)`",
        ),
    }
    Vec::new()
}

fn candidate(declaration: &Declaration, random: &mut Random, attempt: usize, volume: Volume) -> Point {
    let lengths: Vec<usize> = declaration
        .lengths
        .iter()
        .map(|length| match length {
            Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(literal), .. }) => {
                literal.base10_parse().unwrap_or(3).min(LONGEST)
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
    if volume != Volume::Positive && attempt % 2 == 1 {
        stretches[2] = -stretches[2];
    }
    Point { stretches, parameters, lengths, epsilon: 0.5 }
}

/// ψ must not change when two stretches are exchanged.
pub fn isotropy(graph: &mut Graph, written: &Written<'_>, samples: &[Point], diagnostics: &mut Diagnostics) {
    for (i, j) in [(0, 1), (1, 2)] {
        let is_asymmetric = |id: Id| {
            samples.iter().any(|point| {
                let mut swapped = point.clone();
                swapped.stretches.swap(i, j);
                differ(evaluate(graph, id, point), evaluate(graph, id, &swapped))
            })
        };
        if is_asymmetric(written.energy) {
            let Written { declaration, nodes, energy, .. } = written;
            let culprit = written.culprit(is_asymmetric);
            let part = culprit.and_then(|part| nodes.of(part)).filter(|part| part != energy);
            let part = part.map(|part| format!("`{}`", source(graph, declaration, part)));
            let part = part.filter(|part| part.len() <= QUOTABLE);
            let message = format!(
                "an isotropic energy does not change when `{}` and `{}` are exchanged, but {} does: write the same for all three \
                 stretches",
                declaration.stretches[i],
                declaration.stretches[j],
                part.as_deref().unwrap_or("this"),
            );
            return diagnostics.error(culprit, message);
        }
    }
}

/// The energy must have a value wherever its domain reaches, and no stress at rest. Gives whether all is well at rest.
pub fn values(
    graph: &mut Graph,
    written: &Written<'_>,
    gradient: Id,
    samples: &[Point],
    diagnostics: &mut Diagnostics,
) -> bool {
    let mut mistakes = Mistakes::new(diagnostics);
    arguments::powers(graph, written, samples, &mut mistakes);
    if !written.declaration.options.prestressed {
        rest(graph, written, gradient, samples, &mut mistakes);
    }
    let is_well_at_rest = mistakes.is_empty();
    // What has no value where the volume vanishes has none in what is collapsed, and `domain(J > 0.0)` mends both.
    if volume(graph, written, samples, &mut mistakes) {
        collapsed::collapsed(graph, written, &mut mistakes);
    }
    arguments::limits(graph, written, samples, &mut mistakes);
    is_well_at_rest
}

/// Where the domain does not say `J > 0.0`, inverted material has an energy, and where it does not say `J != 0.0`, what is flat.
/// Gives whether it has.
fn volume(graph: &Graph, written: &Written<'_>, samples: &[Point], mistakes: &mut Mistakes<'_>) -> bool {
    // What functions are defined for is their own affair.
    if written.declaration.has_functions() {
        return true;
    }
    let is_short = |&&(sign, _): &&(f64, &str)| has_no_value(graph, written, written.energy, sign, samples);
    let Some(&(sign, message)) = beyond(written.volume).iter().find(is_short) else { return true };
    let breaks = |part| has_no_value(graph, written, part, sign, samples);
    if !mistakes.is_known(breaks) {
        mistakes.report(written, written.culprit(breaks), format!("this has no value {message}"));
    }
    false
}

/// The signs of J, +1 apart, that a domain has, and what to say where an energy has no value there.
fn beyond(volume: Volume) -> &'static [(f64, &'static str)] {
    const BEYOND: [(f64, &str); 2] = [
        (-1.0, "where J < 0, in inverted material: declare `domain(J > 0.0)`"),
        (
            0.0,
            "where J = 0, in flat material: declare `domain(J > 0.0)`, or `domain(J != 0.0)` where inverted material is to be as good as upright",
        ),
    ];
    match volume {
        Volume::Positive => &[],
        Volume::Nonzero => &BEYOND[..1],
        Volume::Any => &BEYOND,
    }
}

/// Whether a part has no value at the samples, given J of this sign, inside the domain.
fn has_no_value(graph: &Graph, written: &Written<'_>, part: Id, sign: f64, samples: &[Point]) -> bool {
    let with_sign = |point: &Point| {
        let [l1, l2, l3] = point.stretches;
        Point { stretches: [l1, l2, sign * l3.abs()], ..point.clone() }
    };
    let is_inside =
        |point: &Point| written.bounds.iter().all(|&bound| evaluate(graph, bound, point).value > 0.0);
    let mut points = samples.iter().map(with_sign).filter(is_inside).peekable();
    points.peek().is_some() && points.all(|point| !evaluate(graph, part, &point).value.is_finite())
}

/// ψ1 must vanish at λ = 1.
fn rest(
    graph: &mut Graph,
    written: &Written<'_>,
    gradient: Id,
    samples: &[Point],
    mistakes: &mut Mistakes<'_>,
) {
    let first = |graph: &mut Graph, part| Differentiator::default().by_stretch(graph, part, 0);
    let is_finite = |graph: &Graph, derivative| {
        samples.iter().all(|point| evaluate(graph, derivative, &at_rest(point)).value.is_finite())
    };
    if !is_finite(graph, gradient) {
        let mut breaks = |part| {
            let derivative = first(graph, part);
            !is_finite(graph, derivative)
        };
        // What else leaves stress at rest is seen once this is finite.
        if mistakes.is_known(&mut breaks) {
            return;
        }
        return mistakes
            .report(written, written.culprit(breaks), "the stress of this is not finite at rest, where λ1 = λ2 = λ3 = 1: divide by nothing that vanishes there, and take no \
             logarithm of it");
    }
    let one = graph.constant(Rational::ONE);
    let is_stressed = |graph: &mut Graph, gradient| {
        let stress = graph.substitute(gradient, [one; 3]);
        samples.iter().any(|point| {
            let rest = at_rest(point);
            let within = evaluate(graph, stress, &rest).value.abs()
                <= NOISE * evaluate(graph, gradient, &rest).magnitude;
            !within // NaN is a mistake too
        })
    };
    // Only the constructor knows the slopes of functions.
    if !written.declaration.has_functions() && is_stressed(graph, gradient) {
        let mut breaks = |part| {
            let derivative = first(graph, part);
            is_stressed(graph, derivative)
        };
        if mistakes.is_known(&mut breaks) {
            return;
        }
        let culprit = written.culprit(breaks);
        let stress = graph.substitute(gradient, [one; 3]);
        let stress = legible(graph, written.declaration, stress);
        let remedy = arguments::vanishing(graph, written).map(|(_, remedy)| remedy);
        let isochoric = isochoric(graph, written);
        let isochoric = first(graph, isochoric);
        let names = invariants(written.declaration);
        let domain = if written.volume == Volume::Positive { "" } else { " with `domain(J > 0.0)`" };
        let leaves_none = !names.is_empty() && !is_stressed(graph, isochoric);
        let instead = leaves_none.then(|| format!("write {}{domain}, which leaves none", in_place(&names)));
        // Where elements are flat, isochoric invariants are beyond limits.
        let is_limited = written.declaration.options.extend.is_some() && !written.bounds.is_empty();
        let ways = match (remedy, instead) {
            (Some(Remedy::Isochoric), Some(instead)) => format!("{instead} and has a value wherever J > 0"),
            (Some(Remedy::Limit(limit)), _) => balance(graph, written, stress, samples, &[limit]),
            (_, Some(instead)) if !is_limited => {
                format!("{}; or {instead}", balance(graph, written, stress, samples, &[]))
            }
            _ => balance(graph, written, stress, samples, &[]),
        };
        let message = format!(
            "this leaves the stress `{}` at rest: {}; or say `prestressed` in the attribute{}",
            source(graph, written.declaration, stress),
            ways,
            if is_of_volumes(written.declaration) { MISTYPED } else { "" },
        );
        mistakes.report(written, culprit, message);
    }
}

/// As a sum of products, or as differentiation leaves it where that is not longer.
fn legible(graph: &mut Graph, declaration: &Declaration, e: Id) -> Id {
    let left = simplify(graph, e);
    let expanded = expand(graph, left);
    let expanded = simplify(graph, expanded);
    let [length, expanded_length] = [left, expanded].map(|e| source(graph, declaration, e).len());
    if expanded_length < length { expanded } else { left }
}

/// What is likelier than a missing term where the energy is one of a compressible solid.
const MISTYPED: &str = " (if the paper's solid is compressible, a factor or a power is mistyped)";

/// Whether the declaration speaks of changes of volume, as none of an incompressible solid does.
fn is_of_volumes(declaration: &Declaration) -> bool {
    let names = identifiers(declaration.body.to_token_stream());
    let is_volume = |name| ["J", "I1b", "I2b"].into_iter().any(|volume| name == volume);
    !declaration.options.domain.is_empty() || names.iter().any(is_volume)
}

/// What takes the stress at rest away, to be pasted, with what else the domain wants.
fn balance(
    graph: &mut Graph,
    written: &Written<'_>,
    stress: Id,
    samples: &[Point],
    limits: &[String],
) -> String {
    let declaration = written.declaration;
    let term = if source(graph, declaration, stress).starts_with('-') {
        let negated = graph.neg(stress);
        format!("+ {}", factor(graph, declaration, negated))
    } else {
        format!("- {}", factor(graph, declaration, stress))
    };
    let domain = format!(" with {}", positive_domain(declaration, limits));
    if cancels(graph, written.energy, stress) {
        let is_needed = !limits.is_empty() || !has_value(graph, written, samples);
        let domain = if is_needed { &domain } else { "" };
        return format!("append `{term} * (J - 1.0)`{domain}, or remove the term in `J.ln()`");
    }
    let logarithm = format!("append `{term} * J.ln()`");
    if !limits.is_empty() {
        return format!("{logarithm}{domain}");
    }
    match written.volume {
        Volume::Positive => logarithm,
        _ if !has_value(graph, written, samples) => format!("{logarithm}{domain}"),
        Volume::Nonzero => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with the declared one"),
        Volume::Any => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with any domain"),
    }
}

/// The declared domain where J > 0, with further conditions.
fn positive_domain(declaration: &Declaration, limits: &[String]) -> String {
    let conditions = declaration.bounds().map(|condition| condition.to_token_stream().to_string());
    let conditions: Vec<_> =
        std::iter::once("J > 0.0".to_owned()).chain(conditions).chain(limits.iter().cloned()).collect();
    format!("`domain({})`", conditions.join(", "))
}

/// Whether the energy needs no further condition on J.
fn has_value(graph: &mut Graph, written: &Written<'_>, samples: &[Point]) -> bool {
    let is_short = |&(sign, _): &(f64, &str)| has_no_value(graph, written, written.energy, sign, samples);
    !beyond(written.volume).iter().any(is_short) && collapsed::without_value(graph, written).is_none()
}

/// Whether the energy has the stress times ln J already, so that to subtract it would take that back.
fn cancels(graph: &mut Graph, energy: Id, stress: Id) -> bool {
    let stretches = [0, 1, 2].map(|i| graph.stretch(i));
    let volume = graph.product_of(&stretches);
    let logarithm = graph.ln(volume);
    let term = graph.mul(stress, logarithm);
    let rest = graph.sub(energy, term);
    let holds = |id| graph.reachable(&[id]).contains(&logarithm);
    holds(energy) && !holds(rest)
}

/// `I1b` for `I1`, or both.
fn in_place(names: &[&str]) -> String {
    let isochoric: Vec<_> = names.iter().map(|name| format!("{name}b")).collect();
    format!("{} for {}", list(&isochoric), list(names))
}

/// The energy with I1b and I2b for I1 and I2.
fn isochoric(graph: &mut Graph, written: &Written<'_>) -> Id {
    resolve::isochoric(written.declaration, graph)
}

/// Which of I1 and I2 are written in the energy.
fn invariants(declaration: &Declaration) -> Vec<&'static str> {
    let names = identifiers(declaration.body.to_token_stream());
    ["I1", "I2"].into_iter().filter(|invariant| names.iter().any(|name| name == invariant)).collect()
}

/// Elements so flat that what grows without bound where the volume vanishes is beyond all limits.
const FLAT: [[f64; 3]; 2] = [[1.0, 1.0, 1e-30], [0.7, 1.0, 1e-30]];

/// Conditions that exclude what is flat leave nothing to an extension, which begins there.
pub fn flat(graph: &Graph, written: &Written<'_>, samples: &[Point], diagnostics: &mut Diagnostics) {
    for (&bound, condition) in written.bounds.iter().zip(written.declaration.bounds()) {
        let excludes = |stretches: [f64; 3]| {
            let flat = |point: &Point| Point { stretches, ..point.clone() };
            let is_inside = |point: &Point| evaluate(graph, bound, &flat(point)).value > 0.0;
            !samples.iter().any(is_inside)
        };
        if let Some([l1, l2, _]) = FLAT.into_iter().find(|&flat| excludes(flat)) {
            let names = identifiers(condition.to_token_stream());
            let speaks_of =
                |words: [&str; 2]| words.into_iter().any(|word| names.iter().any(|name| name == word));
            let instead = if speaks_of(["I1b", "I2b"]) {
                "bound what stays moderate there, such as I1 in place of I1b"
            } else if speaks_of(["I1", "I2"]) {
                "this condition, and write `I1b` for `I1` in the energy, which is 3 or more wherever J > 0"
            } else {
                "this condition"
            };
            let message = format!(
                "`extend` continues the energy beyond J > 0, but where elements are flat, such as at the stretches {l1}, {l2} and 0, \
                 this does not hold: remove `extend`, or {instead}"
            );
            diagnostics.error(condition, message);
        }
    }
}

/// Some shear modulus must be positive, or the constructor would refuse all parameters.
pub fn stiffness(
    graph: &Graph,
    written: &Written<'_>,
    [shear, _]: [Id; 2],
    samples: &[Point],
    diagnostics: &mut Diagnostics,
) {
    let vanishes = samples.iter().all(|point| {
        let Value { value, magnitude } = evaluate(graph, shear, point);
        value.abs() <= NOISE * magnitude
    });
    if vanishes && !written.declaration.has_functions() {
        diagnostics.error(
            written.culprit(|_| false),
            "the shear modulus of this energy is zero at rest: add a term that resists shear, such as `mu / 2.0 * (I1b - 3.0)`",
        );
    }
}

/// The derivatives must be exact; what a mistake found before has left of them need not.
pub fn fractions(graph: &Graph, written: &Written<'_>, diagnostics: &mut Diagnostics) {
    if diagnostics.is_clean() && graph.overflowed() {
        diagnostics.error(
            written.culprit(|_| false),
            "the exact fractions in the derivatives of this energy leave 128 bits: use smaller numbers",
        );
    }
}

fn at_rest(point: &Point) -> Point {
    Point { stretches: [1.0; 3], ..point.clone() }
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
