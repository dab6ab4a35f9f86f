use piola::lanes::{Mask, Real};
use piola::material::{Blocks, Material};

use super::*;
use crate::hand_written::RotatedLinear;
use crate::step::StepError;
use crate::step::testing::{distance, held, settings};
use crate::system::testing::{beam, neo_hookean};

/// A beam of which one end is held and the rest is scaled along x and thrown aside: its report and positions
/// after a step.
fn stepped(filtering: Filtering, scale: f64, max_iterations: usize) -> (NewtonReport, Vec<[f64; 3]>) {
    let mesh = beam(6);
    let newton = NewtonSettings { filtering, max_iterations, tolerance: 1e-9, ..NewtonSettings::default() };
    let mut simulation = held(&mesh, neo_hookean(), settings(newton));
    let bent: Vec<_> =
        mesh.positions.iter().map(|&[x, y, z]| [scale * x, y + 0.3 * scale * x * x, z]).collect();
    simulation.set_positions(&bent).expect("finite");
    let report = simulation.step(0.05).expect("a step").newton;
    (report, simulation.positions().to_vec())
}

#[test]
fn where_the_matrix_is_definite_no_filter_is_asked_for() {
    let (report, positions) = stepped(Filtering::OnDemand, 1.02, 50);
    assert_eq!((report, positions), stepped(Filtering::Always(Filter::None), 1.02, 50));
}

#[test]
fn where_it_is_not_the_clamp_is_taken_and_not_a_shift() {
    let (none, _) = stepped(Filtering::Always(Filter::None), 0.3, 1);
    assert!(none.shift > 0.0, "the case is indefinite: {none:?}");
    let (report, positions) = stepped(Filtering::OnDemand, 0.3, 1);
    let (clamped, expected) = stepped(Filtering::Always(Filter::Clamp), 0.3, 1);
    assert_eq!((report.shift, report.filtered), (0.0, clamped.filtered));
    assert_eq!(positions, expected);
}

#[test]
fn every_way_ends_in_the_same_minimum() {
    let ways = [Filtering::Always(Filter::Clamp), Filtering::Always(Filter::Absolute), Filtering::OnDemand];
    let ends = ways.map(|filtering| stepped(filtering, 0.6, 100));
    for (report, positions) in &ends {
        assert_eq!(report.convergence, Convergence::Tolerance, "{report:?}");
        assert!(report.change < 0.0);
        // The minimum is found to 10⁻⁹ of forces that moved the beam by its length.
        assert!(distance(positions, &ends[0].1) <= 1e-8);
    }
    let [clamp, _, on_demand] = ends.map(|(report, _)| report.iterations);
    assert!(on_demand < clamp, "{on_demand} iterations, {clamp} clamped");
}

/// The derivatives of an energy with the energy itself negated.
struct Negated;

impl Material for Negated {
    fn energy<R: Real>(&self, stretches: [R; 3]) -> R {
        -RotatedLinear.energy(stretches)
    }

    fn blocks<R: Real>(&self, stretches: [R; 3]) -> Blocks<R> {
        RotatedLinear.blocks(stretches)
    }

    defined_everywhere!(has_pole: true);
}

#[test]
fn a_stress_that_does_not_fit_its_energy_is_not_taken_for_rounding() {
    let mesh = beam(2);
    let mut body = held(&mesh, Negated, settings(NewtonSettings::single()));
    let stretched: Vec<_> = mesh.positions.iter().map(|&[x, y, z]| [1.1 * x, y, z]).collect();
    body.set_positions(&stretched).expect("finite");
    let error = body.step(100.0).expect_err("no step decreases the energy");
    assert_eq!(error, StepError::Newton(NewtonError::WrongGradient { term: None }));
}
