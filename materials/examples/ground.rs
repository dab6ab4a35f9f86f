//! A rubber cube falls on the ground: contact as a user-defined term, an integrator of second order, and
//! three solvers of the linear systems, one of which is not piola's.

#![expect(clippy::print_stdout, reason = "a result to show")]

use std::sync::Arc;

use piola_bodies::mesh::tetrahedral_box;
use piola_bodies::step::{
    Integrator, LinearSolver, NewtonSettings, NodeBlocks, Simulation, SimulationSettings, Term,
};
use piola_bodies::system::{Body, LinearError, LowerTriangle, Pins};
use piola_materials::NeoHookean;

/// A plane y = 0 that pushes with ½ k y² at every node below it; k in N/m.
struct Ground(f64);

impl Term for Ground {
    fn energy(&self, x: &[[f64; 3]]) -> Option<f64> {
        Some(x.iter().map(|x| 0.5 * self.0 * x[1].min(0.0).powi(2)).sum())
    }

    fn add_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        x.iter().zip(gradient).for_each(|(x, gradient)| gradient[1] += self.0 * x[1].min(0.0));
    }

    fn add_second_derivatives(&self, x: &[[f64; 3]], blocks: &mut NodeBlocks) {
        let below = (0..x.len()).filter(|&node| x[node][1] < 0.0);
        below.for_each(|node| blocks.add(node, node, [[0.0; 3], [0.0, self.0, 0.0], [0.0; 3]]));
    }
}

/// Conjugate gradients.
fn conjugate(matrix: &LowerTriangle, b: &mut [f64], tolerance: f64) -> Result<usize, LinearError> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let (mut x, mut r, mut p, mut product) = (vec![0.0; b.len()], b.to_vec(), b.to_vec(), b.to_vec());
    let (mut iterations, mut square, goal) = (0, dot(b, b), tolerance * tolerance * dot(b, b));
    while square > goal && iterations < b.len() {
        matrix.multiply(&p, &mut product)?;
        let step = square / dot(&p, &product);
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += step * p);
        r.iter_mut().zip(&product).for_each(|(r, product)| *r -= step * product);
        let turn = dot(&r, &r) / square;
        p.iter_mut().zip(&r).for_each(|(p, r)| *p = r + turn * *p);
        (iterations, square) = (iterations + 1, turn * square);
    }
    b.copy_from_slice(&x);
    Ok(iterations)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A cube of 20 cm falls from 10 cm above the ground: moduli in Pa, density in kg/m³.
    let mesh = tetrahedral_box([6, 6, 6], [0.2; 3])?;
    let body = Body::new(&mesh, NeoHookean::new(3e4, 1.2e5)?, 1000.0)?;
    let newton = NewtonSettings { tolerance: 1e-10, ..Default::default() };
    let (gravity, integrator) = ([0.0, -9.81, 0.0], Integrator::Sdirk2);
    let settings = SimulationSettings { gravity, integrator, newton, ..Default::default() };
    let mut cube = Simulation::new(body, &Pins::none(), settings)?;
    cube.set_positions(&mesh.positions.iter().map(|&[x, y, z]| [x, y + 0.1, z]).collect::<Vec<_>>())?;
    cube.set_terms(vec![Arc::new(Ground(2e4))]);
    let mut cubes = [cube.clone(), cube.clone(), cube];
    let linear = LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 };
    let newton = NewtonSettings { linear, ..newton };
    cubes[1].set_settings(SimulationSettings { newton, ..settings })?;
    cubes[2].set_linear_solver(conjugate)?;
    for cube in &mut cubes {
        (0..160).try_for_each(|_| cube.step(1.0 / 400.0).map(|_| ()))?;
    }
    for cube in &cubes[1..] {
        let pairs = cube.positions().as_flattened().iter().zip(cubes[0].positions().as_flattened());
        let distance = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(distance < 1e-9, "positions differ by {distance:e} m");
    }
    println!("after 0.4 s, from 9.81 J/kg times 0.1 m: {:?}", cubes[0].energies());
    Ok(())
}
