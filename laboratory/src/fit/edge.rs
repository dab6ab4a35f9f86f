//! Edges of the admissible parameters that keep a search from its minimum.
//!
//! If the Gauss–Newton step d that minimises |r + J d| is worth taking and is refused at any length, the
//! search stands at an edge. Its normal is the gradient of the constraint that refuses, which the declaration
//! of the energy provides ([`Energy::constraints`](piola_declare::Energy::constraints)). Then d is sought in
//! what the edges leave free, each kept only as long as its Lagrange multiplier shows that the step would
//! cross it: the active-set method of quadratic programming \[NW06, section 16.5\].
//!
//! Coordinates are parameters scaled so that each changes the residuals by the length one.
//!
//! \[NW06\] Nocedal, Wright, *Numerical Optimization*, 2nd edition, 2006.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector};
use piola::material::MaterialError;
use piola_declare::{Constraint, Limit};

use super::outcome::TrialError;
use super::problem::{Problem, Trial};
use crate::data::Measured;
use crate::specimen::Ordered;

/// Smallest share by which a step must reduce Σ r². The Levenberg–Marquardt method itself stops at 1e-14.
const GAIN: f64 = 1e-10;
/// Residuals whose squares are below this are rounding errors.
const EXACT: f64 = 1e-24;
/// Halvings of a probe until its end is at the edge: to 1e-12 of it, about as near as rounding of the place
/// allows.
const HALVINGS: usize = 40;
/// A step is refused at once if this share of it is.
const PROBE: f64 = 1e-3;
/// Distances to keep from the edge, relative to the length of the step: one far below any visible change, and
/// one that leaves room to go along a curved edge.
const MARGINS: [f64; 2] = [1e-7, 1e-3];
/// Normals that have less than this outside the span of others belong to one curved edge.
const TURN: f64 = 1e-3;
/// Singular values below this by the greatest belong to directions that do not change the residuals.
const SILENCE: f64 = 1e-10;

/// The edges that stopped a search, and the directions along them.
pub(super) struct Stop {
    pub(super) reasons: Vec<TrialError>,
    /// Ways on downwards along the edges, each a place and directions in columns: next to the edges, and at a
    /// distance that leaves room if they are curved.
    pub(super) ways: Vec<(DVector<f64>, DMatrix<f64>)>,
    /// True if no step is possible, so that this is the best point that the edges allow.
    pub(super) is_least: bool,
}

struct Edge {
    /// Outwards, of the length one.
    normal: DVector<f64>,
    reason: TrialError,
}

/// True if the gain in Σ r² is too small to be worth a step.
pub(super) fn is_no_gain(gain: f64, squares: f64) -> bool {
    gain <= GAIN * squares
}

/// The edges that keep the problem from a better fit at its current place; `None` if no edge does.
pub(super) fn stop(problem: &Problem<'_>) -> Option<Stop> {
    let surroundings = Surroundings::of(problem)?;
    let [mut near, far] = MARGINS.map(|margin| surroundings.stop(margin));
    if let (Some(near), Some(far)) = (&mut near, far) {
        near.ways.extend(far.ways);
    }
    near
}

/// Edges along which no way is known.
fn stuck(edges: Vec<Edge>) -> Stop {
    let reasons = edges.into_iter().map(|edge| edge.reason).collect();
    Stop { reasons, ways: Vec::new(), is_least: false }
}

/// True if a limit, of the domain at a measured point or of the parameters, may be the violated one. The
/// entries of a list are distinguished by their index only.
fn may_refuse(limit: &Limit, at: Option<Measured>, refusal: &TrialError) -> bool {
    match (refusal, limit) {
        (TrialError::Inadmissible(MaterialError::Violated { condition, .. }), Limit::Admissible(own))
        // Where rest is outside, points of the same condition may be too.
        | (TrialError::Inadmissible(MaterialError::RestOutside { condition, .. }), Limit::Domain(own)) => {
            condition == own
        }
        (TrialError::Inadmissible(MaterialError::UnstableRest { moduli }), Limit::ShearModulus) => {
            moduli.mu <= 0.0
        }
        (TrialError::Inadmissible(MaterialError::UnstableRest { moduli }), Limit::BulkModulus) => {
            moduli.mu > 0.0
        }
        (TrialError::Point(error), Limit::Domain(_)) => at == Some(error.point),
        _ => false,
    }
}

/// One in each column.
fn normals(edges: &[Edge]) -> DMatrix<f64> {
    let normals: Vec<_> = edges.iter().map(|edge| edge.normal.clone()).collect();
    DMatrix::from_columns(&normals)
}

/// An orthonormal basis of the space orthogonal to all normals.
fn along(edges: &[Edge], unknowns: usize) -> DMatrix<f64> {
    let mut projection = DMatrix::identity(unknowns, unknowns);
    if !edges.is_empty() {
        let across = normals(edges).qr().q();
        projection -= &across * across.transpose();
    }
    let decomposed = projection.symmetric_eigen();
    // The eigenvalues are 0 and 1.
    let kept: Vec<_> = (0..unknowns).filter(|&k| decomposed.eigenvalues[k] > 0.5).collect();
    decomposed.eigenvectors.select_columns(&kept)
}

/// A problem to first order about its current place.
struct Surroundings<'a, 'b> {
    problem: &'a Problem<'b>,
    /// The length of each column of ∂r/∂p: the coordinate of a parameter is p times this.
    scales: DVector<f64>,
    /// The current place.
    place: DVector<f64>,
    residuals: DVector<f64>,
    slopes: DMatrix<f64>,
    /// The length of the step that no edge hinders.
    reach: f64,
}

