//! Stretches at which digits are easily lost.

use piola::__private::random::Random;

/// Triples λ1 ≥ λ2 ≥ |λ3|: rest, equal, close, flat, a line, large, and random ones, `count` of them chosen
/// by chance. With `signed`, λ3 may be negative.
pub fn stretches(random: &mut Random, count: usize, signed: bool) -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for k in 0..count {
        let size = random.uniform(0.5, 2.0);
        let gap = 10f64.powf(random.uniform(-15.5, -4.0));
        let other = size * random.uniform(0.3, 2.0);
        let flat = 10f64.powf(random.uniform(-12.0, -2.0));
        let large = 10f64.powf(random.uniform(1.0, 2.0));
        let triple = match k % 12 {
            0 if random.once_in(4) => [1.0; 3],
            0 => [1.0 + gap, 1.0 - 0.7 * gap, 1.0 + 0.2 * gap],
            1 => [size; 3],
            2 => [size, size, other],
            3 | 4 => [size * (1.0 + gap), size, other],
            5 => [size * (1.0 + gap), size, size * (1.0 - gap * random.uniform(0.0, 2.0))],
            6 => [size, other, flat],
            7 => [size, size * (1.0 + gap), flat],
            8 => [size, flat, flat * (1.0 + if random.once_in(2) { gap } else { 1.0 })],
            9 => [large, size, other / large],
            10 => [large, large * (1.0 + gap), other],
            _ => [size, other, random.uniform(0.2, 2.0)],
        };
        all.push(sorted(triple, signed && random.once_in(3)));
    }
    all
}

fn sorted(mut stretches: [f64; 3], is_inverted: bool) -> [f64; 3] {
    stretches.sort_by(|a, b| b.total_cmp(a));
    if is_inverted {
        stretches[2] = -stretches[2];
    }
    stretches
}

/// Principal strains in descending order, of magnitudes from 10⁻¹ to 10⁻¹⁵.
pub fn strains(random: &mut Random, count: usize) -> Vec<[f64; 3]> {
    let strains = (0..count).map(|_| {
        let size = 10f64.powf(random.uniform(-15.0, -1.0));
        let mut strains: [f64; 3] = std::array::from_fn(|_| size * random.uniform(-1.0, 1.0));
        if random.once_in(3) {
            strains[1] = strains[0];
        }
        strains.sort_by(|a, b| b.total_cmp(a));
        strains
    });
    strains.collect()
}
