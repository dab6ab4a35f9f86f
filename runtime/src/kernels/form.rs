//! Forms of a tangent and of an element's stiffness, made from a point's frames and blocks.

#![expect(non_snake_case, reason = "U, V, W, P as in the literature")]

use std::marker::PhantomData;

use super::sink::{LineBuffer, Sink, Source};
use crate::lanes::{Lanes, Mask, Real, Scalar};
use crate::material::Blocks;
use crate::point::invariants::tangent::{Entries, RowsOf, TermSet, Terms};
use crate::point::matrix::{dot, three, thrice, to_row_major};
use crate::point::{Assemble, Matrix3, Tangent, assemble_blocks, multiply};
use crate::status::Status;

/// Outputs of a tile.
#[derive(Clone, Copy)]
pub(crate) enum Outputs<'a, E> {
    /// P and all 81 entries of dP/dF.
    Points,
    /// Gradients of elements with these shapes at rest, and all 144 entries of their stiffnesses, row by row.
    Elements(Source<'a, E, 10>),
    /// The same with the 90 entries of the blocks of node pairs.
    ElementsByBlocks(Source<'a, E, 10>),
}

/// The kind of thing that outputs belong to, [`Points`] or [`Elements`], with its first output: P itself at
/// points, the gradient at elements.
pub(crate) trait Site {
    /// Shape at rest.
    type Rest<R: Real>;

    /// Shapes at rest of a tile.
    type Shapes<'a, E: Scalar>;

    /// Shapes at rest of the points from `at` on.
    fn rest<R: Lanes>(shapes: &Self::Shapes<'_, R::Scalar>, at: usize) -> Self::Rest<R>;

    /// True if the first output is finite, given that P is.
    fn stays_finite<R: Lanes>(stress: &Matrix3<R>, rest: &Self::Rest<R>) -> R::Mask;

    /// Puts the first output into its place; [`Site::finish`] must follow.
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        rest: &Self::Rest<R>,
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    );

    /// Copies the first output to the slice.
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize);
}

/// Points, which have no shape at rest.
pub(crate) struct Points;

impl Site for Points {
    type Rest<R: Real> = ();
    type Shapes<'a, E: Scalar> = ();

    #[inline(always)]
    fn rest<R: Lanes>((): &(), _: usize) {}

    #[inline(always)]
    fn stays_finite<R: Lanes>(_: &Matrix3<R>, (): &()) -> R::Mask {
        R::Mask::splat(true)
    }

    #[inline(always)]
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        (): &(),
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    ) {
        to.place::<R, 9>(line, at).put_all(to_row_major(*stress));
    }

    #[inline(always)]
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize) {
        to.finish::<R, 9>(line, at, count);
    }
}

/// Elements, which have Dm⁻¹ row by row and the volume at rest.
pub(crate) struct Elements;

impl Site for Elements {
    type Rest<R: Real> = [R; 10];
    type Shapes<'a, E: Scalar> = Source<'a, E, 10>;

    #[inline(always)]
    fn rest<R: Lanes>(shapes: &Source<'_, R::Scalar, 10>, at: usize) -> [R; 10] {
        shapes.get_all(at)
    }

    #[inline(always)]
    fn stays_finite<R: Lanes>(stress: &Matrix3<R>, rest: &[R; 10]) -> R::Mask {
        gradient_is_finite(stress, rest)
    }

    #[inline(always)]
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        rest: &[R; 10],
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    ) {
        put_gradient(stress, rest, to.place::<R, 12>(line, at));
    }

    #[inline(always)]
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize) {
        to.finish::<R, 12>(line, at, count);
    }
}

/// Second output: a form of N components, made from a point's judged tangent, or without a decomposition, and
/// the shape at rest.
pub(crate) trait Output<S: Site, const N: usize> {
    /// Changes blocks if the form requires more than the filter.
    #[inline(always)]
    fn prepare<R: Real>(blocks: &mut Blocks<R>, rest: &S::Rest<R>, has_pole: bool) -> Status<R::Mask> {
        let _ = (blocks, rest, has_pole);
        Status::clean()
    }

