//! Sums over the quadrature points of elements with any number of nodes.

use piola::__private::random::Random;
use piola::batch::{Batch, Kernels, LengthError, Quadrature};
use piola::lanes::Backend;

use crate::hand_written::SaintVenantKirchhoff;

/// Sums of elements with random slopes agree with the formulas, regardless of the neighbouring elements.
fn check<E: Kernels>(nodes: usize, points: usize) {
    const ELEMENTS: usize = 3;
    let mut random = Random::new(31);
    let mut numbers =
        |count: usize| -> Vec<E> { (0..count).map(|_| E::splat(random.uniform(-1.0, 1.0))).collect() };
    let positions = numbers(3 * nodes * ELEMENTS);
    let slopes = numbers(3 * nodes * points * ELEMENTS);
    let volumes = numbers(points * ELEMENTS);
    let zeros = |count: usize| vec![E::splat(0.0); count];
    let wide = |x: E| -> f64 { x.into() };
    let (mut F, mut P) = (zeros(9 * points * ELEMENTS), zeros(9 * points * ELEMENTS));
    let mut dP_dF = zeros(81 * points * ELEMENTS);
    for backend in Backend::available() {
        let mut elements = Quadrature::new(nodes, points).with_backend(backend);
        elements.deform(&positions, &slopes, &mut F).expect("lengths fit");
        Batch::new(&SaintVenantKirchhoff).tangents(&F, &mut P, &mut dP_dF).expect("lengths fit");
        let mut gradients = zeros(3 * nodes * ELEMENTS);
        let mut stiffnesses = zeros(9 * nodes * nodes * ELEMENTS);
        elements.gradients(&slopes, &volumes, &P, &mut gradients).expect("lengths fit");
        elements.stiffnesses(&slopes, &volumes, &dP_dF, &mut stiffnesses).expect("lengths fit");

        // Terms are products of at most four numbers, each rounded, and so are their sums.
        let close = |found: E, terms: &mut dyn Iterator<Item = f64>| {
            let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
            let tolerance = 30.0 * E::UNIT_ROUNDOFF * size;
            assert!((wide(found) - sum).abs() <= tolerance, "{} for {sum}", wide(found));
        };
        let slope = |point: usize, n: usize, b: usize| wide(slopes[3 * (nodes * point + n) + b]);
        for (k, &found) in F.iter().enumerate() {
            let (point, a, b) = (k / 9, k / 3 % 3, k % 3);
            let x = |n: usize| wide(positions[3 * (nodes * (point / points) + n) + a]);
            close(found, &mut (0..nodes).map(|n| x(n) * slope(point, n, b)));
        }
        for element in 0..ELEMENTS {
            let points = element * points..(element + 1) * points;
            for row in 0..3 * nodes {
                let (m, a) = (row / 3, row % 3);
                let terms = points.clone().flat_map(|p| (0..3).map(move |b| (p, b)));
                let term =
                    |(p, b): (usize, usize)| wide(volumes[p]) * wide(P[9 * p + 3 * a + b]) * slope(p, m, b);
                close(gradients[3 * nodes * element + row], &mut terms.map(term));
                for column in 0..3 * nodes {
                    let (n, c) = (column / 3, column % 3);
                    let entry = |row: usize, column: usize| {
                        stiffnesses[3 * nodes * (3 * nodes * element + row) + column]
                    };
                    let terms = points.clone().flat_map(|p| (0..9).map(move |bd| (p, bd / 3, bd % 3)));
                    let term = |(p, b, d): (usize, usize, usize)| {
                        let slopes = slope(p, m, b) * slope(p, n, d);
                        wide(volumes[p]) * wide(dP_dF[81 * p + 9 * (3 * a + b) + 3 * c + d]) * slopes
                    };
                    close(entry(row, column), &mut terms.map(term));
                    assert!(entry(row, column) == entry(column, row));
                }
            }
        }
    }
}

#[test]
fn sums_are_those_of_the_formulas() {
    // Numbers of nodes below, at and above those of a register.
    for (nodes, points) in [(4, 1), (8, 8), (10, 4), (27, 2)] {
        check::<f64>(nodes, points);
        #[cfg(feature = "f32")]
        check::<f32>(nodes, points);
    }
}

#[test]
fn lengths_that_do_not_fit_are_errors() {
    let mut hexahedra = Quadrature::<f64>::new(8, 2);
    let wrong =
        |slice, found, components, points| Err(LengthError { slice, found, components, points, group: 1 });
    assert_eq!(hexahedra.deform(&[0.0; 25], &[], &mut []), wrong("positions", 25, 24, 1));
    assert_eq!(hexahedra.deform(&[0.0; 24], &[0.0; 24], &mut []), wrong("slopes", 24, 24, 2));
    assert_eq!(hexahedra.deform(&[0.0; 24], &[0.0; 48], &mut [0.0; 9]), wrong("F", 9, 9, 2));
    assert_eq!(hexahedra.gradients(&[], &[0.0; 3], &[], &mut []), wrong("volumes", 3, 2, 1));
    let stiffnesses = hexahedra.stiffnesses(&[0.0; 48], &[0.0; 2], &[0.0; 162], &mut [0.0; 575]);
    assert_eq!(stiffnesses, wrong("stiffnesses", 575, 576, 1));
    // Nothing is an answer, too.
    for (nodes, points) in [(0, 0), (0, 1), (8, 0), (usize::MAX, usize::MAX)] {
        let mut none = Quadrature::<f64>::new(nodes, points);
        assert_eq!(none.deform(&[], &[], &mut []), Ok(()));
        assert_eq!(none.stiffnesses(&[], &[], &[], &mut []), Ok(()));
    }
}
