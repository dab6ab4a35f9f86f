//! What is made of a point's frames and blocks: the forms of a tangent and of an element's stiffness.

#![expect(non_snake_case, reason = "U, V, W, P as in the literature")]

use super::stage::{to_matrix, to_numbers};
use crate::lanes::Real;
use crate::material::Blocks;
use crate::point::{Point, Tangent, contract};

/// Two outputs of FIRST and SECOND numbers, from a point and REST numbers of its rest shape.
pub(super) trait Form<const REST: usize, const FIRST: usize, const SECOND: usize> {
    /// Completes the point's status, and its blocks where the form asks for more than the filter does.
    #[inline(always)]
    fn prepare<R: Real>(point: &mut Point<R>, rest: &[R; REST], has_pole: bool) {
        let _ = (point, rest, has_pole);
    }

    /// Hands out the numbers of the first output.
    fn first<R: Real>(point: &Point<R>, rest: &[R; REST], put: impl FnMut(usize, R));

    /// Hands out the numbers of the second output.
    fn second<R: Real>(point: &Point<R>, rest: &[R; REST], put: impl FnMut(usize, R));
}

#[inline(always)]
fn put_stress<R: Real>(point: &Point<R>, mut put: impl FnMut(usize, R)) {
    for (k, number) in to_numbers(point.stress).into_iter().enumerate() {
        put(k, number);
    }
}

/// P and all 81 entries of dP/dF: row 3i+j, column 3k+l at 9 (3i+j) + 3k+l.
pub(super) struct FullTangent;

impl Form<0, 9, 81> for FullTangent {
    #[inline(always)]
    fn first<R: Real>(point: &Point<R>, _: &[R; 0], put: impl FnMut(usize, R)) {
        put_stress(point, put);
    }

    #[inline(always)]
    fn second<R: Real>(point: &Point<R>, _: &[R; 0], mut put: impl FnMut(usize, R)) {
        let Tangent { U, V, blocks } = &point.tangent;
        contract(U, V, blocks, |a, c, block| {
            for x in 0..3 {
                for y in 0..3 {
                    let (row, column) = (3 * a + x, 3 * c + y);
                    put(9 * row + column, block[x][y]);
                    if a != c {
                        put(9 * column + row, block[x][y]);
                    }
                }
            }
        });
    }
}

/// P and the 45 entries of dP/dF on and above the diagonal, row by row.
pub(super) struct PackedTangent;

impl Form<0, 9, 45> for PackedTangent {
    #[inline(always)]
    fn first<R: Real>(point: &Point<R>, _: &[R; 0], put: impl FnMut(usize, R)) {
        put_stress(point, put);
    }

    #[inline(always)]
    fn second<R: Real>(point: &Point<R>, _: &[R; 0], mut put: impl FnMut(usize, R)) {
        let Tangent { U, V, blocks } = &point.tangent;
        contract(U, V, blocks, |a, c, block| {
            for x in 0..3 {
                for y in if a == c { x } else { 0 }..3 {
                    put(packed(9, 3 * a + x, 3 * c + y), block[x][y]);
                }
            }
        });
    }
}

/// Where entry (row, column), row ≤ column, of a symmetric matrix is when its upper triangle is stored row by row.
#[inline(always)]
pub(super) const fn packed(size: usize, row: usize, column: usize) -> usize {
    row * size - row * (row + 1) / 2 + column
}

/// P, and dP/dF as what it is made of: U, V, ψij, flips, twists.
pub(super) struct Factored;

impl Factored {
    /// The tangent from its numbers.
    #[inline(always)]
    pub(super) fn restore<R: Real>(numbers: [R; 30]) -> Tangent<R> {
        let nine = |start: usize| to_matrix(std::array::from_fn(|k| numbers[start + k]));
        let blocks = Blocks {
            gradient: [R::splat(0.0); 3],
            hessian: std::array::from_fn(|k| numbers[18 + k]),
            flip: std::array::from_fn(|k| numbers[24 + k]),
            twist: std::array::from_fn(|k| numbers[27 + k]),
        };
        Tangent { U: nine(0), V: nine(9), blocks }
    }
}

