//! Arguments that nobody should give, and good ones among them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use piola::__private::random::Random;
use piola::{Inversion, material};

/// Neo-Hookean solid, moduli in Pa.
#[material(domain(J > 0.0), extend)]
pub(crate) fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// Runs of each test, each with arguments of its own.
pub(crate) const SEEDS: u64 = 2000;

/// Numbers at which something ends.
const ENDS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    1e200,
    1e-200,
    f64::MIN_POSITIVE,
    5e-324,
    1e100,
    -1e-100,
    f64::EPSILON,
];

/// Numbers of nodes and cells that no address space holds.
pub(crate) const TOO_MANY: [usize; 4] = [1 << 48, 1 << 60, usize::MAX / 2, usize::MAX];

/// Calls a function with arguments of many seeds.
#[track_caller]
pub(crate) fn check(mut call: impl FnMut(&mut Hostile)) {
    for seed in 0..SEEDS {
        let mut hostile = Hostile(Random::new(seed));
        assert!(catch_unwind(AssertUnwindSafe(|| call(&mut hostile))).is_ok(), "panic with seed {seed}");
    }
}

/// A source of arguments, good ones among them, so that each check is passed now and then.
pub(crate) struct Hostile(pub(crate) Random);

impl Hostile {
    pub(crate) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.below(choices.len())]
    }

    pub(crate) fn number(&mut self) -> f64 {
        if self.0.once_in(4) { self.one_of(&ENDS) } else { self.0.uniform(-2.0, 2.0) }
    }

    pub(crate) fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.number())
    }

    /// Mostly this length.
    pub(crate) fn length(&mut self, good: usize) -> usize {
        match self.0.below(6) {
            0 => self.0.below(2 * good + 2),
            1 => good.saturating_sub(1),
            _ => good,
        }
    }

    pub(crate) fn numbers(&mut self, good: usize) -> Vec<f64> {
        let all_good = self.0.once_in(2);
        (0..self.length(good))
            .map(|_| if all_good { self.0.uniform(0.5, 2.0) } else { self.number() })
            .collect()
    }

    pub(crate) fn points(&mut self, good: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut points = good.to_vec();
        points.resize(self.length(good.len()), [0.5; 3]);
        if self.0.once_in(2) && !points.is_empty() {
            let node = self.0.below(points.len());
            points[node] = self.point();
        }
        points
    }

    /// Mostly a node that exists.
    pub(crate) fn node(&mut self, nodes: usize) -> usize {
        match self.0.below(12) {
            0 => self.one_of(&TOO_MANY),
            1 => nodes,
            _ => self.0.below(nodes.clamp(1, 1000)),
        }
    }

    pub(crate) fn rubber(&mut self) -> Rubber {
        let mu = if self.0.once_in(8) { self.one_of(&[1e-300, 1e300, 1e150]) } else { 1e5 };
        let rubber = Rubber::new(mu, 4.0 * mu).expect("positive moduli");
        let inversion = match self.0.below(3) {
            0 => Inversion::Refuse,
            1 => Inversion::Extend { epsilon: 0.1 },
            _ => Inversion::Extend { epsilon: self.one_of(&[5e-324, 1e-100, 1.0 - f64::EPSILON]) },
        };
        rubber.with_inversion(inversion).expect("a threshold between 0 and 1")
    }
}
