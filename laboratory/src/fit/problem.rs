//! Residuals and their derivatives, as functions of the parameters that are free.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra_34::{DMatrix, DVector, Dyn, Owned};

use super::candidate::{Candidate, Numbers};
use crate::curve::{Response, Volume, respond};
use crate::data::{Measured, Unanswered};
use crate::specimen::Ordered;

/// Each residual of a trial that the energy refuses. Far above those of any trial that it does not, it makes the method
/// take a shorter step; its square is a number still.
const REFUSED: f64 = 1e100;

pub(super) struct Problem<'a> {
    start: &'a dyn Candidate,
    numbers: &'a Numbers,
    /// With what the difference is divided by.
    points: &'a [(Measured, f64)],
    volume: Volume,
    /// Which numbers are sought.
    pub(super) free: Vec<usize>,
    /// All numbers, those held included.
    pub(super) values: Vec<f64>,
    /// The free numbers are sought in units of their values at the start.
    units: Vec<f64>,
    trial: Trial,
}

/// The energy with its parameters and what it answers at each point, or why it does not.
enum Trial {
    Answers(Box<dyn Candidate>, Vec<Response>),
    /// A point without an answer, where the parameters are not to blame.
    Refused(Option<Unanswered>),
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        start: &'a dyn Candidate,
        numbers: &'a Numbers,
        points: &'a [(Measured, f64)],
        volume: Volume,
        free: Vec<usize>,
        values: Vec<f64>,
    ) -> Self {
        let unit = |&number: &usize| if values[number] == 0.0 { 1.0 } else { values[number].abs() };
        let units = free.iter().map(unit).collect();
        let mut problem =
            Self { start, numbers, points, volume, free, values, units, trial: Trial::Refused(None) };
        problem.trial = problem.attempt();
        problem
    }

    fn attempt(&self) -> Trial {
        let Ok(candidate) = self.start.with_values(&self.numbers.lists(&self.values)) else {
            return Trial::Refused(None);
        };
        let mut responses = Vec::with_capacity(self.points.len());
        for &(point, _) in self.points {
            match respond(candidate.as_ref(), point.mode, self.volume, point.control) {
                Ok(response) => responses.push(response),
                Err(reason) => return Trial::Refused(Some(Unanswered { point, reason })),
            }
        }
        Trial::Answers(candidate, responses)
    }

    /// Whether there is a residual at each point.
    pub(super) fn answers(&self) -> Result<(), Option<Unanswered>> {
        match &self.trial {
            Trial::Answers(..) => Ok(()),
            Trial::Refused(reason) => Err(*reason),
        }
    }

    /// The energy as tried last, or where it was refused, as given.
    pub(super) fn specimen(&self) -> &dyn Candidate {
        match &self.trial {
            Trial::Answers(candidate, _) => candidate.as_ref(),
            Trial::Refused(_) => self.start,
        }
    }

    /// The number of points.
    pub(super) fn count(&self) -> usize {
        self.points.len()
    }

    /// ∂r/∂p of the free numbers p in their own units; `None` where the trial is refused.
    pub(super) fn slopes(&self) -> Option<DMatrix<f64>> {
        let Trial::Answers(candidate, responses) = &self.trial else { return None };
        let mut slopes = DMatrix::zeros(self.points.len(), self.free.len());
        for (row, (response, (_, size))) in responses.iter().zip(self.points).enumerate() {
            let ordered = Ordered::new(response.stretches);
            let by_parameters = candidate.gradient_by_parameters(ordered.numbers);
            for (column, &number) in self.free.iter().enumerate() {
                let gradient = ordered.back(by_parameters[number]);
                let slope: f64 = (0..3).map(|axis| response.weights[axis] * gradient[axis]).sum();
                slopes[(row, column)] = slope / size;
            }
        }
        Some(slopes)
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, multiples: &DVector<f64>) {
        for (k, &number) in self.free.iter().enumerate() {
            self.values[number] = multiples[k] * self.units[k];
        }
        self.trial = self.attempt();
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_fn(self.free.len(), |k, _| self.values[self.free[k]] / self.units[k])
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Trial::Answers(_, responses) = &self.trial else {
            return Some(DVector::from_element(self.points.len(), REFUSED));
        };
        let residual = |(response, (point, size)): (&Response, &(Measured, f64))| {
            (response.stress - point.stress) / size
        };
        Some(DVector::from_iterator(self.points.len(), responses.iter().zip(self.points).map(residual)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut jacobian = self.slopes()?;
        for (mut column, unit) in jacobian.column_iter_mut().zip(&self.units) {
            column *= *unit;
        }
        Some(jacobian)
    }
}
