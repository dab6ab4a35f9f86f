//! Filters against an eigensolver of the whole 9×9 matrix.

use super::*;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};

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
    let [[h11, h12, h13], [_, h22, h23], [.., h33]] = framed(&Q, eigenvalues, &Q);
    [h11, h22, h33, h12, h13, h23]
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
        [-1.0, 2.0, 3.0],
        [-2.0, -1.0, 3.0],
        [-1.0, -1.0, 3.0],
        [-1.0, 2.0, 2.0],
    ];
    for exponent in 1..18 {
        let e = 10f64.powi(-exponent);
        spectra.extend([
            [1.0, 1.0 + e, 1.0 - e],
            [1.0, e, -e],
            [1.0, -e, -e],
            [-1.0, -1.0 - e, 1.0],
            [-1.0, e, e * e],
            [-1.0, -e, e],
            [e, 1.0, -1.0],
            [1.0, -1.0, e],
            [1.0, 1.0, -e],
        ]);
    }
    spectra
}

/// Hessian blocks that hurt: the spectra in random frames and along the axes, graded by 10^±8 on top of that,
/// and of one or two independent rows.
fn hessians(random: &mut Random) -> Vec<[f64; 6]> {
    let graded = |[h11, h22, h33, h12, h13, h23]: [f64; 6], [a, b, c]: [f64; 3]| {
        [a * a * h11, b * b * h22, c * c * h33, a * b * h12, a * c * h13, b * c * h23]
    };
    let mut all: Vec<_> = (0..200).map(|_| std::array::from_fn(|_| random.uniform(-1.0, 1.0))).collect();
    for spectrum in spectra() {
        let hessian = hessian_with(random, spectrum);
        all.push(hessian);
        all.push([spectrum[0], spectrum[1], spectrum[2], 0.0, 0.0, 0.0]);
        all.push(graded(hessian, [1.0, 1e-4, 1e4]));
        all.push(graded(hessian, [1e-8, 1.0, 1e-4]));
        let [x, y, z] = std::array::from_fn(|_| random.uniform(-1.0, 1.0));
        all.push([x * x, y * y, z * z, x * y, x * z, y * z]);
        all.push([-x * x, y * y, 0.0, 0.0, x * z, y * z]);
    }
    all
}

/// Filters the same blocks in all lanes.
struct Project<'a, E> {
    blocks: &'a Blocks<E>,
    filter: Filter,
}

impl<E: Scalar> Kernel<E> for Project<'_, E> {
    type Output = Blocks<E>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Blocks<E> {
        let blocks = convert(self.blocks, |x| R::splat(x.into()));
        convert(&project(&blocks, self.filter).0, |x: R| of_lane(x, 0))
    }
}

/// A filter in precision E, on every back end, against the eigensolver in doubles; magnitudes are multiplied
/// by a power of two on the way in and divided by it on the way out, which is exact.
#[track_caller]
fn check<E: Scalar>(tangent: &Tangent<f64>, filter: Filter, magnitude: f64) {
    let given = convert(&tangent.blocks, |x| E::splat(x * magnitude));
    // The filter works in the principal frames, the oracle in the world.
    let matrix = |blocks: &Blocks<E>| {
        let blocks = convert(blocks, |x| x.into() / magnitude);
        in_the_world(&tangent.U, &tangent.V, &dense(&blocks))
    };
    let plain = matrix(&given);
    let expected = match filter {
        Filter::None => plain,
        Filter::Clamp => by_eigensolver(&plain, |e| e.max(0.0)),
        Filter::Absolute => by_eigensolver(&plain, f64::abs),
    };
    let norm = norm(plain.iter().flatten());
    // Backward errors of some 10 u ‖A‖ by us, and of some 60 by the sums of 81 products and the solver in
    // doubles; neither function amplifies these by more than ln 9 ≈ 2.
    let bound = (25.0 * <E as Real>::UNIT_ROUNDOFF + 75.0 * <f64 as Real>::UNIT_ROUNDOFF) * norm;
    for backend in Backend::available() {
        let error = difference(&matrix(&backend.run(Project { blocks: &given, filter })), &expected);
        assert!(error <= bound, "{filter:?} of {:?}: {error:e} for {norm:e}, {backend}", tangent.blocks);
    }
}

#[test]
fn filters_agree_with_the_whole_eigenproblem() {
    let mut random = Random::new(31);
    for hessian in hessians(&mut random) {
        // Quotients as large as the Hessian and much smaller, so that either decides about the norm.
        for share in [1.0, 1e-9] {
            let size = share * hessian.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            let Blocks { gradient, flip, twist, .. } = random_blocks(&mut random);
            let (flip, twist) = (flip.map(|x| x * size), twist.map(|x| x * size));
            let blocks = Blocks { gradient, hessian, flip, twist };
            let tangent = Tangent { U: random.rotation(), V: random.rotation(), blocks };
            for filter in [Filter::None, Filter::Clamp, Filter::Absolute] {
                for exponent in [0, 980, -940] {
                    check::<f64>(&tangent, filter, 2f64.powi(exponent));
                }
                for exponent in [0, 90, -90] {
                    check::<f32>(&tangent, filter, 2f64.powi(exponent));
                }
            }
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
            let scaled = |blocks: &Blocks<f64>| convert(blocks, |x| x * scale);
            assert_eq!(project(&scaled(&blocks), Filter::Clamp), (scaled(&plain), filtered));
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

/// The rest after clamping may be tiny compared with the clamped part; its error must be too.
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
        assert!(!evaluate(&SaintVenantKirchhoff, &F, Filter::Clamp).status.filtered);
        assert!(!evaluate(&NeoHookean, &F, Filter::Clamp).status.filtered);
        assert!(!evaluate(&RotatedLinear, &F, Filter::Clamp).status.filtered);
    }
}

/// NaN does not become a plausible number. Flips and twists are eigenvalues of their own.
#[test]
fn a_broken_entry_stays_broken_and_leaves_other_eigenvalues_alone() {
    for k in 0..12 {
        let mut blocks = Blocks { gradient: [1.0; 3], hessian: [2.0; 6], flip: [-1.0; 3], twist: [3.0; 3] };
        match k {
            0..6 => blocks.hessian[k] = f64::NAN,
            6..9 => blocks.flip[k - 6] = f64::NAN,
            _ => blocks.twist[k - 9] = f64::NAN,
        }
        for (filter, flip) in [(Filter::Clamp, 0.0), (Filter::Absolute, 1.0)] {
            let (answer, filtered) = project(&blocks, filter);
            assert_eq!(answer.hessian.into_iter().any(f64::is_nan), k < 6, "{blocks:?} became {answer:?}");
            assert!(filtered || k < 6, "{blocks:?}");
            let quotients = [answer.flip.map(|found| (found, flip)), answer.twist.map(|found| (found, 3.0))];
            for (place, &(found, expected)) in (6..).zip(quotients.as_flattened()) {
                let is_right = if place == k { found.is_nan() } else { found == expected };
                assert!(is_right, "{blocks:?} became {answer:?}");
            }
        }
    }
}
