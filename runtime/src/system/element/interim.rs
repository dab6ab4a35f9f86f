//! Stand-in for `crate::point` until that module arrives.
#![allow(missing_docs)]

use super::{Element, ElementStiffness, pair};
use crate::material::{Blocks, PAIRS};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Svd<R> {
    pub U: [[R; 3]; 3],
    pub stretches: [R; 3],
    pub V: [[R; 3]; 3],
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    None,
    #[default]
    Clamp,
    Absolute,
}

pub(super) fn svd(F: &[[f64; 3]; 3]) -> Svd<f64> {
    let mut b = *F;
    let mut V = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..10 {
        for (p, q) in PAIRS {
            let dot = |i: usize, j: usize| b[0][i] * b[0][j] + b[1][i] * b[1][j] + b[2][i] * b[2][j];
            let (app, aqq, apq) = (dot(p, p), dot(q, q), dot(p, q));
            let angle = 0.5 * (2.0 * apq).atan2(app - aqq);
            let (s, c) = angle.sin_cos();
            for m in [&mut b, &mut V] {
                for row in m.iter_mut() {
                    (row[p], row[q]) = (c * row[p] + s * row[q], c * row[q] - s * row[p]);
                }
            }
        }
    }
    let norm = |j: usize| (b[0][j].powi(2) + b[1][j].powi(2) + b[2][j].powi(2)).sqrt();
    let unit = |x: [f64; 3]| {
        let n = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        x.map(|c| c / n)
    };
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let col = |m: &[[f64; 3]; 3], j: usize| [m[0][j], m[1][j], m[2][j]];
    let s = [norm(0), norm(1), norm(2)];
    let perpendicular = |x: [f64; 3]| {
        unit(if x[0].abs() > 0.6 { cross(x, [0.0, 1.0, 0.0]) } else { cross(x, [1.0, 0.0, 0.0]) })
    };
    let u0 = if s[0] > 1e-300 { unit(col(&b, 0)) } else { [1.0, 0.0, 0.0] };
    let mut u1 = col(&b, 1);
    let d = u0[0] * u1[0] + u0[1] * u1[1] + u0[2] * u1[2];
    u1 = [u1[0] - d * u0[0], u1[1] - d * u0[1], u1[2] - d * u0[2]];
    let u1 = if s[1] > 1e-14 * s[0] && s[1] > 1e-300 { unit(u1) } else { perpendicular(u0) };
    let u2 = cross(u0, u1);
    let b2 = col(&b, 2);
    let U = [[u0[0], u1[0], u2[0]], [u0[1], u1[1], u2[1]], [u0[2], u1[2], u2[2]]];
    Svd { U, stretches: [s[0], s[1], u2[0] * b2[0] + u2[1] * b2[1] + u2[2] * b2[2]], V }
}

pub(super) fn project(blocks: &Blocks<f64>, filter: Filter) -> Blocks<f64> {
    let fix = |x: f64| match filter {
        Filter::None => x,
        Filter::Clamp => x.max(0.0),
        Filter::Absolute => x.abs(),
    };
    let mut out = *blocks;
    out.flip = blocks.flip.map(fix);
    out.twist = blocks.twist.map(fix);
    let h = blocks.hessian;
    let eigen =
        nalgebra::Matrix3::new(h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2]).symmetric_eigen();
    if filter != Filter::None && eigen.eigenvalues.iter().any(|&x| x < 0.0) {
        let d = nalgebra::Matrix3::from_diagonal(&eigen.eigenvalues.map(fix));
        let m = eigen.eigenvectors * d * eigen.eigenvectors.transpose();
        out.hessian = [m[(0, 0)], m[(1, 1)], m[(2, 2)], m[(0, 1)], m[(0, 2)], m[(1, 2)]];
    }
    out
}

pub(super) fn contract(element: &Element, point: &Svd<f64>, blocks: &Blocks<f64>) -> ElementStiffness {
    let Svd { U, V, .. } = point;
    let B = &element.shape.inverse;
    let mut w = [[0.0; 3]; 4];
    for n in 0..3 {
        for l in 0..3 {
            w[n + 1][l] = B[n][0] * V[0][l] + B[n][1] * V[1][l] + B[n][2] * V[2][l];
            w[0][l] -= w[n + 1][l];
        }
    }
    let h = &blocks.hessian;
    let mut out = ElementStiffness::ZERO;
    for i in 0..4 {
        for j in 0..=i {
            for a in 0..3 {
                for c in 0..3 {
                    let mut sum = 0.0;
                    for l in 0..3 {
                        sum += h[l] * U[a][l] * w[i][l] * U[c][l] * w[j][l];
                    }
                    for (k, (p, q)) in PAIRS.into_iter().enumerate() {
                        let (x, y) = (
                            (blocks.flip[k] + blocks.twist[k]) / 2.0,
                            (blocks.flip[k] - blocks.twist[k]) / 2.0,
                        );
                        sum += h[3 + k]
                            * (U[a][p] * w[i][p] * U[c][q] * w[j][q] + U[a][q] * w[i][q] * U[c][p] * w[j][p]);
                        sum += x
                            * (U[a][p] * w[i][q] * U[c][p] * w[j][q] + U[a][q] * w[i][p] * U[c][q] * w[j][p]);
                        sum += y
                            * (U[a][p] * w[i][q] * U[c][q] * w[j][p] + U[a][q] * w[i][p] * U[c][p] * w[j][q]);
                    }
                    out.blocks[pair(i, j)][a][c] = element.shape.volume * sum;
                }
            }
        }
    }
    out
}
