//! What a plane of symmetry makes zero is exactly zero, for every energy of the catalogue: `cargo test -p
//! piola-tests --test symmetry`.
//!
//! Codes that align bodies with their axes compare such entries with zero, and equal stretches with each
//! other.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use piola::__private::random::Random;
use piola::Inversion;
use piola::batch::Batch;
use piola::lanes::Backend;
use piola::point::Filter;
use piola_tests::answers::Answers;
use piola_tests::energies::ENERGIES;

const COUNT: usize = 384;

/// Deformation gradients that map the first axis to itself, and every other one the others too.
fn samples() -> Vec<[f64; 9]> {
    let mut random = Random::new(11);
    let near_one = |random: &mut Random| random.uniform(0.75, 1.25);
    (0..COUNT)
        .map(|p| {
            let [a, b, c] = [(); 3].map(|()| near_one(&mut random));
            let [d, e] = [(); 2].map(|()| if p % 2 == 0 { 0.0 } else { random.uniform(-0.25, 0.25) });
            match p % 6 {
                0 => [a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, b],
                2 => [a, 0.0, 0.0, 0.0, a, 0.0, 0.0, 0.0, c],
                _ => [a, 0.0, 0.0, 0.0, b, d, 0.0, e, c],
            }
        })
        .collect()
}

#[test]
fn entries_that_a_plane_of_symmetry_makes_zero_are_zero() {
    let samples = samples();
    let F = samples.concat();
    let mut unequal = Vec::new();
    for energy in ENERGIES.iter() {
        let subject = energy.subject(&energy.typical(), Inversion::Refuse).expect("typical parameters");
        for backend in Backend::available() {
            for filter in [Filter::None, Filter::Clamp] {
                let batch = Batch::new(&*subject.double).with_backend(backend).with_filter(filter);
                let Answers { beside, tangents, statuses, .. } = Answers::of(batch, &F);
                for (p, F) in samples.iter().enumerate().filter(|(p, _)| !statuses[*p][2].refused) {
                    let (P, dP_dF) = (&beside[9 * p..][..9], &tangents[81 * p..][..81]);
                    let axes = if p % 2 == 0 { 0..3 } else { 0..1 };
                    for axis in axes {
                        // A reflection of the axis changes the sign of an odd entry 3i + j.
                        let is_odd = |k: usize| (k / 3 == axis) != (k % 3 == axis);
                        let of_P = (0..9).filter(|&k| is_odd(k)).map(|k| P[k]);
                        let of_tangent = (0..81).filter(|k| is_odd(k / 9) != is_odd(k % 9)).map(|k| dP_dF[k]);
                        assert!(
                            of_P.chain(of_tangent).all(|number| number == 0.0),
                            "{}, {backend}, {filter:?}: P of {F:?} is {P:?}, dP/dF is {dP_dF:?}",
                            energy.name
                        );
                    }
                    if p % 6 == 0 && P[4] != P[8] || p % 6 == 2 && P[0] != P[4] {
                        unequal.push((energy.name, backend.name(), filter));
                    }
                }
            }
        }
    }
    unequal.dedup();
    assert!(unequal.is_empty(), "equal stretches have unequal stresses: {unequal:?}");
}
