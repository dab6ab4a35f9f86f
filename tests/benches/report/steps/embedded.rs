//! The free flight once more, by a loop around batches: what single precision of the point kernels saves and
//! costs.
//!
//! F, stresses and stiffnesses are computed in `f32` or `f64`; positions, sums, factor and solution stay in
//! `f64`. Newton's method without a line search, until the gradient has fallen to 10⁻⁶ of its first norm or
//! does not fall any more.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::time::Instant;

use piola::batch::{Batch, Layout, Stages};
use piola::point::Filter;
use piola::step::SimulationSettings;
use piola::system::{BlockMatrix, Body, Cholesky, Pins};
use piola_materials::StableNeoHookean;
use piola_scenes::geometry::Geometry;
use piola_scenes::scene::DINOSAUR;
use piola_scenes::settings::Settings;

use super::motion::{TIME_STEP, Track, free_material, turning_and_stretching};
use super::{References, Way, empty_row};
use crate::data::StepRow;

/// Of Newton's method in a step, if rounding does not end it before.
const ITERATIONS: usize = 20;

/// A row for each precision.
pub(super) fn rows(frames: usize, references: &References) -> Result<Vec<StepRow>, String> {
    let course = |result: Result<(Track, f64), Box<dyn std::error::Error>>, setting: &str| {
        let (track, seconds) = result.map_err(|error| error.to_string())?;
        let settings = SimulationSettings::default();
        let way = Way { axis: "precision", setting: setting.to_owned(), division: 1.0, settings };
        let mut row = empty_row(super::Body::Free, &way);
        row.fill(&track, seconds, Some(references));
        Ok::<_, String>(row)
    };
    Ok(vec![
        course(fly::<f64>(frames, |x| x, |x| x), "point kernels in f64")?,
        course(fly::<f32>(frames, |x| x as f32, f64::from), "point kernels in f32")?,
    ])
}

/// The flight and how long its steps took, s.
fn fly<E: Stages>(
    frames: usize,
    narrow: fn(f64) -> E,
    widen: fn(E) -> f64,
) -> Result<(Track, f64), Box<dyn std::error::Error>> {
    let geometry = Geometry::load(&Settings::new(&DINOSAUR))?;
    let mesh = &geometry.mesh;
    let material = free_material()?;
    let body = Body::new(mesh, material, DINOSAUR.density)?;
    let mut flight = Flight::new(&body, &material, narrow, widen)?;
    let mut positions = mesh.positions.clone();
    let mut velocities = turning_and_stretching(mesh);
    let mut track = Track::new(mesh.bounds().size()[1]);
    let clock = Instant::now();
    for _ in 0..frames {
        track.newton_iterations += flight.step(&mut positions, &mut velocities)?;
        track.steps += 1;
        track.note(&positions);
    }
    Ok((track, clock.elapsed().as_secs_f64()))
}

struct Flight<'a, E: Stages> {
    body: &'a Body,
    batch: Batch<'a, E>,
    narrow: fn(f64) -> E,
    widen: fn(E) -> f64,
    rest: Vec<E>,
    F: Vec<E>,
    gradients: Vec<E>,
    stiffnesses: Vec<E>,
    widened: Vec<f64>,
    matrix: BlockMatrix,
    cholesky: Cholesky,
    /// Of the objective of a step, N.
    gradient: Vec<[f64; 3]>,
    direction: Vec<f64>,
}

impl<'a, E: Stages> Flight<'a, E> {
    fn new(
        body: &'a Body,
        material: &'a StableNeoHookean,
        narrow: fn(f64) -> E,
        widen: fn(E) -> f64,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let (nodes, elements) = (body.rest().len(), body.elements().len());
        let tets: Vec<[usize; 4]> = body.elements().iter().map(|element| element.nodes).collect();
        let matrix = BlockMatrix::new(nodes, &tets, &Pins::none())?;
        let cholesky = Cholesky::new(matrix.pattern().column_starts(), matrix.pattern().row_indices())?;
        let rest = body.elements().iter().flat_map(|element| {
            let inverse = element.shape.inverse.into_iter().flatten();
            inverse.chain([element.shape.volume]).map(narrow)
        });
        let numbers = |count: usize| vec![E::default(); count * elements];
        Ok(Self {
            body,
            batch: Batch::new(material).with_filter(Filter::Clamp),
            narrow,
            widen,
            rest: rest.collect(),
            F: numbers(9),
            gradients: numbers(12),
            stiffnesses: numbers(78),
            widened: vec![0.0; 78 * elements],
            matrix,
            cholesky,
            gradient: vec![[0.0; 3]; nodes],
            direction: vec![0.0; 3 * nodes],
        })
    }

