//! Every flip and twist of the catalogue at every gap, with a table: `cargo test -p piola-tests --test
//! quotients`, with `-- NAME` those of the energies whose names contain it.
//!
//! A quotient D may err by 10 u (1 + κ) relative to max(|D|, |ψii| + |ψij|), where κ is its condition with
//! respect to relative changes of the stretches, and of the threshold of an extension. Where that fails,
//! Σ|terms of D| enters the maximum: a sum whose terms cancel by the nature of the energy cannot do better.
//! The table counts those. Parameters are rounded to `f32` first, so that both formats judge one material.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::collections::HashSet;
use std::fmt;

use piola::__private::pole_floor;
use piola::Inversion;
use piola::interpreter::Interpreted;
use piola::material::{MaterialError, PAIRS, Response};
use piola_tests::declarations::slices;
use piola_tests::declared::Declared;
use piola_tests::energies::{ENERGIES, Format, Judged, Subject, is_asked_for};
use piola_tests::quotients::{expected, samples};
use rayon::prelude::*;

/// The constant of the judgement |D − D*| ≤ C u (scale + sensitivity).
const C: f64 = 10.0;

/// Of a threshold that is exact in both formats.
const EXTEND: Inversion = Inversion::Extend { epsilon: 0.25 };

/// A line of the table: energy, inversion, format.
type Line = (&'static str, &'static str, &'static str, Tally);

fn main() {
    let judged: Result<Vec<_>, String> = trials().into_par_iter().map(judge).collect();
    let mut lines = judged.unwrap_or_else(|error| panic!("{error}")).concat();
    print(&mut lines);
    let failures: Vec<_> = lines.iter().flat_map(failures).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Parameters other than the typical ones: where those switch off a part of the energy, and splines whose
/// coefficients are exact in `f64`, from control points at equal distances of ½. Rounded ones make the force
/// jump by a rounding error at each control point, which a definition in 96 digits divides by the gap.
const OTHERS: [(&str, &[&[f64]]); 2] = [
    ("blatz_ko", &[&[2.2e5], &[0.6], &[1.0]]),
    (
        "stretch_spline",
        &[
            &[1.0, 0.0, 1.5, 1.5e5, 2.0, 2.5e5],
            &[1.0, 0.0, 1.5, 1e4, 2.0, 3e4],
            &[0.5, -2e6, 1.0, 0.0, 1.5, 1.25e6],
        ],
    ),
];

/// An energy, the name of its inversion in the table, its parameters, and the inversion.
type Trial = (&'static Judged, &'static str, Vec<&'static [f64]>, Inversion);

/// A trial for each energy with each choice of parameters, plain and, where it can be, extended.
fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for energy in ENERGIES.iter().filter(|energy| is_asked_for(energy.name)) {
        let others =
            OTHERS.iter().filter(|(name, _)| *name == energy.name).map(|(_, values)| values.to_vec());
        for values in std::iter::once(energy.typical()).chain(others) {
            for (word, inversion) in [("refuse", Inversion::Refuse), ("extend", EXTEND)] {
                if inversion == EXTEND && !can_be_extended(energy, &values) {
                    continue;
                }
                trials.push((energy, word, values.clone(), inversion));
            }
        }
    }
    trials
}

/// Typical parameters can be extended wherever the energy can; of other ones, some may not.
fn can_be_extended(Judged { energy, .. }: &Judged, values: &[&[f64]]) -> bool {
    let restores = || !matches!(energy.material(values, EXTEND), Err(MaterialError::DoesNotRestore { .. }));
    energy.description().extends && (values == energy.typical() || restores())
}

/// The quotients that fail, one in each line.
fn failures((name, word, precision, tally): &Line) -> Vec<String> {
    let mut all: Vec<_> =
        tally.failures.iter().map(|failure| format!("{name} {word} {precision} {failure}")).collect();
    if tally.failed > 0 || tally.judged == 0 {
        let Tally { failed, judged, .. } = tally;
        all.push(format!("{name} {word} {precision}: {failed} of {judged} quotients failed"));
    }
    all
}

fn print(table: &mut [Line]) {
    println!("Errors of quotients in units of u (1 + κ) max(|D|, |ψii| + |ψij|); each may reach {C}.");
    println!("flat: how many stay below {C} u max(|D|, |ψii| + |ψij|).");
    println!("terms: how many need Σ|terms| in that maximum. pole: twists below the floor of a pole.");
    println!("range: the exact value leaves the format.\n");
    println!(
        "{:28} {:6} {:4} {:>8} {:>7} {:>8} {:>6} {:>6} {:>6} {:>6}",
        "material", "", "", "judged", "worst", "flat", "terms", "pole", "range", "failed"
    );
    table.sort_by_key(|&(name, word, precision, _)| (name, word == "extend", precision == "f32"));
    let mut total = Tally::default();
    for (name, word, precision, tally) in table {
        println!("{name:28} {word:6} {precision:4} {tally}");
        total.add(tally);
    }
    println!("{:28} {:6} {:4} {total}", "all", "", "");
}

/// The lines of both formats.
///
/// # Errors
/// Why the material cannot be judged.
fn judge((energy, word, values, inversion): Trial) -> Result<Vec<Line>, String> {
    let rounded =
        values.iter().map(|list| list.iter().map(|&value| f64::from(value as f32)).collect()).collect();
    let values = slices(&rounded);
    let build =
        |inversion| energy.subject(&values, inversion).map_err(|error| format!("{}: {error}", energy.name));
    let subject = build(inversion)?;
    let material: &dyn Response<f64> = &*subject.double;
    let (threshold, moved) = match inversion {
        Inversion::Refuse => (None, None),
        Inversion::Extend { epsilon } => {
            let moved = build(Inversion::Extend { epsilon: epsilon * (1.0 + FRACTION) })?;
            (Some(epsilon), Some(moved.exact))
        }
    };
    // All but the smallest gaps of the second one straddle a control point of the exact splines.
    let mut scales = vec![1.1, 1.5 - 1e-5, 4.0, 30.0, 0.05, 1e-6];
    scales.extend(upper_end(material));
    let samples = samples(&scales, material.admits([1.0, 0.9, -0.8]), threshold);
    let declared = Declared::read(energy.energy.text(), &values, inversion)?;
    let judge = Judge { subject: &subject, moved: moved.as_ref(), declared: &declared };
    let (double, single) = (judge.tally::<f64>(&samples), judge.tally::<f32>(&samples));
    Ok(vec![(energy.name, word, "f64", double), (energy.name, word, "f32", single)])
}

/// Nearly the size at which a ball leaves the domain, if it ever does.
fn upper_end(material: &dyn Response<f64>) -> Option<f64> {
    let admits = |size: f64| material.admits([size; 3]);
    let (mut inside, mut outside) = (1.0, 1e3);
    if admits(outside) {
        return None;
    }
    for _ in 0..50 {
        let middle = 0.5 * (inside + outside);
        *(if admits(middle) { &mut inside } else { &mut outside }) = middle;
    }
    Some(0.999 * inside)
}

/// Relative shift of a threshold, to see its effect.
const FRACTION: f64 = 1.0 / (1u64 << 20) as f64;

/// A subject, and its material with a threshold that is larger by [`FRACTION`].
struct Judge<'a> {
    subject: &'a Subject,
    moved: Option<&'a Interpreted>,
    declared: &'a Declared,
}

impl Judge<'_> {
    /// All quotients at all samples, rounded to the format.
    fn tally<R: Format>(&self, samples: &[[f64; 3]]) -> Tally {
        let &Self { subject, moved, declared } = self;
        let material = R::of(subject);
        let mut tally = Tally::default();
        let mut judged = HashSet::new();
        for &sample in samples {
            let stretches = sample.map(R::splat);
            let exact = stretches.map(R::widen);
            // Gaps below the format's resolution are the gap zero, which is judged once.
            if !material.admits(stretches) || !judged.insert(exact.map(f64::to_bits)) {
                continue;
            }
            let blocks = material.blocks(stretches);
            let (found, quotients) = ([blocks.flip, blocks.twist], expected(&subject.exact, exact));
            let floor = pole_floor(stretches).widen();
            for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
                for (kind, sign) in ['-', '+'].into_iter().enumerate() {
                    let mut quotient = quotients[kind][pair];
                    if sign == '+' && material.has_pole() && exact[i] + exact[j] < floor {
                        tally.pole += 1;
                        continue;
                    }
                    if !R::splat(quotient.scale.to_f64()).is_finite() {
                        tally.range += 1;
                        continue;
                    }
                    let found = found[kind][pair].widen();
                    let mut error = quotient.error(found, R::UNIT_ROUNDOFF);
                    if error.conditioned > C
                        && let Some(moved) = moved
                    {
                        let there = expected(moved, exact)[kind][pair];
                        quotient = quotient.with_threshold(there.value, FRACTION);
                        error = quotient.error(found, R::UNIT_ROUNDOFF);
                    }
                    tally.judged += 1;
                    tally.flat += usize::from(error.flat <= C);
                    if error.conditioned > C {
                        let terms = declared.terms(exact);
                        error = quotient.with_terms(terms[kind][pair]).error(found, R::UNIT_ROUNDOFF);
                        tally.terms += 1;
                    }
                    tally.failed += usize::from(error.conditioned > C);
                    if error.conditioned > tally.worst.max(C) {
                        let (i, j, exact_value) = (i + 1, j + 1, quotient.value.to_f64());
                        tally.failures.push(format!(
                            "D{sign}{i}{j} at {exact:?} is {found:e}, not {exact_value:e}: {error:.1?}"
                        ));
                    }
                    tally.worst = tally.worst.max(error.conditioned);
                }
            }
        }
        tally
    }
}

#[derive(Clone, Default)]
struct Tally {
    judged: usize,
    worst: f64,
    flat: usize,
    terms: usize,
    failed: usize,
    pole: usize,
    range: usize,
    /// Descriptions, each worse than the one before.
    failures: Vec<String>,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.judged += other.judged;
        self.worst = self.worst.max(other.worst);
        self.flat += other.flat;
        self.terms += other.terms;
        self.failed += other.failed;
        self.pole += other.pole;
        self.range += other.range;
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { judged, worst, flat, terms, failed, pole, range, .. } = self;
        write!(f, "{judged:8} {worst:7.1} {flat:8} {terms:6} {pole:6} {range:6} {failed:6}")
    }
}
