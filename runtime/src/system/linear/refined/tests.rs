use super::super::conjugate_gradients::End;
use super::*;
use crate::hand_written::SaintVenantKirchhoff;
use crate::point::Filter;
use crate::system::assemble::Elastic;
use crate::system::pattern::Pattern;
use crate::system::stiffnesses::ElementStiffnesses;
use crate::system::testing::{Scaled, beam};
use crate::system::{Body, Pins};

/// A matrix of a beam and its pattern: stiffness of material of about `modulus`, Pa, and a diagonal.
struct Example {
    pattern: Pattern,
    values: Vec<f64>,
}

impl Example {
    /// `squeezed` along x to this part of its length, unfiltered; `diagonal` is a multiple of modulus times
    /// length.
    fn new(modulus: f64, squeezed: f64, diagonal: f64) -> Self {
        let mesh = beam(20);
        let material = Scaled { material: SaintVenantKirchhoff, factor: modulus };
        let body = Body::new(&mesh, material, 1000.0).expect("a body");
        let pattern = Pattern::new(mesh.positions.len(), body.elements(), &Pins::none()).expect("small");
        let positions: Vec<_> = mesh.positions.iter().map(|x| [squeezed * x[0], x[1], x[2]]).collect();
        let mut elastic = Elastic::new(&body);
        elastic.evaluate(&body, &positions);
        let mut stiffnesses = ElementStiffnesses::new(&body);
        elastic.linearise(&body, Filter::None, &mut stiffnesses);
        let mut values = vec![0.0; pattern.entries().row_idx().len()];
        stiffnesses.fill(&pattern, |_| diagonal * modulus, &mut values);
        Self { pattern, values }
    }

    fn matrix(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.pattern.entries(), &self.values)
    }

    /// b − A x for a right side of ones, relative to b, with what the iteration says.
    #[track_caller]
    fn residual(&self, tolerance: f64) -> (f64, Iteration) {
        let mut refined = RefinedCholesky::new(self.pattern.shared_entries()).expect("small");
        refined.factor(self.matrix()).expect("positive definite");
        let mut x = vec![1.0; self.pattern.unknowns()];
        let iteration = refined.solve(self.matrix(), &mut x, tolerance);
        let lower = self.matrix().to_dense();
        let entry = |i: usize, j: usize| if i >= j { lower[(i, j)] } else { lower[(j, i)] };
        let residual = |i: usize| 1.0 - (0..x.len()).map(|j| entry(i, j) * x[j]).sum::<f64>();
        let square: f64 = (0..x.len()).map(|i| residual(i).powi(2)).sum();
        ((square / x.len() as f64).sqrt(), iteration)
    }
}

#[test]
fn stiffness_of_any_unit_is_solved_to_digits_that_f32_does_not_have() {
    for modulus in [1e-30, 1e-3, 1e6, 1e12, 1e60] {
        let (residual, iteration) = Example::new(modulus, 1.0, 1e-3).residual(1e-12);
        assert_eq!(iteration.end, End::Converged);
        assert!(iteration.iterations <= 5, "{iteration:?} at {modulus:e} Pa");
        // Condition about 10⁵, of which u ‖A‖ ‖x‖ is left.
        assert!(residual <= 2e-11, "{residual:e} at {modulus:e} Pa");
    }
}

/// Six rigid motions hang on a diagonal of 10⁻⁹ of the stiffness, which f32 cannot tell from zero.
#[test]
fn what_the_factor_misses_costs_iterations() {
    let (residual, iteration) = Example::new(1e6, 1.0, 1e-10).residual(1e-6);
    assert_eq!(iteration.end, End::Converged);
    assert!((2..=40).contains(&iteration.iterations), "{iteration:?}");
    // Condition about 10¹².
    assert!(residual <= 1e-4, "{residual:e}");
}

#[test]
fn an_indefinite_matrix_is_found_out() {
    let example = Example::new(1e6, 0.4, 1e-6);
    let (_, iteration) = example.residual(1e-6);
    assert_eq!(iteration.end, End::NegativeCurvature);
}

#[test]
fn what_is_not_finite_is_an_error() {
    let mut example = Example::new(1e6, 1.0, 1.0);
    example.values[7] = f64::NAN;
    let mut refined = RefinedCholesky::new(example.pattern.shared_entries()).expect("small");
    assert!(matches!(refined.factor(example.matrix()), Err(LinearError::NotPositive { .. })));
}
