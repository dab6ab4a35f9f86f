//! How long calls take.

use std::time::{Duration, Instant};

/// How often something is timed.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Of how many repeats the least and the median are taken.
    pub repeats: usize,
    /// How long a repeat lasts at least; it consists of as many calls.
    pub at_least: Duration,
}

/// Nanoseconds per point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// Of the fastest repeat, which was disturbed the least.
    pub least: f64,
    /// Half of the repeats took longer.
    pub median: f64,
}

/// Times calls that each work on so many points.
pub fn time(effort: Effort, points: usize, mut call: impl FnMut()) -> Times {
    let [times] = time_in_turns(effort, points, [&mut call]);
    times
}

/// Times several calls, a repeat of each in turns, so that what disturbs one disturbs the others too.
pub fn time_in_turns<const N: usize>(
    effort: Effort,
    points: usize,
    mut calls: [&mut dyn FnMut(); N],
) -> [Times; N] {
    let counts = calls.each_mut().map(|call| {
        // The first call finds its numbers in no cache and its memory not yet there.
        call();
        let start = Instant::now();
        call();
        let once = start.elapsed().max(Duration::from_nanos(1));
        effort.at_least.as_nanos().div_ceil(once.as_nanos()).max(1)
    });
    let mut found = [const { Vec::new() }; N];
    for _ in 0..effort.repeats {
        for ((call, count), found) in calls.iter_mut().zip(counts).zip(&mut found) {
            let start = Instant::now();
            for _ in 0..count {
                call();
            }
            found.push(start.elapsed().as_secs_f64() * 1e9 / (count as f64 * points as f64));
        }
    }
    found.map(|mut times| {
        times.sort_by(f64::total_cmp);
        Times { least: times[0], median: times[times.len() / 2] }
    })
}
