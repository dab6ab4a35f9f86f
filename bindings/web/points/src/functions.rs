//! Functions of the portable lanes at random bits: equal checksums mean equal bits.

use piola::lanes::{Backend, Kernel, Lanes, Scalar};

/// Numbers at which each function is taken: twice as many as the longest registers hold, many times over.
const COUNT: usize = 1 << 14;

/// Functions of two numbers, the second of which most ignore.
const NAMES: [&str; 17] = [
    "sqrt",
    "cbrt",
    "ln",
    "exp",
    "ln_1p",
    "exp_m1",
    "sinh",
    "tanh",
    "asinh",
    "sin",
    "atan",
    "erf",
    "softplus",
    "powf",
    "max",
    "copysign",
    "power_of_two_scale",
];

/// Lines with format, function and checksum.
pub(crate) fn checksums() -> Vec<String> {
    let backend = Backend::portable();
    let double = backend.run(Apply { arguments: &random(f64::from_bits) });
    let single = backend.run(Apply { arguments: &random(|bits| f32::from_bits((bits >> 32) as u32)) });
    let double = double.map(|values| fold(values.into_iter().map(f64::to_bits)));
    let single = single.map(|values| fold(values.into_iter().map(|x| u64::from(x.to_bits()))));
    let lines = [("f64", double), ("f32", single)].map(|(format, sums)| {
        NAMES.into_iter().zip(sums).map(move |(name, sum)| format!("{format} {name} {sum:016x}"))
    });
    lines.into_iter().flatten().collect()
}

/// A checksum by a product and an exclusive or for each number [FNV-1a].
fn fold(bits: impl Iterator<Item = u64>) -> u64 {
    bits.fold(0xcbf2_9ce4_8422_2325, |sum, bits| (sum ^ bits).wrapping_mul(0x100_0000_01b3))
}

/// Numbers with random bits; every other one has an exponent near zero, where functions have values.
fn random<E>(from_bits: fn(u64) -> E) -> Vec<E> {
    let mut state = 1_u64;
    let number = |index| {
        // Xorshift by 13, 7 and 17.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let near_one = (state & 0x87ff_ffff_ffff_ffff) | 0x3800_0000_0000_0000;
        from_bits(if index % 2 == 0 { state } else { near_one })
    };
    (0..COUNT).map(number).collect()
}

struct Apply<'a, E> {
    arguments: &'a [E],
}

impl<E: Scalar> Kernel<E> for Apply<'_, E> {
    type Output = [Vec<E>; NAMES.len()];

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Self::Output {
        let mut results = [const { Vec::new() }; NAMES.len()];
        for arguments in self.arguments.chunks_exact(2 * R::LANES) {
            let (x, y) = (R::load(arguments), R::load(&arguments[R::LANES..]));
            let (scale, _) = x.power_of_two_scale();
            let values = [
                x.sqrt(),
                x.cbrt(),
                x.ln(),
                x.exp(),
                x.ln_1p(),
                x.exp_m1(),
                x.sinh(),
                x.tanh(),
                x.asinh(),
                x.sin(),
                x.atan(),
                x.erf(),
                x.softplus(),
                x.abs().powf(y),
                x.max(y),
                x.copysign(y),
                scale,
            ];
            for (value, results) in values.into_iter().zip(&mut results) {
                // Which bits a NaN has, no processor promises.
                let is_number = !(!value.less(R::splat(0.0)) & !R::splat(-1.0).less(value));
                let start = results.len();
                results.resize(start + R::LANES, arguments[0]);
                R::select(is_number, value, R::splat(-0.5)).store(&mut results[start..]);
            }
        }
        results
    }
}
