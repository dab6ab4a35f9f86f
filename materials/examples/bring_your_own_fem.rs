//! Your own finite-element code with piola for the material: slices of deformation gradients in, slices of
//! stresses and tangents out.
//!
//! The elements are trilinear hexahedra with 2×2×2 Gauss points, whose shape functions piola does not know.
//! For these there is [`piola::batch::Batch`], and for sums over points [`piola::batch::Quadrature`]. The
//! program checks its forces and stiffness by finite differences, then bends and stretches a bar of rubber by
//! a force at its tip.
//! Slices are made anew in each call for brevity; a real code keeps them, and the `Quadrature`.

#![expect(non_snake_case, reason = "F, P, dP_dF, X and J as in the literature")]
#![expect(clippy::print_stdout, reason = "a result to show")]

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use piola::batch::{Batch, Quadrature};
use piola::point::Filter;
use piola_materials::NeoHookean;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    // Soft rubber: moduli in Pa.
    let bar = Bar::new(NeoHookean::new(1e5, 4e5)?)?;
    check_slopes(&bar)?;

    // A kilonewton along the bar and 150 N across it, shared by the nine nodes of its tip.
    let mut load = DVector::zeros(bar.X.len());
    for node in NODES - FACE..NODES {
        load[3 * node] = 1000.0 / 9.0;
        load[3 * node + 2] = -150.0 / 9.0;
    }
    let (x, residuals) = solve(&bar, &load)?;
    let by = (&x - &bar.X).rows_range(3 * (NODES - 1)..).into_owned();
    for steps in residuals[residuals.len().saturating_sub(3)..].windows(2) {
        // Newton's method squares a relative error, times what the second derivative of the forces makes of
        // it: a few.
        let [before, after] = [steps[0], steps[1]].map(|residual| residual / load.norm());
        assert!(after <= 10.0 * before * before, "from {before:e} to {after:e}");
    }
    let residuals: Vec<String> = residuals.iter().map(|residual| format!("{residual:.0e}")).collect();
    println!("the tip moves by {:.4?} m; residuals, N: {}", by.as_slice(), residuals.join(", "));
    Ok(())
}

/// Cells of the bar along each axis, a decimetre each.
const CELLS: [usize; 3] = [4, 2, 2];
const ELEMENTS: usize = CELLS[0] * CELLS[1] * CELLS[2];
const POINTS: usize = 8 * ELEMENTS;
/// Nodes of each of the faces across the bar, which are numbered one after the other.
const FACE: usize = (CELLS[1] + 1) * (CELLS[2] + 1);
const NODES: usize = (CELLS[0] + 1) * FACE;
/// The unknowns from here on are free.
const FREE: usize = 3 * FACE;

/// A bar of hexahedra, held at x = 0.
///
/// Unknown 3n+a is coordinate a of node n, in m. Point 8e+q is Gauss point q of element e, in every slice.
struct Bar {
    material: NeoHookean,
    /// Nodal positions at rest.
    X: DVector<f64>,
    elements: Vec<[usize; 8]>,
    /// ∂N/∂X of the eight shape functions at each point, 1/m.
    slopes: Vec<f64>,
    /// Volume of each point, m³: its weight times det ∂X/∂ξ.
    volumes: Vec<f64>,
}

