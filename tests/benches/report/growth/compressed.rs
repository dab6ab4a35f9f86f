//! The step of another code: scalar entries in compressed rows, and conjugate gradients preconditioned by the
//! diagonal.
//!
//! So do \[VegaFEM\] and many others. The stiffnesses are piola's, and the matrix is whole.
//!
//! \[VegaFEM\] Barbič, Sin, Schroeder, *Vega FEM Library*, 2012.

use std::error::Error;

use piola::batch::{Batch, Layout, Tetrahedra, TileMaterial};
use piola::point::Filter;
use piola::system::{Body, CsrPlaces};
use rayon::prelude::*;

/// Rows that a thread takes at once.
const CHUNK: usize = 4096;

/// A body stepped by implicit Euler, one iteration of Newton's method a step.
pub(crate) struct Stepper<M> {
    material: M,
    corners: Vec<[usize; 4]>,
    /// Dm⁻¹ and volume of each element.
    rest: Vec<f64>,
    positions: Vec<[f64; 3]>,
    velocities: Vec<[f64; 3]>,
    /// First of the three unknowns of each node that is not pinned.
    unknowns: Vec<Option<usize>>,
    /// Mass of each unknown, kg.
    masses: Vec<f64>,
    row_starts: Vec<u32>,
    columns: Vec<u32>,
    places: CsrPlaces,
}

impl<M: TileMaterial<f64>> Stepper<M> {
    /// A body of one material, `material`, at rest.
    ///
    /// # Errors
    /// Where the matrix cannot be made.
    pub(crate) fn new(body: &Body, material: M, pinned: &[usize]) -> Result<Self, Box<dyn Error>> {
        let corners: Vec<[usize; 4]> = body.elements().iter().map(|element| element.nodes).collect();
        let shapes = body.elements().iter().map(|element| element.shape);
        let rest =
            shapes.flat_map(|shape| shape.inverse.into_iter().flatten().chain([shape.volume])).collect();
        let nodes = body.rest().len();
        let mut free = 0;
        let unknowns: Vec<Option<usize>> = (0..nodes)
            .map(|node| {
                let is_free = pinned.binary_search(&node).is_err();
                free += usize::from(is_free);
                is_free.then(|| 3 * (free - 1))
            })
            .collect();
        let mut masses = Vec::with_capacity(3 * free);
        let mut neighbours = vec![Vec::new(); nodes];
        for corners in &corners {
            for &node in corners {
                neighbours[node].extend(corners.iter().filter_map(|&other| unknowns[other]));
            }
        }
        let (mut row_starts, mut columns) = (vec![0], Vec::new());
        for node in (0..nodes).filter(|&node| unknowns[node].is_some()) {
            let of_node = &mut neighbours[node];
            of_node.sort_unstable();
            of_node.dedup();
            for _ in 0..3 {
                masses.push(body.masses()[node]);
                columns.extend(of_node.iter().flat_map(|&unknown| [0, 1, 2].map(|c| (unknown + c) as u32)));
                row_starts.push(u32::try_from(columns.len())?);
            }
        }
        let tetrahedra = Tetrahedra::new(nodes, &corners)?;
        let places = CsrPlaces::new(tetrahedra, |node| unknowns[node], &row_starts, &columns)?;
        Ok(Self {
            material,
            corners,
            rest,
            positions: body.rest().to_vec(),
            velocities: vec![[0.0; 3]; nodes],
            unknowns,
            masses,
            row_starts,
            columns,
            places,
        })
    }

    /// Number of unknowns.
    fn unknowns(&self) -> usize {
        self.masses.len()
    }

