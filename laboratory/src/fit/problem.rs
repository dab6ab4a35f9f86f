//! Residuals and their derivatives, as functions of the parameters that are free.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use piola::interpreter::Interpreted;
use piola::material::Form;

use super::Candidate;
use super::outcome::TrialError;
use crate::curve::{Response, Volume};
use crate::data::Measured;
use crate::specimen::Ordered;

/// Each residual of a trial that the energy refuses. Far above those of any trial that it does not, it makes
/// the method take a shorter step; its square is a number still.
const REFUSED: f64 = 1e100;

/// Energy to be fitted, and the points that count.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) start: &'a Candidate,
    /// The number of values of each parameter, and its form.
    pub(super) parameters: &'a [(usize, Form)],
    /// Indices of the free numbers among the values of all parameters.
    pub(super) free: &'a [usize],
    /// Points, each with the divisor of its difference.
    pub(super) points: &'a [(Measured, f64)],
    pub(super) volume: Volume,
}

/// Result of a trial: the material with its parameters and its response at each point, or the reason for a
/// refusal.
pub(super) type Trial = Result<(Interpreted, Vec<Response>), TrialError>;

impl Task<'_> {
    pub(super) fn attempt(&self, values: &[f64]) -> Trial {
        let Candidate { energy, material } = self.start;
        let material = energy.with_values(material, &self.lists(values))?;
        let response = |(point, _): &(Measured, f64)| point.response(&material, self.volume);
        let responses = self.points.iter().map(response).collect::<Result<_, _>>()?;
        Ok((material, responses))
    }

    /// The values as lists, one for each parameter.
    pub(super) fn lists(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let mut rest = values;
        let mut next = |length: usize| {
            let (list, after) = rest.split_at(length);
            rest = after;
            list.to_vec()
        };
        self.parameters.iter().map(|&(length, _)| next(length)).collect()
    }
}

pub(super) struct Problem<'a> {
    pub(super) task: Task<'a>,
    /// All numbers, those held included.
    pub(super) values: Vec<f64>,
    pub(super) trial: Trial,
    /// The free numbers are `origin` + `basis` · `place`, and `place` is what the Levenberg–Marquardt method
    /// changes.
    origin: DVector<f64>,
    basis: DMatrix<f64>,
    place: DVector<f64>,
}

impl<'a> Problem<'a> {
    /// Each free number is sought in units of its value here.
    pub(super) fn new(task: Task<'a>, values: Vec<f64>) -> Self {
        let count = task.free.len();
        let unit = |&number: &usize| if values[number] == 0.0 { 1.0 } else { values[number].abs() };
        let units = DVector::from_iterator(count, task.free.iter().map(unit));
        let place = DVector::from_fn(count, |k, _| values[task.free[k]] / units[k]);
        let (origin, basis) = (DVector::zeros(count), DMatrix::from_diagonal(&units));
        Self { task, trial: task.attempt(&values), values, origin, basis, place }
    }

    /// A problem whose free numbers are `origin` plus any combination of the columns of `basis`.
    pub(super) fn within(&self, origin: DVector<f64>, basis: DMatrix<f64>) -> Self {
        let (values, place) = (self.with_free(&origin), DVector::zeros(basis.ncols()));
        Self { task: self.task, trial: self.task.attempt(&values), values, origin, basis, place }
    }

    /// A new problem at the current place, all free numbers in units of their current values.
    pub(super) fn anew(&self) -> Self {
        Self::new(self.task, self.values.clone())
    }

    /// A problem in which only these coordinates change.
    pub(super) fn with_alone(&self, changing: &[usize]) -> Self {
        let (basis, place) = (self.basis.select_columns(changing), self.place.select_rows(changing));
        let mut alone = self.within(self.free_values(), basis);
        // Not from zero: the method makes its first steps as long as what it begins from is, in units of what
        // is changed.
        alone.origin -= &alone.basis * &place;
        alone.place = place;
        alone
    }

    pub(super) fn free_values(&self) -> DVector<f64> {
        DVector::from_iterator(self.task.free.len(), self.task.free.iter().map(|&number| self.values[number]))
    }

    /// All numbers, with these for the free ones.
    pub(super) fn with_free(&self, free: &DVector<f64>) -> Vec<f64> {
        let mut values = self.values.clone();
        for (&number, &value) in self.task.free.iter().zip(free.iter()) {
            values[number] = value;
        }
        values
    }

    /// The material as tried last, or where it was refused, as given.
    pub(super) fn specimen(&self) -> &Interpreted {
        self.trial.as_ref().map_or(&self.task.start.material, |(material, _)| material)
    }

    /// ∂r/∂p of the free numbers p in their own units; `None` where the trial is refused.
    pub(super) fn slopes(&self) -> Option<DMatrix<f64>> {
        let Ok((material, responses)) = &self.trial else { return None };
        let mut slopes = DMatrix::zeros(self.task.points.len(), self.task.free.len());
        for (row, (response, (_, size))) in responses.iter().zip(self.task.points).enumerate() {
            let ordered = Ordered::new(response.stretches);
            let by_parameters = self.task.start.energy.gradient_by_parameters(material, ordered.numbers);
            for (column, &number) in self.task.free.iter().enumerate() {
                let gradient = ordered.back(by_parameters[number]);
                let slope: f64 = (0..3).map(|axis| response.weights[axis] * gradient[axis]).sum();
                slopes[(row, column)] = slope / size;
            }
        }
        Some(slopes)
    }

    /// ∂r/∂p with columns of the length one, and their lengths before; `None` where there is none, or a free
    /// number changes nothing.
    pub(super) fn scaled_slopes(&self) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let mut slopes = self.slopes()?;
        let lengths = DVector::from_fn(slopes.ncols(), |column, _| slopes.column(column).norm());
        for (mut column, length) in slopes.column_iter_mut().zip(lengths.iter()) {
            column /= *length;
        }
        let are_lengths = lengths.iter().all(|&length| length.is_finite() && length > 0.0);
        are_lengths.then_some((slopes, lengths))
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, place: &DVector<f64>) {
        self.values = self.with_free(&(&self.origin + &self.basis * place));
        self.trial = self.task.attempt(&self.values);
        self.place.copy_from(place);
    }

    fn params(&self) -> DVector<f64> {
        self.place.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let points = self.task.points;
        let residual = |k: usize, _: usize| match &self.trial {
            Ok((_, responses)) => (responses[k].stress - points[k].0.stress) / points[k].1,
            Err(_) => REFUSED,
        };
        Some(DVector::from_fn(points.len(), residual))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        Some(self.slopes()? * &self.basis)
    }
}
