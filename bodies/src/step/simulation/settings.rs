//! Settings of a simulation, and their checks.

use crate::step::damping::Damping;
use crate::step::error::SetupError;
use crate::step::integrator::Integrator;
use crate::step::line_search::LineSearchSettings;
use crate::step::newton::NewtonSettings;

/// Settings of a [`Simulation`](super::Simulation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct SimulationSettings {
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// Forces against velocity.
    pub damping: Damping,
    /// Method by which steps advance in time.
    pub integrator: Integrator,
    /// Settings of the minimisation in each stage of a step.
    pub newton: NewtonSettings,
    /// Settings of the line search, which shortens Newton steps.
    pub line_search: LineSearchSettings,
}

crate::chained::chained!(SimulationSettings {
    with_gravity(gravity: [f64; 3]),
    with_damping(damping: Damping),
    with_integrator(integrator: Integrator),
    with_newton(newton: NewtonSettings),
    with_line_search(line_search: LineSearchSettings),
});

/// Checks that all settings are in range.
pub(super) fn check_settings(settings: &SimulationSettings) -> Result<(), SetupError> {
    let SimulationSettings { gravity, damping, newton, line_search, .. } = settings;
    let between = |x: f64, low: f64, high: f64| low < x && x < high;
    let checks = [
        (gravity.iter().all(|g| g.is_finite()), "gravity must be finite"),
        (newton.max_iterations > 0, "Newton's method needs at least one iteration"),
        (newton.tolerance >= 0.0 && newton.tolerance < 1.0, "the tolerance must be at least 0 and below 1"),
        (
            newton.error_share >= 0.0 && newton.error_share < 1.0,
            "the share of a step's error must be at least 0 and below 1",
        ),
        (
            between(line_search.sufficient_decrease, 0.0, 0.5),
            "the sufficient decrease must be between 0 and 1/2",
        ),
        (between(line_search.shrink, 0.0, 1.0), "the shrinking factor must be between 0 and 1"),
        (line_search.max_trials > 0, "the line search needs at least one trial"),
    ];
    let broken = checks.into_iter().find(|(holds, _)| !holds).map(|(_, rule)| rule);
    let broken = broken.or(damping.broken_rule());
    match broken.or(newton.linear.broken_rule()) {
        Some(rule) => Err(SetupError::Setting { rule }),
        None => Ok(()),
    }
}
