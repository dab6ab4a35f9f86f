//! Energies of I1, I2 and J agree with themselves as functions of stretches.

use piola::Inversion;
use piola::lanes::Real;
use piola_tests::declarations::{Sample, slices};
use piola_tests::energies::{Format, Subject, find};

/// Stretches at which every energy of the catalogue is defined, moderately stretched and near rest.
const STRETCHES: [[f64; 3]; 3] = [[1.25, 1.0625, 0.875], [1.0 + 1e-3, 1.0, 1.0 - 1e-3], [1.5, 0.9, 0.75]];

const EPSILON: f64 = 0.25;

/// Trials that are not about each energy.
pub(crate) const TRIALS: [(&str, fn()); 1] =
    [("invariants::below_the_threshold_they_do_not_hold", below_the_threshold_invariants_do_not_hold)];

/// Judges an energy that has invariants; false for others.
fn judge_subject(name: &str, subject: &Subject) -> bool {
    let material = f64::of(subject);
    if !material.has_invariants() {
        assert!(!material.admits_invariants([3.0, 3.0, 1.0]));
        return false;
    }
    let [young, lambda] = [subject.moduli.young(), subject.moduli.lambda];
    for l in STRETCHES.into_iter().filter(|&l| material.admits(l)) {
        let squares = l.map(|l| l * l);
        let volume: f64 = l.iter().product();
        let first: f64 = squares.iter().sum();
        let second = squares[0] * squares[1] + squares[1] * squares[2] + squares[2] * squares[0];
        let invariants = [first, second, volume];
        assert!(material.admits_invariants(invariants), "{name} at {l:?}");
        // Rounding of invariants near 3 and 1, in terms as large as the moduli.
        let noise = 200.0 * f64::UNIT_ROUNDOFF * (young + lambda);
        let [found, expected] = [material.energy_by_invariants(invariants), material.energy(l)];
        assert!(
            found.is_nan() || (found - expected).abs() <= noise,
            "{name} at {l:?}: {found} for {expected}"
        );
        let [w1, w2, wj] = material.gradient_by_invariants(invariants);
        let expected = material.gradient(l);
        for k in 0..3 {
            let found = 2.0 * l[k] * (w1 + w2 * (first - squares[k])) + wj * volume / l[k];
            assert!((found - expected[k]).abs() <= noise, "{name} at {l:?}: {found} for {}", expected[k]);
        }
    }
    true
}

pub(crate) fn judge(sample: &Sample) {
    let name = sample.judged.name;
    let Some(values) = sample.values().into_iter().next() else { return };
    for inversion in sample.judged.inversions(EPSILON) {
        let subject = sample.judged.subject(&slices(&values), inversion).expect("admissible");
        let has_invariants = judge_subject(name, &subject);
        assert!(has_invariants || !["neo_hookean", "gent", "mooney_rivlin"].contains(&name), "{name}");
        assert!(!has_invariants || !["ogden", "arap", "stretch_spline"].contains(&name), "{name}");
    }
}

/// λ3 ≥ 2J/I1, so that 2J > ε I1 excludes every point below the threshold.
fn below_the_threshold_invariants_do_not_hold() {
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
