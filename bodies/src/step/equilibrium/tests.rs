use nalgebra::{DMatrix, SymmetricEigen};

use piola::batch::TileMaterial;

use super::*;
use crate::mesh::TetMesh;
use crate::step::{SimulationSettings, Spring, testing};
use crate::system::testing::{beam, kirchhoff, neo_hookean, rotated, stiffness_product};

fn simulation(mesh: &TetMesh, material: impl TileMaterial<f64> + 'static, pins: &Pins) -> Simulation {
    testing::simulation(mesh, material, pins, SimulationSettings::default())
}

/// All eigenvalues of M⁻¹K over the free nodes, ascending, by a dense method from products with single
/// displacements.
fn dense(simulation: &Simulation) -> Vec<f64> {
    let (body, nodes) = (simulation.body(), simulation.positions().len());
    let is_free = |unknown: &usize| !simulation.pinned().contains(&(unknown / 3));
    let free: Vec<usize> = (0..3 * nodes).filter(is_free).collect();
    let mut matrix = DMatrix::zeros(free.len(), free.len());
    let mut x = vec![[0.0; 3]; nodes];
    for (column, &j) in free.iter().enumerate() {
        x.as_flattened_mut()[j] = 1.0;
        let mut product = stiffness_product(body, simulation.positions(), Filter::None, &x);
        x.as_flattened_mut()[j] = 0.0;
        for spring in simulation.springs() {
            if spring.anchor.nodes[0] == j / 3 {
                product[j / 3][j % 3] += spring.stiffness;
            }
        }
        for (row, &i) in free.iter().enumerate() {
            let masses = body.masses()[i / 3] * body.masses()[j / 3];
            matrix[(row, column)] = product.as_flattened()[i] / masses.sqrt();
        }
    }
    let mut values: Vec<f64> = SymmetricEigen::new(matrix).eigenvalues.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The classification must agree with the eigenvalues of the dense method, after the zeros of the rigid
/// motions.
#[track_caller]
fn check(simulation: &Simulation, rigid: usize, stability: Stability) -> Equilibrium {
    let equilibrium = Equilibrium::of(simulation).expect("finite");
    let values = dense(simulation);
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    // The dense method's own error, some dozen roundings of the largest.
    let noise = 1e-13 * largest;
    let mut others: Vec<f64> = values;
    for _ in 0..rigid {
        let nearest = (0..others.len()).min_by(|&a, &b| others[a].abs().total_cmp(&others[b].abs()));
        let zero = others.remove(nearest.expect("a rigid motion"));
        assert!(zero.abs() <= noise, "{zero:e} is not rigid");
    }
    let sign = others[0] / noise;
    let agrees = match stability {
        Stability::Unbalanced => true,
        Stability::Stable => sign > 1.0,
        Stability::Saddle => sign < -1.0,
        Stability::Undecided => sign.abs() <= 1.0,
    };
    assert!(agrees, "{:e} is not that of {stability:?}", others[0]);
    assert_eq!((equilibrium.rigid_motions, equilibrium.stability), (rigid, stability), "{equilibrium:?}");
    equilibrium
}

#[test]
fn a_held_body_at_rest_is_stable() {
    let mesh = beam(3);
    for rigid in 0..3 {
        // The four nodes of an end, two nodes and the axis through them, one node.
        let pins = Pins::at((0..[4, 2, 1][rigid]).collect::<Vec<_>>());
        let rigid = [0, 1, 3][rigid];
        let equilibrium = check(&simulation(&mesh, rotated(), &pins), rigid, Stability::Stable);
        assert!(equilibrium.is_stress_free());
        assert_eq!(equilibrium.inverted, 0);
        // A few roundings of stretches of 1.
        assert!((equilibrium.smallest_sum - 2.0).abs() < 1e-14, "{equilibrium:?}");
    }
}

#[test]
fn a_free_body_at_rest_is_stable_but_for_six_motions() {
    let mut free = simulation(&beam(3), neo_hookean(), &Pins::none());
    check(&free, 6, Stability::Stable);
    let turned: Vec<[f64; 3]> = free.positions().iter().map(|&[x, y, z]| [5.0 - y, x, z]).collect();
    free.set_positions(&turned).expect("finite");
    check(&free, 6, Stability::Stable);
}

#[test]
fn a_body_that_is_blind_to_reflection_is_stable_inside_out() {
    let mut body = simulation(&beam(2), kirchhoff(), &Pins::none());
    let mirrored: Vec<[f64; 3]> = body.positions().iter().map(|x| x.map(|c| -c)).collect();
    body.set_positions(&mirrored).expect("finite");
    let equilibrium = check(&body, 6, Stability::Stable);
    assert!(equilibrium.is_stress_free());
    assert_eq!((equilibrium.inverted, equilibrium.smallest_sum), (12, 0.0));
}

#[test]
fn a_point_without_forces_is_a_saddle() {
    let mut body = simulation(&beam(2), kirchhoff(), &Pins::none());
    body.set_positions(&vec![[0.3; 3]; body.positions().len()]).expect("finite");
    let equilibrium = check(&body, 3, Stability::Saddle);
    assert_eq!((equilibrium.residual, equilibrium.inverted), (0.0, 0));
}

#[test]
fn a_spring_holds_a_point_and_stiffens_it() {
    let mut body = simulation(&beam(2), rotated(), &Pins::none());
    let target = body.positions()[0];
    body.set_springs(&[Spring::on_node(0, target, 100.0)]).expect("a spring");
    check(&body, 3, Stability::Stable);
}

#[test]
fn unbalanced_forces_are_no_equilibrium() {
    let mut body = simulation(&beam(2), rotated(), &Pins::at([0, 1, 2, 3]));
    let stretched: Vec<[f64; 3]> = body.positions().iter().map(|&[x, y, z]| [1.1 * x, y, z]).collect();
    body.set_positions(&stretched).expect("finite");
    let equilibrium = check(&body, 0, Stability::Unbalanced);
    assert!(equilibrium.residual > 0.1 * equilibrium.largest_force && !equilibrium.is_stress_free());
}

#[test]
fn where_nothing_is_free_nothing_is_said() {
    let mesh = beam(1);
    let body = simulation(&mesh, rotated(), &Pins::at(0..mesh.positions.len()));
    let equilibrium = Equilibrium::of(&body).expect("finite");
    assert_eq!((equilibrium.rigid_motions, equilibrium.stability), (0, Stability::Stable));
}

/// The second piece of a body moves without energy, and its motions are not rigid ones of the whole body.
#[test]
fn a_body_in_two_pieces_is_undecided() {
    let mut mesh = beam(2);
    let (nodes, tets) = (mesh.positions.len(), mesh.tets.clone());
    mesh.positions.extend(mesh.positions.clone().iter().map(|&[x, y, z]| [x, y + 1.0, z]));
    mesh.tets.extend(tets.iter().map(|tet| tet.map(|node| node + nodes)));
    mesh.tags.clear();
    check(&simulation(&mesh, rotated(), &Pins::at([0, 1, 2, 3])), 0, Stability::Undecided);
}

#[test]
fn bodies_of_any_size_are_classified_or_refused() {
    for (scale, is_fine) in [(1e-100, true), (1e-60, true), (1e60, true), (1e100, false)] {
        let mut mesh = beam(2);
        mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        match Equilibrium::of(&simulation(&mesh, rotated(), &Pins::none())) {
            Ok(found) => {
                assert_eq!(
                    (found.stability, found.rigid_motions),
                    (Stability::Stable, 6),
                    "{scale:e}: {found:?}"
                );
                assert!(is_fine, "{scale:e}");
            }
            // The squares of forces overflow.
            Err(error) => assert!(!is_fine && error == NewtonError::NotFinite, "{scale:e}: {error}"),
        }
    }
}
