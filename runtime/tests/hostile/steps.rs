//! Steps and equilibria, with terms, solvers and equations that answer nonsense.

use piola::mesh::{Anchor, tetrahedral_box};
use piola::step::{
    Equilibrium, NewtonError, NodeBlocks, Simulation, SimulationSettings, SparseSolver, Spring, StepEquation,
    StepStart, Term, solve_step,
};
use piola::system::{Body, LinearError, LowerTriangle};

use crate::arguments::{Hostile, SEEDS, check};

/// A term of hostile numbers: it refuses, it is not finite, it names nodes that are missing or share no
/// element.
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
    fn solve(&mut self, _: LowerTriangle<'_>, b: &mut [f64], _: f64) -> Result<usize, LinearError> {
        self.error.map_or(Ok(0), Err)?;
        b.fill(self.x);
        Ok(0)
    }
}

/// An equation that answers with hostile numbers.
struct Nowhere<'a>(&'a mut Hostile);

impl Nowhere<'_> {
    fn number(&mut self, good: f64) -> Result<f64, NewtonError> {
        if self.0.0.once_in(8) { Err(NewtonError::NotFinite) } else { Ok(self.0.about(good)) }
    }
}

impl StepEquation for Nowhere<'_> {
    type Jacobian = ();
    type Error = NewtonError;

    fn start(&mut self, share: f64, start: StepStart) -> Result<f64, NewtonError> {
        let [before, ahead, kept] = [(); 3].map(|()| self.0.point());
        let _ = start.position(share, before, ahead, kept);
        self.number(1.0)
    }

    fn linearise(&mut self) -> Result<(), NewtonError> {
        self.number(0.0).map(|_| ())
    }

    fn correct(&mut self, (): &()) -> Result<f64, NewtonError> {
        self.number(0.5)
    }

    fn take_direction(&mut self) -> f64 {
        self.0.about(1.0)
    }

    fn try_step(&mut self, _: f64) -> Result<Option<f64>, NewtonError> {
        let refuses = self.0.0.once_in(8);
        self.number(0.5).map(|residual| (!refuses).then_some(residual))
    }

    fn accept(&mut self) {}

    fn keep_solution(&mut self) {}
}

#[test]
fn equations() {
    let mut solved = 0;
    check(|hostile| {
        let SimulationSettings { newton, line_search, .. } = hostile.settings();
        if let Ok(report) = solve_step(&mut Nowhere(hostile), &newton, &line_search) {
            assert!(report.residual.is_finite(), "{report:?}");
            solved += 1;
        }
    });
    assert!(solved > 0, "no equation counts as solved");
}

/// A step that succeeds leaves numbers behind.
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
            let _ = match hostile.0.below(12) {
                5 => simulation.set_accelerations(&hostile.points(&mesh.positions)),
                6 => simulation.set_forces(&hostile.points(&vec![[0.0; 3]; nodes])),
                7 => simulation.set_pins(&hostile.pins(nodes)),
                8 => {
                    let _ = simulation.set_material(hostile.node(1), hostile.rubber());
                    Ok(())
                }
                9 => {
                    simulation.set_terms(vec![std::sync::Arc::new(Nonsense {
                        energy: (!hostile.0.once_in(8)).then(|| hostile.about(0.0)),
                        force: [(); 3].map(|()| hostile.about(0.0)),
                        nodes: [(); 2].map(|()| hostile.node(nodes)),
                        block: [(); 3].map(|()| [(); 3].map(|()| hostile.about(0.0))),
                        longest: hostile.about(1.0),
                    })]);
                    Ok(())
                }
                10 => {
                    let error = hostile.one_of(&[
                        None,
                        Some(LinearError::NotPositive { column: usize::MAX }),
                        Some(LinearError::NotFactored),
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
        let dt = hostile.about(0.01);
        let stepped = match hostile.0.below(6) {
            0 | 1 => simulation.equilibrate(),
            2 => simulation.advance_within(dt, hostile.about(0.1)).map(|report| report.step),
            _ => simulation.step(dt),
        };
        if stepped.is_ok() {
            steps += 1;
            let state = [simulation.positions(), simulation.velocities(), simulation.accelerations()];
            assert!(state.concat().as_flattened().iter().all(|x| x.is_finite()), "dt = {dt:e}: {state:?}");
        }
        let _ = simulation.reactions();
        if let Ok(Equilibrium { smallest_eigenvalue: Some(eigenvalue), .. }) = Equilibrium::of(&simulation) {
            assert!(eigenvalue.value.is_finite() && eigenvalue.error.is_finite(), "{eigenvalue:?}");
        }
    });
    assert!(steps > SEEDS / 20, "{steps} steps succeed");
}
