//! The catalogue in plane strain and plane stress: free of stress across, the slopes right, and no
//! infinite or NaN result under a clean status, wherever the deformation lies.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::__private::random::Random;
use piola::Real;
use piola::interpreter::Interpreted;
use piola::point::plane::{Matrix2, in_space, plane_strain, plane_stress};
use piola::point::{Filter, evaluate};
use piola_tests::energies::ENERGIES;

/// Runs a check on every material of the catalogue in every treatment of inversion, each read from its
/// declaration: `interpreted.rs` sees that it has the bits of the compiled one, which takes long
/// to build.
fn everywhere(mut check: impl FnMut(&str, &Interpreted)) {
    for energy in ENERGIES.iter() {
        for inversion in energy.inversions(0.1) {
            let material = energy.energy.material(&energy.typical(), inversion).expect("typical parameters");
            check(&format!("{} {inversion:?}", energy.name), &material);
        }
    }
}

fn drawn(random: &mut Random, spread: f64) -> Matrix2<f64> {
    let mut entry = |middle: f64| middle + spread * random.uniform(-1.0, 1.0);
    [[entry(1.0), entry(0.0)], [entry(0.0), entry(1.0)]]
}

#[test]
fn near_rest_every_material_has_plane_stress() {
    let mut random = Random::new(141);
    let mut worst = 0f64;
    everywhere(|name, material| {
        // The stress of Murnaghan's plastic falls from a strain of some 6 % on: λ + 2μ + 2 (l + 2m) E = 0.
        let strain = if name.starts_with("murnaghan") { 0.01 } else { 0.1 };
        for _ in 0..200 {
            let F = drawn(&mut random, strain);
            let point = plane_stress(material, &F, Filter::None);
            assert!(point.status.is_clean() && !point.no_equilibrium, "{name} at {F:?}");
            let space = evaluate(material, &in_space(&F, point.out_of_plane_stretch), Filter::None);
            let dP_dF = space.tangent.to_matrix();
            let stiffness = dP_dF.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            worst = worst.max(space.stress[2][2].abs() / (stiffness * f64::EPSILON));
            // A little more F changes P by the tangent, up to second order, 1e-12 of it, and rounding over h.
            let h = 1e-6;
            let dF = drawn(&mut random, 1.0);
            let at = |h: f64| {
                let F = std::array::from_fn(|i| std::array::from_fn(|j| F[i][j] + h * dF[i][j]));
                plane_stress(material, &F, Filter::None).stress
            };
            let (ahead, behind, dP) = (at(h), at(-h), point.tangent.apply(&dF));
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let error = (ahead[i][j] - behind[i][j]) / (2.0 * h) - dP[i][j];
                assert!(error.abs() <= 1e-7 * stiffness, "{name}: {error:e} for {stiffness:e} at {F:?}");
            }
        }
    });
    // The decomposition of F in space differs by 20 u from that in the plane, times what derivatives make of
    // it.
    assert!(worst <= 40.0, "P33 of {worst} times the rounding of F");
}

/// Number of clean points, whose results are neither infinite nor NaN, and of those without equilibrium.
fn judged<R: Real<Mask = bool>>(name: &str, material: &Interpreted, F: &Matrix2<R>) -> [usize; 2] {
    let (mut clean, mut without) = (0, 0);
    for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
        for point in [plane_strain(material, F, filter), plane_stress(material, F, filter)] {
            without += usize::from(point.no_equilibrium);
            if point.status.is_clean() {
                clean += 1;
                let tangent = point.tangent.to_matrix();
                let numbers = point.stress.as_flattened().iter().chain(tangent.as_flattened());
                let mut numbers = numbers.chain(point.out_of_plane_slope.as_flattened());
                let others = point.energy + point.out_of_plane_stress;
                let are_finite = numbers.all(|x| x.is_finite()) && others.is_finite();
                assert!(are_finite, "{name} at {F:?}: {point:?}");
            }
        }
    }
    [clean, without]
}

#[test]
fn nothing_infinite_comes_with_a_clean_status() {
    let mut random = Random::new(142);
    let (mut clean, mut without) = (0, 0);
    everywhere(|name, material| {
        for round in 0..800 {
            let F = match round % 4 {
                0 => drawn(&mut random, 1.5),
                1 => {
                    let spread = 10f64.powf(random.uniform(-8.0, 8.0));
                    drawn(&mut random, spread)
                }
                2 => {
                    let size = 10f64.powf(random.uniform(-12.0, 12.0));
                    drawn(&mut random, 1.5).map(|row| row.map(|x| size * x))
                }
                _ => std::array::from_fn(|_| std::array::from_fn(|_| f64::from_bits(random.bits()))),
            };
            let [more_clean, more_without] = judged(name, material, &F);
            (clean, without) = (clean + more_clean, without + more_without);
            if round / 4 % 2 == 0 {
                judged(name, material, &F.map(|row| row.map(|x| x as f32)));
            }
        }
    });
    // A judge that never meets one of the answers judges nothing.
    assert!(clean > 1000 && without > 100, "{clean} clean, {without} without equilibrium");
}
