//! Materials that are compiled and interpreted, compared: equal bits of all responses.

use piola::__private::random::Random;
use piola::material::Response;

use crate::energies::Format;

/// Ordered stretches of every size, some of them equal, zero or of opposite sign.
pub fn stretches(random: &mut Random) -> [f64; 3] {
    let spread = [0.0, 1e-9, 0.3, 3.0, 300.0][random.below(5)];
    let mut stretches: [f64; 3] = std::array::from_fn(|_| (spread * random.uniform(-0.5, 0.5)).exp());
    if random.below(4) == 0 {
        stretches[1] = stretches[0];
    }
    stretches.sort_by(|a, b| b.total_cmp(a));
    if random.below(4) == 0 {
        stretches[2] = [-stretches[2], 0.0, -0.0][random.below(3)];
    }
    stretches
}

/// All responses at one triple of stretches, as one row.
pub fn responses<R: Format>(material: &dyn Response<R>, at: [R; 3]) -> Vec<R> {
    let truth = |value: bool| R::splat(f64::from(u8::from(value)));
    let blocks = material.blocks(at);
    let mut all = vec![material.energy(at), truth(material.admits(at))];
    all.extend(material.gradient(at));
    all.extend(material.gradient_at_strains(at.map(|stretch| stretch - R::splat(1.0))));
    all.extend(blocks.gradient.into_iter().chain(blocks.hessian).chain(blocks.flip).chain(blocks.twist));
    all.extend([material.has_invariants(), material.has_pole(), material.ends_at_zero_volume()].map(truth));
    if material.has_invariants() {
        all.extend([material.has_second_invariant(), material.admits_invariants(at)].map(truth));
        all.extend(material.gradient_by_invariants(at));
        all.extend(material.derivatives_by_invariants(at));
        if material.has_energy_by_invariants() {
            all.push(material.energy_by_invariants(at));
        }
    }
    all
}

/// Fails unless all numbers have equal bits, or are both NaN.
#[track_caller]
pub fn check<E: Format>(what: &str, found: &[E], expected: &[E]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        let [one, other] = [found, expected].map(E::widen);
        let is_same = one.to_bits() == other.to_bits() || one.is_nan() && other.is_nan();
        assert!(is_same, "{what}, entry {k}: {found:?} interpreted, {expected:?} compiled");
    }
}
