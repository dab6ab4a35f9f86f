//! Deformation gradients of arbitrary finite entries: random patterns of bits, and families of them that
//! reach the regions which independent entries miss, such as rank 1, equal stretches, or all entries
//! subnormal.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use piola::__private::random::Random;
use piola::point::Matrix3;

use crate::energies::Format;

/// Every entry as a double.
pub fn widen<R: Format>(F: &Matrix3<R>) -> Matrix3<f64> {
    F.map(|row| row.map(R::widen))
}

/// Number of families of deformation gradients.
pub const FAMILIES: usize = 8;

/// A deformation gradient with finite entries, of each of the [`FAMILIES`] in turn.
pub fn draw<R: Format>(turn: usize, random: &mut Random) -> Matrix3<R> {
    loop {
        let F = candidate(turn % FAMILIES, random);
        // Products of large numbers may have overflowed.
        if F.iter().flatten().all(|x: &R| x.is_finite()) {
            return F;
        }
    }
}

fn candidate<R: Format>(family: usize, random: &mut Random) -> Matrix3<R> {
    match family {
        // Nine independent patterns of bits.
        0 => matrix(|_, _| finite(random)),
        // Nine patterns of bits with the exponent in common.
        1 => {
            let power = magnitude(random, full_range::<R>());
            matrix(|_, _| R::splat(power * random.uniform(-2.0, 2.0)))
        }
        // Entries from a few special numbers, hence duplicates, zeros, subnormal and largest numbers.
        2 => {
            let palette: [R; 3] = std::array::from_fn(|_| special(random));
            matrix(|_, _| palette[random.below(3)])
        }
        // A permuted diagonal matrix of independent patterns of bits.
        3 => {
            let shift = random.below(3);
            matrix(|i, j| if (i + shift) % 3 == j { finite(random) } else { R::splat(0.0) })
        }
        4 => frames(random),
        // Sums of one or two products of vectors: rank 1 and, up to rounding, rank 2.
        5 => {
            let power = magnitude(random, full_range::<R>());
            let spread = random.below(40) as i32;
            let mut vector = || -> [f64; 3] {
                std::array::from_fn(|_| {
                    // Small integers make the products exact, so that the rank is.
                    let integer = random.below(9) as f64 - 4.0;
                    integer * 2f64.powi(random.below(spread as usize + 1) as i32)
                })
            };
            let (a, b, c, d) = (vector(), vector(), vector(), vector());
            let second = if random.once_in(2) { 0.0 } else { 1.0 };
            matrix(|i, j| R::splat(power * (a[i] * b[j] + second * c[i] * d[j])))
        }
        // A rotation, or the identity, with a disturbance of any smaller magnitude.
        6 => {
            let rest = if random.once_in(2) { IDENTITY } else { random.rotation() };
            let size = 2f64.powi(-(random.below(70) as i32));
            matrix(|i, j| R::splat(rest[i][j] + size * random.uniform(-1.0, 1.0)))
        }
        // Moderate entries.
        _ => matrix(|_, _| R::splat(random.uniform(-2.0, 2.0))),
    }
}

const IDENTITY: Matrix3<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn matrix<R>(mut entry: impl FnMut(usize, usize) -> R) -> Matrix3<R> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// A pattern of bits that is neither infinite nor NaN.
fn finite<R: Format>(random: &mut Random) -> R {
    loop {
        let x = R::from_bits(random.bits());
        if x.is_finite() {
            return x;
        }
    }
}

/// The binary exponents of all finite numbers, subnormal ones included.
fn full_range<R: Format>() -> (i32, i32) {
    (R::SMALLEST.log2() as i32, R::LARGEST.log2() as i32 - 1)
}

/// A power of two with an exponent of that range.
fn magnitude(random: &mut Random, (low, high): (i32, i32)) -> f64 {
    let exponent = low + random.below((high - low + 1) as usize) as i32;
    // In two steps, because 2^-1074 is subnormal and `powi` would divide one by infinity.
    2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

/// A number at which something may happen.
fn special<R: Format>(random: &mut Random) -> R {
    let largest = R::splat(R::LARGEST);
    let magnitude = match random.below(12) {
        0 | 1 => R::splat(0.0),
        2 => R::splat(R::SMALLEST),
        3 => R::splat(R::MIN_POSITIVE),
        4 => R::splat(R::MIN_POSITIVE.sqrt()),
        5 => R::splat(R::UNIT_ROUNDOFF),
        6 | 7 => R::splat(1.0),
        8 => R::splat(R::LARGEST.sqrt()),
        9 => largest,
        10 => R::splat(1.0 + random.below(4) as f64 * R::UNIT_ROUNDOFF),
        _ => finite(random),
    };
    if random.once_in(2) { -magnitude } else { magnitude }
}

/// U diag(λ) Vᵀ, where the λ lie within a window of exponents, some of them equal, opposite, zero or
/// reflected.
fn frames<R: Format>(random: &mut Random) -> Matrix3<R> {
    let (low, high) = full_range::<R>();
    let width = [2, 12, 60, high - low][random.below(4)];
    let start = if random.once_in(2) { -width / 2 } else { low + random.below((high - low) as usize) as i32 };
    let window = (start.max(low), (start + width).clamp(low, high));
    let mut stretches: [f64; 3] =
        std::array::from_fn(|_| magnitude(random, window) * random.uniform(1.0, 2.0));
    if random.once_in(3) {
        // Equal except for a gap of any size.
        stretches[1] = stretches[0] * (1.0 + 2f64.powi(-(random.below(60) as i32)));
    }
    if random.once_in(4) {
        stretches[2] = stretches[random.below(2)];
    }
    if random.once_in(8) {
        stretches[2] = 0.0;
    }
    if random.once_in(2) {
        stretches[2] = -stretches[2];
    }
    let (U, V) = match random.below(3) {
        0 => (IDENTITY, IDENTITY),
        1 => (random.rotation(), IDENTITY),
        _ => (random.rotation(), random.rotation()),
    };
    matrix(|i, j| R::splat((0..3).map(|k| U[i][k] * stretches[k] * V[j][k]).sum()))
}
