//! The oracle is the definition: residuals of F − U diag(λ) Vᵀ, UᵀU − I, VᵀV − I in about 106 bits, sharing
//! no code with the kernel, over families of matrices chosen to hurt: equal and vanishing stretches, bad
//! scaling, every rank.

use super::*;
use crate::convert::to_nalgebra;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::point::tests::{diagonal, framed, moved, norm, of_lane, product};
use crate::point::twice::Twice;
use crate::random::Random;

mod search;

type Exact = [[f64; 3]; 3];

/// The tested methods, each on every back end.
#[derive(Clone, Copy, Debug)]
enum Method {
    Plain,
    SignedByDeterminant,
}

const METHODS: [Method; 2] = [Method::Plain, Method::SignedByDeterminant];

impl Method {
    #[inline(always)]
    fn of<R: Real>(self, F: &Matrix3<R>) -> Svd<R> {
        match self {
            Self::Plain => svd(F),
            Self::SignedByDeterminant => svd_signed_by_determinant(F),
        }
    }
}

/// Decomposes matrices with interleaved lanes; where too few are left, the last one fills the other lanes.
struct Decompose<'a, E> {
    method: Method,
    matrices: &'a [Matrix3<E>],
}

impl<E: Scalar> Kernel<E> for Decompose<'_, E> {
    type Output = Vec<Svd<E>>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Vec<Svd<E>> {
        decompose_in_lanes::<R::Interleaved>(self.method, self.matrices)
    }
}

#[inline(always)]
fn decompose_in_lanes<R: Lanes>(method: Method, matrices: &[Matrix3<R::Scalar>]) -> Vec<Svd<R::Scalar>> {
    let mut answers = Vec::with_capacity(matrices.len());
    for some in matrices.chunks(R::LANES) {
        let matrix = |lane: usize| some[lane.min(some.len() - 1)];
        let F = three!(i => three!(j => R::from_fn(|lane| matrix(lane)[i][j].into())));
        let Svd { U, stretches, V } = method.of(&F);
        answers.extend((0..some.len()).map(|lane| Svd {
            U: U.map(|row| row.map(|x| of_lane(x, lane))),
            stretches: stretches.map(|x| of_lane(x, lane)),
            V: V.map(|row| row.map(|x| of_lane(x, lane))),
        }));
    }
    answers
}

/// The decompositions of matrices by every back end.
fn by_every_backend<E: Scalar>(method: Method, matrices: &[Matrix3<E>]) -> Vec<(Backend, Vec<Svd<E>>)> {
    Backend::available().map(|backend| (backend, backend.run(Decompose { method, matrices }))).collect()
}

fn rounded<R: Real>(F: &Exact) -> Matrix3<R> {
    F.map(|row| row.map(R::splat))
}

fn exact<R: Scalar>(F: &Matrix3<R>) -> Exact {
    F.map(|row| row.map(Into::into))
}

/// The largest entry of UᵀU − I.
fn orthogonality(U: &Exact) -> f64 {
    let entry = |i: usize, j: usize| {
        let terms = (0..3).map(|k| Twice::of(U[k][i]).mul(Twice::of(U[k][j])));
        Twice::sum(terms.chain([Twice::of(if i == j { -1.0 } else { 0.0 })])).0.abs()
    };
    (0..9).map(|k| entry(k / 3, k % 3)).fold(0.0, f64::max)
}

/// ‖F − U diag(λ) Vᵀ‖ in the Frobenius norm; F is brought to a harmless magnitude first, which is exact.
fn residual(F: &Exact, U: &Exact, stretches: [f64; 3], V: &Exact) -> f64 {
    let entry = |i: usize, j: usize| {
        let terms = (0..3).map(|k| Twice::of(-U[i][k]).mul(Twice::of(stretches[k])).mul(Twice::of(V[j][k])));
        Twice::sum([Twice::of(F[i][j])].into_iter().chain(terms)).0
    };
    norm(&std::array::from_fn::<f64, 9, _>(|k| entry(k / 3, k % 3)))
}

/// Promises with their bounds in units of eps = 2u: the backward error, 24 u, and the deviations of U and V
/// from orthogonality, 20 u.
const PROMISES: [(&str, f64); 3] = [("backward", 12.0), ("left", 10.0), ("right", 10.0)];

/// Worst errors over a family, in units of eps, in the order of the [`PROMISES`].
#[derive(Debug, Default)]
struct Worst([f64; 3]);

