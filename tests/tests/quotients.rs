//! Every flip and twist of the catalogue at every gap, with a table: `cargo test --release -p piola-tests quotients`.
//!
//! A quotient D may err by 10 u (1 + κ) relative to max(|D|, |ψii| + |ψij|), where κ is its condition with respect to
//! relative changes of the stretches, and of the threshold of an extension. Where that fails, Σ|terms of D| enters the maximum: a sum whose terms cancel by the
//! nature of the energy cannot do better. The table counts those. Parameters are rounded to `f32` first, so that both
//! formats judge one material.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test with its own main and a table to show"
)]

use std::cell::LazyCell;
use std::collections::HashSet;
use std::fmt;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

use piola::material::{Inadmissible, PAIRS};
use piola::quotient::pole_floor;
use piola::{Inversion, Material, Real};
use piola_materials::{CATALOGUE, Entry, Visitor};
use piola_tests::declared::Declared;
use piola_tests::quotients::{expected, samples};

/// The constant of the judgement |D − D*| ≤ C u (scale + sensitivity).
const C: f64 = 10.0;

/// Of a threshold that is exact in both formats.
const EXTEND: Inversion = Inversion::Extend { epsilon: 0.25 };

fn main() -> ExitCode {
    // `cargo test NAME` passes the name to every test target; this one is its own only test.
    if std::env::args().skip(1).any(|argument| !argument.starts_with('-') && !"quotients".contains(&argument))
    {
        return ExitCode::SUCCESS;
    }
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(failed) => {
            eprintln!("{failed} quotients failed");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Parameters other than the typical ones: where those switch off a part of the energy, and splines whose coefficients are
/// exact in `f64`, from control points at equal distances of ½. Rounded ones make the force jump by a rounding error at each
/// control point, which a definition in 96 digits divides by the gap.
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

/// The number of quotients that failed.
fn run() -> Result<usize, String> {
    println!("Errors of quotients in units of u (1 + κ) max(|D|, |ψii| + |ψij|); each may reach {C}.");
    println!("flat: how many stay below {C} u max(|D|, |ψii| + |ψij|).");
    println!("terms: how many need Σ|terms| in that maximum. pole: twists below the floor of a pole.");
    println!("range: the exact value leaves the format.\n");
    println!(
        "{:28} {:6} {:4} {:>8} {:>7} {:>8} {:>6} {:>6} {:>6} {:>6}",
        "material", "", "", "judged", "worst", "flat", "terms", "pole", "range", "failed"
    );
    let mut work = Vec::new();
    for entry in CATALOGUE {
        let others = OTHERS.iter().filter(|(name, _)| *name == entry.name).map(|&(_, values)| values);
        for values in std::iter::once(entry.typical()).chain(others) {
            work.extend([Inversion::Refuse, EXTEND].map(|inversion| (entry, values, inversion)));
        }
    }
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        while let Some(&(entry, values, inversion)) = work.get(next.fetch_add(1, Ordering::Relaxed)) {
            done.push((entry.name, inversion, judge(entry, values, inversion)));
        }
        done
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut tables = Vec::new();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        for worker in workers {
            tables.extend(worker.join().map_err(|_| "a judge panicked")?);
        }
        Ok::<_, String>(())
    })?;
    tables.sort_by_key(|&(name, inversion, _)| (name, inversion == EXTEND));

    let mut total = Tally::default();
    let mut failures = Vec::new();
    for (name, inversion, tallies) in tables {
        let word = if inversion == EXTEND { "extend" } else { "refuse" };
        for (precision, tally) in tallies? {
            println!("{name:28} {word:6} {precision:4} {tally}");
            let label = |failure: &String| format!("failed: {name} {word} {precision} {failure}");
            failures.extend(tally.failures.iter().map(label));
            total.add(&tally);
        }
    }
    println!("{:28} {:6} {:4} {total}", "all", "", "");
    for failure in &failures {
        println!("{failure}");
    }
    Ok(total.failed)
}

/// The tallies of both formats; none where the material has no extension.
fn judge(
    entry: &Entry,
    values: &[&[f64]],
    inversion: Inversion,
) -> Result<Vec<(&'static str, Tally)>, String> {
    let rounded: Vec<Vec<f64>> =
        values.iter().map(|list| list.iter().map(|&value| f64::from(value as f32)).collect()).collect();
    let values: Vec<&[f64]> = rounded.iter().map(Vec::as_slice).collect();
    let declared: Lazy = LazyCell::new(Box::new(|| Declared::read(&entry.description, &values, inversion)));
    match entry.visit(&values, inversion, Judge { values: &values, inversion, declared }) {
        Ok(tallies) => tallies,
        Err(Inadmissible::NoExtension { .. } | Inadmissible::DoesNotRestore { .. }) => Ok(Vec::new()),
        Err(error) => Err(format!("{}: {error}", entry.name)),
    }
}

