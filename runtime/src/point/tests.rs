//! Stress, tangent and filters against dense algebra, finite differences and a 9×9 eigensolver.

use super::*;
use crate::hand_written::{NeoHookean, RotatedLinear, SaintVenantKirchhoff};
use crate::lanes::Lanes;
use crate::material::Material;
use crate::material::PAIRS;
use crate::random::Random;

mod filters;
mod lanes;
mod measures;
mod plane;
mod small_strain;
mod statuses;

pub(super) fn product(A: &Matrix3<f64>, B: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| A[i][k] * B[k][j]).sum()))
}

fn transposed(A: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| A[j][i]))
}

pub(super) fn diagonal(d: [f64; 3]) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

/// A + s B.
pub(super) fn moved(A: &Matrix3<f64>, s: f64, B: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| A[i][j] + s * B[i][j]))
}

pub(super) fn norm<'a>(entries: impl IntoIterator<Item = &'a f64>) -> f64 {
    entries.into_iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The number of a lane.
pub(super) fn of_lane<R: Lanes>(x: R, lane: usize) -> R::Scalar {
    let mut all = vec![R::Scalar::default(); R::LANES];
    x.store(&mut all);
    all[lane]
}

/// Q diag(l) Wᵀ.
pub(super) fn framed(Q: &Matrix3<f64>, l: [f64; 3], W: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| Q[i][k] * l[k] * W[j][k]).sum()))
}

fn with_stretches(random: &mut Random, l: [f64; 3]) -> Matrix3<f64> {
    framed(&random.rotation(), l, &random.rotation())
}

/// Deformations from harmless to equal and inverted stretches; only the first three are inside J > 0.
const STRETCHES: [[f64; 3]; 7] = [
    [1.7, 1.1, 0.6],
    [1.3, 1.3, 0.8],
    [1.0, 1.0, 1.0],
    [1.2, 0.9, -0.5],
    [1.1, 0.7, 0.0],
    [0.5, 0.5, -0.2],
    [2.0, 1e-9, -1e-10],
];

fn random_blocks(random: &mut Random) -> Blocks<f64> {
    let zero = Blocks { gradient: [0.0; 3], hessian: [0.0; 6], flip: [0.0; 3], twist: [0.0; 3] };
    convert(&zero, |_: f64| random.uniform(-1.0, 1.0))
}

/// Each number by itself.
fn convert<A: Real, B: Real>(blocks: &Blocks<A>, mut number: impl FnMut(A) -> B) -> Blocks<B> {
    Blocks {
        gradient: blocks.gradient.map(&mut number),
        hessian: blocks.hessian.map(&mut number),
        flip: blocks.flip.map(&mut number),
        twist: blocks.twist.map(&mut number),
    }
}

/// The 9×9 map between the principal frames, entry by entry from its definition.
fn dense(blocks: &Blocks<f64>) -> [[f64; 9]; 9] {
    let mut A = [[0.0; 9]; 9];
    for k in 0..3 {
        A[4 * k][4 * k] = blocks.hessian[k];
    }
    for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
        A[4 * i][4 * j] = blocks.hessian[3 + pair];
        A[4 * j][4 * i] = blocks.hessian[3 + pair];
        let (ij, ji) = (3 * i + j, 3 * j + i);
        // D⁻ on (1, 1)/√2 and D⁺ on (1, −1)/√2.
        let (flip, twist) = (blocks.flip[pair], blocks.twist[pair]);
        A[ij][ij] = flip / 2.0 + twist / 2.0;
        A[ji][ji] = A[ij][ij];
        A[ij][ji] = flip / 2.0 - twist / 2.0;
        A[ji][ij] = A[ij][ji];
    }
    A
}

/// (U ⊗ W) A (U ⊗ W)ᵀ by four nested sums.
fn in_the_world(U: &Matrix3<f64>, W: &Matrix3<f64>, A: &[[f64; 9]; 9]) -> [[f64; 9]; 9] {
    let weight = |row: usize, r: usize| U[row / 3][r / 3] * W[row % 3][r % 3];
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            (0..81).map(|rc| weight(row, rc / 9) * A[rc / 9][rc % 9] * weight(column, rc % 9)).sum()
        })
    })
}

