//! Terms alone and in a simulation.

use std::sync::Arc;

use piola::__private::random::Random;
use piola::NoSuchNode;

use super::*;
use crate::mesh::{Anchor, TetMesh};
use crate::step::testing::{distance, falling, simulation, solved_by, solvers};
use crate::step::{LinearSolver, NewtonError, NewtonSettings, Simulation, StepError};
use crate::system::Pins;
use crate::system::testing::{beam, neo_hookean, shake};

/// A repulsion −k log(|xa − xb| − d) of two nodes, which must not come nearer than d.
struct Barrier {
    nodes: [usize; 2],
    distance: f64,
    stiffness: f64,
    /// Factors of the gradient and of the second derivatives, 1 if they are right.
    factors: [f64; 2],
}

impl Barrier {
    /// The gap, and the unit vector from the second node to the first.
    fn gap(&self, x: &[[f64; 3]]) -> (f64, [f64; 3]) {
        let [a, b] = self.nodes;
        let d: [f64; 3] = std::array::from_fn(|c| x[a][c] - x[b][c]);
        let length = d.iter().map(|d| d * d).sum::<f64>().sqrt();
        (length - self.distance, d.map(|d| d / length))
    }
}

impl Term for Barrier {
    fn energy(&self, x: &[[f64; 3]]) -> Option<f64> {
        let (gap, _) = self.gap(x);
        (gap > 0.0).then(|| -self.stiffness * gap.ln())
    }

    fn add_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        let (gap, n) = self.gap(x);
        let force = self.factors[0] * self.stiffness / gap;
        for c in 0..3 {
            gradient[self.nodes[0]][c] -= force * n[c];
            gradient[self.nodes[1]][c] += force * n[c];
        }
    }

    /// The part along the line of the nodes, which is all that is positive.
    fn add_second_derivatives(&self, x: &[[f64; 3]], blocks: &mut NodeBlocks) {
        let (gap, n) = self.gap(x);
        let k = self.factors[1] * self.stiffness / (gap * gap);
        let block = |sign: f64| n.map(|row| n.map(|column| sign * k * row * column));
        let [a, b] = self.nodes;
        blocks.add(a, a, block(1.0));
        blocks.add(b, b, block(1.0));
        blocks.add(a, b, block(-1.0));
    }

    fn longest_step(&self, x: &[[f64; 3]], d: &[[f64; 3]]) -> f64 {
        let [a, b] = self.nodes;
        let approach = (0..3).map(|c| (d[a][c] - d[b][c]).powi(2)).sum::<f64>().sqrt();
        0.9 * self.gap(x).0 / approach
    }
}

/// Springs of random anchors, one of which names a node twice.
fn springs(random: &mut Random) -> Vec<Spring> {
    let mut spring = |nodes: [usize; 4]| Spring {
        anchor: Anchor { nodes, weights: [0; 4].map(|_| random.uniform(-1.0, 1.0)) },
        target: [0; 3].map(|_| random.uniform(-1.0, 1.0)),
        stiffness: random.uniform(1.0, 2.0),
    };
    vec![spring([0, 1, 2, 3]), spring([4, 1, 4, 4]), spring([3, 0, 4, 1])]
}

/// Energies, gradients and second derivatives of springs are quadratic, so that differences are exact up to
/// rounding.
#[test]
fn derivatives_of_springs_are_those_of_their_energy() {
    let mut random = Random::new(7);
    let springs = springs(&mut random);
    let [x, y] = [(); 2].map(|()| shake(&mut random, &[[0.0; 3]; 5], 1.0));
    let d: Vec<[f64; 3]> = (0..5).map(|n| std::array::from_fn(|c| y[n][c] - x[n][c])).collect();
    let mut slopes = [vec![[0.0; 3]; 5], vec![[0.0; 3]; 5]];
    springs.add_gradient(&x, &mut slopes[0]);
    springs.add_gradient(&y, &mut slopes[1]);
    let along =
        |g: &[[f64; 3]]| -> f64 { g.as_flattened().iter().zip(d.as_flattened()).map(|(g, d)| g * d).sum() };
    let exact = 0.5 * (along(&slopes[0]) + along(&slopes[1]));
    let change = springs.change(&x, &y).expect("everywhere");
    let difference = springs.energy(&y).expect("everywhere") - springs.energy(&x).expect("everywhere");
    assert!((change.difference - exact).abs() <= 1e-13 && (difference - exact).abs() <= 1e-13);
    assert!(change.noise > 0.0 && change.noise <= 1e-13);

    check_term(&springs, &x, false).expect("second derivatives, to rounding too");
}