/// Expressions of an energy, understood when they are first asked for.
type Lazy<'a> = LazyCell<Result<Declared, String>, Box<dyn FnOnce() -> Result<Declared, String> + 'a>>;

struct Judge<'a> {
    values: &'a [&'a [f64]],
    inversion: Inversion,
    declared: Lazy<'a>,
}

impl Visitor for Judge<'_> {
    type Output = Result<Vec<(&'static str, Tally)>, String>;

    fn visit<M: piola::material::Declared + 'static>(self, material: M) -> Self::Output {
        let threshold = match self.inversion {
            Inversion::Refuse => None,
            Inversion::Extend { epsilon } => Some(epsilon),
        };
        // All but the smallest gaps of the second one straddle a control point of the exact splines.
        let mut scales = vec![1.1, 1.5 - 1e-5, 4.0, 30.0, 0.05, 1e-6];
        scales.extend(upper_end(&material));
        let moved = match self.inversion {
            Inversion::Refuse => None,
            Inversion::Extend { epsilon } => {
                let inversion = Inversion::Extend { epsilon: epsilon * (1.0 + FRACTION) };
                Some(M::from_values(self.values, inversion).map_err(|error| error.to_string())?)
            }
        };
        let subject = Subject { material: &material, moved: moved.as_ref(), declared: &self.declared };
        let signed = material.admits([1.0, 0.9, -0.8]);
        let samples = samples(&scales, signed, threshold);
        Ok(vec![
            ("f64", tally(&subject, &samples, |value: f64| value)?),
            ("f32", tally(&subject, &samples, |value: f32| f64::from(value))?),
        ])
    }
}

/// Nearly the size at which a ball leaves the domain, if it ever does.
fn upper_end(material: &impl Material) -> Option<f64> {
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

/// By which a threshold is moved, to see what it changes.
const FRACTION: f64 = 1.0 / (1u64 << 20) as f64;

/// What is judged, also with a threshold that is larger by [`FRACTION`].
struct Subject<'a, 'l, M> {
    material: &'a M,
    moved: Option<&'a M>,
    declared: &'a Lazy<'l>,
}

/// All quotients at all samples, rounded to the format.
fn tally<M: Material, R: Real<Mask = bool>>(
    &Subject { material, moved, declared }: &Subject<'_, '_, M>,
    samples: &[[f64; 3]],
    widen: fn(R) -> f64,
) -> Result<Tally, String> {
    let mut tally = Tally::default();
    let mut judged = HashSet::new();
    for &sample in samples {
        let stretches = sample.map(R::splat);
        let exact = stretches.map(widen);
        // Gaps below the format's resolution are the gap zero, which is judged once.
        if !material.admits(stretches) || !judged.insert(exact.map(f64::to_bits)) {
            continue;
        }
        let blocks = material.blocks(stretches);
        let (flips, twists) = expected(material, exact);
        let floor = widen(pole_floor(stretches));
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            for (sign, quotient, found) in
                [('-', flips[pair], blocks.flip[pair]), ('+', twists[pair], blocks.twist[pair])]
            {
                if sign == '+' && material.has_pole() && exact[i] + exact[j] < floor {
                    tally.pole += 1;
                    continue;
                }
                if !R::splat(quotient.scale.to_f64()).is_finite() {
                    tally.range += 1;
                    continue;
                }
                let found = widen(found);
                let mut quotient = quotient;
                let mut error = quotient.error(found, R::UNIT_ROUNDOFF);
                if error.conditioned > C
                    && let Some(moved) = moved
                {
                    let (flips, twists) = expected(moved, exact);
                    let there = if sign == '-' { flips[pair] } else { twists[pair] };
                    quotient = quotient.with_threshold(there.value, FRACTION);
                    error = quotient.error(found, R::UNIT_ROUNDOFF);
                }
                tally.judged += 1;
                tally.flat += usize::from(error.flat <= C);
                if error.conditioned > C {
                    let (flip_terms, twist_terms) = declared.as_ref().map_err(String::clone)?.terms(exact);
                    let terms = if sign == '-' { flip_terms[pair] } else { twist_terms[pair] };
                    error = quotient.with_terms(terms).error(found, R::UNIT_ROUNDOFF);
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
    Ok(tally)
}

/// What has been judged.
#[derive(Default)]
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