impl Worst {
    #[track_caller]
    fn see<R: Scalar>(&mut self, F: &Matrix3<R>, svd: &Svd<R>) {
        let (U, V) = (exact(&svd.U), exact(&svd.V));
        let stretches: [f64; 3] = svd.stretches.map(Into::into);
        let [s1, s2, s3] = stretches;
        assert!(s1 >= s2 && s2 >= s3.abs(), "unordered {stretches:?} of {F:?}");
        for Q in [&U, &V] {
            assert!((to_nalgebra(Q).determinant() - 1.0).abs() < 1e-4, "det = −1 for {F:?}: {svd:?}");
        }
        let backward = if s1 > 0.0 {
            let scale = 2f64.powi(-(s1.log2().floor().max(-1020.0) as i32));
            let F = exact(F).map(|row| row.map(|x| x * scale));
            residual(&F, &U, stretches.map(|s| s * scale), &V) / (s1 * scale)
        } else {
            assert_eq!(exact(F), [[0.0; 3]; 3]);
            0.0
        };
        for (worst, error) in self.0.iter_mut().zip([backward, orthogonality(&U), orthogonality(&V)]) {
            *worst = worst.max(error / (2.0 * R::UNIT_ROUNDOFF));
        }
    }

    #[track_caller]
    fn check(&self, family: &str) {
        let holds = self.0.iter().zip(PROMISES).all(|(&error, (_, bound))| error <= bound);
        assert!(holds, "{family}: {self:.2?} eps");
    }
}

/// Calls `f` for the matrices of all families: plain, and scaled by 10^±exponent or its root.
fn families(count: usize, exponent: f64, mut f: impl FnMut(&str, &Exact)) {
    let scales = [exponent, -exponent, exponent / 2.0, -exponent / 2.0].map(|e| (e, 10f64.powf(e)));
    let mut turn = scales.into_iter().cycle();
    let mut f = |name: &str, F: &Exact| {
        f(name, F);
        if let Some((e, scale)) = turn.next() {
            f(&format!("{name}, 1e{e}"), &F.map(|row| row.map(|x| x * scale)));
        }
    };
    f("zero", &[[0.0; 3]; 3]);
    let mut random = Random::new(1);
    let permutations = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    for _ in 0..count {
        let (Q, W) = (random.rotation(), random.rotation());
        let mut spectrum = |name: &str, d: [f64; 3]| f(name, &framed(&Q, d, &W));
        let e = 10f64.powf(random.uniform(-16.0, 0.0));
        let a = random.uniform(0.1, 3.0);
        spectrum("repeated", [a, a, a]);
        spectrum("repeated", [2.0 * a, a, a]);
        spectrum("repeated", [a, a, -0.3 * a]);
        spectrum("near-repeated", [a, a * (1.0 + e), -a * (1.0 - e)]);
        spectrum("needle", [1.0, e, e * a]);
        spectrum("flat", [1.0, a, e]);
        spectrum("graded", [1.0, e, e * e]);
        spectrum("rank 2", [1.0, a, 0.0]);
        spectrum("rank 1", [a, 0.0, 0.0]);
        spectrum("reflection", [1.0, a, -1.0]);

        let G = random.matrix();
        f("random", &G);
        f("reflected", &G.map(|row| row.map(|x| -x)));
        f("near rest", &product(&Q, &moved(&diagonal([1.0; 3]), e, &G)));
        f("near rest", &moved(&diagonal([1.0; 3]), e, &G));
        f("graded columns", &product(&G, &diagonal([e, 1.0, e.sqrt()])));
        f("graded rows", &product(&diagonal([e.sqrt(), e, 1.0]), &G));
        f(
            "graded both ways",
            &product(&diagonal([1.0, e, e.sqrt()]), &product(&G, &diagonal([e, 1.0, 1.0]))),
        );
        // Every entry has its own magnitude.
        let wild = G.map(|row| row.map(|x| x * 2f64.powi(random.uniform(-60.0, 1.0) as i32)));
        f("wild", &wild);
        let sparse =
            G.map(|row| row.map(|x| if random.uniform(0.0, 1.0) < 0.5 { 0.0 } else { x * e.sqrt() + x }));
        f("sparse", &sparse);
        let columns = permutations[random.uniform(0.0, 6.0) as usize];
        f("permuted diagonal", &diagonal([e, -1.0, a]).map(|row| columns.map(|j| row[j])));
    }
}