impl Bar {
    fn new(material: NeoHookean) -> Result<Self> {
        let [_, ny, nz] = CELLS;
        // No element is a cube, so that ∂X/∂ξ differs from point to point.
        let X = DVector::from_fn(3 * NODES, |unknown, _| {
            let (n, a) = (unknown / 3, unknown % 3);
            let at = [n / FACE, n % FACE / (nz + 1), n % (nz + 1)];
            0.1 * at[a] as f64 + 0.01 * irregular(unknown)
        });
        let mut bar = Self { material, X, elements: Vec::new(), slopes: Vec::new(), volumes: Vec::new() };
        for e in 0..ELEMENTS {
            let [i, j, k] = [e / (ny * nz), e / nz % ny, e % nz];
            let node = |n: usize| FACE * (i + (n & 1)) + (nz + 1) * (j + (n >> 1 & 1)) + k + (n >> 2);
            let nodes: [usize; 8] = std::array::from_fn(node);
            for q in 0..8 {
                let xi = [0, 1, 2].map(|axis| sign(q, axis) / f64::sqrt(3.0));
                // N_n = Π (1 + s ξ)/8 with the signs s of corner n; J = ∂X/∂ξ.
                let dN_dxi: [Vector3<f64>; 8] = std::array::from_fn(|n| {
                    let factor = [0, 1, 2].map(|axis| 1.0 + sign(n, axis) * xi[axis]);
                    Vector3::from_fn(|axis, _| {
                        sign(n, axis) * factor[(axis + 1) % 3] * factor[(axis + 2) % 3] / 8.0
                    })
                });
                let mut J = Matrix3::zeros();
                for (&node, dN) in nodes.iter().zip(&dN_dxi) {
                    J += bar.X.fixed_rows::<3>(3 * node) * dN.transpose();
                }
                // ∂N/∂X = J⁻ᵀ ∂N/∂ξ.
                let inverse = J.try_inverse().ok_or("an element is flat")?;
                for dN in dN_dxi {
                    bar.slopes.extend_from_slice((inverse.transpose() * dN).as_slice());
                }
                bar.volumes.push(J.determinant());
            }
            bar.elements.push(nodes);
        }
        Ok(bar)
    }

    /// F of all points.
    fn deform(&self, x: &DVector<f64>) -> Result<Vec<f64>> {
        let nodes = self.elements.as_flattened().iter();
        let positions: Vec<f64> = nodes.flat_map(|node| [0, 1, 2].map(|a| x[3 * node + a])).collect();
        let mut F = vec![0.0; 9 * POINTS];
        Quadrature::<f64>::new(8, 8).deform(&positions, &self.slopes, &mut F)?;
        Ok(F)
    }

    /// Elastic energy, J; infinite if a point lies outside the domain of the material.
    fn energy(&self, x: &DVector<f64>) -> Result<f64> {
        let mut energies = vec![0.0; POINTS];
        let survey = Batch::<f64>::new(&self.material).energies(&self.deform(x)?, &mut energies)?;
        let sum = energies.iter().zip(&self.volumes).map(|(energy, volume)| energy * volume).sum();
        Ok(if survey.is_clean() { sum } else { f64::INFINITY })
    }

    /// Gradient of the energy, N, and stiffness, N/m, with the filter on dP/dF of each point.
    fn linearise(&self, x: &DVector<f64>, filter: Filter) -> Result<(DVector<f64>, DMatrix<f64>)> {
        let (mut P, mut dP_dF) = (vec![0.0; 9 * POINTS], vec![0.0; 81 * POINTS]);
        let batch = Batch::<f64>::new(&self.material).with_filter(filter);
        let survey = batch.tangents(&self.deform(x)?, &mut P, &mut dP_dF)?;
        if let Some(point) = survey.first {
            return Err(format!("point {point} is outside the domain of the material").into());
        }
        let mut hexahedra = Quadrature::<f64>::new(8, 8);
        let (mut gradients, mut stiffnesses) = (vec![0.0; 24 * ELEMENTS], vec![0.0; 24 * 24 * ELEMENTS]);
        hexahedra.gradients(&self.slopes, &self.volumes, &P, &mut gradients)?;
        hexahedra.stiffnesses(&self.slopes, &self.volumes, &dP_dF, &mut stiffnesses)?;

        let (mut gradient, mut stiffness) = (DVector::zeros(x.len()), DMatrix::zeros(x.len(), x.len()));
        for (element, nodes) in self.elements.iter().enumerate() {
            let unknown = |k: usize| 3 * nodes[k / 3] + k % 3;
            for row in 0..24 {
                gradient[unknown(row)] += gradients[24 * element + row];
                for column in 0..24 {
                    let entry = stiffnesses[24 * (24 * element + row) + column];
                    stiffness[(unknown(row), unknown(column))] += entry;
                }
            }
        }
        Ok((gradient, stiffness))
    }
}

