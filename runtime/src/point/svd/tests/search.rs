//! A search for matrices that hurt the decomposition most, and the worst it has found.
//!
//! `found.txt` holds one matrix per line: the kernel, the quantity, the precision, the error in eps when it
//! was found on the worst back end of its machine, and nine entries as bit patterns, row by row. The first
//! lines were found for Jacobi's method, the last ten for the present kernels. The search that writes such
//! lines climbs on from them and from new starts. It takes the same few steps every time;
//! `PIOLA_SEARCH_SECONDS` sets its duration:
//!
//! ```text
//! PIOLA_SEARCH_SECONDS=1200 cargo test -p piola --lib search_for_the_worst -- --nocapture
//! ```

use std::time::{Duration, Instant};

use super::*;

/// A real type whose bits can be read, written and mutated.
trait Bits: Scalar {
    const NAME: &'static str;
    const WIDTH: u32;
    /// Entries stay between 2^−RANGE and 2^RANGE in magnitude, or zero: no stretch is then subnormal.
    const RANGE: i32;
    fn bits(self) -> u64;
    fn from_bits(bits: u64) -> Self;
}

impl Bits for f64 {
    const NAME: &'static str = "f64";
    const WIDTH: u32 = 64;
    const RANGE: i32 = 996;
    fn bits(self) -> u64 {
        self.to_bits()
    }
    fn from_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

impl Bits for f32 {
    const NAME: &'static str = "f32";
    const WIDTH: u32 = 32;
    const RANGE: i32 = 99;
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
    fn from_bits(bits: u64) -> Self {
        // The upper half is zero: patterns come from `bits` or from lines that were printed from it.
        Self::from_bits(bits as u32)
    }
}

const KERNELS: [(&str, Method); 2] =
    [("svd", Method::Plain), ("svd_signed_by_determinant", Method::SignedByDeterminant)];
const QUANTITIES: [&str; 3] = ["backward", "left", "right"];

/// The worst of all back ends.
fn error<R: Bits>(method: Method, quantity: &str, F: &Exact) -> f64 {
    let mut worst = Worst::default();
    let F = rounded::<R>(F);
    for (_, answers) in by_every_backend(method, &[F]) {
        worst.see(&F, &answers[0]);
    }
    match quantity {
        "backward" => worst.backward,
        "left" => worst.left,
        _ => worst.right,
    }
}

/// A line of `found.txt`.
struct Found {
    quantity: &'static str,
    precision: &'static str,
    error: f64,
    bits: [u64; 9],
}

impl Found {
    fn all() -> Vec<Self> {
        let line = |line: &'static str| {
            let mut words = line.split(' ').skip(1);
            let mut word = || words.next().expect("thirteen words in a line");
            Self {
                quantity: word(),
                precision: word(),
                error: word().parse().expect("the error in eps"),
                bits: std::array::from_fn(|_| u64::from_str_radix(word(), 16).expect("a bit pattern")),
            }
        };
        include_str!("found.txt").lines().map(line).collect()
    }

    /// The matrix, if it is one of this precision.
    fn matrix<R: Bits>(&self) -> Option<Exact> {
        let entry = |k: usize| R::from_bits(self.bits[k]).into();
        (self.precision == R::NAME)
            .then(|| std::array::from_fn(|i| std::array::from_fn(|j| entry(3 * i + j))))
    }
}

/// One of 0, …, n − 1.
fn pick(random: &mut Random, n: u32) -> usize {
    random.uniform(0.0, f64::from(n)) as usize
}

fn start(random: &mut Random) -> Exact {
    let mut exponent = |deepest: f64| 2f64.powf(random.uniform(-deepest, 0.0));
    let spectrum = [1.0, exponent(60.0), exponent(60.0)];
    let gap = exponent(60.0);
    match pick(random, 7) {
        0 => random.matrix(),
        1 => product(&random.rotation(), &product(&diagonal(spectrum), &random.rotation())),
        2 => product(
            &random.rotation(),
            &product(&diagonal([1.0, 1.0 + gap, spectrum[1]]), &random.rotation()),
        ),
        3 => perturbed(&random.rotation(), gap, &random.matrix()),
        4 => random.matrix().map(|row| row.map(|x| x * 2f64.powi(-(pick(random, 50) as i32)))),
        5 => perturbed(&diagonal([1.0, 1.0 + gap, 1.0 - gap]), spectrum[1], &random.matrix()),
        _ => product(&diagonal(spectrum), &product(&random.matrix(), &diagonal([gap, 1.0, spectrum[2]]))),
    }
}

/// A neighbour of F, near or far.
fn mutated<R: Bits>(F: &Exact, random: &mut Random) -> Exact {
    let mut G = *F;
    let (i, j, k) = (pick(random, 3), pick(random, 3), pick(random, 3));
    match pick(random, 8) {
        0 => {
            let bit = random.uniform(0.0, f64::from(R::WIDTH)) as u32;
            G[i][j] = R::from_bits(R::splat(G[i][j]).bits() ^ (1 << bit)).into();
        }
        1 => {
            // The bits below the exponent: a step within rounding of F.
            let bit = pick(random, 8) as u32;
            G[i][j] = R::from_bits(R::splat(G[i][j]).bits() ^ (1 << bit)).into();
        }
        2 => G = perturbed(F, 2f64.powf(random.uniform(-50.0, 0.0)), &random.matrix()),
        3 => G[i][j] *= 1.0 + 2f64.powf(random.uniform(-50.0, 1.0)) * random.uniform(-1.0, 1.0),
        4 => G[i][j] = [0.0, 1.0, G[k][j], -G[i][j], G[i][k]][pick(random, 5)],
        5 => G[i] = G[i].map(|x| x * 2f64.powi(pick(random, 9) as i32 - 4)),
        6 => {
            let factor = 2f64.powi(pick(random, 9) as i32 - 4);
            G.iter_mut().for_each(|row| row[j] *= factor);
        }
        _ => {
            // One column moves towards another.
            let share = 2f64.powf(random.uniform(-30.0, 0.0));
            G.iter_mut().for_each(|row| row[j] += share * row[k]);
        }
    }
    G
}