#[test]
fn derivatives_are_compared_with_differences() {
    let positions = [[0.0, -0.02, 0.1], [0.3, 0.2, 0.1]];
    let check = |distance: f64, factors: [f64; 2], is_filtered: bool| {
        let barrier = Barrier { nodes: [0, 1], distance, stiffness: 1.0, factors };
        check_term(&barrier, &positions, is_filtered)
    };
    assert_eq!(check(0.2, [1.0; 2], true), Ok(()));
    for (factors, is_filtered, expected) in [
        ([-1.0, 1.0], true, "the gradient at node 0 (from 0) along x is -4.6"),
        ([1.001, 1.0], true, "the gradient at node 0 (from 0) along x is 4.6"),
        ([f64::NAN, 1.0], true, "the gradient at node 0 (from 0) along x is NaN"),
        ([1.0, -1.0], true, "the second derivatives K give"),
        ([1.0, f64::NAN], true, "the second derivatives K give"),
        // Without negative eigenvalues they are not exact.
        ([1.0, 1.0], false, "the second derivatives K give"),
    ] {
        let message = check(0.2, factors, is_filtered).expect_err(expected).to_string();
        assert!(message.starts_with(expected), "{message}");
    }
    assert_eq!(check(9.0, [1.0; 2], true), check_term(&Vec::<Spring>::new(), &positions, true));
    assert!(check(9.0, [1.0; 2], true).is_err());
}

#[test]
fn a_gradient_that_does_not_fit_its_energy_is_named_and_not_taken_for_rounding() {
    let mesh = beam(2);
    for linear in solvers(1e-3) {
        for newton in [NewtonSettings::default(), NewtonSettings::single()] {
            let settings = falling(NewtonSettings { linear, ..newton });
            let mut body = simulation(&mesh, neo_hookean(), &Pins::none(), settings);
            let barrier = |stiffness: f64, factors: [f64; 2]| -> Arc<dyn Term> {
                Arc::new(Barrier { nodes: [0, 11], distance: 0.22, stiffness, factors })
            };
            body.set_terms(vec![barrier(1e-3, [1.0; 2]), barrier(1.0, [-1.0, 1.0])]);
            let error = body.step(0.01).expect_err("no step decreases the energy");
            assert_eq!(error, StepError::Newton(NewtonError::WrongGradient { term: Some(1) }));
            assert_eq!(body.positions(), mesh.positions);
            body.set_terms(vec![barrier(1e-3, [1.0; 2])]);
            body.step(0.01).expect("a step");
        }
    }
}

#[test]
fn blocks_of_missing_nodes_are_noted_and_left_out() {
    let mut blocks = NodeBlocks::default();
    blocks.begin(2);
    blocks.add(1, 0, [[1.0; 3]; 3]);
    blocks.add(0, 2, [[1.0; 3]; 3]);
    assert_eq!((blocks.missing(), blocks.pairs().collect::<Vec<_>>()), (Some(2), vec![[1, 0]]));
    blocks.begin(2);
    assert_eq!((blocks.missing(), blocks.pairs().next()), (None, None));
}

fn bar(mesh: &TetMesh, pins: &Pins, linear: LinearSolver) -> Simulation {
    simulation(mesh, neo_hookean(), pins, falling(NewtonSettings { tolerance: 1e-10, ..solved_by(linear) }))
}

/// Both ends of a bar are driven at each other; all solvers take the blocks of nodes that share no element.
#[test]
fn a_barrier_between_distant_nodes_is_never_crossed() {
    let mesh = beam(4);
    let [a, b] = [0, mesh.positions.len() - 1];
    let gap = |x: &[[f64; 3]]| (0..3).map(|c| (x[a][c] - x[b][c]).powi(2)).sum::<f64>().sqrt();
    let ends = solvers(1e-10).map(|linear| {
        let mut simulation = bar(&mesh, &Pins::none(), linear);
        let distance = 0.9 * gap(&mesh.positions);
        let barrier = Barrier { nodes: [a, b], distance, stiffness: 1e-3, factors: [1.0; 2] };
        simulation.set_terms(vec![Arc::new(barrier)]);
        let mut velocities = vec![[0.0; 3]; mesh.positions.len()];
        for (v, x) in velocities.iter_mut().zip(&mesh.positions) {
            *v = x.map(|x| -4.0 * x);
        }
        simulation.set_velocities(&velocities).expect("finite");
        let mut nearest = f64::INFINITY;
        for _ in 0..30 {
            let report = simulation.step(2e-3).expect("a step");
            assert!(report.energies.terms.is_finite());
            nearest = nearest.min(gap(simulation.positions()));
        }
        assert!(nearest > distance && nearest < 1.02 * distance, "{nearest} of {distance}");
        simulation.positions().to_vec()
    });
    assert!(distance(&ends[1], &ends[0]) <= 1e-9);
}

