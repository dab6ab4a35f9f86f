//! A search for matrices that hurt the decomposition most, and the worst it has found.
//!
//! `found.txt` holds one matrix per line: the method, the quantity, the precision, the error in eps when it
//! was found on the worst back end of its machine, and nine entries as the bits of doubles, row by row. The
//! first lines were found for Jacobi's method, the last ten for the present kernels. The search that writes
//! such lines climbs on from them and from new starts. It takes the same few steps every time;
//! `PIOLA_SEARCH_SECONDS` sets its duration:
//!
//! ```text
//! PIOLA_SEARCH_SECONDS=1200 cargo test -p piola --lib search_for_the_worst -- --nocapture
//! ```

use std::any::type_name;
use std::time::{Duration, Instant};

use super::*;

/// The worst errors of all back ends.
fn errors<R: Scalar>(method: Method, F: &Exact) -> Worst {
    let mut worst = Worst::default();
    let F = rounded::<R>(F);
    for (_, answers) in by_every_backend(method, &[F]) {
        worst.see(&F, &answers[0]);
    }
    worst
}

/// The matrices of `found.txt` of a format.
fn found<R>() -> impl Iterator<Item = Exact> {
    include_str!("found.txt").lines().filter_map(|line| {
        let words: Vec<_> = line.split(' ').collect();
        let [_, quantity, precision, error, entries @ ..] = &words[..] else {
            panic!("thirteen words in a line")
        };
        let (_, bound) = PROMISES.iter().find(|(name, _)| name == quantity).expect("a quantity");
        assert!(error.parse::<f64>().expect("the error in eps") <= *bound, "when it was found: {line}");
        let entry = |k: usize| f64::from_bits(u64::from_str_radix(entries[k], 16).expect("a bit pattern"));
        let F = std::array::from_fn(|i| std::array::from_fn(|j| entry(3 * i + j)));
        (*precision == type_name::<R>()).then_some(F)
    })
}

fn start(random: &mut Random) -> Exact {
    let mut exponent = |deepest: f64| 2f64.powf(random.uniform(-deepest, 0.0));
    let spectrum = [1.0, exponent(60.0), exponent(60.0)];
    let gap = exponent(60.0);
    match random.below(7) {
        0 => random.matrix(),
        1 => framed(&random.rotation(), spectrum, &random.rotation()),
        2 => framed(&random.rotation(), [1.0, 1.0 + gap, spectrum[1]], &random.rotation()),
        3 => moved(&random.rotation(), gap, &random.matrix()),
        4 => random.matrix().map(|row| row.map(|x| x * 2f64.powi(-(random.below(50) as i32)))),
        5 => moved(&diagonal([1.0, 1.0 + gap, 1.0 - gap]), spectrum[1], &random.matrix()),
        _ => product(&diagonal(spectrum), &product(&random.matrix(), &diagonal([gap, 1.0, spectrum[2]]))),
    }
}

/// A neighbour of F, near or far.
fn mutated<R: Scalar>(F: &Exact, random: &mut Random) -> Exact {
    let mut G = *F;
    // The lowest bit of R in a double.
    let lowest = (R::UNIT_ROUNDOFF / (f64::EPSILON / 2.0)).log2() as usize;
    let (i, j, k) = (random.below(3), random.below(3), random.below(3));
    match random.below(8) {
        0 => {
            let bit = lowest + random.below(64 - lowest);
            G[i][j] = f64::from_bits(G[i][j].to_bits() ^ (1 << bit));
        }
        1 => {
            // The bits below the exponent: a step within rounding of F.
            let bit = lowest + random.below(8);
            G[i][j] = f64::from_bits(G[i][j].to_bits() ^ (1 << bit));
        }
        2 => G = moved(F, 2f64.powf(random.uniform(-50.0, 0.0)), &random.matrix()),
        3 => G[i][j] *= 1.0 + 2f64.powf(random.uniform(-50.0, 1.0)) * random.uniform(-1.0, 1.0),
        4 => G[i][j] = [0.0, 1.0, G[k][j], -G[i][j], G[i][k]][random.below(5)],
        5 => G[i] = G[i].map(|x| x * 2f64.powi(random.below(9) as i32 - 4)),
        6 => {
            let factor = 2f64.powi(random.below(9) as i32 - 4);
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

/// True if the largest entry is so far from the ends of the range that no stretch is subnormal.
fn is_in_range<R: Scalar>(F: &Exact) -> bool {
    let largest = F.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    F.iter().flatten().all(|x| x.is_finite()) && largest.log2().abs() <= -R::MIN_POSITIVE.log2() - 27.0
}

/// Least effort of a search: a number of candidates, and a time.
#[derive(Clone, Copy)]
struct Budget {
    steps: usize,
    time: Duration,
}

/// Climbs from one start after the other until the budget is spent; the worst matrix and its error.
fn search<R: Scalar>(method: Method, quantity: usize, budget: Budget, seed: u64) -> (f64, Exact) {
    const PATIENCE: usize = 4_000;
    const ELITE: usize = 12;
    let as_held = |F: &Exact| exact(&rounded::<R>(F));
    let mut random = Random::new(seed);
    let error = |F: &Exact| errors::<R>(method, F).0[quantity];
    let judged = |F: Exact| {
        METHODS.iter().for_each(|&method| errors::<R>(method, &F).check("found.txt"));
        (error(&F), F)
    };
    let mut elite: Vec<_> = found::<R>().map(judged).collect();
    assert!(elite.len() >= 4, "a find for each method and quantity");
    let begin = Instant::now();
    let goes_on = |steps: usize| steps < budget.steps || begin.elapsed() < budget.time;
    let mut steps = 0;
    while goes_on(steps) {
        let first = if random.uniform(0.0, 1.0) < 0.3 && !elite.is_empty() {
            elite[random.below(elite.len())].1
        } else {
            start(&mut random)
        };
        let mut F = as_held(&first);
        if !is_in_range::<R>(&F) {
            continue;
        }
        let mut record = error(&F);
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
            let found = error(&candidate);
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

fn report<R: Scalar>(method: Method, quantity: usize, budget: Budget, seed: u64) {
    let (error, F) = search::<R>(method, quantity, budget, seed);
    let bits: Vec<_> = F.as_flattened().iter().map(|x| format!("{:x}", x.to_bits())).collect();
    let (name, bound) = PROMISES[quantity];
    println!("{method:?} {name} {} {error:.3} {}", type_name::<R>(), bits.join(" "));
    assert!(error <= bound, "{name} error of {method:?}: {error} eps for {F:?}");
}

#[test]
fn search_for_the_worst() {
    const STEPS: usize = 100_000;
    let seconds: f64 = std::env::var("PIOLA_SEARCH_SECONDS").map_or(0.0, |s| s.parse().expect("seconds"));
    // U and V are the same from both methods, so that their orthogonality needs one search.
    let searches = [(METHODS[0], 0, 0.3), (METHODS[1], 0, 0.3), (METHODS[0], 1, 0.2), (METHODS[0], 2, 0.2)];
    for (seed, (method, quantity, share)) in (1..).zip(searches) {
        let budget = Budget { steps: STEPS, time: Duration::from_secs_f64(share * seconds / 2.0) };
        report::<f64>(method, quantity, budget, seed);
        report::<f32>(method, quantity, budget, seed);
    }
}
