//! Reproducible random numbers: SplitMix64 \[SLF14\], too small to justify a dependency.
//!
//! A seed gives the same samples on every machine and in every later version.
//!
//! \[SLF14\] Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, 2014.

/// A stream of pseudorandom numbers.
///
/// ```
/// let mut random = piola::__private::random::Random::new(7);
/// let x = random.uniform(-1.0, 1.0);
/// assert_eq!(x, -0.22034050321745702);
/// ```
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Starts the stream of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        // The upper 53 bits are a uniform integer that a double holds exactly.
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Uniform among 0 … count − 1; `count` is far below 2³² in all uses, so that the bias of the remainder
    /// vanishes.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    /// True on average once in `count` times.
    pub fn once_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// A 3×3 matrix with entries uniform in [−1, 1).
    pub fn matrix(&mut self) -> [[f64; 3]; 3] {
        std::array::from_fn(|_| std::array::from_fn(|_| self.uniform(-1.0, 1.0)))
    }

    /// A rotation matrix, from a unit quaternion uniform over the sampled part of the ball.
    pub fn rotation(&mut self) -> [[f64; 3]; 3] {
        loop {
            let [w, x, y, z] = std::array::from_fn(|_| self.uniform(-1.0, 1.0));
            let norm = w * w + x * x + y * y + z * z;
            // Outside the ball corners would be preferred; close to zero the division would magnify rounding.
            if !(0.01..=1.0).contains(&norm) {
                continue;
            }
            let s = 2.0 / norm;
            return [
                [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
                [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
                [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
            ];
        }
    }
}
