//! Steps and equilibria, with terms and solvers that answer nonsense.

use piola_bodies::mesh::{Anchor, tetrahedral_box};
use piola_bodies::step::{
    Equilibrium, NodeBlocks, Simulation, SparseSolver, Spring, StepReport, Term, check_term,
};
use piola_bodies::system::{Body, LinearError, LowerTriangle};

use crate::arguments::{SEEDS, check};

/// A term of hostile numbers: it returns errors, infinities and NaN, and names nodes that are missing or
/// share no element.
struct Nonsense {
    energy: Option<f64>,
    force: [f64; 3],
    nodes: [usize; 2],
    block: [[f64; 3]; 3],
    longest: f64,
}

impl Term for Nonsense {
    fn energy(&self, _: &[[f64; 3]]) -> Option<f64> {
        self.energy
    }

    fn add_gradient(&self, _: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        (0..3).for_each(|c| gradient[0][c] += self.force[c]);
    }

    fn add_second_derivatives(&self, _: &[[f64; 3]], blocks: &mut NodeBlocks) {
        blocks.add(self.nodes[0], self.nodes[1], self.block);
    }

    fn longest_step(&self, _: &[[f64; 3]], _: &[[f64; 3]]) -> f64 {
        self.longest
    }
}

/// A solver that fails, or answers with hostile numbers.
#[derive(Clone)]
struct Wrong {
    error: Option<LinearError>,
    x: f64,
}

impl SparseSolver for Wrong {
    fn solve(&mut self, _: &LowerTriangle, b: &mut [f64], _: f64) -> Result<usize, LinearError> {
        self.error.map_or(Ok(0), Err)?;
        b.fill(self.x);
        Ok(0)
    }
}

/// A step that succeeds leaves numbers behind, and one that fails the state before it.
#[test]
fn simulations() {
    let mut steps = 0;
    check(|hostile| {
        let mut mesh = tetrahedral_box([2, 1, 1], [2.0, 1.0, 1.0]).expect("a box");
        let scale = if hostile.0.once_in(4) { hostile.one_of(&[1e-100, 1e-50, 1e50, 1e100]) } else { 1.0 };
        mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        let density = hostile.about(1e3);
        let Ok(body) = Body::new(&mesh, hostile.rubber(), density) else { return };
        let nodes = body.rest().len();
        let (pins, settings) = (hostile.pins(nodes), hostile.settings());
        let Ok(mut simulation) = Simulation::new(body, &pins, settings) else { return };
        for _ in 0..4 {
            let _ = match hostile.0.below(11) {
                5 => simulation.set_accelerations(&hostile.points(&mesh.positions)),
                6 => simulation.set_forces(&hostile.points(&vec![[0.0; 3]; nodes])),
                7 => simulation.set_pins(&hostile.pins(nodes)),
                8 => {
                    let term = Nonsense {
                        energy: (!hostile.0.once_in(8)).then(|| hostile.about(0.0)),
                        force: [(); 3].map(|()| hostile.about(0.0)),
                        nodes: [(); 2].map(|()| hostile.node(nodes)),
                        block: [(); 3].map(|()| [(); 3].map(|()| hostile.about(0.0))),
                        longest: hostile.about(1.0),
                    };
                    let _ = check_term(&term, simulation.positions(), hostile.0.once_in(2));
                    simulation.set_terms(vec![std::sync::Arc::new(term)]);
                    Ok(())
                }
                9 => {
                    let error = hostile.one_of(&[
                        None,
                        Some(LinearError::NotPositive { column: usize::MAX }),
                        Some(LinearError::OutOfMemory),
                    ]);
                    simulation.set_linear_solver(Wrong { error, x: hostile.about(0.0) })
                }
                0 => simulation.set_positions(&hostile.points(&mesh.positions)),
                1 => simulation.set_velocities(&hostile.points(&mesh.positions)),
                2 => simulation.prescribe(hostile.node(nodes), hostile.point()),
                3 => simulation.set_settings(hostile.settings()),
                _ => simulation.set_springs(&[Spring {
                    anchor: Anchor {
                        nodes: mesh.tets[0]
                            .map(|node| if hostile.0.once_in(8) { hostile.node(nodes) } else { node }),
                        weights: [(); 4].map(|()| hostile.about(0.25)),
                    },
                    target: hostile.point(),
                    stiffness: hostile.about(1e3),
                }]),
            };
        }
        let state = |simulation: &Simulation| {
            [simulation.positions(), simulation.velocities(), simulation.accelerations()].concat()
        };
        let (dt, before) = (hostile.about(0.01), state(&simulation));
        let stepped = match hostile.0.below(8) {
            0 => simulation.equilibrate(),
            1 => simulation.equilibrate_here(),
            2 => simulation.advance_within(dt, hostile.about(0.1)).map(|report| report.step),
            3 => simulation.advance_within_here(dt, hostile.about(0.1)).map(|report| report.step),
            4 => simulation.step_here(dt),
            _ => simulation.step(dt),
        };
        let after = state(&simulation);
        match stepped {
            Ok(StepReport { newton, min_det, energies, .. }) => {
                steps += 1;
                assert!(after.as_flattened().iter().all(|x| x.is_finite()), "dt = {dt:e}: {after:?}");
                let numbers = [newton.residual, newton.change, min_det, energies.elastic];
                assert!(numbers.iter().all(|x| x.is_finite()), "dt = {dt:e}: {newton:?}, {energies:?}");
            }
            Err(_) => assert_eq!(before, after),
        }
        let _ = simulation.reactions();
        if let Ok(found) = Equilibrium::of(&simulation) {
            assert!(found.residual.is_finite() && found.largest_force.is_finite(), "{found:?}");
        }
    });
    assert!(steps > SEEDS / 20, "{steps} steps succeed");
}
