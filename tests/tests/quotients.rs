//! Every flip and twist of the catalogue at every gap, with a table: `cargo test --release -p piola-tests quotients`.
//!
//! A quotient D may err by 10 u (1 + κ) relative to max(|D|, |ψii| + |ψij|), where κ is its condition with respect to
//! relative changes of the stretches. Parameters are rounded to `f32` first, so that both formats judge one material.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test with its own main and a table to show"
)]

use std::process::ExitCode;

use piola::material::{Declared, Inadmissible, PAIRS};
use piola::quotient::pole_floor;
use piola::{Inversion, Real};
use piola_materials::{CATALOGUE, Entry, Visitor};
use piola_tests::quotients::{expected, samples};

/// The constant of the judgement |D − D*| ≤ C u (scale + sensitivity).
const C: f64 = 10.0;

/// Exact in both formats.
const EPSILON: f64 = 0.25;

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

/// The number of quotients that failed.
fn run() -> Result<usize, String> {
    println!("Errors of quotients in units of u (1 + κ) max(|D|, |ψii| + |ψij|); each may reach {C}.");
    println!("flat: how many stay below {C} u max(|D|, |ψii| + |ψij|).");
    println!("pole: twists below the floor of a pole. range: the exact value leaves the format.\n");
    println!(
        "{:28} {:6} {:4} {:>8} {:>7} {:>9} {:>7} {:>6} {:>6}",
        "material", "", "", "judged", "worst", "flat", "failed", "pole", "range"
    );
    let work: Vec<(&Entry, Inversion)> = CATALOGUE
        .iter()
        .flat_map(|entry| [Inversion::Refuse, Inversion::Extend { epsilon: EPSILON }].map(|i| (entry, i)))
        .collect();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    let worker = || {
        let mut done = Vec::new();
        while let Some(&(entry, inversion)) =
            work.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
        {
            done.push((entry.name, inversion, judge(entry, inversion)));
        }
        done
    };
    let mut tables: Vec<_> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        handles.into_iter().flat_map(|handle| handle.join().expect("a judge does not panic")).collect()
    });
    tables.sort_by_key(|&(name, inversion, _)| (name, inversion != Inversion::Refuse));

    let mut total = Tally::default();
    let mut failures = Vec::new();
    for (name, inversion, tallies) in tables {
        let word = if inversion == Inversion::Refuse { "refuse" } else { "extend" };
        for (precision, tally) in tallies? {
            println!("{name:28} {word:6} {precision:4} {tally}");
            failures
                .extend(tally.failures.iter().map(|failure| format!("{name} {word} {precision}: {failure}")));
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
fn judge(entry: &Entry, inversion: Inversion) -> Result<Vec<(&'static str, Tally)>, String> {
    let values = parameters(entry)?;
    let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
    match entry.visit(&values, inversion, Judge(inversion)) {
        Ok(tallies) => Ok(tallies),
        Err(Inadmissible::NoExtension { .. } | Inadmissible::DoesNotRestore { .. }) => Ok(Vec::new()),
        Err(error) => Err(format!("{}: {error}", entry.name)),
    }
}

/// Typical parameters, each rounded to `f32`.
fn parameters(entry: &Entry) -> Result<Vec<Vec<f64>>, String> {
    let typical: &[&[f64]] = match entry.name {
        "arap" | "symmetric_dirichlet" => &[&[3.5e5]],
        "arruda_boyce" => &[&[3.5e5], &[3.0], &[3.1e6]],
        "blatz_ko" => &[&[3.5e5], &[0.6], &[1.7]],
        "fung" => &[&[1e4], &[0.5], &[0.3]],
        "gent" => &[&[3.5e5], &[40.0], &[3.1e6]],
        "mooney_rivlin" | "mooney_rivlin_coupled" => &[&[3.5e5], &[0.9e5], &[3.1e6]],
        "ogden" => &[&[6.3e5, 1.2e3, -1e4], &[1.3, 5.0, -2.0], &[1e7]],
        "yeoh" => &[&[3.5e5], &[-7e3], &[350.0], &[3.1e6]],
        "varga" | "hencky" | "neo_hookean_lnj" | "stvk" | "rotated_linear" | "fixed_corotated"
        | "stable_neo_hookean" => &[&[3.5e5], &[3.1e6]],
        name => return Err(format!("{name}: no parameters")),
    };
    Ok(typical.iter().map(|list| list.iter().map(|&value| f64::from(value as f32)).collect()).collect())
}

struct Judge(Inversion);

impl Visitor for Judge {
    type Output = Vec<(&'static str, Tally)>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        let threshold = match self.0 {
            Inversion::Refuse => None,
            Inversion::Extend { epsilon } => Some(epsilon),
        };
        let mut scales = vec![1.1, 4.0, 30.0, 0.05, 1e-6];
        scales.extend(upper_end(&material));
        let signed = material.admits([1.0, 0.9, -0.8]);
        let samples = samples(&scales, signed, threshold);
        vec![
            ("f64", tally(&material, &samples, |value: f64| value)),
            ("f32", tally(&material, &samples, |value: f32| f64::from(value))),
        ]
    }
}

/// Nearly the size at which a ball leaves the domain, if it ever does.
fn upper_end(material: &impl Declared) -> Option<f64> {
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

/// All quotients at all samples, rounded to the format.
fn tally<R: Real<Mask = bool>>(material: &impl Declared, samples: &[[f64; 3]], widen: fn(R) -> f64) -> Tally {
    let mut tally = Tally::default();
    let mut last = [f64::NAN; 3];
    for &sample in samples {
        let stretches = sample.map(R::splat);
        let exact = stretches.map(widen);
        // Gaps below the format's resolution are the gap zero, which is judged once.
        if exact == last || !material.admits(stretches) {
            continue;
        }
        last = exact;
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
                let (flat, error) = quotient.error(widen(found), R::UNIT_ROUNDOFF);
                tally.judged += 1;
                tally.flat += usize::from(flat <= C);
                tally.failed += usize::from(error > C);
                if error > tally.worst {
                    tally.worst = error;
                    if error > C {
                        tally.failures.push(format!(
                            "D{sign}{}{} at {exact:?} is {:e}, not {:e}: {error:.1} u(1+κ), {flat:.1} u",
                            i + 1,
                            j + 1,
                            widen(found),
                            quotient.value.to_f64(),
                        ));
                    }
                }
            }
        }
    }
    tally
}

/// What has been judged.
#[derive(Default)]
struct Tally {
    judged: usize,
    worst: f64,
    flat: usize,
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
        self.failed += other.failed;
        self.pole += other.pole;
        self.range += other.range;
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { judged, worst, flat, failed, pole, range, .. } = self;
        let share = 100.0 * *flat as f64 / (*judged).max(1) as f64;
        write!(f, "{judged:8} {worst:7.1} {share:8.2}% {failed:7} {pole:6} {range:6}")
    }
}
