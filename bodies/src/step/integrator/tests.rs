use super::*;
use crate::step::testing::{distance, left_end, simulation};
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

/// Function that prescribes places of a body at a time, given the positions at rest.
type Drive = fn(&mut Simulation, &[[f64; 3]], f64);

/// A bar, how it is held and driven, the scale of its velocities at the start, and the rate of its damping.
struct Motion {
    is_held: bool,
    drive: Drive,
    speed: f64,
    damping: f64,
}

const DURATION: f64 = 0.08;

impl Motion {
    /// Positions after [`DURATION`]. The velocities at the start stretch and shear the bar.
    fn end(&self, integrator: Integrator, steps: usize) -> Vec<[f64; 3]> {
        let mesh = beam(3);
        let newton = NewtonSettings { tolerance: 1e-12, ..Default::default() };
        let settings = SimulationSettings { integrator, damping: self.damping, newton, ..Default::default() };
        let pins = if self.is_held { left_end(&mesh) } else { Pins::none() };
        let mut simulation = simulation(&mesh, neo_hookean(), &pins, settings);
        let velocity = |&[x, y, _]: &[f64; 3]| {
            [2.0 * x, 1.0 * x * x - 0.3 * y * x, 0.5 * x].map(|velocity| self.speed * velocity)
        };
        let velocities: Vec<_> = mesh.positions.iter().map(velocity).collect();
        simulation.set_velocities(&velocities).expect("finite");
        let dt = DURATION / steps as f64;
        (self.drive)(&mut simulation, &mesh.positions, 0.0);
        for step in 1..=steps {
            (self.drive)(&mut simulation, &mesh.positions, step as f64 * dt);
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

fn drive_pins(simulation: &mut Simulation, rest: &[[f64; 3]], t: f64) {
    for node in simulation.pinned().to_vec() {
        let [x, y, z] = rest[node];
        simulation.prescribe(node, [x + 2.0 * t * t, y + 5.0 * t.powi(3), z]).expect("pinned");
    }
}

fn pull_tip(simulation: &mut Simulation, rest: &[[f64; 3]], t: f64) {
    let (tip, [x, y, z]) = (rest.len() - 1, rest[rest.len() - 1]);
    let spring = Spring::on_node(tip, [x + t, y + 8.0 * t * t, z], 2000.0);
    simulation.set_springs(&[spring]).expect("a node");
}

#[test]
fn errors_of_smooth_motions_fall_with_the_order() {
    for (is_held, damping) in [(false, 0.0), (true, 0.0), (true, 3.0)] {
        let motion = Motion { is_held, drive: |_, _, _| (), speed: 1.0, damping };
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

/// Pinned nodes and targets of springs that are moved between steps move evenly through the next one, which
/// is of second order.
#[test]
fn driven_pins_and_moving_targets_leave_second_order() {
    for (drive, speed) in [(drive_pins as Drive, 1.0), (pull_tip, 0.0)] {
        let motion = Motion { is_held: true, drive, speed, damping: 0.0 };
        let exact = motion.end(Integrator::Sdirk3, 1280);
        for integrator in [Integrator::Sdirk2, Integrator::Sdirk3] {
            let order = motion.order(integrator, 40, &exact);
            assert!(order > 1.9, "{integrator:?}, speed {speed}: {order}");
        }
    }
}
