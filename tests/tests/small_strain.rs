//! Energy and stress from the displacement gradient, for every energy and strains down to 10⁻⁶⁰, compared
//! with what is left of it in F: `cargo test -p piola-tests --test small_strain -- --nocapture`.
//!
//! The oracle is the ordinary way through F = I + H, in 320 bits.

#![expect(clippy::print_stdout, reason = "a table to show")]

use piola::__private::random::Random;
use piola::interpreter::Interpreted;
use piola::point::{self, DisplacementGradient, EnergyPoint, Filter, Matrix3, StressPoint};
use piola::{Inversion, Material, Real};
use piola_tests::cases::norm;
use piola_tests::compiled;
use piola_tests::energies::{ENERGIES, Format, Subject};
use piola_tests::multiprecision::Multiprecision;

/// The constant of the judgements ‖P − P*‖ ≤ C u (‖P*‖ + ‖dP/dF‖ ‖H‖) and |ψ − ψ*| ≤ C u (|ψ*| + ‖P*‖ ‖H‖).
const C: f64 = 30.0;

/// Displacement gradients of each magnitude, rotations as large as strains.
const SAMPLES: usize = 8;

type Exact = Multiprecision<5>;

/// Worst errors in units of u (‖P‖ + ‖dP/dF‖ ‖H‖): from H, and through F; that of ψ from H, in its own.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    from_displacement: f64,
    through_deformation: f64,
    energy: f64,
}

impl Worst {
    /// Displacement gradients of a magnitude in a format.
    fn of<R: Format>(subject: &Subject, magnitude: f64) -> Self {
        let (material, exact_material) = (R::of(subject), &subject.exact);
        let mut random = Random::new(7);
        let mut worst = Self::default();
        for _ in 0..SAMPLES {
            // Entries that both precisions hold.
            let displacement: Matrix3<f64> = std::array::from_fn(|_| {
                std::array::from_fn(|_| R::splat(magnitude * random.uniform(-1.0, 1.0)).widen())
            });
            let exact: Matrix3<Exact> = plus_identity(&displacement.map(|row| row.map(Exact::splat)));
            let svd = point::svd(&exact);
            let expected = point::stress(&svd, exact_material.gradient(svd.stretches));

            let rounded = displacement.map(|row| row.map(R::splat));
            let near = DisplacementGradient(&rounded);
            let StressPoint { stress, status } = compiled::evaluate_stress(material, near);
            assert!(!status.refused && !status.nonfinite && !status.bounded);
            let through = compiled::evaluate_stress(material, &plus_identity(&rounded)).stress;

            let tangent =
                compiled::evaluate(f64::of(subject), &plus_identity(&displacement), Filter::None).tangent;
            let stiffness = norm(tangent.to_matrix().iter().flatten().copied());
            let size = norm(displacement.iter().flatten().copied());
            let scale = norm(expected.iter().flatten().map(|x| x.to_f64())) + stiffness * size;
            let error = |found: &Matrix3<R>| {
                let differences = found.iter().flatten().zip(expected.iter().flatten());
                let differences = differences.map(|(&x, &y)| (Exact::splat(x.widen()) - y).to_f64());
                norm(differences) / (R::UNIT_ROUNDOFF * scale)
            };
            // The oracle of ψ keeps 96 digits, of which the square of the strain takes its own.
            if magnitude > 1e-30 && is_free_of_stress(exact_material, subject.moduli.mu) {
                let EnergyPoint { energy, status } = compiled::evaluate_energy(material, near);
                assert!(!status.refused && !status.nonfinite);
                let one = Exact::splat(1.0);
                let expected_energy = exact_material.energy(svd.stretches) - exact_material.energy([one; 3]);
                let scale = expected_energy.to_f64().abs()
                    + norm(expected.iter().flatten().map(|x| x.to_f64())) * size;
                let difference = (Exact::splat(energy.widen()) - expected_energy).to_f64().abs();
                worst.energy = worst.energy.max(difference / (R::UNIT_ROUNDOFF * scale));
            }
            worst.from_displacement = worst.from_displacement.max(error(&stress));
            worst.through_deformation = worst.through_deformation.max(error(&through));
        }
        worst
    }
}

/// True if ψ in 96 digits has no stress at rest. It has a little if it contains a fraction that `f64` rounds,
/// such as 1/6; it is then no oracle for strains, since its linear term outweighs the rest.
fn is_free_of_stress(material: &Interpreted, mu: f64) -> bool {
    let (one, step) = (Exact::splat(1.0), Exact::splat(1e-30));
    let energy = |step: Exact| material.energy([one + step, one, one]);
    let slope = ((energy(step) - energy(-step)) / (step + step)).to_f64();
    slope.abs() < 1e-25 * mu
}

fn plus_identity<R: Real>(displacement: &Matrix3<R>) -> Matrix3<R> {
    let one = R::splat(1.0);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| if i == j { displacement[i][j] + one } else { displacement[i][j] })
    })
}

#[track_caller]
fn judge<R: Format>(magnitudes: &[f64]) {
    println!("\n{}: worst error from H, and through F, in u (‖P‖ + ‖dP/dF‖ ‖H‖); that of ψ\n", R::NAME);
    let columns: Vec<_> = magnitudes.iter().map(|magnitude| format!("{magnitude:>22e}")).collect();
    println!("{:22}{}", "largest entry of H", columns.concat());
    let mut failures = Vec::new();
    for energy in ENERGIES.iter() {
        let subject = energy.subject(&energy.typical(), Inversion::Refuse).expect("typical parameters");
        let mut line = format!("{:22}", energy.name);
        for &magnitude in magnitudes {
            let worst = Worst::of::<R>(&subject, magnitude);
            line += &format!(
                "{:7.1} {:8.0e} {:5.1}",
                worst.from_displacement, worst.through_deformation, worst.energy
            );
            let within = worst.from_displacement <= C && worst.energy <= C;
            if !within {
                failures.push(format!("{} at {magnitude:e}: {worst:?}", energy.name));
            }
        }
        println!("{line}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn energies_and_stresses_keep_their_digits_in_f64() {
    judge::<f64>(&[0.1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-60]);
}

#[test]
fn energies_and_stresses_keep_their_digits_in_f32() {
    judge::<f32>(&[0.1, 1e-2, 1e-4, 1e-6, 1e-12]);
}
