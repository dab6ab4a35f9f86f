//! Values that are not finite are reported by every entry point: in F, in H, and in results.

use super::*;
use crate::hand_written::{ExtendedNeoHookean, Scaled};
use crate::material::Material;

const FILTERS: [Filter; 3] = [Filter::None, Filter::Clamp, Filter::Absolute];

/// Entry points that report `nonfinite`, each after a check of its own numbers: those of F at F, the others
/// at H.
#[track_caller]
fn check<R: Real<Mask = bool> + Into<f64>>(
    material: &impl Material,
    F: &Matrix3<R>,
    H: &Matrix3<R>,
) -> Vec<bool> {
    let finite = |x: &R| (*x).into().is_finite();
    let mut said = Vec::new();
    let mut see = |status: Status<bool>, is_finite: bool| {
        assert!(is_finite || status.nonfinite || status.refused, "unflagged at {F:?} or {H:?}: {status:?}");
        said.push(status.nonfinite);
    };
    let EnergyPoint { energy, status } = evaluate_energy(material, F);
    see(status, finite(&energy));
    let H = DisplacementGradient(H);
    for StressPoint { stress, status } in [evaluate_stress(material, F), evaluate_stress(material, H)] {
        see(status, stress.iter().flatten().all(finite));
    }
    for filter in FILTERS {
        for point in [evaluate(material, F, filter), evaluate(material, H, filter)] {
            let dP = point.tangent.apply(&[[R::splat(-1.0 / 3.0); 3]; 3]);
            let all_finite = point.stress.iter().chain(&dP).flatten().all(finite)
                && point.tangent.to_matrix().iter().flatten().all(finite);
            see(point.status, all_finite);
        }
    }
    said
}

/// What every entry point reports of F, as H too, with four materials.
#[track_caller]
fn said<R: Real<Mask = bool> + Into<f64>>(F: &Matrix3<R>) -> Vec<bool> {
    [
        check(&SaintVenantKirchhoff, F, F),
        check(&NeoHookean, F, F),
        check(&RotatedLinear, F, F),
        check(&ExtendedNeoHookean { epsilon: 0.3 }, F, F),
    ]
    .concat()
}

#[test]
fn nan_and_infinity_are_said_by_every_entry_point() {
    let mut random = Random::new(61);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for entry in 0..9 {
            for size in [1.0, 0.01, 1e-300, 0.0] {
                let mut F = random.matrix().map(|row| row.map(|x| x * size));
                F[entry / 3][entry % 3] = bad;
                let all = [said(&F), said(&F.map(|row| row.map(|x| x as f32)))].concat();
                assert!(all.into_iter().all(|said| said), "{F:?}");
            }
        }
    }
}

/// Matrices with entries of all magnitudes, each near its own end of the range now and then.
#[test]
fn no_infinity_goes_unsaid_at_any_magnitude() {
    let mut random = Random::new(62);
    let mut overflows = 0;
    for round in 0..20_000 {
        let common = random.uniform(-1022.0, 1023.9);
        let mut entry = |sign: f64| {
            let own = if round % 2 == 0 { common } else { random.uniform(-1022.0, 1023.9) };
            sign.signum() * 2f64.powf(own) * random.uniform(0.5, 1.0)
        };
        let F = Random::new(round).matrix().map(|row| row.map(&mut entry));
        // The exponents of single precision are an eighth as far.
        let single = F.map(|row| row.map(|x| (x.signum() * x.abs().powf(0.125)) as f32));
        overflows += [said(&F), said(&single)].concat().into_iter().filter(|&said| said).count();
    }
    assert!(overflows > 10_000, "the samples are too easy: {overflows} overflows");
}

/// Moduli up to the largest number, so that blocks come near it one step after the other.
#[test]
fn the_last_octaves_before_overflow_are_said_and_no_others() {
    let identity = diagonal([1.0; 3]);
    let mut random = Random::new(63);
    for _ in 0..200 {
        let F = with_stretches(&mut random, [1.1, 1.0, 0.9]);
        for octave in 0..40 {
            // The largest number of the blocks is 2μ + λ = 3.5, in units of the factor.
            let factor = f64::MAX / 3.5 * 2f64.powf(-f64::from(octave) / 4.0);
            let stiff = Scaled { factor, material: RotatedLinear };
            let said = check(&stiff, &F, &moved(&F, -1.0, &identity));
            // From a twentieth of the largest number on nothing is near an end.
            assert!(octave < 18 || !said.into_iter().any(|said| said), "{octave} at {F:?}");
        }
    }
}

/// The bound behind [`tangent_stays_finite`], at its corners: every number ± a sixteenth of the largest.
#[test]
fn a_sixteenth_of_the_largest_number_leaves_room_for_rotations() {
    let mut random = Random::new(64);
    for _ in 0..20_000 {
        let blocks = convert(&random_blocks(&mut random), |x| (f64::MAX / 16.0).copysign(x));
        assert!(tangent_stays_finite(&blocks));
        let (U, V) = (random.rotation(), random.rotation());
        for filter in FILTERS {
            let tangent = Tangent { U, V, blocks: project(&blocks, filter).0 };
            let dF = random.matrix().map(|row| row.map(|x| x / 3.0));
            let dP = tangent.apply(&dF);
            let mut all = tangent.to_matrix().into_iter().flatten().chain(dP.into_iter().flatten());
            assert!(all.all(f64::is_finite), "{tangent:?}");
        }
    }
}
