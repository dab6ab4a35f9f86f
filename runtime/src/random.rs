//! Reproducible random numbers: SplitMix64 \[SLF14\], small enough that no dependency is worth its place.
//!
//! Whoever draws samples states a seed, and gets the same samples on every machine.
//!
//! \[SLF14\] Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, 2014.

/// A stream of pseudorandom numbers.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        // The upper 53 bits are a uniform integer that a double holds exactly.
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// A 3×3 matrix with entries uniform in [−1, 1).
    pub(crate) fn matrix(&mut self) -> [[f64; 3]; 3] {
        std::array::from_fn(|_| std::array::from_fn(|_| self.uniform(-1.0, 1.0)))
    }

    /// A rotation matrix, uniform over the unit quaternions of the sampled ball.
    pub(crate) fn rotation(&mut self) -> [[f64; 3]; 3] {
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
