//! Residuals and their derivatives, as functions of the parameters that are free.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use piola::material::{Constraint, Limit, MaterialError, Moduli};

use super::candidate::{Candidate, Numbers};
use super::trial::TrialError;
use crate::curve::{Mode, Response, Volume, respond};
use crate::data::{Measured, PointError};
use crate::specimen::{self, Ordered};

/// Each residual of a trial that the energy refuses. Far above those of any trial that it does not, it makes
/// the method take a shorter step; its square is a number still.
const REFUSED: f64 = 1e100;

/// Energy to be fitted, and the points that count.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) start: &'a dyn Candidate,
    pub(super) numbers: &'a Numbers,
    /// Points, each with the divisor of its difference.
    pub(super) points: &'a [(Measured, f64)],
    pub(super) volume: Volume,
}

pub(super) struct Problem<'a> {
    task: Task<'a>,
    /// Indices of the free numbers.
    pub(super) free: Vec<usize>,
    /// All numbers, those held included.
    pub(super) values: Vec<f64>,
    /// The free numbers in the units of the Levenberg–Marquardt method.
    coordinates: Coordinates,
    trial: Trial,
}

/// A constraint on the free numbers.
pub(super) struct Bound {
    limit: Limit,
    /// The measured point, if the domain of the energy has to reach it.
    point: Option<Measured>,
    /// Positive where the constraint holds.
    pub(super) value: f64,
    /// The derivative of the value with respect to each free number.
    pub(super) gradient: DVector<f64>,
}

impl Bound {
    /// True if this may be the violated constraint. The entries of a list are distinguished by their index
    /// only.
    pub(super) fn refuses(&self, error: &TrialError) -> bool {
        match (error, &self.limit) {
            (TrialError::Inadmissible(MaterialError::Violated { condition, .. }), Limit::Admissible(own)) => {
                condition == own
            }
            (TrialError::Inadmissible(MaterialError::UnstableRest { moduli }), Limit::ShearModulus) => {
                moduli.mu <= 0.0
            }
            (TrialError::Inadmissible(MaterialError::UnstableRest { moduli }), Limit::BulkModulus) => {
                moduli.mu > 0.0
            }
            // Where rest is outside, points of the same condition may be too.
            (TrialError::Inadmissible(MaterialError::RestOutside { condition, .. }), Limit::Domain(own)) => {
                condition == own
            }
            (TrialError::Point(error), Limit::Domain(_)) => self.point == Some(error.point),
            _ => false,
        }
    }
}

/// The free numbers are `origin` + `basis` · `place`, and `place` is what the method changes.
struct Coordinates {
    origin: DVector<f64>,
    basis: DMatrix<f64>,
    place: DVector<f64>,
}

/// Result of a trial: the energy with its parameters and its response at each point, or the reason for a
/// refusal.
type Trial = Result<(Box<dyn Candidate>, Vec<Response>), TrialError>;

impl Task<'_> {
    fn attempt(&self, values: &[f64]) -> Trial {
        let candidate = self.start.with_values(&self.numbers.lists(values))?;
        let mut responses = Vec::with_capacity(self.points.len());
        for &(point, _) in self.points {
            let response = respond(candidate.as_ref(), point.mode, self.volume, point.control);
            responses.push(response.map_err(|reason| PointError { point, reason })?);
        }
        Ok((candidate, responses))
    }
}

impl<'a> Problem<'a> {
    /// Each free number is sought in units of its value here.
    pub(super) fn new(task: Task<'a>, free: Vec<usize>, values: Vec<f64>) -> Self {
        let unit = |&number: &usize| if values[number] == 0.0 { 1.0 } else { values[number].abs() };
        let units = DVector::from_iterator(free.len(), free.iter().map(unit));
        let coordinates = Coordinates {
            origin: DVector::zeros(free.len()),
            place: DVector::from_fn(free.len(), |k, _| values[free[k]] / units[k]),
            basis: DMatrix::from_diagonal(&units),
        };
        let trial = task.attempt(&values);
        Self { task, free, values, coordinates, trial }
    }

    /// A new problem at the current place, all free numbers in units of their current values.
    pub(super) fn anew(&self) -> Self {
        Self::new(self.task, self.free.clone(), self.values.clone())
    }

    /// A problem whose free numbers are `origin` plus any combination of the columns of `basis`.
    pub(super) fn within(&self, origin: DVector<f64>, basis: DMatrix<f64>) -> Self {
        let values = self.with_free(&origin);
        let trial = self.task.attempt(&values);
        let place = DVector::zeros(basis.ncols());
        let coordinates = Coordinates { origin, basis, place };
        Self { task: self.task, free: self.free.clone(), values, coordinates, trial }
    }