    fn put_all<R: Real>(tangent: &Tangent<R>, rest: &S::Rest<R>, to: &mut (impl Components<R> + ?Sized));

    /// Returns the lanes for which the tangent is as accurate as by a decomposition, and nothing can overflow
    /// on the way from it to the form.
    fn put_all_by_invariants<R: Real, T: TermSet>(
        terms: &Terms<R, T>,
        rest: &S::Rest<R>,
        to: &mut (impl Components<R> + ?Sized),
    ) -> R::Mask;
}

/// Place of the components of an output.
pub(crate) trait Components<R> {
    fn put(&mut self, k: usize, number: R);

    #[inline(always)]
    fn put_all<const N: usize>(&mut self, numbers: [R; N])
    where
        R: Copy,
    {
        for k in 0..N {
            self.put(k, numbers[k]);
        }
    }
}

/// Lines: component k at k LINE.
impl<E: Scalar, R: Lanes<Scalar = E>> Components<R> for [E] {
    #[inline(always)]
    fn put(&mut self, k: usize, number: R) {
        number.store(&mut self[k * E::LINE..]);
    }
}

#[cfg(all(feature = "interpreter", not(test)))]
impl<R: Real, const N: usize> Components<R> for [R; N] {
    #[inline(always)]
    fn put(&mut self, k: usize, number: R) {
        self[k] = number;
    }
}

/// All 81 entries of dP/dF: row 3i+j, column 3k+l at 9 (3i+j) + 3k+l.
pub(crate) struct FullTangent;

impl Output<Points, 81> for FullTangent {
    #[inline(always)]
    fn put_all<R: Real>(tangent: &Tangent<R>, (): &(), to: &mut (impl Components<R> + ?Sized)) {
        let Tangent { U, V, blocks } = tangent;
        assemble_blocks(U, V, blocks, &mut TangentPlace(to));
    }

    #[inline(always)]
    fn put_all_by_invariants<R: Real, T: TermSet>(
        terms: &Terms<R, T>,
        (): &(),
        to: &mut (impl Components<R> + ?Sized),
    ) -> R::Mask {
        terms.assemble(&Entries, &mut TangentPlace(to))
    }
}

/// Output for the blocks of [`assemble_blocks`] as entries of dP/dF.
struct TangentPlace<'a, C: ?Sized>(&'a mut C);

impl<R: Real, C: Components<R> + ?Sized> Assemble<R> for TangentPlace<'_, C> {
    #[inline(always)]
    fn block(&mut self, a: usize, c: usize, block: &Matrix3<R>) {
        thrice!(x => {
            thrice!(y => {
                let (row, column) = (3 * a + x, 3 * c + y);
                self.0.put(9 * row + column, block[x][y]);
                self.0.put(9 * column + row, block[x][y]);
            });
        });
    }
}

/// Rest shape of an element: Dm⁻¹ row by row, then its volume.
struct Rest<R> {
    inverse: [[R; 3]; 3],
    volume: R,
}

impl<R: Real> Rest<R> {
    #[inline(always)]
    fn new([a, b, c, d, e, f, g, h, i, volume]: [R; 10]) -> Self {
        Self { inverse: [[a, b, c], [d, e, f], [g, h, i]], volume }
    }

    /// True if the stiffness is finite in any frames, given a bound of the entries of its tangent. A negative
    /// volume, which has no root, is not.
    #[inline(always)]
    fn keeps_finite(&self, tangent: R) -> R::Mask {
        let shape = largest(to_row_major(self.inverse)) * self.volume.sqrt();
        (shape * R::splat(1024.0) * (shape * tangent)).is_finite()
    }

    /// The gradients of the barycentric coordinates of nodes 1, 2, 3, a row for each, times √volume.
    #[inline(always)]
    fn scaled_gradients(&self) -> [[R; 3]; 3] {
        let factor = self.volume.sqrt();
        three!(n => three!(x => factor * self.inverse[n][x]))
    }
}

