//! Rules that an energy keeps for all parameters: it is isotropic, has a value everywhere in its domain, and
//! at rest it is free of stress and resists shear.
//!
//! They are decided by evaluation at random points with random parameters, relative to what rounding could
//! hide: a normal form would call (x + y)² and x² + 2xy + y² different. The judges return [`Finding`]s.

use crate::algebra::excess::has_squares;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::extension::extend;
use crate::algebra::interpret::{Estimate, Point, evaluate};
use crate::printer::rust;
use crate::read::diagnostics::Diagnostics;
use crate::read::domain::Volume;
use crate::read::parse::mentions;
use explain::QUOTABLE;
use finding::{Finding, Findings};
use samples::{is_zero, samples};
pub(crate) use source::Source;
use units::units;
pub(crate) use units::units_of_parameters;

mod argument;
mod blame;
mod explain;
mod finding;
mod rest;
mod roughness;
mod samples;
mod source;
mod units;
mod vanishing;
mod volume;

/// Checks an energy as it is written, and returns samples of its domain if there is no mistake.
pub(crate) fn written(
    graph: &mut Graph,
    source: &Source<'_>,
    is_well_formed: bool,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Point>> {
    // A misspelt domain may be the one that `extend` needs.
    report(options(source, is_well_formed), diagnostics);
    if !diagnostics.is_clean() {
        return None;
    }
    let samples = samples(graph, source).map_err(|finding| report([finding], diagnostics)).ok()?;
    report(isotropy(graph, source, &samples), diagnostics);
    report(domain(graph, source, &samples), diagnostics);
    report(units(graph, source), diagnostics);
    diagnostics.is_clean().then_some(samples)
}

/// Reports broken rules.
pub(crate) fn report(findings: impl IntoIterator<Item = Finding>, diagnostics: &mut Diagnostics) {
    for Finding { tokens, message } in findings {
        diagnostics.error(tokens, message);
    }
}

/// True if an energy has no value for a volume of its domain, or cannot be continued, which is known before
/// its derivatives. Leaves the graph as it is.
pub(crate) fn is_out_of_domain(graph: &Graph, source: &Source<'_>, samples: &[Point]) -> bool {
    let mut graph = graph.clone();
    if source.declaration.options.extend.is_none() {
        return !volume::has_value(&mut graph, source, samples);
    }
    let continued = extend(&mut graph, source.energy);
    continued_powers(&graph, source).is_some()
        || !flat(&graph, source, samples).is_empty()
        || continued_value(&graph, source, continued, samples).is_some()
}

/// Derivatives of an energy that are judged.
pub(crate) struct Derived {
    /// ψ1 inside the domain.
    pub(crate) gradient: Id,
    /// The second derivatives inside the domain.
    pub(crate) hessian: [Id; 6],
    /// The small-strain shear modulus.
    pub(crate) shear: Id,
    /// The energy continued beyond its domain, if it is to be.
    pub(crate) continued: Option<Id>,
    /// True if the fractions of these derivatives are exact.
    pub(crate) is_exact: bool,
}

/// Checks an energy by its derivatives. Consequences of a mistake are not reported in addition to it.
pub(crate) fn derived(
    graph: &mut Graph,
    source: &Source<'_>,
    derived: &Derived,
    samples: &[Point],
) -> Vec<Finding> {
    const OVERFLOW: &str =
        "the exact fractions in the derivatives of this energy leave 128 bits: use smaller numbers";
    let is_prestressed = source.declaration.options.prestressed;
    let mut findings = Findings::new(source);
    if derived.is_exact {
        vanishing::powers_at_rest(graph, samples, &mut findings);
        roughness::roughness(graph, &derived.hessian, &mut findings);
        if !is_prestressed {
            rest::rest(graph, derived.gradient, samples, &mut findings);
        }
    } else {
        findings.add(source.blamed_term(|_| false), OVERFLOW);
    }
    // The shear stiffness is checked once the energy is stress-free at rest: the correction may change it.
    let is_stiffness_judged = !is_prestressed && findings.found.is_empty();
    if derived.is_exact {
        volume::volumes(graph, samples, &mut findings);
        vanishing::limits(graph, samples, &mut findings);
    }
    let mut findings = findings.found;
    findings.extend(flat(graph, source, samples));
    findings.extend(continued_powers(graph, source));
    if findings.is_empty() {
        findings.extend(derived.continued.and_then(|energy| continued_value(graph, source, energy, samples)));
    }
    if is_stiffness_judged {
        findings.extend(stiffness(graph, source, derived.shear, samples));
    }
    if findings.is_empty() && graph.overflowed() {
        findings.push(Finding::new(source.blamed_term(|_| false), OVERFLOW));
    }
    findings
}

/// Checks that ψ does not change when two stretches are exchanged.
fn isotropy(graph: &mut Graph, source: &Source<'_>, samples: &[Point]) -> Option<Finding> {
    let changes = |&exchanged: &[usize; 2]| differs(graph, [source.energy; 2], exchanged, samples);
    let exchanged = [[0, 1], [1, 2]].into_iter().find(changes)?;
    let blamed = source.blamed_term(|id| differs(graph, [id; 2], exchanged, samples));
    let term = blamed.and_then(|term| source.nodes.of(term)).filter(|&term| term != source.energy);
    let term = term.map(|term| format!("`{}`", rust(graph, source.declaration, term)));
    let term = term.filter(|term| term.len() <= QUOTABLE);
    let [i, j] = exchanged.map(|i| &source.declaration.stretches[i]);
    let message = format!(
        "an isotropic energy does not change when `{i}` and `{j}` are exchanged, but {} does: write the same \
         for all three stretches",
        term.as_deref().unwrap_or("this")
    );
    Some(Finding::new(blamed, message))
}

/// Checks that conditions of the domain are alike for all stretches, or on the largest or the smallest one.
fn domain(graph: &Graph, source: &Source<'_>, samples: &[Point]) -> Vec<Finding> {
    let is_on_second = |bound: Id| {
        let differs = |exchanged| differs(graph, [bound; 2], exchanged, samples);
        differs([0, 1]) && differs([1, 2]) && !differs([0, 2])
    };
    // Conditions may be written out for each stretch.
    let is_written_out = |bound: Id| {
        let is_mirror = |other: Id, exchanged| !differs(graph, [bound, other], exchanged, samples);
        [[0, 1], [1, 2]]
            .into_iter()
            .all(|exchanged| source.bounds.iter().any(|&other| is_mirror(other, exchanged)))
    };
    let conditions = source.bounds.iter().zip(source.declaration.bounds());
    let mistaken = conditions.filter(|&(&bound, _)| is_on_second(bound) && !is_written_out(bound));
    let [l1, l2, l3] = &source.declaration.stretches;
    let message = format!(
        "a domain is symmetric, and stretches come in order, `{l1}` ≥ `{l2}` ≥ `{l3}`: write this condition for the \
         largest, `{l1}`, if it is an upper limit, or for the smallest, `{l3}`, if it is a lower one"
    );
    mistaken.map(|(_, condition)| Finding::new(condition, &*message)).collect()
}

/// True if an expression differs from another one in which two stretches are exchanged.
fn differs(graph: &Graph, [one, other]: [Id; 2], [i, j]: [usize; 2], samples: &[Point]) -> bool {
    samples.iter().any(|point| {
        let mut swapped = point.clone();
        swapped.stretches.swap(i, j);
        let (a, b) = (evaluate(graph, one, point), evaluate(graph, other, &swapped));
        // NaN differs.
        !is_zero(Estimate { value: a.value - b.value, magnitude: a.magnitude + b.magnitude })
    })
}

/// Checks that the words of the attribute fit the declaration. The domain of one with mistakes of form is not
/// judged.
fn options(source: &Source<'_>, is_well_formed: bool) -> Option<Finding> {
    const MESSAGE: &str =
        "`extend` continues an energy beyond `domain(J > 0.0)`: declare that or remove `extend`";
    let is_extended = source.declaration.options.extend.is_some();
    (is_well_formed && is_extended && source.volume == Volume::Any)
        .then(|| Finding::new(source.extend(), MESSAGE))
}

/// Checks that no real power of an expression that vanishes at rest is to be continued.
fn continued_powers(graph: &Graph, source: &Source<'_>) -> Option<Finding> {
    const MESSAGE: &str = "the energy has a real power of an expression that vanishes at rest, which is not \
                           continued beyond J > 0: remove `extend`";
    (source.declaration.options.extend.is_some() && has_squares(graph, source.energy))
        .then(|| Finding::new(source.extend(), MESSAGE))
}

/// Checks that the continuation of an energy has a value at elements that are nearly flat, flat and inverted.
fn continued_value(graph: &Graph, source: &Source<'_>, continued: Id, samples: &[Point]) -> Option<Finding> {
    /// λ3 where the continuation begins at 0.1.
    const THIRD: [f64; 7] = [0.05, 0.01, 1e-3, 0.0, -0.01, -0.3, -1.0];
    // The domain of functions is not known here.
    if source.declaration.has_functions() {
        return None;
    }
    let without_value = |sample: &Point| {
        let [l1, l2, _] = sample.stretches.map(f64::abs);
        THIRD.map(|l3| [l1, l2, l3]).into_iter().find(|&stretches| {
            let point = Point { stretches, epsilon: 0.1, ..sample.clone() };
            let energy = evaluate(graph, continued, &point).value;
            energy.is_nan() || energy == f64::NEG_INFINITY
        })
    };
    let found: Vec<_> = samples.iter().filter_map(without_value).collect();
    // Some parameters may be beyond what any element has.
    let [l1, l2, l3] = found.first().filter(|_| 2 * found.len() > samples.len())?;
    let message = format!(
        "`extend` continues logarithms and powers of stretches below J = 0, but where they make up an argument of \
         another logarithm, root or real power, this may turn negative, as at the stretches {l1:.3}, {l2:.3} and \
         {l3}: remove `extend`"
    );
    Some(Finding::new(source.extend(), message))
}

/// Elements so flat that any value that is unbounded at vanishing volume exceeds every limit.
const FLAT: [[f64; 3]; 2] = [[1.0, 1.0, 1e-30], [0.7, 1.0, 1e-30]];

/// Checks that no condition of the domain excludes flat elements, where an extension begins if there is one.
fn flat(graph: &Graph, source: &Source<'_>, samples: &[Point]) -> Vec<Finding> {
    if source.declaration.options.extend.is_none() {
        return Vec::new();
    }
    let excludes = |bound: Id, stretches: [f64; 3]| {
        let flat = |point: &Point| Point { stretches, ..point.clone() };
        !samples.iter().any(|point| evaluate(graph, bound, &flat(point)).value > 0.0)
    };
    let conditions = source.bounds.iter().zip(source.declaration.bounds());
    let finding = |(&bound, condition)| {
        let [l1, l2, _] = FLAT.into_iter().find(|&flat| excludes(bound, flat))?;
        let instead = if mentions(condition, &["I1b", "I2b"]) {
            "bound a quantity that stays moderate there, such as I1 instead of I1b"
        } else if mentions(condition, &["I1", "I2"]) {
            "this condition, and write `I1b` for `I1` in the energy, which is 3 or more wherever J > 0"
        } else {
            "this condition"
        };
        let message = format!(
            "`extend` continues the energy beyond J > 0, but where elements are flat, such as at the stretches {l1}, \
             {l2} and 0, this does not hold: remove `extend`, or {instead}"
        );
        Some(Finding::new(condition, message))
    };
    conditions.filter_map(finding).collect()
}

/// Checks that some shear modulus is positive: otherwise the constructor would refuse all parameters.
fn stiffness(graph: &Graph, source: &Source<'_>, shear: Id, samples: &[Point]) -> Option<Finding> {
    const MESSAGE: &str = "the shear modulus of this energy is zero at rest: add a term that resists shear, \
                           such as `mu / 2.0 * (I1b - 3.0)`";
    let vanishes = samples.iter().all(|point| is_zero(evaluate(graph, shear, point)));
    (vanishes && !source.declaration.has_functions())
        .then(|| Finding::new(source.blamed_term(|_| false), MESSAGE))
}