    /// A step of implicit Euler; how many iterations it took.
    fn step(
        &mut self,
        positions: &mut [[f64; 3]],
        velocities: &mut [[f64; 3]],
    ) -> Result<usize, Box<dyn std::error::Error>> {
        let start = positions.to_vec();
        let per_square = 1.0 / (TIME_STEP * TIME_STEP);
        let (mut first, mut before) = (f64::INFINITY, f64::INFINITY);
        let mut iterations = 0;
        while iterations < ITERATIONS {
            self.linearise(positions)?;
            for (node, &mass) in self.body.masses().iter().enumerate() {
                for c in 0..3 {
                    let free = start[node][c] + TIME_STEP * velocities[node][c];
                    self.gradient[node][c] += mass * per_square * (positions[node][c] - free);
                }
            }
            let residual = self.gradient.as_flattened().iter().map(|g| g * g).sum::<f64>().sqrt();
            first = if iterations == 0 { residual } else { first };
            let is_rounding = residual >= before && residual <= 1e-3 * first;
            if iterations > 0 && (residual <= 1e-6 * first || is_rounding) {
                break;
            }
            before = residual;
            self.solve(per_square)?;
            for (unknown, &node) in self.direction.chunks_exact(3).zip(self.matrix.pattern().node_of_free()) {
                for c in 0..3 {
                    positions[node][c] += unknown[c];
                }
            }
            iterations += 1;
        }
        for (velocity, (position, start)) in velocities.iter_mut().zip(positions.iter().zip(&start)) {
            for c in 0..3 {
                velocity[c] = (position[c] - start[c]) / TIME_STEP;
            }
        }
        Ok(iterations)
    }

    /// Gradients and stiffnesses of the elements, and the sum of the former.
    fn linearise(&mut self, positions: &[[f64; 3]]) -> Result<(), Box<dyn std::error::Error>> {
        for (element, F) in self.body.elements().iter().zip(self.F.chunks_exact_mut(9)) {
            let exact = element.deformation_gradient(positions);
            for (x, y) in F.iter_mut().zip(exact.as_flattened()) {
                *x = (self.narrow)(*y);
            }
        }
        let Self { batch, rest, F, gradients, stiffnesses, .. } = self;
        let survey = batch.packed_stiffnesses(F, rest, gradients, stiffnesses)?;
        if !survey.is_clean() {
            return Err("an element has left the range of the numbers".into());
        }
        self.gradient.fill([0.0; 3]);
        for (element, of_element) in self.body.elements().iter().zip(self.gradients.chunks_exact(12)) {
            for (k, &g) in of_element.iter().enumerate() {
                self.gradient[element.nodes[k / 3]][k % 3] += (self.widen)(g);
            }
        }
        Ok(())
    }

    fn solve(&mut self, per_square: f64) -> Result<(), Box<dyn std::error::Error>> {
        for (wide, &narrow) in self.widened.iter_mut().zip(&self.stiffnesses) {
            *wide = (self.widen)(narrow);
        }
        let masses = self.body.masses();
        self.matrix.assemble_packed(&self.widened, Layout::Points, |node| masses[node] * per_square)?;
        self.cholesky.factor(self.matrix.values())?;
        for (unknown, &node) in self.direction.chunks_exact_mut(3).zip(self.matrix.pattern().node_of_free()) {
            for c in 0..3 {
                unknown[c] = -self.gradient[node][c];
            }
        }
        self.cholesky.solve(&mut self.direction)?;
        Ok(())
    }
}