impl Form<0, 9, 30> for Factored {
    #[inline(always)]
    fn first<R: Real>(point: &Point<R>, _: &[R; 0], put: impl FnMut(usize, R)) {
        put_stress(point, put);
    }

    #[inline(always)]
    fn second<R: Real>(point: &Point<R>, _: &[R; 0], mut put: impl FnMut(usize, R)) {
        let Tangent { U, V, blocks } = &point.tangent;
        let frames = to_numbers(*U).into_iter().chain(to_numbers(*V));
        let all = frames.chain(blocks.hessian).chain(blocks.flip).chain(blocks.twist);
        for (k, number) in all.enumerate() {
            put(k, number);
        }
    }
}

/// Dm⁻¹ row by row, its volume last: what an element's forms need of its shape at rest.
struct Rest<R> {
    inverse: [[R; 3]; 3],
    volume: R,
}

impl<R: Real> Rest<R> {
    #[inline(always)]
    fn new([a, b, c, d, e, f, g, h, i, volume]: [R; 10]) -> Self {
        Self { inverse: [[a, b, c], [d, e, f], [g, h, i]], volume }
    }

    /// W: row n is the gradient of the barycentric coordinate of node n + 1, seen from the principal frame at rest, times
    /// √volume.
    #[inline(always)]
    fn shape_gradients(&self, V: &[[R; 3]; 3]) -> [[R; 3]; 3] {
        let factor = self.volume.sqrt();
        self.inverse.map(|row| {
            let scaled = row.map(|entry| factor * entry);
            std::array::from_fn(|l| {
                scaled[0].mul_add(V[0][l], scaled[1].mul_add(V[1][l], scaled[2] * V[2][l]))
            })
        })
    }
}

#[inline(always)]
fn largest<R: Real>(numbers: impl IntoIterator<Item = R>) -> R {
    numbers.into_iter().fold(R::splat(0.0), |largest, x| x.abs().max(largest))
}

/// The largest twist in an element's stiffness, relative to the rest of its tangent: far above what is ordinary, far below
/// 1/u. The collapsed horse recovers to the same digits with anything from 1e2 to 1e8.
const STIFFEST: f64 = 1e6;

/// Cuts off what a factorisation cannot resolve, and says so.
///
/// Where a stress jumps in the restoring sense, as of a rotated linear solid at λ2 + λ3 = 0 with λ(λ1 − 3) > 2μ, the energy
/// has a convex kink: the twist D⁺ is positive and unbounded, no filter touches it, and the factors of a matrix that
/// holds it beside ordinary entries lose all digits of those. A stiffness [`STIFFEST`] times the others is rigid enough.
#[inline(always)]
fn blunt<R: Real>(point: &mut Point<R>) {
    let blocks = &mut point.tangent.blocks;
    let limit = R::splat(STIFFEST) * largest(blocks.hessian.into_iter().chain(blocks.flip));
    for twist in &mut blocks.twist {
        // Not `min`, which would turn NaN into a plausible number.
        let is_blunted = limit.less(*twist);
        *twist = R::select(is_blunted, limit, *twist);
        point.status.bounded = point.status.bounded | is_blunted;
    }
}

/// Marks as not finite what may overflow on the way from the tangent to the stiffness or from stress to forces.
///
/// An entry of the stiffness is a sum of at most 27 products of an entry of the tangent and two of W, or minus a sum of
/// nine entries; one of the gradient is a sum of nine products of the stress, Dm⁻¹ and the volume.
#[inline(always)]
fn mark_overflow<R: Real>(point: &mut Point<R>, rest: &Rest<R>) {
    let blocks = &point.tangent.blocks;
    let tangent = largest(blocks.hessian.into_iter().chain(blocks.flip).chain(blocks.twist));
    let stress = largest(to_numbers(point.stress));
    let shape = largest(rest.inverse.into_iter().flatten());
    let force = shape * rest.volume * R::splat(16.0) * stress;
    let stiffness = (shape * rest.volume) * R::splat(1024.0) * (shape * tangent);
    point.status.nonfinite = point.status.nonfinite | !(force.is_finite() & stiffness.is_finite());
}

