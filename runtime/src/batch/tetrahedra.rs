//! Linear tetrahedra of a mesh: which nodes they join, and how the positions of these become edges.

use super::sink::Lines;
use crate::NoSuchNode;
use crate::lanes::Scalar;

/// The nodes of linear tetrahedra, four of each, seen to exist once for many calls.
#[derive(Clone, Copy, Debug)]
pub struct Tetrahedra<'a> {
    nodes: usize,
    corners: &'a [[usize; 4]],
}

impl<'a> Tetrahedra<'a> {
    /// Tetrahedra that join nodes numbered from 0 to `nodes` − 1.
    ///
    /// # Errors
    /// [`NoSuchNode`] for the first node that does not exist.
    pub fn new(nodes: usize, corners: &'a [[usize; 4]]) -> Result<Self, NoSuchNode> {
        match corners.as_flattened().iter().position(|&node| node >= nodes) {
            Some(at) => Err(NoSuchNode { element: Some(at / 4), node: corners.as_flattened()[at], nodes }),
            None => Ok(Self { nodes, corners }),
        }
    }

    /// The four nodes of each.
    #[must_use]
    pub fn corners(&self) -> &'a [[usize; 4]] {
        self.corners
    }

    /// Number of nodes of the mesh.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Stores Ds of the tetrahedra from `start` on, one in each of so many lanes; past the last one edges of
    /// length 1 along the axes.
    pub(super) fn set_edges<E: Scalar>(
        &self,
        start: usize,
        count: usize,
        positions: &[[E; 3]],
        edges: &mut Lines<E, 9>,
    ) {
        let [zero, one] = [0.0, 1.0].map(E::splat);
        for lane in 0..count {
            let [x0, x1, x2, x3] = match self.corners.get(start + lane) {
                Some(corners) => corners.map(|node| positions[node]),
                None => [[zero; 3], [one, zero, zero], [zero, one, zero], [zero, zero, one]],
            };
            set_edges(edges, lane, [x0, x1, x2, x3]);
        }
    }
}

/// Stores Ds: row a, column k is coordinate a of corner k + 1 less that of corner 0.
#[inline]
pub(super) fn set_edges<E: Scalar>(edges: &mut Lines<E, 9>, lane: usize, [x0, x1, x2, x3]: [[E; 3]; 4]) {
    for a in 0..3 {
        edges.set(lane, 3 * a, x1[a] - x0[a]);
        edges.set(lane, 3 * a + 1, x2[a] - x0[a]);
        edges.set(lane, 3 * a + 2, x3[a] - x0[a]);
    }
}

#[cfg(test)]
mod tests {
    #![expect(non_snake_case, reason = "F as in the literature")]

    use super::*;
    use crate::batch::{Batch, Layout, LengthError, MatrixForm, REST, TileMaterial};
    use crate::hand_written::{NeoHookean, NeoHookeanByInvariants, SaintVenantKirchhoff};
    use crate::lanes::{Backend, Real};
    use crate::point::Filter;
    use crate::random::Random;

    /// Nodes, corners and shapes at rest of a mesh whose tetrahedra share nodes.
    struct Mesh<E> {
        positions: Vec<[E; 3]>,
        corners: Vec<[usize; 4]>,
        rest: Vec<[E; REST]>,
    }

    /// Four nodes in a row are near the corners of a regular tetrahedron, and F is near 1.1 times the unit
    /// matrix.
    fn mesh<E: Scalar>(tetrahedra: usize) -> Mesh<E> {
        let regular = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let mut random = Random::new(9);
        let mut near = |x: f64, by: f64| E::splat(x + random.uniform(-by, by));
        let positions: Vec<[E; 3]> =
            (0..tetrahedra + 3).map(|node| regular[node % 4].map(|x| near(x, 0.1))).collect();
        // Every other one has its last nodes swapped, so that all have a positive volume.
        let corners: Vec<[usize; 4]> = (0..tetrahedra)
            .map(|t| if t % 2 == 0 { [t, t + 1, t + 3, t + 2] } else { [t, t + 1, t + 2, t + 3] })
            .collect();
        let rest = corners.iter().map(|&corners| {
            let Ds = edges(&positions, corners);
            let minor = |i: usize, j: usize| {
                let [p, q, r, s] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
                Ds[r][p] * Ds[s][q] - Ds[r][q] * Ds[s][p]
            };
            let det = Ds[0][0] * minor(0, 0) + Ds[1][0] * minor(0, 1) + Ds[2][0] * minor(0, 2);
            let mut shape = [near(0.5, 0.4); REST];
            for j in 0..3 {
                let F: [E; 3] = std::array::from_fn(|i| near(if i == j { 1.1 } else { 0.0 }, 0.05));
                for i in 0..3 {
                    shape[3 * i + j] = (0..3).fold(E::splat(0.0), |sum, k| sum + minor(i, k) * F[k]) / det;
                }
            }
            shape
        });
        Mesh { rest: rest.collect(), positions, corners }
    }

    fn edges<E: Scalar>(positions: &[[E; 3]], corners: [usize; 4]) -> [[E; 3]; 3] {
        let [x0, x1, x2, x3] = corners.map(|node| positions[node]);
        std::array::from_fn(|a| [x1[a] - x0[a], x2[a] - x0[a], x3[a] - x0[a]])
    }

