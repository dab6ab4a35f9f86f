//! Helpers shared by the tests of the baselines.

use piola::Material;
use piola::Real;
use piola::point::{Filter, Matrix3, evaluate};

/// All stretches well apart, 1.4, 1.2 and 0.7, with rotations on both sides.
pub(crate) const SHEARED: Matrix3<f64> = [[1.3, 0.2, -0.1], [0.0, 0.8, 0.3], [0.4, -0.2, 1.1]];

/// The rest state.
pub(crate) const IDENTITY: Matrix3<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Matrix in another format.
pub(crate) fn convert<R: Real>(matrix: &Matrix3<f64>) -> Matrix3<R> {
    matrix.map(|row| row.map(R::splat))
}

/// P and dP/dF by this library.
pub(crate) fn exact<R: Real>(
    material: &impl Material,
    deformation: &Matrix3<R>,
) -> (Matrix3<R>, [[R; 9]; 9]) {
    let point = evaluate(material, deformation, Filter::None);
    (point.stress, point.tangent.to_matrix())
}

/// ‖found − expected‖ / ‖expected‖, Frobenius norms.
pub(crate) fn error<R: Real + Into<f64>, const N: usize>(found: &[[R; N]; N], expected: &[[R; N]; N]) -> f64 {
    let squares = |entry: &dyn Fn(usize, usize) -> f64| -> f64 {
        (0..N * N).map(|k| entry(k / N, k % N).powi(2)).sum()
    };
    let difference = squares(&|i, j| found[i][j].into() - expected[i][j].into());
    (difference / squares(&|i, j| expected[i][j].into())).sqrt()
}
