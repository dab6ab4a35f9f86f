use super::*;
use crate::mesh::TetMesh;
use crate::step::testing::{distance, left_end, settings, simulation};
use crate::step::{NewtonSettings, Simulation, SimulationSettings, Spring};
use crate::system::Pins;
use crate::system::testing::{beam, neo_hookean};

/// The order conditions: Σ bj = 1, Σ bj cj = 1/2, Σ bj cj² = 1/3, Σ bi aij cj = 1/6, up to the order.
#[test]
fn coefficients_have_their_order() {
    let methods = [(Integrator::ImplicitEuler, 1), (Integrator::Sdirk2, 2), (Integrator::Sdirk3, 3)];
    for (integrator, order) in methods {
        let Method { diagonal, rows } = integrator.method();
        let rows: Vec<Vec<f64>> = rows.iter().map(|row| [row, &[diagonal][..]].concat()).collect();
        let c: Vec<f64> = rows.iter().map(|row| row.iter().sum()).collect();
        let b = &rows[rows.len() - 1];
        let sum = |f: &dyn Fn(usize) -> f64| -> f64 { (0..b.len()).map(|j| b[j] * f(j)).sum() };
        let inner = |i: usize| -> f64 { rows[i].iter().zip(&c).map(|(a, c)| a * c).sum() };
        let conditions =
            [(1, sum(&|_| 1.0) - 1.0), (2, sum(&|j| c[j]) - 0.5), (3, sum(&|j| c[j] * c[j]) - 1.0 / 3.0)];
        for (of_order, error) in conditions.into_iter().chain([(3, sum(&inner) - 1.0 / 6.0)]) {
            // The rounding of γ, times the slopes of polynomials up to the third degree.
            assert_eq!(error.abs() <= 1e-14, of_order <= order, "{integrator:?}, {of_order}: {error:e}");
        }
    }
}

/// A bar, how it is held and driven, and the rate of its damping.
struct Motion {
    is_held: bool,
    is_driven: bool,
    damping: f64,
}

const DURATION: f64 = 0.08;

impl Motion {
    /// Positions after [`DURATION`]. The bar is stretched and sheared by its velocities at the start.
    fn end(&self, integrator: Integrator, steps: usize) -> Vec<[f64; 3]> {
        let mesh = beam(3);
        let mut simulation = bar(&mesh, self.is_held, accurate(integrator).with_damping(self.damping));
        let velocities: Vec<[f64; 3]> =
            mesh.positions.iter().map(|&[x, y, _]| [2.0 * x, 1.0 * x * x - 0.3 * y * x, 0.5 * x]).collect();
        simulation.set_velocities(&velocities).expect("finite");
        let dt = DURATION / steps as f64;
        for step in 1..=steps {
            if self.is_driven {
                let t = step as f64 * dt;
                for node in simulation.pinned().to_vec() {
                    let [x, y, z] = mesh.positions[node];
                    simulation.prescribe(node, [x + 2.0 * t * t, y + 5.0 * t.powi(3), z]).expect("pinned");
                }
            }
            simulation.step(dt).expect("a smooth motion");
        }
        simulation.positions().to_vec()
    }

    /// The exponent of the error as these steps are halved.
    fn order(&self, integrator: Integrator, steps: usize, exact: &[[f64; 3]]) -> f64 {
        let [coarse, fine] = [steps, 2 * steps].map(|steps| distance(&self.end(integrator, steps), exact));
        (coarse / fine).log2()
    }
}

fn accurate(integrator: Integrator) -> SimulationSettings {
    settings(NewtonSettings::default().with_tolerance(1e-12)).with_integrator(integrator)
}

fn bar(mesh: &TetMesh, is_held: bool, settings: SimulationSettings) -> Simulation {
    let pins = if is_held { left_end(mesh) } else { Pins::none() };
    simulation(mesh, neo_hookean(), &pins, settings)
}

#[test]
fn errors_of_smooth_motions_fall_with_the_order() {
    for (is_held, damping) in [(false, 0.0), (true, 0.0), (true, 3.0)] {
        let motion = Motion { is_held, is_driven: false, damping };
        let exact = motion.end(Integrator::Sdirk3, 640);
        for (integrator, steps, order, slack) in [
            (Integrator::ImplicitEuler, 80, 1.0, 0.1),
            (Integrator::Sdirk2, 40, 2.0, 0.1),
            (Integrator::Sdirk3, 40, 3.0, 0.15),
        ] {
            let found = motion.order(integrator, steps, &exact);
            assert!((found - order).abs() <= slack, "{integrator:?}, {is_held}, {damping}: {found}");
        }
    }
}

/// Pinned nodes move evenly through each step, which is of second order.
#[test]
fn driven_pins_leave_second_order() {
    let motion = Motion { is_held: true, is_driven: true, damping: 0.0 };
    let exact = motion.end(Integrator::Sdirk3, 1280);
    for integrator in [Integrator::Sdirk2, Integrator::Sdirk3] {
        let order = motion.order(integrator, 40, &exact);
        assert!(order > 1.9, "{integrator:?}: {order}");
    }
}

/// A target that is moved between steps moves evenly through the next one, so that pulls are of second order
/// too.
#[test]
fn moving_targets_of_springs_leave_second_order() {
    let mesh = beam(3);
    let tip = mesh.positions.len() - 1;
    let end = |integrator, steps: usize| {
        let mut simulation = bar(&mesh, true, accurate(integrator));
        let at = |t: f64| {
            let [x, y, z] = mesh.positions[tip];
            [Spring::on_node(tip, [x + t, y + 8.0 * t * t, z], 2000.0)]
        };
        simulation.set_springs(&at(0.0)).expect("a node");
        for step in 1..=steps {
            let dt = DURATION / steps as f64;
            simulation.set_springs(&at(step as f64 * dt)).expect("a node");
            simulation.step(dt).expect("a pull");
        }
        simulation.positions().to_vec()
    };
    let exact = end(Integrator::Sdirk3, 1280);
    for integrator in [Integrator::Sdirk2, Integrator::Sdirk3] {
        let [coarse, fine] = [40, 80].map(|steps| distance(&end(integrator, steps), &exact));
        assert!((coarse / fine).log2() > 1.9, "{integrator:?}: {coarse:e}, {fine:e}");
    }
}