/// Judges the decompositions of matrices, family by family, by every back end.
#[track_caller]
fn judge<E: Scalar>(method: Method, names: &[String], matrices: &[Matrix3<E>]) {
    for (backend, answers) in by_every_backend(method, matrices) {
        let mut worst = std::collections::BTreeMap::<&str, Worst>::new();
        for ((name, F), answer) in names.iter().zip(matrices).zip(&answers) {
            worst.entry(name).or_default().see(F, answer);
        }
        for (name, worst) in &worst {
            worst.check(&format!("{name}, {backend}"));
        }
    }
}

fn bounds_hold<E: Scalar>(exponent: f64, method: Method) {
    let (mut names, mut matrices) = (Vec::<String>::new(), Vec::<Matrix3<E>>::new());
    families(5_000, exponent, |name, F| {
        names.push(name.into());
        matrices.push(rounded(F));
    });
    judge(method, &names, &matrices);
}

#[test]
fn bounds_hold_in_f64() {
    for method in METHODS {
        bounds_hold::<f64>(300.0, method);
    }
}

#[test]
fn bounds_hold_in_f32() {
    for method in METHODS {
        bounds_hold::<f32>(30.0, method);
    }
}

/// All 19683 matrices of −1, 0, 1: every rank, every tie of columns, every reflection.
#[test]
fn bounds_hold_for_small_integers() {
    fn check<E: Scalar>() {
        let entry = |code: usize, k: usize| E::splat((code / 3usize.pow(k as u32) % 3) as f64 - 1.0);
        let matrix = |code| std::array::from_fn(|i| std::array::from_fn(|j| entry(code, 3 * i + j)));
        let matrices: Vec<Matrix3<E>> = (0..3usize.pow(9)).map(matrix).collect();
        judge(Method::Plain, &vec![String::from("integers"); matrices.len()], &matrices);
    }
    check::<f64>();
    check::<f32>();
}

/// Lanes without instructions of their own compute as a single number does, and no lane depends on the
/// others.
#[test]
fn portable_lanes_give_the_bits_of_a_scalar() {
    let mut random = Random::new(7);
    let matrices: Vec<_> = (0..67).map(|_| random.matrix()).collect();
    for method in METHODS {
        for (backend, answers) in by_every_backend(method, &matrices) {
            for (F, answer) in matrices.iter().zip(&answers) {
                let alone = backend.run(Decompose { method, matrices: &[*F] });
                assert_eq!(*answer, alone[0], "{backend}");
                if backend == Backend::portable() {
                    assert_eq!(*answer, method.of(F));
                }
            }
        }
    }
}

#[track_caller]
fn check_exact(F: Exact, stretches: [f64; 3]) {
    let svd = svd::<f64>(&F);
    assert_eq!(svd.stretches, stretches);
    assert_eq!(residual(&F, &svd.U, svd.stretches, &svd.V), 0.0, "{svd:?}");
}

#[test]
fn signed_permutations_and_diagonals_are_exact() {
    check_exact(diagonal([1.0; 3]), [1.0; 3]);
    check_exact(diagonal([-1.0; 3]), [1.0, 1.0, -1.0]);
    check_exact(diagonal([0.25, -3.0, 1e-200]), [3.0, 0.25, -1e-200]);
    check_exact([[0.0, 0.0, 3.0], [5.0, 0.0, 0.0], [0.0, 0.5, 0.0]], [5.0, 3.0, 0.5]);
    check_exact([[0.0, 5.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.5]], [5.0, 3.0, -0.5]);
    check_exact(diagonal([0.0, 2.0, 0.0]), [2.0, 0.0, 0.0]);
    let [one, three] = [1, 3].map(f64::from_bits);
    check_exact(diagonal([three, one, 0.0]), [three, one, 0.0]);
}

#[test]
fn nothing_at_all_gives_identities() {
    let identity = diagonal([1.0; 3]);
    for signs in 0..1 << 9 {
        let zero = |k: usize| if signs >> k & 1 == 1 { -0.0 } else { 0.0 };
        let F: Exact = std::array::from_fn(|i| std::array::from_fn(|j| zero(3 * i + j)));
        for (backend, answers) in by_every_backend(Method::Plain, &[F]) {
            let found = (answers[0].U, answers[0].stretches, answers[0].V);
            assert_eq!(found, (identity, [0.0; 3], identity), "{F:?}, {backend}");
        }
    }
}

