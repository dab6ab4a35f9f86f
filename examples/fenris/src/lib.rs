#![doc = include_str!("../README.md")]
#![expect(non_snake_case, reason = "F, H, P, and I, J of pairs of nodes, as in the literature and in fenris")]

use fenris::nalgebra::{DMatrixViewMut, DVectorView, Matrix3 as Columns, U3, Vector3};
use fenris_solid::{HyperelasticMaterial, deformation_gradient};
use piola::material::Response;
use piola::point::{
    DisplacementGradient, EnergyPoint, Filter, Matrix3, StressPoint, evaluate_dense, evaluate_energy,
    evaluate_stress,
};

/// Material of piola with the interfaces of fenris.
///
/// Where a point lies outside the domain of the energy, or a result is infinite or NaN, the energy is
/// infinite, and stress and contraction are NaN, as of fenris' own materials.
///
/// The parameters of a quadrature point are a material of its own, of the same type, or `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiolaMaterial<M> {
    /// The material of all points that have none of their own.
    pub material: M,
    /// Treatment of negative eigenvalues of dP/dF in contractions.
    pub filter: Filter,
}

impl<M> PiolaMaterial<M> {
    fn at<'a>(&'a self, own: &'a Option<M>) -> &'a M {
        own.as_ref().unwrap_or(&self.material)
    }

    /// The entries of the filtered dP/dF, row 3i+k for entry (i, k) of P, column 3j+m for entry (j, m) of F.
    fn tangent<T: Number>(&self, F: &Columns<T>, own: &Option<M>) -> [[T; 9]; 9]
    where
        M: Response<T>,
    {
        let point = evaluate_dense(self.at(own), &rows(F), self.filter);
        if point.status.is_clean() { point.tangent } else { [[number(f64::NAN); 9]; 9] }
    }
}

/// `f64` and `f32`, for both libraries.
pub trait Number: fenris::Real + piola::Real<Mask = bool> {}

impl<T: fenris::Real + piola::Real<Mask = bool>> Number for T {}

impl<T: Number, M: Response<T> + Clone + 'static> HyperelasticMaterial<T, U3> for PiolaMaterial<M> {
    type Parameters = Option<M>;

    fn compute_energy_density(&self, F: &Columns<T>, own: &Option<M>) -> T {
        energy_or_infinity(evaluate_energy(self.at(own), &rows(F)))
    }

    /// ψ(F) − ψ(I), with all digits at small strain.
    fn compute_energy_density_du(&self, u_grad: &Columns<T>, own: &Option<M>) -> T {
        let H = rows(&u_grad.transpose());
        energy_or_infinity(evaluate_energy(self.at(own), DisplacementGradient(&H)))
    }

    fn compute_stress_tensor(&self, F: &Columns<T>, own: &Option<M>) -> Columns<T> {
        stress_or_nan(evaluate_stress(self.at(own), &rows(F)))
    }

    fn compute_stress_tensor_du(&self, u_grad: &Columns<T>, own: &Option<M>) -> Columns<T> {
        let H = rows(&u_grad.transpose());
        stress_or_nan(evaluate_stress(self.at(own), DisplacementGradient(&H)))
    }

    fn compute_stress_contraction(
        &self,
        F: &Columns<T>,
        a: &Vector3<T>,
        b: &Vector3<T>,
        own: &Option<M>,
    ) -> Columns<T> {
        let half = contract_last(&self.tangent(F, own), [b[0], b[1], b[2]]);
        columns(&contract_first(&half, [a[0], a[1], a[2]]))
    }

    fn accumulate_stress_contractions_into(
        &self,
        mut output: DMatrixViewMut<'_, T>,
        alpha: T,
        F: &Columns<T>,
        a: DVectorView<'_, T>,
        b: DVectorView<'_, T>,
        own: &Option<M>,
    ) {
        let tangent = self.tangent(F, own);
        // fenris reads the upper triangle alone.
        for J in 0..b.len() / 3 {
            let half = contract_last(&tangent, [0, 1, 2].map(|m| alpha * b[3 * J + m]));
            for I in 0..(J + 1).min(a.len() / 3) {
                let block = contract_first(&half, [0, 1, 2].map(|k| a[3 * I + k]));
                let mut to = output.fixed_view_mut::<3, 3>(3 * I, 3 * J);
                to += columns(&block);
            }
        }
    }

    // Without this fenris would call it for each pair of nodes by itself.
    fn accumulate_stress_contractions_du_into(
        &self,
        output: DMatrixViewMut<'_, T>,
        alpha: T,
        u_grad: &Columns<T>,
        a: DVectorView<'_, T>,
        b: DVectorView<'_, T>,
        own: &Option<M>,
    ) {
        self.accumulate_stress_contractions_into(output, alpha, &deformation_gradient(u_grad), a, b, own);
    }
}

fn energy_or_infinity<T: Number>(EnergyPoint { energy, status }: EnergyPoint<T>) -> T {
    if status.is_clean() { energy } else { number(f64::INFINITY) }
}

fn stress_or_nan<T: Number>(StressPoint { stress, status }: StressPoint<T>) -> Columns<T> {
    if status.is_clean() { columns(&stress) } else { Columns::repeat(number(f64::NAN)) }
}

fn number<T: Number>(value: f64) -> T {
    <T as piola::Real>::splat(value)
}

/// Σm dP_ik/dF_jm b_m at 3i+k, j.
fn contract_last<T: Number>(dP_dF: &[[T; 9]; 9], b: [T; 3]) -> [[T; 3]; 9] {
    let mut half = [[T::zero(); 3]; 9];
    for (half, row) in half.iter_mut().zip(dP_dF) {
        for j in 0..3 {
            half[j] = row[3 * j] * b[0] + row[3 * j + 1] * b[1] + row[3 * j + 2] * b[2];
        }
    }
    half
}

/// Σk half_ikj a_k at i, j.
fn contract_first<T: Number>(half: &[[T; 3]; 9], a: [T; 3]) -> Matrix3<T> {
    let mut block = [[T::zero(); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            block[i][j] = half[3 * i][j] * a[0] + half[3 * i + 1][j] * a[1] + half[3 * i + 2][j] * a[2];
        }
    }
    block
}

fn rows<T: Number>(matrix: &Columns<T>) -> Matrix3<T> {
    matrix.transpose().into()
}

fn columns<T: Number>(rows: &Matrix3<T>) -> Columns<T> {
    Columns::from(*rows).transpose()
}