#[test]
fn terms_that_refuse_a_state_or_name_no_node_fail_the_step_and_change_nothing() {
    let mesh = beam(2);
    let mut simulation = bar(&mesh, &Pins::none(), LinearSolver::Cholesky);
    let error = |simulation: &mut Simulation, term: Arc<dyn Term>| {
        let before = simulation.positions().to_vec();
        simulation.set_terms(vec![term]);
        let error = simulation.step(1e-3).expect_err("no such step");
        assert_eq!(simulation.positions(), before);
        error
    };
    let refuses = Barrier { nodes: [0, 1], distance: 100.0, stiffness: 1.0, factors: [1.0; 2] };
    assert_eq!(error(&mut simulation, Arc::new(refuses)), NewtonError::TermRefuses { term: 0 }.into());

    /// A term of a node that a body of twelve does not have.
    struct Lost;
    impl Term for Lost {
        fn energy(&self, _: &[[f64; 3]]) -> Option<f64> {
            Some(0.0)
        }
        fn add_gradient(&self, _: &[[f64; 3]], _: &mut [[f64; 3]]) {}
        fn add_second_derivatives(&self, _: &[[f64; 3]], blocks: &mut NodeBlocks) {
            blocks.add(3, 12, [[0.0; 3]; 3]);
        }
    }
    let lost = error(&mut simulation, Arc::new(Lost));
    assert_eq!(
        lost,
        StepError::Newton(NewtonError::NoSuchNode(NoSuchNode { element: None, node: 12, nodes: 12 }))
    );
    simulation.set_terms(Vec::new());
    simulation.step(1e-3).expect("a free fall");
}

/// Forces, pins and the reactions at them, in statics and while the pinned end is shaken.
#[test]
fn reactions_balance_all_other_forces() {
    let mesh = beam(3);
    let pins = Pins::at([0, 1, 2, 3]);
    for linear in solvers(1e-10) {
        let mut simulation = bar(&mesh, &pins, linear);
        let mut forces = vec![[0.0; 3]; mesh.positions.len()];
        forces[14] = [3.0, 1.0, -2.0];
        simulation.set_forces(&forces).expect("finite");
        simulation.equilibrate().expect("a hanging bar");
        let mass: f64 = simulation.body().masses().iter().sum();
        let sum = |reactions: &[[f64; 3]]| -> [f64; 3] {
            std::array::from_fn(|c| reactions.iter().map(|r| r[c]).sum())
        };
        let held = sum(&simulation.reactions().expect("admissible"));
        for (held, expected) in held.into_iter().zip([-3.0, 9.81 * mass - 1.0, 2.0]) {
            assert!((held - expected).abs() <= 1e-6, "{held} for {expected}");
        }

        for step in 1..=5 {
            for &node in pins.nodes() {
                let [x, y, z] = mesh.positions[node];
                simulation.prescribe(node, [x, y + 1e-3 * f64::from(step * step), z]).expect("pinned");
            }
            simulation.step(0.01).expect("a step");
        }
        // Momentum changes by what gravity, forces and pins do.
        let masses = simulation.body().masses();
        let inertia: [f64; 3] = std::array::from_fn(|c| {
            simulation.accelerations().iter().zip(masses).map(|(a, m)| m * a[c]).sum()
        });
        let held = sum(&simulation.reactions().expect("admissible"));
        let others = [3.0, 1.0 - 9.81 * mass, -2.0];
        for c in 0..3 {
            assert!((inertia[c] - held[c] - others[c]).abs() <= 1e-5, "{linear:?}: {inertia:?}, {held:?}");
        }
    }
}

/// Pins come and go: with a pattern that fits, and with a new one.
#[test]
fn changed_pins_are_those_of_a_new_simulation() {
    let mesh = beam(4);
    let first = Pins::at([0, 1, 2, 3]);
    for linear in solvers(1e-10) {
        for then in [Pins::at([0, 1, 2, 3, 9, 17]), Pins::at([2, 17]), Pins::none()] {
            let mut changed = bar(&mesh, &first, linear);
            changed.step(0.01).expect("a step");
            let mut fresh = bar(&mesh, &then, linear);
            fresh.set_positions(changed.positions()).expect("finite");
            fresh.set_velocities(changed.velocities()).expect("finite");
            changed.set_pins(&then).expect("nodes");
            assert_eq!(changed.pinned(), then.nodes());
            for _ in 0..3 {
                changed.step(0.01).expect("a step");
                fresh.step(0.01).expect("a step");
            }
            assert!(distance(changed.positions(), fresh.positions()) <= 1e-9, "{linear:?}, {then:?}");
        }
    }
    let mut simulation = bar(&mesh, &first, LinearSolver::Cholesky);
    assert!(simulation.set_pins(&Pins::at([99])).is_err());
    assert_eq!(simulation.pinned(), first.nodes());
}