    /// A step of `h` seconds; returns the iterations of conjugate gradients to this relative residual.
    ///
    /// # Errors
    /// Where they do not end.
    pub(crate) fn step(
        &mut self,
        h: f64,
        gravity: [f64; 3],
        tolerance: f64,
    ) -> Result<usize, Box<dyn Error>> {
        let tetrahedra = Tetrahedra::new(self.positions.len(), &self.corners)?;
        let mut gradients = vec![0.0; 12 * self.corners.len()];
        let mut values = vec![0.0; self.columns.len()];
        {
            let mut stiffnesses = vec![0.0; 144 * self.corners.len()];
            Batch::new(&self.material).with_filter(Filter::Clamp).with_threads(true).stiffnesses_at(
                tetrahedra,
                &self.positions,
                &self.rest,
                &mut gradients,
                &mut stiffnesses,
            )?;
            self.places.add(&stiffnesses, Layout::Points, &mut values)?;
        }

        let mut forces = vec![0.0; self.unknowns()];
        for (corners, gradient) in self.corners.iter().zip(gradients.chunks(12)) {
            for (corner, gradient) in corners.iter().zip(gradient.chunks(3)) {
                let Some(unknown) = self.unknowns[*corner] else { continue };
                for c in 0..3 {
                    forces[unknown + c] -= gradient[c];
                }
            }
        }
        let mut diagonal = vec![0.0; self.unknowns()];
        for (node, unknown) in self.unknowns.iter().enumerate() {
            let Some(unknown) = *unknown else { continue };
            for c in 0..3 {
                let row = unknown + c;
                forces[row] += self.masses[row] * (gravity[c] + self.velocities[node][c] / h);
                let entries = self.row_starts[row] as usize..self.row_starts[row + 1] as usize;
                let own = entries.into_iter().find(|&entry| self.columns[entry] as usize == row);
                let own = own.ok_or("a row has no diagonal entry")?;
                values[own] += self.masses[row] / (h * h);
                diagonal[row] = values[own];
            }
        }
        let (moves, iterations) = self.solve(&values, &diagonal, forces, tolerance)?;
        for (node, unknown) in self.unknowns.iter().enumerate() {
            let Some(unknown) = *unknown else { continue };
            for c in 0..3 {
                self.positions[node][c] += moves[unknown + c];
                self.velocities[node][c] = moves[unknown + c] / h;
            }
        }
        Ok(iterations)
    }

    fn solve(
        &self,
        values: &[f64],
        diagonal: &[f64],
        mut residual: Vec<f64>,
        tolerance: f64,
    ) -> Result<(Vec<f64>, usize), Box<dyn Error>> {
        let goal = tolerance * dot(&residual, &residual).sqrt();
        let mut solution = vec![0.0; residual.len()];
        let scaled =
            |residual: &[f64]| -> Vec<f64> { residual.iter().zip(diagonal).map(|(r, d)| r / d).collect() };
        let mut direction = scaled(&residual);
        let mut product = vec![0.0; residual.len()];
        let mut slope = dot(&residual, &direction);
        for iteration in 0..10_000 {
            if dot(&residual, &residual).sqrt() <= goal {
                return Ok((solution, iteration));
            }
            self.multiply(values, &direction, &mut product);
            let length = slope / dot(&direction, &product);
            add(&mut solution, length, &direction);
            add(&mut residual, -length, &product);
            let preconditioned = scaled(&residual);
            let next = dot(&residual, &preconditioned);
            for (direction, preconditioned) in direction.iter_mut().zip(&preconditioned) {
                *direction = preconditioned + next / slope * *direction;
            }
            slope = next;
        }
        Err("conjugate gradients do not end".into())
    }

    fn multiply(&self, values: &[f64], x: &[f64], product: &mut [f64]) {
        product.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, product)| {
            for (row, product) in (chunk * CHUNK..).zip(product) {
                let entries = self.row_starts[row] as usize..self.row_starts[row + 1] as usize;
                let pairs = values[entries.clone()].iter().zip(&self.columns[entries]);
                *product = pairs.map(|(value, &column)| value * x[column as usize]).sum();
            }
        });
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    let chunks = x.par_chunks(CHUNK).zip(y.par_chunks(CHUNK));
    chunks.map(|(x, y)| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>()).sum()
}

fn add(sum: &mut [f64], factor: f64, x: &[f64]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += factor * x;
    }
}
