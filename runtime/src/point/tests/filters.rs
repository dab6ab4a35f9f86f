//! Filters against an eigensolver of the whole 9×9 matrix.

use super::*;

/// f(A) by nalgebra's eigensolver, which has never heard of stretches.
fn by_eigensolver(A: &[[f64; 9]; 9], f: impl Fn(f64) -> f64) -> [[f64; 9]; 9] {
    let matrix = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| A[i][j]);
    let eigen = matrix.symmetric_eigen();
    let filtered = eigen.eigenvectors
        * nalgebra::SMatrix::from_diagonal(&eigen.eigenvalues.map(f))
        * eigen.eigenvectors.transpose();
    std::array::from_fn(|i| std::array::from_fn(|j| filtered[(i, j)]))
}

fn hessian_with(random: &mut Random, eigenvalues: [f64; 3]) -> [f64; 6] {
    let Q = random.rotation();
    let entry = |i: usize, j: usize| (0..3).map(|k| Q[i][k] * eigenvalues[k] * Q[j][k]).sum();
    [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)]
}

/// Spectra of the Hessian block that make eigensolvers fail: pairs, triples, zeros, tiny gaps, tiny signs.
fn spectra() -> Vec<[f64; 3]> {
    let mut spectra = vec![
        [1.0, 1.0, 1.0],
        [-1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [2.0, 0.5, -0.1],
        [-2.0, 1e-3, 0.3],
    ];
    for exponent in 1..18 {
        let e = 10f64.powi(-exponent);
        spectra.extend([
            [1.0, 1.0 + e, 1.0 - e],
            [1.0, e, -e],
            [1.0, -e, -e],
            [-1.0, -1.0 - e, 1.0],
            [-1.0, e, e * e],
            [e, 1.0, -1.0],
        ]);
    }
    spectra
}

#[test]
fn filters_agree_with_the_whole_eigenproblem() {
    let mut random = Random::new(31);
    for spectrum in spectra() {
        let mut blocks = random_blocks(&mut random);
        blocks.hessian = hessian_with(&mut random, spectrum);
        // The filter works in the principal frames, the oracle in the world.
        let tangent = Tangent { U: random.rotation(), V: random.rotation(), blocks };
        for (filter, f) in
            [(Filter::Clamp, (|e: f64| e.max(0.0)) as fn(f64) -> f64), (Filter::Absolute, f64::abs)]
        {
            let expected = by_eigensolver(&tangent.to_matrix(), f);
            let (blocks, _) = project(&tangent.blocks, filter);
            let answer = Tangent { blocks, ..tangent }.to_matrix();
            let error = difference(&answer, &expected);
            // Backward errors of some 10 eps ‖A‖, by them and by us; neither function amplifies these by more than
            // ln 9 ≈ 2.
            let scale = norm(tangent.to_matrix().iter().flatten());
            assert!(error < 60.0 * f64::EPSILON * scale, "{filter:?} of {spectrum:?}: {error:e}");
        }
    }
}

/// The same from deformation gradients, with equal stretches among them.
#[test]
fn filtered_points_agree_with_the_whole_eigenproblem() {
    fn check(material: &impl Material, F: &Matrix3<f64>) {
        let dP_dF = evaluate(material, F, Filter::None).tangent.to_matrix();
        let answer = evaluate(material, F, Filter::Clamp).tangent.to_matrix();
        let error = difference(&answer, &by_eigensolver(&dP_dF, |e| e.max(0.0)));
        assert!(error < 60.0 * f64::EPSILON * norm(dP_dF.iter().flatten()), "{F:?}: {error:e}");
    }
    let mut random = Random::new(37);
    for stretches in STRETCHES {
        let F = with_stretches(&mut random, stretches);
        check(&SaintVenantKirchhoff, &F);
        check(&RotatedLinear, &F);
        if stretches[2] > 0.0 {
            check(&NeoHookean, &F);
        }
    }
}

#[test]
fn single_precision_filters_agree_with_double() {
    let mut random = Random::new(32);
    for spectrum in spectra() {
        let narrow = |x: [f64; 6]| x.map(|x| x as f32);
        let hessian = narrow(hessian_with(&mut random, spectrum));
        let blocks = Blocks { gradient: [0.0; 3], hessian, flip: [1.0; 3], twist: [-1.0; 3] };
        let wide =
            Blocks { gradient: [0.0; 3], hessian: hessian.map(f64::from), flip: [1.0; 3], twist: [-1.0; 3] };
        let (answer, filtered) = project(&blocks, Filter::Clamp);
        let (expected, _) = project(&wide, Filter::Clamp);
        assert!(filtered && answer.twist == [0.0; 3]);
        for k in 0..6 {
            let error = (f64::from(answer.hessian[k]) - expected.hessian[k]).abs();
            assert!(error < 30.0 * f64::from(f32::EPSILON), "{spectrum:?}: {error:e}");
        }
    }
}

/// Powers of two are exact, so a scaled block must give the scaled bits.
#[test]
fn magnitude_does_not_matter() {
    let mut random = Random::new(33);
    for spectrum in spectra() {
        let mut blocks = random_blocks(&mut random);
        blocks.hessian = hessian_with(&mut random, spectrum);
        let (plain, filtered) = project(&blocks, Filter::Clamp);
        // What is below 10⁻¹⁷ in these blocks keeps its bits down to a scale of 2⁻⁹⁰⁰.
        for scale in [2f64.powi(900), 2f64.powi(-900)] {
            let times = |x: &[f64; 3]| x.map(|x| x * scale);
            let scaled = Blocks {
                gradient: times(&blocks.gradient),
                hessian: blocks.hessian.map(|x| x * scale),
                flip: times(&blocks.flip),
                twist: times(&blocks.twist),
            };
            let (answer, also) = project(&scaled, Filter::Clamp);
            assert_eq!(answer.hessian, plain.hessian.map(|x| x * scale));
            assert_eq!((answer.flip, answer.twist), (times(&plain.flip), times(&plain.twist)));
            assert_eq!(also, filtered);
        }
    }
}

#[test]
fn what_is_semidefinite_stays_bit_for_bit() {
    let mut random = Random::new(34);
    for _ in 0..500 {
        let spectrum = std::array::from_fn(|_| 10f64.powf(random.uniform(-12.0, 2.0)));
        let mut blocks = random_blocks(&mut random);
        blocks.hessian = hessian_with(&mut random, spectrum);
        blocks.flip = blocks.flip.map(f64::abs);
        blocks.twist = [0.0, -0.0, 1e-300];
        for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
            assert_eq!(project(&blocks, filter), (blocks, false));
        }
    }
}