#[inline(always)]
fn largest<R: Real, const N: usize>(numbers: [R; N]) -> R {
    let mut largest = R::splat(0.0);
    for k in 0..N {
        largest = numbers[k].abs().max(largest);
    }
    largest
}

/// The largest twist in an element's stiffness, relative to the rest of its tangent: far above ordinary
/// values, far below 1/u. The collapsed horse recovers to the same digits with anything from 1e2 to 1e8.
pub const MAX_STIFFNESS_RATIO: f64 = 1e6;

/// Bounds twists that a factorisation could not resolve; true if one was bounded.
///
/// Where a stress jumps in the restoring sense, as for a rotated linear solid at λ2 + λ3 = 0 with λ(λ1 − 3) >
/// 2μ, the energy has a convex kink: the twist D⁺ is positive and unbounded, no filter touches it, and the
/// factors of a matrix that holds it next to ordinary entries lose all digits of those. A stiffness
/// [`MAX_STIFFNESS_RATIO`] times the others is rigid enough.
#[inline(always)]
pub(crate) fn cap_twist<R: Real>(blocks: &mut Blocks<R>) -> R::Mask {
    let limit = R::splat(MAX_STIFFNESS_RATIO) * largest([largest(blocks.hessian), largest(blocks.flip)]);
    // Not `min`, which would turn NaN into a plausible number.
    let is_capped = three!(pair => limit.less(blocks.twist[pair]));
    blocks.twist = three!(pair => R::select(is_capped[pair], limit, blocks.twist[pair]));
    is_capped[0] | is_capped[1] | is_capped[2]
}

/// True if nothing can overflow on the way from stress to the gradient: a sum of nine products of the stress,
/// Dm⁻¹ and the volume.
#[inline(always)]
pub(crate) fn gradient_is_finite<R: Real>(stress: &Matrix3<R>, rest: &[R; 10]) -> R::Mask {
    let Rest { inverse, volume } = Rest::new(*rest);
    (largest(to_row_major(inverse)) * volume * R::splat(16.0) * largest(to_row_major(*stress))).is_finite()
}

/// The gradient of an element's energy in its nodal positions: entry a of node n at 3n+a.
///
/// v P Dm⁻ᵀ; its column n belongs to node n + 1, and node 0 takes minus their sum.
#[inline(always)]
pub(crate) fn put_gradient<R: Real>(
    stress: &Matrix3<R>,
    rest: &[R; 10],
    to: &mut (impl Components<R> + ?Sized),
) {
    let rest = Rest::new(*rest);
    thrice!(a => {
        let row = three!(x => stress[a][x] * rest.volume);
        let [g1, g2, g3] = three!(n => dot(row, rest.inverse[n]));
        to.put(a, -(g1 + g2 + g3));
        to.put(3 + a, g1);
        to.put(6 + a, g2);
        to.put(9 + a, g3);
    });
}

/// Form of an element's stiffness with N components.
pub(crate) trait StiffnessForm<const N: usize> {
    /// The place of the entry between coordinate a of node i and c of node j, i ≥ j, and that of its mirror
    /// image.
    fn places(i: usize, a: usize, j: usize, c: usize) -> (usize, Option<usize>);
}

/// All 144 entries: unknown 3i+a is coordinate a of node i, entry (row, column) at 12 row + column.
pub(crate) struct FullStiffness;

impl StiffnessForm<144> for FullStiffness {
    #[inline(always)]
    fn places(i: usize, a: usize, j: usize, c: usize) -> (usize, Option<usize>) {
        let (row, column) = (3 * i + a, 3 * j + c);
        (12 * row + column, Some(12 * column + row))
    }
}

/// The blocks of the node pairs i ≥ j in the order (0,0), (1,0), (1,1), (2,0), …, nine entries each.
pub(crate) struct BlockStiffness;