    fn lay<E: Scalar, const N: usize>(layout: Layout, points: &[[E; N]], padding: [E; N]) -> Vec<E> {
        let count = match layout {
            Layout::Points => points.len(),
            Layout::Lines => points.len().next_multiple_of(E::LINE),
        };
        let mut slice = vec![E::splat(0.0); N * count];
        for p in 0..count {
            let numbers = points.get(p).unwrap_or(&padding);
            for k in 0..N {
                slice[layout.index::<E>(p, N, k)] = numbers[k];
            }
        }
        slice
    }

    /// The outputs at positions are those at the deformation gradients that these make.
    fn check<E: crate::batch::Stages>(material: &dyn TileMaterial<E>, filter: Filter)
    where
        f64: From<E>,
    {
        // Two tiles, the last line of which is not full.
        let Mesh { positions, corners, rest } = mesh::<E>(64 + 13);
        let tetrahedra = Tetrahedra::new(positions.len(), &corners).expect("nodes that exist");
        let unit = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0].map(E::splat);
        let F: Vec<[E; 9]> = corners
            .iter()
            .zip(&rest)
            .map(|(&corners, rest)| {
                let Ds = edges(&positions, corners);
                std::array::from_fn(|k| {
                    (0..3).fold(E::splat(0.0), |sum, m| sum + Ds[k / 3][m] * rest[3 * m + k % 3])
                })
            })
            .collect();
        let unit_F = unit[..9].try_into().expect("nine of ten");
        for backend in Backend::available() {
            for layout in [Layout::Points, Layout::Lines] {
                let batch =
                    Batch::new(material).with_filter(filter).with_backend(backend).with_layout(layout);
                let (F, rest) = (lay(layout, &F, unit_F), lay(layout, &rest, unit));
                let count = rest.len() / REST;
                let zeros = |numbers: usize| vec![E::splat(0.0); numbers * count];
                let (mut gradients, mut full, mut packed) = (zeros(12), zeros(144), zeros(78));
                let (mut expected_gradients, mut expected, mut expected_packed) =
                    (zeros(12), zeros(144), zeros(78));
                let at = batch.stiffnesses_at(
                    MatrixForm::Full,
                    tetrahedra,
                    &positions,
                    &rest,
                    &mut gradients,
                    &mut full,
                );
                let from =
                    batch.stiffnesses(MatrixForm::Full, &F, &rest, &mut expected_gradients, &mut expected);
                assert_eq!(at, from);
                assert!(at.expect("lengths fit").is_clean());
                close(&gradients, &expected_gradients);
                close(&full, &expected);
                batch
                    .stiffnesses_at(
                        MatrixForm::Packed,
                        tetrahedra,
                        &positions,
                        &rest,
                        &mut gradients,
                        &mut packed,
                    )
                    .expect("lengths fit");
                batch
                    .stiffnesses(MatrixForm::Packed, &F, &rest, &mut expected_gradients, &mut expected_packed)
                    .expect("lengths fit");
                close(&packed, &expected_packed);
            }
        }
    }

    /// Beside the largest entry of all: F is made with other roundings, and derivatives of the energies are
    /// of the order of 1.
    fn close<E: Scalar>(found: &[E], expected: &[E])
    where
        f64: From<E>,
    {
        let largest = expected.iter().fold(0.0, |largest: f64, &x| largest.max(f64::from(x).abs()));
        assert!(largest > 0.0);
        for (&found, &expected) in found.iter().zip(expected) {
            let error = (f64::from(found) - f64::from(expected)).abs();
            assert!(error <= 200.0 * <E as Real>::UNIT_ROUNDOFF * largest, "{found:?} for {expected:?}");
        }
    }

    #[test]
    fn stiffnesses_at_positions_are_those_of_their_gradients() {
        check::<f64>(&SaintVenantKirchhoff, Filter::None);
        #[cfg(feature = "f32")]
        check::<f32>(&SaintVenantKirchhoff, Filter::None);
        check::<f64>(&NeoHookean, Filter::Clamp);
        check::<f64>(&NeoHookeanByInvariants, Filter::None);
        #[cfg(feature = "f32")]
        check::<f32>(&NeoHookeanByInvariants, Filter::None);
    }

    #[test]
    fn nodes_that_do_not_exist_and_lengths_that_do_not_fit_are_errors() {
        let corners = [[0, 1, 2, 3], [1, 2, 3, 4]];
        let error = Tetrahedra::new(4, &corners).expect_err("node 4");
        assert_eq!(error, NoSuchNode { element: Some(1), node: 4, nodes: 4 });
        assert_eq!(error.to_string(), "element 1 names node 4: the 4 nodes are numbered from 0");
        let tetrahedra = Tetrahedra::new(5, &corners).expect("nodes that exist");
        let batch = Batch::<f64>::new(&SaintVenantKirchhoff);
        let call = |positions: usize, rest: usize| {
            let (positions, rest) = (vec![[0.0; 3]; positions], vec![0.0; rest]);
            batch.stiffnesses_at(
                MatrixForm::Full,
                tetrahedra,
                &positions,
                &rest,
                &mut [0.0; 24],
                &mut [0.0; 288],
            )
        };
        let wrong = |slice, found, components, points| {
            Err(LengthError { slice, found, components, points, group: 1 })
        };
        assert_eq!(call(4, 20), wrong("positions", 12, 3, 5));
        assert_eq!(call(5, 30), wrong("rest", 30, 10, 2));
        assert!(call(5, 20).is_ok());
    }
}