/// The gradient of an element's energy in its nodal positions: entry a of node n at 3n+a.
///
/// v P Dm⁻ᵀ; its column n belongs to node n + 1, and node 0 takes minus their sum.
#[inline(always)]
fn put_gradient<R: Real>(point: &Point<R>, rest: &[R; 10], mut put: impl FnMut(usize, R)) {
    let rest = Rest::new(*rest);
    for a in 0..3 {
        let row = point.stress[a].map(|entry| rest.volume * entry);
        let gradients =
            rest.inverse.map(|node| row[0].mul_add(node[0], row[1].mul_add(node[1], row[2] * node[2])));
        put(a, -(gradients[0] + gradients[1] + gradients[2]));
        for (n, gradient) in gradients.into_iter().enumerate() {
            put(3 * (n + 1) + a, gradient);
        }
    }
}

/// The stiffness from the blocks of the tangent: [`contract`] with W in place of V, with no 9×12 product.
///
/// Calls `put(i, j, a, c, value)` for coordinate a of node i and c of node j, once for each pair i > j, and for i = j with
/// a ≤ c. Node 0 takes minus the sums over the others, so that a common translation is resisted by rounding alone.
#[inline(always)]
fn stiffness<R: Real>(point: &Point<R>, rest: &[R; 10], mut put: impl FnMut(usize, usize, usize, usize, R)) {
    let Tangent { U, V, blocks } = &point.tangent;
    let W = Rest::new(*rest).shape_gradients(V);
    contract(U, &W, blocks, |a, c, block| {
        // `block[x][y]` belongs to coordinate a of node x + 1 and coordinate c of node y + 1; for a ≠ c it stands for
        // its mirror image too.
        let rows = block.map(|row| row[0] + row[1] + row[2]);
        let columns: [R; 3] = std::array::from_fn(|y| block[0][y] + block[1][y] + block[2][y]);
        put(0, 0, a, c, rows[0] + rows[1] + rows[2]);
        for x in 0..3 {
            put(x + 1, x + 1, a, c, block[x][x]);
            put(x + 1, 0, a, c, -rows[x]);
            for y in 0..x {
                put(x + 1, y + 1, a, c, block[x][y]);
            }
            if a != c {
                put(x + 1, 0, c, a, -columns[x]);
                for y in 0..x {
                    put(x + 1, y + 1, c, a, block[y][x]);
                }
            }
        }
    });
}

macro_rules! stiffness_form {
    ($(#[$doc:meta])* $Form:ident of $numbers:literal, |$i:ident, $j:ident, $a:ident, $c:ident| $places:expr) => {
        $(#[$doc])*
        pub(super) struct $Form;

        impl Form<10, 12, $numbers> for $Form {
            #[inline(always)]
            fn prepare<R: Real>(point: &mut Point<R>, rest: &[R; 10], has_pole: bool) {
                if has_pole {
                    blunt(point);
                }
                mark_overflow(point, &Rest::new(*rest));
            }

            #[inline(always)]
            fn first<R: Real>(point: &Point<R>, rest: &[R; 10], put: impl FnMut(usize, R)) {
                put_gradient(point, rest, put);
            }

            #[inline(always)]
            fn second<R: Real>(point: &Point<R>, rest: &[R; 10], mut put: impl FnMut(usize, R)) {
                stiffness(point, rest, |$i, $j, $a, $c, value| {
                    for place in $places {
                        put(place, value);
                    }
                });
            }
        }
    };
}

stiffness_form! {
    /// All 144 entries: unknown 3i+a is coordinate a of node i, entry (row, column) at 12 row + column.
    FullStiffness of 144, |i, j, a, c| {
        let (row, column) = (3 * i + a, 3 * j + c);
        [12 * row + column, 12 * column + row]
    }
}

stiffness_form! {
    /// The 78 entries on and above the diagonal, row by row.
    PackedStiffness of 78, |i, j, a, c| {
        let (row, column) = (3 * i + a, 3 * j + c);
        [packed(12, row.min(column), row.max(column))]
    }
}

stiffness_form! {
    /// The blocks of the node pairs i ≥ j in the order (0,0), (1,0), (1,1), (2,0), …, nine entries each.
    BlockStiffness of 90, |i, j, a, c| {
        let start = 9 * (i * (i + 1) / 2 + j);
        [start + 3 * a + c, if i == j { start + 3 * c + a } else { start + 3 * a + c }]
    }
}