fn difference<const N: usize>(A: &[[f64; N]; N], B: &[[f64; N]; N]) -> f64 {
    norm(A.iter().flatten().zip(B.iter().flatten()).map(|(a, b)| a - b).collect::<Vec<_>>().iter())
}

#[test]
fn the_matrix_and_the_product_are_those_of_the_dense_sums() {
    let mut random = Random::new(11);
    for _ in 0..200 {
        let (U, V, blocks) = (random.rotation(), random.rotation(), random_blocks(&mut random));
        let expected = in_the_world(&U, &V, &dense(&blocks));
        let (tangent, dF, size) = (Tangent { U, V, blocks }, random.matrix(), norm(expected.as_flattened()));
        // Each entry is a sum of 81 products here and of 15 there.
        assert!(difference(&tangent.to_matrix(), &expected) < 100.0 * f64::EPSILON * size);
        let entry = |row: usize| (0..9).map(|k| expected[row][k] * dF[k / 3][k % 3]).sum::<f64>();
        let product = std::array::from_fn(|i| std::array::from_fn(|j| entry(3 * i + j)));
        let error = difference(&tangent.apply(&dF), &product);
        assert!(error < 100.0 * f64::EPSILON * size * norm(dF.as_flattened()), "{error:e}");
    }
}

/// The claim of `docs/emit.md` on the bounds between which roundings decide whether a point is `bounded`.
#[test]
fn roundings_decide_at_a_pole() {
    let mut random = Random::new(19);
    let u = f32::EPSILON / 2.0;
    let mut at = |sum: f64| {
        let (l1, l2) = (random.uniform(1.0, 2.0), random.uniform(0.1, 1.0));
        let F = with_stretches(&mut random, [l1, l2, sum * l1 - l2]);
        let point = evaluate(&RotatedLinear, &F.map(|row| row.map(|x| x as f32)), Filter::None);
        let [l1, l2, l3] = point.stretches;
        assert_eq!(point.status.bounded, l2 + l3 < 2.0 * u * l1);
        ((l2 + l3) / (u * l1), point.status.bounded)
    };
    let opposite: Vec<_> = (0..10_000).map(|_| at(0.0)).collect();
    // The largest is about 8 among a million.
    assert!(opposite.iter().all(|&(sum, _)| sum < 10.0));
    let share = opposite.iter().filter(|(_, bounded)| *bounded).count();
    assert!((8_000..9_900).contains(&share), "{share}");
    assert!((0..10_000).all(|_| !at(12.0 * f64::from(u)).1));
}

#[test]
fn the_status_says_what_the_numbers_cannot() {
    let fine = Status::default();
    let inverted = diagonal([1.0, 1.0, -0.1]);
    assert_eq!(evaluate(&SaintVenantKirchhoff, &inverted, Filter::None).status, fine);
    assert_eq!(evaluate(&RotatedLinear, &inverted, Filter::None).status, fine);
    assert!(evaluate(&NeoHookean, &inverted, Filter::None).status.refused);
    assert!(evaluate_energy(&NeoHookean, &inverted).status.refused);
    assert!(evaluate_stress(&NeoHookean, &inverted).status.refused);

    let mirrored = evaluate(&RotatedLinear, &diagonal([1.0, 1.0, -1.0]), Filter::None);
    assert_eq!(mirrored.status, Status { bounded: true, ..fine });
    assert!(mirrored.tangent.to_matrix().iter().flatten().all(|x| x.is_finite()));
    let collapsed = evaluate(&RotatedLinear, &diagonal([0.0; 3]), Filter::Clamp);
    assert_eq!(collapsed.status, Status { bounded: true, filtered: true, ..fine });
    assert!(collapsed.tangent.blocks.twist == [0.0; 3]);
}