fn is_in_range<R: Bits>(F: &Exact) -> bool {
    let largest = F.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    F.iter().flatten().all(|x| x.is_finite()) && largest.log2().abs() <= f64::from(R::RANGE)
}

/// Least effort of a search: a number of candidates, and a time.
#[derive(Clone, Copy)]
struct Budget {
    steps: usize,
    time: Duration,
}

/// Climbs from one start after the other until the budget is spent; the worst matrix and its error.
fn search<R: Bits>(method: Method, quantity: &str, budget: Budget, seed: u64) -> (f64, Exact) {
    const PATIENCE: usize = 4_000;
    const ELITE: usize = 12;
    let as_held = |F: &Exact| exact(&rounded::<R>(F));
    let mut random = Random::new(seed);
    let judged = |F: Exact| (error::<R>(method, quantity, &F), F);
    let mut elite: Vec<_> = Found::all().iter().filter_map(Found::matrix::<R>).map(judged).collect();
    let begin = Instant::now();
    let goes_on = |steps: usize| steps < budget.steps || begin.elapsed() < budget.time;
    let mut steps = 0;
    while goes_on(steps) {
        let first = if random.uniform(0.0, 1.0) < 0.3 && !elite.is_empty() {
            elite[pick(&mut random, elite.len() as u32)].1
        } else {
            start(&mut random)
        };
        let mut F = as_held(&first);
        if !is_in_range::<R>(&F) {
            continue;
        }
        let mut record = error::<R>(method, quantity, &F);
        let mut since = 0;
        while since < PATIENCE && goes_on(steps) {
            (steps, since) = (steps + 1, since + 1);
            let mut candidate = mutated::<R>(&F, &mut random);
            if random.uniform(0.0, 1.0) < 0.3 {
                candidate = mutated::<R>(&candidate, &mut random);
            }
            let candidate = as_held(&candidate);
            if !is_in_range::<R>(&candidate) {
                continue;
            }
            let found = error::<R>(method, quantity, &candidate);
            if found >= record {
                if found > record {
                    since = 0;
                }
                (record, F) = (found, candidate);
            }
        }
        elite.push((record, F));
        elite.sort_by(|a, b| b.0.total_cmp(&a.0));
        elite.truncate(ELITE);
    }
    elite.into_iter().next().unwrap_or((0.0, [[0.0; 3]; 3]))
}

fn report<R: Bits>((kernel, method): (&str, Method), quantity: &str, budget: Budget, seed: u64) {
    let (error, F) = search::<R>(method, quantity, budget, seed);
    let bits: Vec<_> = F.iter().flatten().map(|&x| format!("{:x}", R::splat(x).bits())).collect();
    println!("{kernel} {quantity} {} {error:.3} {}", R::NAME, bits.join(" "));
    assert!(error <= bound(quantity), "{quantity} error of {kernel}: {error} eps for {F:?}");
}

fn bound(quantity: &str) -> f64 {
    if quantity == "backward" { BACKWARD } else { ORTHOGONALITY }
}

#[test]
fn search_for_the_worst() {
    const STEPS: usize = 100_000;
    let seconds: f64 = std::env::var("PIOLA_SEARCH_SECONDS").map_or(0.0, |s| s.parse().expect("seconds"));
    // U and V are the same from both kernels, so that their orthogonality needs one search.
    let searches = [(KERNELS[0], 0, 0.3), (KERNELS[1], 0, 0.3), (KERNELS[0], 1, 0.2), (KERNELS[0], 2, 0.2)];
    for (seed, (kernel, quantity, share)) in (1..).zip(searches) {
        let budget = Budget { steps: STEPS, time: Duration::from_secs_f64(share * seconds / 2.0) };
        report::<f64>(kernel, QUANTITIES[quantity], budget, seed);
        report::<f32>(kernel, QUANTITIES[quantity], budget, seed);
    }
}

#[test]
fn the_worst_that_was_found_stays_within_the_bound() {
    fn check<R: Bits>(found: &Found) -> bool {
        let Some(F) = found.matrix::<R>() else { return false };
        for (kernel, method) in KERNELS {
            for quantity in QUANTITIES {
                let error = error::<R>(method, quantity, &F);
                assert!(error <= bound(quantity), "{quantity} error of {kernel}: {error} eps for {F:?}");
            }
        }
        found.error <= bound(found.quantity)
    }
    let all = Found::all();
    assert!(all.iter().all(|found| check::<f64>(found) || check::<f32>(found)));
    assert!(all.len() >= 8, "a find for each kernel, quantity and precision");
}