/// What is left after clamping may be tiny beside what was clamped; its error must be too.
#[test]
fn nothing_is_left_of_a_negative_definite_hessian() {
    let mut random = Random::new(36);
    for _ in 0..100 {
        let spectrum = std::array::from_fn(|_| random.uniform(-1.0, -0.1));
        let mut blocks = random_blocks(&mut random);
        blocks.hessian = hessian_with(&mut random, spectrum);
        assert_eq!(project(&blocks, Filter::Clamp).0.hessian, [0.0; 6]);
    }
}

#[test]
fn rest_is_not_reported_as_filtered() {
    let mut random = Random::new(35);
    for _ in 0..200 {
        // Rounding gives the twists of a rotated body either sign.
        let F = random.rotation();
        assert!(!evaluate(&SaintVenantKirchhoff, &F, Filter::Clamp).filtered);
        assert!(!evaluate(&NeoHookean, &F, Filter::Clamp).filtered);
        assert!(!evaluate(&RotatedLinear, &F, Filter::Clamp).filtered);
    }
}

#[test]
fn a_broken_block_does_not_become_a_plausible_one() {
    for k in 0..12 {
        let mut blocks = Blocks { gradient: [1.0; 3], hessian: [2.0; 6], flip: [1.0; 3], twist: [1.0; 3] };
        match k {
            0..6 => blocks.hessian[k] = f64::NAN,
            6..9 => blocks.flip[k - 6] = f64::NAN,
            _ => blocks.twist[k - 9] = f64::NAN,
        }
        for filter in [Filter::Clamp, Filter::Absolute] {
            let (answer, _) = project(&blocks, filter);
            let all = || answer.hessian.into_iter().chain(answer.flip).chain(answer.twist);
            assert!(all().any(f64::is_nan), "{blocks:?} became {answer:?}");
        }
    }
}
