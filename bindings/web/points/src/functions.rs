//! Functions of the portable lanes at random bits: equal checksums mean equal bits.

use piola::lanes::{Backend, Kernel, Lanes, Scalar};

/// Numbers at which each function is taken: twice as many as the longest registers hold, many times over.
const COUNT: usize = 1 << 14;

/// Lines with format, function and checksum.
pub(crate) fn checksums() -> Vec<String> {
    let backend = Backend::portable();
    let double = backend.run(Apply { arguments: &random(f64::from_bits) });
    let single = backend.run(Apply { arguments: &random(|bits| f32::from_bits((bits >> 32) as u32)) });
    let double = double.into_iter().map(|(name, values)| ("f64", name, fold(values, f64::to_bits)));
    let single = single.into_iter().map(|(name, values)| ("f32", name, fold(values, |x| x.to_bits().into())));
    double.chain(single).map(|(format, name, sum)| format!("{format} {name} {sum:016x}")).collect()
}

/// A checksum by a product and an exclusive or for each number [FNV-1a].
fn fold<E>(values: Vec<E>, bits: fn(E) -> u64) -> u64 {
    let bits = values.into_iter().map(bits);
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
    /// The functions, of two numbers, the second of which most ignore, with their values.
    type Output = Vec<(&'static str, Vec<E>)>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Self::Output {
        let mut results: Self::Output = Vec::new();
        for arguments in self.arguments.chunks_exact(2 * R::LANES) {
            let (x, y) = (R::load(arguments), R::load(&arguments[R::LANES..]));
            let (scale, _) = x.power_of_two_scale();
            let values = [
                ("sqrt", x.sqrt()),
                ("cbrt", x.cbrt()),
                ("ln", x.ln()),
                ("exp", x.exp()),
                ("ln_1p", x.ln_1p()),
                ("exp_m1", x.exp_m1()),
                ("sinh", x.sinh()),
                ("tanh", x.tanh()),
                ("asinh", x.asinh()),
                ("sin", x.sin()),
                ("atan", x.atan()),
                ("erf", x.erf()),
                ("softplus", x.softplus()),
                ("powf", x.abs().powf(y)),
                ("max", x.max(y)),
                ("copysign", x.copysign(y)),
                ("power_of_two_scale", scale),
            ];
            if results.is_empty() {
                results.extend(values.iter().map(|&(name, _)| (name, Vec::new())));
            }
            for ((_, value), (_, results)) in values.into_iter().zip(&mut results) {
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