impl<'a, 'b> Surroundings<'a, 'b> {
    /// `None` where the residuals are rounding, or numbers leave their range.
    fn of(problem: &'a Problem<'b>) -> Option<Self> {
        let (residuals, (slopes, scales)) = (problem.residuals()?, problem.scaled_slopes()?);
        if residuals.norm_squared() <= EXACT * residuals.len() as f64 {
            return None;
        }
        let place = problem.free_values().component_mul(&scales);
        let unknowns = place.len();
        let mut surroundings = Self { problem, scales, place, residuals, slopes, reach: 0.0 };
        surroundings.reach = surroundings.step(&along(&[], unknowns))?.norm();
        Some(surroundings)
    }

    /// The edges of [`stop`], at this distance from them.
    fn stop(&self, margin: f64) -> Option<Stop> {
        let unknowns = self.place.len();
        let mut edges: Vec<Edge> = Vec::new();
        // Each turn finds an edge; some may be dropped again.
        for _ in 0..2 * unknowns {
            let basis = along(&edges, unknowns);
            let step = self.step(&basis)?;
            // A little away from each edge.
            let away = |place: DVector<f64>, edge: &Edge| place - &edge.normal * (margin * self.reach);
            let from = edges.iter().fold(self.place.clone(), away);
            let is_worth = !is_no_gain((&self.slopes * &step).norm_squared(), self.residuals.norm_squared());
            let refused = self.attempt(&(&from + &step * PROBE)).err().filter(|_| is_worth);
            let Some(refusal) = refused else {
                // Directions by coordinates, converted to directions by free numbers.
                let scaled = |row: usize, column: usize| basis[(row, column)] / self.scales[row];
                let columns = DMatrix::from_fn(unknowns, basis.ncols(), scaled);
                let ways = is_worth.then(|| (from.component_div(&self.scales), columns));
                let stop = Stop { ways: ways.into_iter().collect(), is_least: !is_worth, ..stuck(edges) };
                return (!stop.reasons.is_empty()).then_some(stop);
            };
            let normal = self.normal(&from, &(&step * PROBE), &refusal);
            let Some(normal) = normal.filter(|normal| basis.tr_mul(normal).norm() > TURN) else {
                let mut stop = stuck(edges);
                if stop.reasons.is_empty() {
                    stop.reasons.push(refusal);
                }
                return Some(stop);
            };
            edges.push(Edge { normal, reason: refusal });
            let multipliers = self.multipliers(&edges)?;
            let mut multipliers = multipliers.iter();
            edges.retain(|_| multipliers.next().is_none_or(|&multiplier| multiplier >= 0.0));
        }
        Some(stuck(edges))
    }

    /// A trial at these coordinates.
    fn attempt(&self, place: &DVector<f64>) -> Trial {
        self.problem.task.attempt(&self.problem.with_free(&place.component_div(&self.scales)))
    }

    /// Unit outward normal at the edge that a probe meets; `None` if the edge is not a constraint of the
    /// declaration.
    fn normal(
        &self,
        from: &DVector<f64>,
        probe: &DVector<f64>,
        refusal: &TrialError,
    ) -> Option<DVector<f64>> {
        let (mut inside, mut outside) = (from - probe, from + probe);
        self.attempt(&inside).ok()?;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (&inside + &outside);
            let is_inside = self.attempt(&middle).is_ok();
            *(if is_inside { &mut inside } else { &mut outside }) = middle;
        }
        let (material, responses) = self.attempt(&inside).ok()?;
        let task = &self.problem.task;
        let energy = &task.start.energy;
        let of_parameters = energy.constraints(&material).into_iter().map(|constraint| (constraint, None));
        // That free sides give way when a parameter changes is left out.
        let of_domain = responses.iter().zip(task.points).flat_map(|(response, &(point, _))| {
            let ordered = Ordered::new(response.stretches);
            let constraints = energy.domain_constraints(&material, ordered.numbers);
            constraints.into_iter().map(move |constraint| (constraint, Some(point)))
        });
        let refusing = of_parameters
            .chain(of_domain)
            .filter(|(constraint, point)| may_refuse(&constraint.limit, *point, refusal));
        let distances = refusing.map(|(Constraint { value, gradient, .. }, _)| {
            let normal = DVector::from_fn(task.free.len(), |k, _| gradient[task.free[k]] / self.scales[k]);
            let length = normal.norm();
            (value / length, -normal / length)
        });
        distances.min_by(|(one, _), (other, _)| one.total_cmp(other)).map(|(_, normal)| normal)
    }

    /// The step d in the span of the basis that makes |r + J d| least.
    fn step(&self, basis: &DMatrix<f64>) -> Option<DVector<f64>> {
        if basis.ncols() == 0 {
            return Some(DVector::zeros(basis.nrows()));
        }
        let decomposed = (&self.slopes * basis).svd(true, true);
        let silence = SILENCE * decomposed.singular_values.max();
        let step = decomposed.solve(&-&self.residuals, silence).ok()?;
        Some(basis * step).filter(|step| step.iter().all(|component| component.is_finite()))
    }

    /// Lagrange multipliers of the edges for the step that keeps to all of them: Jᵀ (r + J d) + Σ multiplier
    /// · normal = 0.
    fn multipliers(&self, edges: &[Edge]) -> Option<DVector<f64>> {
        let step = self.step(&along(edges, self.place.len()))?;
        let rest = self.slopes.tr_mul(&(&self.residuals + &self.slopes * step));
        normals(edges).svd(true, true).solve(&-rest, 0.0).ok()
    }
}
