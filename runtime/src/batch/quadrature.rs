//! Elements with any number of nodes and quadrature points: deformation gradients of their points, and the
//! sums over points that make gradients and stiffnesses of their nodes.
//!
//! With the slopes g = ∂N/∂X of the shape functions and the volume v of each point,
//!
//! ```text
//! F_ab = Σm x_ma g_mb,   ∂W/∂x_ma = Σ v P_ab g_mb,   ∂²W/∂x_ma∂x_nc = Σ v g_mb (dP_ab/dF_cd g_nd)
//! ```
//!
//! The product in brackets is made once for each point and node n, and lanes hold nodes n side by side.

#![expect(non_snake_case, reason = "F, P, dP_dF as in the literature")]

use super::LengthError;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::point::matrix::three;

/// Elements with a given number of nodes and quadrature points each: sums over the points, with the scratch
/// memory to compute them.
///
/// Hexahedra, quadratic tetrahedra and any element whose shape functions the caller provides. Every slice has
/// one element after the other:
///
/// | slice | of | numbers |
/// |---|---|---|
/// | `positions` | each element | coordinate a of node n at 3n+a, m |
/// | `slopes` | each point | ∂N/∂X, along axis b of node n at 3n+b, 1/m |
/// | `volumes` | each point | its weight times the size of det ∂X/∂ξ, m³; a negative one reverses forces |
/// | `F`, `P`, `dP_dF` | each point | 9, 9 and 81, as [`Batch::tangents`](super::Batch::tangents) has them |
/// | `gradients` | each element | as `positions`, N; **forces are minus these** |
/// | `stiffnesses` | each element | unknown 3n+a in row and column 3n+a, N/m; exactly symmetric |
///
/// Only the first call allocates memory. Calls compute on the thread of the caller: other threads may use a
/// clone for their own elements. The results of an element do not depend on the others.
///
/// The [front page](crate#other-elements) of the crate has a program.
#[derive(Clone, Debug)]
pub struct Quadrature<E> {
    nodes: usize,
    points: usize,
    backend: Backend,
    room: Vec<E>,
}

impl<E: Scalar> Quadrature<E> {
    /// Elements with `nodes` nodes and `points` quadrature points each, computed with the best instructions
    /// of this processor.
    #[must_use]
    pub fn new(nodes: usize, points: usize) -> Self {
        Self { nodes, points, backend: Backend::best(), room: Vec::new() }
    }

    /// Sets the instructions to compute with.
    #[must_use]
    pub fn with_backend(self, backend: Backend) -> Self {
        Self { backend, ..self }
    }

    /// Computes the deformation gradients of all points of the elements, whose number follows from the length
    /// of `positions`.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn deform(&self, positions: &[E], slopes: &[E], F: &mut [E]) -> Result<(), LengthError> {
        let (unknowns, points) = (self.unknowns(), self.points);
        let elements = positions.len().checked_div(unknowns).unwrap_or(0);
        LengthError::check("positions", positions.len(), unknowns, elements, 1)?;
        LengthError::check("slopes", slopes.len(), unknowns, elements.saturating_mul(points), 1)?;
        LengthError::check("F", F.len(), 9, elements.saturating_mul(points), 1)?;
        for (point, (F, slopes)) in F.chunks_exact_mut(9).zip(chunks(slopes, unknowns)).enumerate() {
            F.fill(E::splat(0.0));
            let x = &positions[point / points * unknowns..][..unknowns];
            for (x, slope) in x.chunks_exact(3).zip(slopes.chunks_exact(3)) {
                for a in 0..3 {
                    for b in 0..3 {
                        F[3 * a + b] = x[a].mul_add(slope[b], F[3 * a + b]);
                    }
                }
            }
        }
        Ok(())
    }

    /// Gradients of the elements' energies in their nodal positions, N, from the stresses of their points.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn gradients(
        &self,
        slopes: &[E],
        volumes: &[E],
        P: &[E],
        gradients: &mut [E],
    ) -> Result<(), LengthError> {
        let (unknowns, elements) = (self.unknowns(), self.elements(slopes, volumes)?);
        LengthError::check("P", P.len(), 9, volumes.len(), 1)?;
        LengthError::check("gradients", gradients.len(), unknowns, elements, 1)?;
        gradients.fill(E::splat(0.0));
        let points = chunks(slopes, unknowns).zip(volumes).zip(P.chunks_exact(9)).enumerate();
        for (point, ((slopes, &volume), P)) in points {
            let gradients = &mut gradients[point / self.points * unknowns..];
            for (gradient, slope) in gradients.chunks_exact_mut(3).zip(slopes.chunks_exact(3)) {
                for a in 0..3 {
                    for b in 0..3 {
                        gradient[a] = (volume * P[3 * a + b]).mul_add(slope[b], gradient[a]);
                    }
                }
            }
        }
        Ok(())
    }

    /// Stiffnesses of the elements, N/m, from the tangents of their points: semidefinite if these are.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn stiffnesses(
        &mut self,
        slopes: &[E],
        volumes: &[E],
        dP_dF: &[E],
        stiffnesses: &mut [E],
    ) -> Result<(), LengthError> {
        let (unknowns, elements) = (self.unknowns(), self.elements(slopes, volumes)?);
        let Self { nodes, points, backend, .. } = *self;
        LengthError::check("dP_dF", dP_dF.len(), 81, volumes.len(), 1)?;
        LengthError::check("stiffnesses", stiffnesses.len(), unknowns.saturating_mul(unknowns), elements, 1)?;
        if stiffnesses.is_empty() {
            return Ok(());
        }
        // Only a first call makes room; nothing writes to what stands beyond the nodes.
        self.room.resize(Room::<E>::size(nodes), E::splat(0.0));
        for (element, stiffness) in stiffnesses.chunks_exact_mut(unknowns * unknowns).enumerate() {
            let of = element * points..(element + 1) * points;
            backend.run(StiffnessSums {
                nodes,
                slopes: &slopes[unknowns * of.start..unknowns * of.end],
                volumes: &volumes[of.clone()],
                dP_dF: &dP_dF[81 * of.start..81 * of.end],
                room: Room::new(nodes, &mut self.room),
                stiffness,
            });
        }
        Ok(())
    }

    /// Number of elements in these slices.
    fn elements(&self, slopes: &[E], volumes: &[E]) -> Result<usize, LengthError> {
        let elements = volumes.len().checked_div(self.points).unwrap_or(0);
        LengthError::check("volumes", volumes.len(), self.points, elements, 1)?;
        LengthError::check("slopes", slopes.len(), self.unknowns(), volumes.len(), 1)?;
        Ok(elements)
    }

    fn unknowns(&self) -> usize {
        self.nodes.saturating_mul(3)
    }
}