#[test]
fn what_is_not_finite_gives_no_plausible_number() {
    fn check<E: Scalar>(method: Method) {
        let mut matrices = Vec::new();
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for k in 0..9 {
                for plain in [Random::new(4).matrix(), diagonal([1.0; 3]), [[0.0; 3]; 3]] {
                    let mut F = rounded::<E>(&plain);
                    F[k / 3][k % 3] = E::splat(bad);
                    matrices.push(F);
                }
            }
        }
        for (backend, answers) in by_every_backend(method, &matrices) {
            for (F, answer) in matrices.iter().zip(answers) {
                let stretches: [f64; 3] = answer.stretches.map(Into::into);
                assert!(stretches.iter().all(|s| s.is_nan()), "{F:?} became {stretches:?}, {backend}");
            }
        }
    }
    for method in METHODS {
        check::<f64>(method);
        check::<f32>(method);
    }
}

/// Matrices whose determinant is known exactly and far below the u λ1³ that the plain kernel resolves.
#[test]
fn the_determinant_gives_tiny_stretches_with_sign_and_digits() {
    let mut random = Random::new(6);
    let mut plain_is_wrong = 0;
    for _ in 0..2_000 {
        // The third row is the sum of the others plus (0, 0, d), so that det F = d (a1 b2 − a2 b1); integers
        // of 20 bits and a third column (1, −1, d) keep every entry exact.
        let [a1, a2, b1, b2] = std::array::from_fn(|_| random.uniform(-1e6, 1e6).round());
        let d = random.uniform(-1.0, 1.0) * 2f64.powi(-70);
        let F = [[a1, a2, 1.0], [b1, b2, -1.0], [a1 + b1, a2 + b2, d]];
        let expected = d * (a1 * b2 - a2 * b1);
        let [s1, s2, s3] = svd_signed_by_determinant::<f64>(&F).stretches;
        // d is far below the entries, so its products are rounded to u each before they cancel; λ1 λ2 λ3
        // undoes a quotient in three more roundings.
        let scale = d.abs() * ((a1 * b2).abs() + (a2 * b1).abs());
        let error = (s1 * s2 * s3 - expected).abs();
        assert!(error <= 8.0 * f64::EPSILON * scale, "{:e} for {expected:e}", s1 * s2 * s3);
        plain_is_wrong += usize::from((svd::<f64>(&F).stretches[2] > 0.0) != (expected > 0.0));
    }
    assert!(plain_is_wrong > 100, "the samples are too easy: the plain sign is wrong {plain_is_wrong} times");
}

/// Entries that a plane of symmetry makes zero, and the stretch across it, are exact: the frames of a
/// diagonal F are permutations.
#[test]
fn planes_of_symmetry_are_exact() {
    let mut random = Random::new(7);
    let mut matrices = Vec::new();
    for pattern in 0..400 {
        let mut F = random.matrix();
        let [k, l, m] = [pattern % 3, (pattern + 1) % 3, (pattern + 2) % 3];
        for other in [l, m] {
            F[k][other] = 0.0;
            F[other][k] = 0.0;
        }
        if pattern % 2 == 0 {
            F[l][m] = 0.0;
            F[m][l] = 0.0;
        }
        if pattern % 5 == 0 {
            F[l][l] = F[k][k];
        }
        F[m][m] *= [1.0, 1e-9, 1e9][pattern % 3];
        matrices.push(F);
    }
    for method in METHODS {
        for (backend, answers) in by_every_backend(method, &matrices) {
            for (pattern, (F, Svd { U, stretches, V })) in matrices.iter().zip(answers).enumerate() {
                let axes = if pattern % 2 == 0 { vec![0, 1, 2] } else { vec![pattern % 3] };
                for k in axes {
                    let column = (0..3).find(|&column| V[k][column].abs() == 1.0);
                    let column = column.unwrap_or_else(|| panic!("{backend}: no axis {k} in {V:?} of {F:?}"));
                    for Q in [U, V] {
                        let [row, of_column] =
                            [Q[k], Q.map(|row| row[column])].map(|line| line.map(f64::abs));
                        let [axis, place] = [k, column].map(|index| diagonal([1.0; 3])[index]);
                        assert_eq!([row, of_column], [place, axis], "{backend}: {F:?}");
                    }
                    assert_eq!(stretches[column].abs(), F[k][k].abs(), "{backend}: {F:?}");
                }
            }
        }
    }
}
