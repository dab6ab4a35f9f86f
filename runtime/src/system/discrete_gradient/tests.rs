use super::*;
use crate::random::Random;
use crate::system::testing::{KIRCHHOFF, NEO_HOOKEAN, beam, shake};

/// A beam, a strongly deformed state, and a displacement by a turn of this angle and a random motion.
fn motion(body: &Body, seed: u64, angle: f64, amplitude: f64) -> [Vec<[f64; 3]>; 2] {
    let mut random = Random::new(seed);
    let stretched: Vec<[f64; 3]> = body.rest().iter().map(|&[x, y, z]| [1.5 * x, 0.8 * y, 0.7 * z]).collect();
    let before = shake(&mut random, &stretched, 0.01);
    let (sin, cos) = angle.sin_cos();
    let turned: Vec<[f64; 3]> =
        before.iter().map(|&[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]).collect();
    let after = shake(&mut random, &turned, amplitude);
    let displacement = before.iter().zip(&after).map(|(a, b)| std::array::from_fn(|c| b[c] - a[c])).collect();
    [before, displacement]
}

fn energy(body: &Body, positions: &[[f64; 3]]) -> f64 {
    let mut response = crate::system::ElasticResponse::new(body);
    response.energy(body, positions).expect("lengths").0
}

fn gradient_of(discrete: &DiscreteGradient, body: &Body) -> Vec<[f64; 3]> {
    let mut gradient = vec![[0.0; 3]; body.rest().len()];
    discrete.add_gradient(body, &mut gradient).expect("lengths");
    gradient
}

/// Work equals the change of energy, and forces and torques add up to zero, for any displacement.
#[test]
fn energy_and_momenta_are_kept() {
    let bodies = [Body::new(&beam(3), NEO_HOOKEAN, 1000.0), Body::new(&beam(3), KIRCHHOFF, 1000.0)];
    for body in bodies.map(|body| body.expect("a body")) {
        for (seed, (angle, amplitude)) in
            [(0.0, 1e-7), (0.0, 1e-4), (0.4, 0.01), (1.5, 0.02)].into_iter().enumerate()
        {
            let [before, displacement] = motion(&body, seed as u64, angle, amplitude);
            let mut discrete = DiscreteGradient::new(&body);
            discrete.begin(&body, &before).expect("upright");
            discrete.evaluate(&body, &displacement).expect("upright");
            let gradient = gradient_of(&discrete, &body);
            let after: Vec<[f64; 3]> =
                before.iter().zip(&displacement).map(|(x, d)| std::array::from_fn(|c| x[c] + d[c])).collect();
            let work: f64 = gradient.iter().zip(&displacement).map(|(g, d)| dot(*g, *d)).sum();
            let (start, end) = (energy(&body, &before), energy(&body, &after));
            assert!((work - (end - start)).abs() <= 1e-13 * start, "{work:e} for {:e}", end - start);
            let size: f64 = gradient.iter().flatten().map(|g| g.abs()).sum();
            let mut torque = [0.0; 3];
            for node in 0..before.len() {
                let x: [f64; 3] = std::array::from_fn(|c| before[node][c] + 0.5 * displacement[node][c]);
                for c in 0..3 {
                    let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                    torque[c] += x[a] * gradient[node][b] - x[b] * gradient[node][a];
                }
            }
            assert!(torque.iter().all(|t| t.abs() <= 1e-15 * size), "{torque:?} beside {size}");
        }
    }
}

/// The stress has all its digits also where the states are close.
#[test]
fn it_tends_to_the_gradient_with_the_displacement() {
    let body = Body::new(&beam(3), NEO_HOOKEAN, 1000.0).expect("a body");
    for amplitude in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        let [before, displacement] = motion(&body, 5, 0.0, amplitude);
        let mut discrete = DiscreteGradient::new(&body);
        discrete.begin(&body, &before).expect("upright");
        discrete.evaluate(&body, &displacement).expect("upright");
        let middle: Vec<[f64; 3]> = before
            .iter()
            .zip(&displacement)
            .map(|(x, d)| std::array::from_fn(|c| x[c] + 0.5 * d[c]))
            .collect();
        let mut expected = vec![[0.0; 3]; before.len()];
        crate::system::ElasticResponse::new(&body).gradient(&body, &middle, &mut expected).expect("lengths");
        let size = expected.iter().flatten().fold(0.0_f64, |size, g| size.max(g.abs()));
        let bound = (1e4 * amplitude * amplitude + 1e-13) * size;
        for (found, expected) in gradient_of(&discrete, &body).iter().zip(&expected) {
            for c in 0..3 {
                assert!((found[c] - expected[c]).abs() <= bound, "{amplitude:e}: {found:?} for {expected:?}");
            }
        }
    }
}

/// By central differences, with and without a difference of energies to make up for.
#[test]
fn the_tangent_is_the_derivative() {
    let body = Body::new(&beam(2), NEO_HOOKEAN, 1000.0).expect("a body");
    for (angle, amplitude, is_corrected) in [(0.3, 0.01, true), (0.0, 1e-5, false)] {
        let [before, displacement] = motion(&body, 7, angle, amplitude);
        let mut discrete = DiscreteGradient::new(&body);
        discrete.begin(&body, &before).expect("upright");
        discrete.evaluate(&body, &displacement).expect("upright");
        assert_eq!(discrete.elements.iter().any(|mean| mean.correction.is_some()), is_corrected);
        discrete.linearise(&body).expect("finite");
        let nodes = before.len();
        let mut tangent = vec![vec![0.0; 3 * nodes]; 3 * nodes];
        for (element, entries) in body.elements().iter().zip(discrete.tangents(&body)) {
            for (row, entries) in entries.iter().enumerate() {
                for (column, entry) in entries.iter().enumerate() {
                    let place = |k: usize| 3 * element.nodes[k / 3] + k % 3;
                    tangent[place(row)][place(column)] += entry;
                }
            }
        }
        let size = tangent.iter().flatten().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        let h = 1e-7;
        for column in 0..3 * nodes {
            let mut at = |step: f64| {
                let mut moved = displacement.clone();
                moved[column / 3][column % 3] += step;
                discrete.evaluate(&body, &moved).expect("upright");
                gradient_of(&discrete, &body)
            };
            let (ahead, behind) = (at(h), at(-h));
            for row in 0..3 * nodes {
                let slope = (ahead[row / 3][row % 3] - behind[row / 3][row % 3]) / (2.0 * h);
                let found = tangent[row][column];
                assert!((found - slope).abs() <= 1e-6 * size, "{found:e} for {slope:e} of {size:e}");
            }
        }
    }
}

#[test]
fn inverted_elements_are_named() {
    let body = Body::new(&beam(1), KIRCHHOFF, 1000.0).expect("a body");
    let mut discrete = DiscreteGradient::new(&body);
    let mirrored: Vec<[f64; 3]> = body.rest().iter().map(|&[x, y, z]| [-x, y, z]).collect();
    assert!(discrete.begin(&body, &mirrored).is_err());
    discrete.begin(&body, body.rest()).expect("upright");
    let over: Vec<[f64; 3]> = body.rest().iter().map(|&[x, ..]| [-2.0 * x, 0.0, 0.0]).collect();
    assert!(discrete.evaluate(&body, &over).is_err());
}
