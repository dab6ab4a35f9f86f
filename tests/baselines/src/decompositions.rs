//! Alternative signed singular value decompositions F = U diag(λ) Vᵀ: those of two linear algebra libraries,
//! and Jacobi's method on FᵀF.
//!
//! All have the conventions of [`Svd`](piola::point::Svd): det U = det V = 1 and λ1 ≥ λ2 ≥ |λ3|, so that any
//! of them can stand in for [`piola::point::svd()`].

mod jacobi;
mod libraries;

pub use jacobi::jacobi;
pub use libraries::{faer, nalgebra};
use piola::__private::matrix::descending;

#[cfg(test)]
mod tests {
    #![expect(non_snake_case, reason = "F, U, V as in the literature")]

    use piola::Real;
    use piola::point::{Matrix3, Svd};

    use super::*;
    use crate::matrix::{cofactor, dot, multiply_transposed, scale_columns, to_world, transpose};
    use crate::testing::{IDENTITY, SHEARED, convert, error};
    use piola::__private::random::Random;

    /// Backward error ‖F − U diag(λ) Vᵀ‖/‖F‖ and distance of U and V from rotations, in units of u; the
    /// larger one.
    #[track_caller]
    fn defect<R: Real<Mask = bool> + Into<f64>>(F: &Matrix3<R>, svd: &Svd<R>) -> f64 {
        let Svd { U, stretches: [l1, l2, l3], V } = svd;
        assert!(!l1.less(*l2) && !l2.less(l3.abs()), "λ = {:?}", svd.stretches);
        let mut worst = error(&multiply_transposed(&scale_columns(U, svd.stretches), V), F);
        for rotation in [U, V] {
            let gram = multiply_transposed(&transpose(rotation), &transpose(rotation));
            worst = worst.max(error(&gram, &convert(&IDENTITY)));
            let determinant: f64 = dot(rotation[0], cofactor(rotation)[0]).into();
            assert!(determinant > 0.0);
        }
        worst / R::UNIT_ROUNDOFF
    }

    /// Rotations around these stretches, and their opposites: what is said of F holds for its reflection.
    fn samples<R: Real>(stretches: [f64; 3]) -> impl Iterator<Item = Matrix3<R>> {
        let mut random = Random::new(4);
        (0..100).map(move |k| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let diagonal = scale_columns(&IDENTITY, stretches.map(|stretch| sign * stretch));
            convert(&to_world(&random.rotation(), &diagonal, &random.rotation()))
        })
    }

    #[track_caller]
    fn worst<R: Real<Mask = bool> + Into<f64>>(
        stretches: [f64; 3],
        decompose: impl Fn(&Matrix3<R>) -> Option<Svd<R>>,
    ) -> f64 {
        samples(stretches).map(|F| defect(&F, &decompose(&F).expect("a finite matrix"))).fold(0.0, f64::max)
    }

    /// A few dozen operations for each entry, none of which cancels where no stretch is small.
    #[test]
    fn all_decompose_ordinary_matrices() {
        for stretches in [[1.4, 1.0, 0.7], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [3.0, 3.0, 0.5]] {
            let found = [
                worst::<f64>(stretches, nalgebra),
                worst::<f64>(stretches, faer),
                worst::<f64>(stretches, |F| Some(jacobi(F, 6))),
                worst::<f32>(stretches, nalgebra),
                worst::<f32>(stretches, faer),
                worst::<f32>(stretches, |F| Some(jacobi(F, 5))),
            ];
            assert!(found.into_iter().all(|defect| defect <= 50.0), "{stretches:?}: {found:?}");
        }
    }

    /// FᵀF forgets what is below √u λ1; bidiagonalisation does not.
    #[test]
    fn squares_lose_half_of_the_digits() {
        let stretches = [1.0, 2e-8, 1e-8];
        let found = [
            worst::<f64>(stretches, nalgebra),
            worst::<f64>(stretches, faer),
            worst::<f64>(stretches, |F| Some(jacobi(F, 6))),
        ];
        let [nalgebra, faer, jacobi] = found;
        assert!(nalgebra >= 1e6 && jacobi >= 1e6 && faer <= 50.0, "{found:?}");
    }

    /// What is not a number has no decomposition by the libraries; a fixed number of sweeps passes it on.
    #[test]
    fn nothing_is_found_in_what_is_not_finite() {
        let mut F = SHEARED;
        F[1][2] = f64::NAN;
        assert!(nalgebra(&F).is_none() && faer(&F).is_none());
        assert!(jacobi(&F, 4).stretches.iter().any(|stretch| stretch.is_nan()));
    }

    /// Four are enough for `f32`, two more for `f64`, where each brings a third of the digits at least.
    #[test]
    fn rough_angles_need_more_sweeps() {
        let stretches = [1.4, 1.0, 0.7];
        assert!(worst::<f32>(stretches, |F| Some(jacobi(F, 4))) <= 1e3);
        assert!(worst::<f64>(stretches, |F| Some(jacobi(F, 4))) >= 1e8);
    }
}