    /// A problem in which only these coordinates change.
    pub(super) fn with_alone(&self, changing: &[usize]) -> Self {
        let Coordinates { basis, place, .. } = &self.coordinates;
        let (basis, place) = (basis.select_columns(changing), place.select_rows(changing));
        let mut alone = self.within(self.place(), basis);
        // Not from zero: the method makes its first steps as long as what it begins from is, in units of what
        // is changed.
        alone.coordinates.origin -= &alone.coordinates.basis * &place;
        alone.coordinates.place = place;
        alone
    }

    /// All numbers, with these for the free ones.
    fn with_free(&self, free: &DVector<f64>) -> Vec<f64> {
        let mut values = self.values.clone();
        for (&number, &value) in self.free.iter().zip(free.iter()) {
            values[number] = value;
        }
        values
    }

    pub(super) fn place(&self) -> DVector<f64> {
        DVector::from_iterator(self.free.len(), self.free.iter().map(|&number| self.values[number]))
    }

    /// Succeeds if there is a residual at each point with these free numbers.
    pub(super) fn accepts(&self, free: &DVector<f64>) -> Result<(), TrialError> {
        self.task.attempt(&self.with_free(free)).map(drop)
    }

    /// Succeeds if there is a residual at each point.
    pub(super) fn answers(&self) -> Result<(), TrialError> {
        self.trial.as_ref().map(|_| ()).map_err(Clone::clone)
    }

    /// The constraints on the free numbers at the current place: those of the parameters, and for each point
    /// those of the domain at its stretches. That free sides give way when a parameter changes is left out of
    /// these.
    pub(super) fn bounds(&self) -> Vec<Bound> {
        let Ok((candidate, responses)) = &self.trial else { return Vec::new() };
        let bound = |Constraint { limit, value, gradient }: Constraint, point| {
            let gradient = DVector::from_iterator(self.free.len(), self.free.iter().map(|&k| gradient[k]));
            Bound { limit, point, value, gradient }
        };
        let of_parameters = candidate.constraints().into_iter().map(|constraint| bound(constraint, None));
        let of_domain = responses.iter().zip(self.task.points).flat_map(|(response, &(point, _))| {
            let constraints = candidate.domain_constraints(Ordered::new(response.stretches).numbers);
            constraints.into_iter().map(move |constraint| bound(constraint, Some(point)))
        });
        of_parameters.chain(of_domain).collect()
    }

    /// The energy as tried last, or where it was refused, as given.
    pub(super) fn specimen(&self) -> &dyn Candidate {
        match &self.trial {
            Ok((candidate, _)) => candidate.as_ref(),
            Err(_) => self.task.start,
        }
    }

    /// The small-strain moduli of the energy as tried last, if specimens were made to keep a volume that it
    /// might change.
    ///
    /// Simple shear keeps the volume of every solid.
    pub(super) fn moduli_if_volume_is_imposed(&self) -> Option<Moduli> {
        let is_imposed = self.task.points.iter().any(|(point, _)| point.mode != Mode::SimpleShear);
        (self.task.volume == Volume::Kept && is_imposed).then(|| specimen::moduli(self.specimen()))
    }

    pub(super) fn count(&self) -> usize {
        self.task.points.len()
    }

    /// ∂r/∂p of the free numbers p in their own units; `None` where the trial is refused.
    pub(super) fn slopes(&self) -> Option<DMatrix<f64>> {
        let Ok((candidate, responses)) = &self.trial else { return None };
        let mut slopes = DMatrix::zeros(self.task.points.len(), self.free.len());
        for (row, (response, (_, size))) in responses.iter().zip(self.task.points).enumerate() {
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

    fn set_params(&mut self, place: &DVector<f64>) {
        let Coordinates { origin, basis, .. } = &self.coordinates;
        self.values = self.with_free(&(origin + basis * place));
        self.trial = self.task.attempt(&self.values);
        self.coordinates.place.copy_from(place);
    }

    fn params(&self) -> DVector<f64> {
        self.coordinates.place.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Ok((_, responses)) = &self.trial else {
            return Some(DVector::from_element(self.task.points.len(), REFUSED));
        };
        let residual = |(response, (point, size)): (&Response, &(Measured, f64))| {
            (response.stress - point.stress) / size
        };
        Some(DVector::from_iterator(
            self.task.points.len(),
            responses.iter().zip(self.task.points).map(residual),
        ))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        Some(self.slopes()? * &self.coordinates.basis)
    }
}
