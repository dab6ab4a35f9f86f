//! Settings of a simulation, and their checks.

use crate::step::error::SetupError;
use crate::step::integrator::Integrator;
use crate::step::newton::NewtonSettings;

/// Settings of a [`Simulation`](super::Simulation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct SimulationSettings {
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// Rate α of damping, 1/s: the force −α m v on each node slows every motion alike, falling too. Implicit
    /// Euler damps in addition to it.
    pub damping: f64,
    /// Method by which steps advance in time.
    pub integrator: Integrator,
    /// Settings of the minimisation in each stage of a step.
    pub newton: NewtonSettings,
}

pub(super) fn check_settings(settings: &SimulationSettings) -> Result<(), SetupError> {
    let SimulationSettings { gravity, damping, newton, .. } = settings;
    let checks = [
        (gravity.iter().all(|g| g.is_finite()), "gravity must be finite"),
        (*damping >= 0.0 && damping.is_finite(), "damping must be finite and not negative"),
        (newton.max_iterations > 0, "Newton's method needs at least one iteration"),
        (newton.tolerance >= 0.0 && newton.tolerance < 1.0, "the tolerance must be at least 0 and below 1"),
        (
            newton.error_share >= 0.0 && newton.error_share < 1.0,
            "the share of a step's error must be at least 0 and below 1",
        ),
    ];
    let broken = checks.into_iter().find(|(holds, _)| !holds).map(|(_, rule)| rule);
    match broken.or(newton.linear.broken_rule()) {
        Some(rule) => Err(SetupError(rule.to_owned())),
        None => Ok(()),
    }
}