fn chunks<E>(of: &[E], size: usize) -> impl Iterator<Item = &[E]> {
    of.chunks_exact(size.max(1))
}

/// Number of nodes, rounded up to whole registers of any back end.
fn stride<E: Scalar>(nodes: usize) -> usize {
    nodes.next_multiple_of(E::LINE)
}

/// The stiffness of an element.
struct StiffnessSums<'a, E> {
    nodes: usize,
    slopes: &'a [E],
    volumes: &'a [E],
    dP_dF: &'a [E],
    room: Room<'a, E>,
    stiffness: &'a mut [E],
}

/// Scratch memory: values of one point, and sums over all points.
struct Room<'a, E> {
    /// The slopes along each axis, node by node.
    axes: &'a mut [E],
    /// Each slope in all lanes of a register.
    splats: &'a mut [E],
    /// Entries at (a, c), block of nodes n, node m, lane: those with m beyond the block are left out.
    sums: &'a mut [E],
}

impl<'a, E: Scalar> Room<'a, E> {
    fn size(nodes: usize) -> usize {
        3 * stride::<E>(nodes) + 3 * nodes * E::LINE + 9 * nodes * stride::<E>(nodes)
    }

    fn new(nodes: usize, room: &'a mut [E]) -> Self {
        let (axes, room) = room.split_at_mut(3 * stride::<E>(nodes));
        let (splats, sums) = room.split_at_mut(3 * nodes * E::LINE);
        Self { axes, splats, sums }
    }
}

impl<E: Scalar> Kernel<E> for StiffnessSums<'_, E> {
    type Output = ();

    // Plain loops: closures and iterators that are not inlined are not compiled for the back end.
    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Self { nodes, slopes, volumes, dP_dF, room: Room { axes, splats, sums }, stiffness } = self;
        let (stride, lanes, unknowns) = (stride::<E>(nodes), R::LANES, 3 * nodes);
        // Of each (a, c), one row of registers for each block of nodes.
        let (row, rows) = (nodes * lanes, nodes.div_ceil(lanes));
        sums.fill(E::splat(0.0));
        for point in 0..volumes.len() {
            let slopes = &slopes[unknowns * point..][..unknowns];
            let dP_dF = &dP_dF[81 * point..][..81];
            for k in 0..unknowns {
                axes[k % 3 * stride + k / 3] = slopes[k];
                R::splat(slopes[k].into()).store(&mut splats[k * lanes..]);
            }
            for ac in 0..9 {
                let (a, c) = (ac / 3, ac % 3);
                // v dP_ab/dF_cd at b, d.
                let t = three!(b => three!(d => {
                    R::splat((volumes[point] * dP_dF[9 * (3 * a + b) + 3 * c + d]).into())
                }));
                for block in 0..rows {
                    let n = block * lanes;
                    let g = three!(d => R::load(&axes[d * stride + n..]));
                    let [p1, p2, p3] =
                        three!(b => t[b][0].mul_add(g[0], t[b][1].mul_add(g[1], t[b][2] * g[2])));
                    let count = nodes.min(n + lanes);
                    let sum = &mut sums[(ac * rows + block) * row..][..count * lanes];
                    let splats = &splats[..3 * count * lanes];
                    for m in 0..count {
                        let g = &splats[3 * m * lanes..][..3 * lanes];
                        let sum = &mut sum[m * lanes..][..lanes];
                        let after = R::load(g).mul_add(p1, R::load(sum));
                        let after = R::load(&g[lanes..]).mul_add(p2, after);
                        R::load(&g[2 * lanes..]).mul_add(p3, after).store(sum);
                    }
                }
            }
        }
        for ac in 0..9 {
            let (a, c) = (ac / 3, ac % 3);
            for n in 0..nodes {
                let sums = &sums[(ac * rows + n / lanes) * row + n % lanes..];
                // Of a node with itself, one triangle is copied to the other.
                for m in 0..n + usize::from(a <= c) {
                    let entry = sums[m * lanes];
                    stiffness[unknowns * (3 * m + a) + 3 * n + c] = entry;
                    stiffness[unknowns * (3 * n + c) + 3 * m + a] = entry;
                }
            }
        }
    }
}