impl StiffnessForm<90> for BlockStiffness {
    #[inline(always)]
    fn places(i: usize, a: usize, j: usize, c: usize) -> (usize, Option<usize>) {
        let start = 9 * (i * (i + 1) / 2 + j);
        (start + 3 * a + c, (i == j).then_some(start + 3 * c + a))
    }
}

impl<F: StiffnessForm<N>, const N: usize> Output<Elements, N> for F {
    #[inline(always)]
    fn prepare<R: Real>(blocks: &mut Blocks<R>, rest: &[R; 10], has_pole: bool) -> Status<R::Mask> {
        let bounded = if has_pole { cap_twist(blocks) } else { R::Mask::splat(false) };
        // An entry is a sum of at most 27 products of an entry of the tangent and two of W, or of nine such
        // sums.
        let tangent = largest([largest(blocks.hessian), largest(blocks.flip), largest(blocks.twist)]);
        Status { bounded, nonfinite: !Rest::new(*rest).keeps_finite(tangent), ..Status::clean() }
    }

    #[inline(always)]
    fn put_all<R: Real>(tangent: &Tangent<R>, rest: &[R; 10], to: &mut (impl Components<R> + ?Sized)) {
        let Tangent { U, V, blocks } = tangent;
        // Row n is the gradient of the barycentric coordinate of node n + 1 in the principal frame at rest.
        let W = multiply(&Rest::new(*rest).scaled_gradients(), V);
        assemble_blocks(U, &W, blocks, &mut StiffnessPlace::<F, _, N>(PhantomData, to));
    }

    #[inline(always)]
    fn put_all_by_invariants<R: Real, T: TermSet>(
        terms: &Terms<R, T>,
        rest: &[R; 10],
        to: &mut (impl Components<R> + ?Sized),
    ) -> R::Mask {
        // Before the entries, which need all registers.
        let (bound, _) = terms.bounds();
        let rest = Rest::new(*rest);
        let coordinates = RowsOf::new(rest.scaled_gradients());
        let keeps_digits = terms.assemble(&coordinates, &mut StiffnessPlace::<F, _, N>(PhantomData, to));
        keeps_digits & rest.keeps_finite(bound)
    }
}

/// Stiffness from the blocks of the tangent: [`assemble_blocks`] with W instead of V, with no 9×12 product.
///
/// Node 0 takes minus the sums over the others, so that a common translation is resisted by rounding alone.
struct StiffnessPlace<'a, F, C: ?Sized, const N: usize>(PhantomData<F>, &'a mut C);

impl<F: StiffnessForm<N>, C: ?Sized, const N: usize> StiffnessPlace<'_, F, C, N> {
    #[inline(always)]
    fn put<R: Real>(&mut self, [i, a]: [usize; 2], [j, c]: [usize; 2], entry: R)
    where
        C: Components<R>,
    {
        let (place, mirrored) = F::places(i, a, j, c);
        self.1.put(place, entry);
        if let Some(mirrored) = mirrored {
            self.1.put(mirrored, entry);
        }
    }
}

impl<F: StiffnessForm<N>, R: Real, C: Components<R> + ?Sized, const N: usize> Assemble<R>
    for StiffnessPlace<'_, F, C, N>
{
    #[inline(always)]
    fn block(&mut self, a: usize, c: usize, block: &Matrix3<R>) {
        // `block[x][y]` belongs to coordinate a of node x + 1 and coordinate c of node y + 1, and stands for
        // its mirror image too, which for a = c is itself.
        let rows = three!(x => block[x][0] + block[x][1] + block[x][2]);
        self.put([0, a], [0, c], rows[0] + rows[1] + rows[2]);
        thrice!(x => {
            self.put([x + 1, a], [0, c], -rows[x]);
            self.put([x + 1, c], [0, a], -(block[0][x] + block[1][x] + block[2][x]));
            self.put([x + 1, a], [x + 1, c], block[x][x]);
            thrice!(y => {
                if y < x {
                    self.put([x + 1, a], [y + 1, c], block[x][y]);
                    self.put([x + 1, c], [y + 1, a], block[y][x]);
                }
            });
        });
    }
}
