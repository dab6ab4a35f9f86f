//! Energies of I1, I2 and J say so, and where these are enough.

use piola::Inversion;
use piola_tests::declarations::{Sample, slices};
use piola_tests::energies::{Format, find};

/// Stretches at which every energy of the catalogue is defined, moderately stretched and near rest.
const STRETCHES: [[f64; 3]; 3] = [[1.25, 1.0625, 0.875], [1.0 + 1e-3, 1.0, 1.0 - 1e-3], [1.5, 0.9, 0.75]];

const EPSILON: f64 = 0.25;

/// Where an energy with invariants is defined, they are admitted. Its values there are compared with those by
/// stretches by the contract.
pub(crate) fn judge(sample: &Sample) {
    let name = sample.judged.name;
    let Some(values) = sample.values().into_iter().next() else { return };
    for inversion in sample.judged.inversions(EPSILON) {
        let subject = sample.judged.subject(&slices(&values), inversion).expect("admissible");
        let material = f64::of(&subject);
        let has_invariants = material.has_invariants();
        for l in STRETCHES.into_iter().filter(|&l| material.admits(l)) {
            let [a, b, c] = l.map(|l| l * l);
            let invariants = [a + b + c, a * b + b * c + c * a, l.iter().product()];
            assert_eq!(material.admits_invariants(invariants), has_invariants, "{name} at {l:?}");
        }
        assert!(has_invariants || !["neo_hookean", "gent", "mooney_rivlin"].contains(&name), "{name}");
        assert!(!has_invariants || !["ogden", "arap", "stretch_spline"].contains(&name), "{name}");
    }
}

/// λ3 ≥ 2J/I1, so that 2J > ε I1 excludes every point below the threshold.
pub(crate) fn below_the_threshold_invariants_do_not_hold() {
    let neo_hookean = find("neo_hookean").expect("in the catalogue");
    let solid = |inversion| neo_hookean.subject(&[&[1.0], &[1.5]], inversion).expect("admissible");
    let (rubber, extended) = (solid(Inversion::Refuse), solid(Inversion::Extend { epsilon: EPSILON }));
    let (rubber, extended) = (f64::of(&rubber), f64::of(&extended));
    for [l1, l2, l3] in [[1.0, 1.0, 0.2], [1.0, 1.0, -0.5], [0.0; 3], [0.24; 3], [100.0, 100.0, 0.24f64]] {
        let (first, volume) = (l1 * l1 + l2 * l2 + l3 * l3, l1 * l2 * l3);
        assert!(!extended.admits_invariants([first, 0.0, volume]), "{l3}");
        assert_eq!(rubber.admits_invariants([first, 0.0, volume]), volume > 0.0, "{l3}");
    }
    assert!(extended.admits_invariants([3.0, 3.0, 1.0f64]));
    assert!(!extended.admits_invariants([f64::NAN, 3.0, 1.0]));
}