/// The sign of a corner or Gauss point of [−1, 1]³ along an axis.
fn sign(corner: usize, axis: usize) -> f64 {
    if corner >> axis & 1 == 1 { 1.0 } else { -1.0 }
}

/// Irregular number between −1 and 1, reproducible from n.
fn irregular(n: usize) -> f64 {
    (1.0 + 17.0 * n as f64).sin()
}

/// Solves for the state in which the gradient of the energy equals the load, by Newton's method. Returns the
/// residual of each iteration too, N.
///
/// Far from there the filtered tangent makes every step one downhill, whose length a line search finds; near
/// it the tangent itself makes steps that square the residual.
fn solve(bar: &Bar, load: &DVector<f64>) -> Result<(DVector<f64>, Vec<f64>)> {
    let (mut x, mut filter, mut residuals) = (bar.X.clone(), Filter::Clamp, Vec::new());
    for _ in 0..50 {
        let (gradient, stiffness) = bar.linearise(&x, filter)?;
        let residual = (load - gradient).rows_range(FREE..).into_owned();
        residuals.push(residual.norm());
        // Rounding is some 10⁻¹⁴ of the load.
        if residual.norm() <= 1e-10 * load.norm() {
            return Ok((x, residuals));
        }

        let stiffness = stiffness.view_range(FREE.., FREE..).into_owned();
        let cholesky = stiffness.cholesky().ok_or("the bar has buckled")?;
        let mut step = DVector::zeros(x.len());
        step.rows_range_mut(FREE..).copy_from(&cholesky.solve(&residual));
        if filter == Filter::Clamp {
            let before = bar.energy(&x)? - load.dot(&x);
            while bar.energy(&(&x + &step))? - load.dot(&(&x + &step)) > before {
                step *= 0.5;
            }
        }
        x += step;
        if residual.norm() <= 0.2 * load.norm() {
            filter = Filter::None;
        }
    }
    Err(format!("no equilibrium: the residuals are {residuals:.1?} N").into())
}

/// Checks that forces are the slope of the energy and the stiffness that of the forces: halving the step of a
/// central difference must divide its error by four.
fn check_slopes(bar: &Bar) -> Result<()> {
    let unknowns = bar.X.len();
    // Strained by a tenth or so, every element in another way.
    let x = DVector::from_fn(unknowns, |n, _| bar.X[n] + 0.01 * irregular(n + unknowns));
    let (forces, stiffness) = bar.linearise(&x, Filter::None)?;
    let mut errors = [[0.0; 2]; 2];
    for (errors, h) in errors.iter_mut().zip([2e-3, 1e-3]) {
        for n in 0..unknowns {
            let moved = |by: f64| DVector::from_fn(unknowns, |m, _| if m == n { x[m] + by } else { x[m] });
            let energy_slope = (bar.energy(&moved(h))? - bar.energy(&moved(-h))?) / (2.0 * h);
            let (after, _) = bar.linearise(&moved(h), Filter::None)?;
            let (before, _) = bar.linearise(&moved(-h), Filter::None)?;
            let force_slope = (after - before) / (2.0 * h);
            errors[0] += (energy_slope - forces[n]).powi(2);
            errors[1] += (force_slope - stiffness.column(n)).norm_squared();
        }
    }
    for (coarse, fine) in errors[0].iter().zip(errors[1]) {
        let ratio = (coarse / fine).sqrt();
        // Steps of a hundredth of an element: the next term of the error is 10⁻⁴ of this one, times a number.
        assert!((ratio - 4.0).abs() <= 0.1, "the error fell by {ratio}");
    }
    Ok(())
}
