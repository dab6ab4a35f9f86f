//! Times of calls, and the machine that measures them.

use std::time::{Duration, Instant};

/// Effort of timing something.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Number of repeats of which the least and the median are taken.
    pub repeats: usize,
    /// Minimum time of a repeat; it consists of as many calls as fit.
    pub at_least: Duration,
    /// After how much time for one call in all its repeats no further one is made, if there have been three.
    pub at_most: Duration,
}

/// Nanoseconds per point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// Time in the fastest repeat, which was disturbed the least.
    pub least: f64,
    /// Half of the repeats took longer.
    pub median: f64,
}

/// Times calls that each work on `points` points.
pub fn time(effort: Effort, points: usize, mut call: impl FnMut()) -> Times {
    time_in_turns(effort, points, &mut [&mut call])[0]
}

/// Times several calls, a repeat of each in turns, so that what disturbs one disturbs the others too.
pub fn time_in_turns(effort: Effort, points: usize, calls: &mut [&mut dyn FnMut()]) -> Vec<Times> {
    let counts: Vec<u128> = calls
        .iter_mut()
        .map(|call| {
            // The first call finds its numbers in no cache and its memory not yet there.
            call();
            let start = Instant::now();
            call();
            let once = start.elapsed().max(Duration::from_nanos(1));
            effort.at_least.as_nanos().div_ceil(once.as_nanos()).max(1)
        })
        .collect();
    let mut found = vec![Vec::new(); calls.len()];
    let mut spent = vec![Duration::ZERO; calls.len()];
    for repeat in 0..effort.repeats {
        for (index, call) in calls.iter_mut().enumerate() {
            if repeat >= 3 && spent[index] > effort.at_most {
                continue;
            }
            // What the one before has driven out of the caches is not this one's fault.
            call();
            let start = Instant::now();
            for _ in 0..counts[index] {
                call();
            }
            let elapsed = start.elapsed();
            spent[index] += elapsed;
            found[index].push(elapsed.as_secs_f64() * 1e9 / (counts[index] as f64 * points as f64));
        }
    }
    found.into_iter().map(Times::of).collect()
}

impl Times {
    /// Least and median of the times of repeats, at least one.
    pub fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        Self { least: times[0], median: times[times.len() / 2] }
    }
}

/// The processor's name, if the system reports it.
#[must_use]
pub fn processor() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let mut fields = cpuinfo.lines().filter_map(|line| line.split_once(':'));
        fields.find(|(key, _)| key.trim() == name).map(|(_, value)| value.trim())
    };
    match (field("model name"), field("cpu family"), field("model")) {
        (Some(name), Some(family), Some(model)) => format!("{name} (family {family}, model {model})"),
        (Some(name), ..) => name.to_owned(),
        _ => format!("unknown {}", std::env::consts::ARCH),
    }
}
