//! Elements from the positions of their nodes, compared with those from deformation gradients.

use piola::__private::random::Random;
use piola::NoSuchNode;
use piola::batch::{Batch, Kernels, Layout, LengthError, REST, Tetrahedra, TileMaterial};
use piola::lanes::{Backend, Real, Scalar};
use piola::point::Filter;

use crate::hand_written::{NeoHookean, SaintVenantKirchhoff};
use crate::{Logarithmic, lay};

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
    let mut near = |x: f64, by: f64| x + random.uniform(-by, by);
    let positions: Vec<[E; 3]> =
        (0..tetrahedra + 3).map(|node| regular[node % 4].map(|x| E::splat(near(x, 0.1)))).collect();
    // Every other one has its last nodes swapped, so that all have a positive volume.
    let corners: Vec<[usize; 4]> = (0..tetrahedra)
        .map(|t| if t % 2 == 0 { [t, t + 1, t + 3, t + 2] } else { [t, t + 1, t + 2, t + 3] })
        .collect();
    let rest = corners.iter().map(|&corners| {
        let Ds = edges(&positions, corners);
        let F = nalgebra::Matrix3::from_fn(|i, j| near(if i == j { 1.1 } else { 0.0 }, 0.05));
        let Ds = nalgebra::Matrix3::<f64>::from_fn(|i, j| Ds[i][j].into());
        let shape = Ds.try_inverse().expect("a volume") * F;
        std::array::from_fn(|k| E::splat(if k < 9 { shape[(k / 3, k % 3)] } else { near(0.5, 0.4) }))
    });
    Mesh { rest: rest.collect(), positions, corners }
}

fn edges<E: Scalar>(positions: &[[E; 3]], corners: [usize; 4]) -> [[E; 3]; 3] {
    let [x0, x1, x2, x3] = corners.map(|node| positions[node]);
    std::array::from_fn(|a| [x1[a] - x0[a], x2[a] - x0[a], x3[a] - x0[a]])
}

/// As a slice of a layout, whose last line is filled up.
fn padded<E: Kernels, const N: usize>(layout: Layout, points: &[[E; N]], padding: [E; N]) -> Vec<E> {
    let mut points = points.to_vec();
    if layout == Layout::Lines {
        points.resize(points.len().next_multiple_of(E::LINE), padding);
    }
    lay(layout, &points)
}

/// The outputs at positions are those at the deformation gradients that these make.
fn check<E: Kernels>(material: &dyn TileMaterial<E>, filter: Filter) {
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
            let batch = Batch::new(material).with_filter(filter).with_backend(backend).with_layout(layout);
            let (F, rest) = (padded(layout, &F, unit_F), padded(layout, &rest, unit));
            let count = rest.len() / REST;
            let zeros = |numbers: usize| vec![E::splat(0.0); numbers * count];
            let (mut gradients, mut full) = (zeros(12), zeros(144));
            let (mut expected_gradients, mut expected) = (zeros(12), zeros(144));
            let at = batch.stiffnesses_at(tetrahedra, &positions, &rest, &mut gradients, &mut full);
            let from = batch.stiffnesses(&F, &rest, &mut expected_gradients, &mut expected);
            assert_eq!(at, from);
            assert!(at.expect("lengths fit").is_clean());
            close(&gradients, &expected_gradients);
            close(&full, &expected);
        }
    }
}

/// Relative to the largest entry of all: F is made with other roundings, and derivatives of the energies are
/// of the order of 1.
fn close<E: Scalar>(found: &[E], expected: &[E]) {
    let wide = |x: E| -> f64 { x.into() };
    let largest = expected.iter().fold(0.0, |largest: f64, &x| largest.max(wide(x).abs()));
    assert!(largest > 0.0);
    for (&found, &expected) in found.iter().zip(expected) {
        let error = (wide(found) - wide(expected)).abs();
        assert!(error <= 200.0 * <E as Real>::UNIT_ROUNDOFF * largest, "{found:?} for {expected:?}");
    }
}

#[test]
fn stiffnesses_at_positions_are_those_of_their_gradients() {
    check::<f64>(&SaintVenantKirchhoff, Filter::None);
    #[cfg(feature = "f32")]
    check::<f32>(&SaintVenantKirchhoff, Filter::None);
    check::<f64>(&NeoHookean, Filter::Clamp);
    let logarithmic = Logarithmic::new(1.0, 1.5).expect("admissible");
    check::<f64>(&logarithmic, Filter::None);
    #[cfg(feature = "f32")]
    check::<f32>(&logarithmic, Filter::None);
}

#[test]
fn elements_of_negative_volume_are_not_finite() {
    const COUNT: usize = 70;
    let Mesh { positions, corners, mut rest } = mesh::<f64>(COUNT);
    for shape in &mut rest {
        shape[REST - 1] = -shape[REST - 1];
    }
    let tetrahedra = Tetrahedra::new(positions.len(), &corners).expect("nodes that exist");
    let (mut gradients, mut stiffnesses) = (vec![0.0; 12 * COUNT], vec![0.0; 144 * COUNT]);
    for energy in [&SaintVenantKirchhoff as &dyn TileMaterial<f64>, &NeoHookean] {
        for backend in Backend::available() {
            for filter in [Filter::None, Filter::Clamp] {
                let survey = Batch::new(energy).with_backend(backend).with_filter(filter).stiffnesses_at(
                    tetrahedra,
                    &positions,
                    rest.as_flattened(),
                    &mut gradients,
                    &mut stiffnesses,
                );
                assert_eq!(survey.expect("lengths fit").nonfinite, COUNT, "{backend}");
            }
        }
    }
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
        batch.stiffnesses_at(tetrahedra, &positions, &rest, &mut [0.0; 24], &mut [0.0; 288])
    };
    let wrong =
        |slice, found, components, points| Err(LengthError { slice, found, components, points, group: 1 });
    assert_eq!(call(4, 20), wrong("positions", 12, 3, 5));
    assert_eq!(call(5, 30), wrong("rest", 30, 10, 2));
    assert!(call(5, 20).is_ok());
}
