//! Options for the time steps.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use piola_bodies::step::Integrator;

use crate::output::Newton;
use crate::settings::Settings;

/// Overrides of the steps of a scene.
#[derive(Clone, Debug, PartialEq, Args)]
#[non_exhaustive]
pub struct StepOptions {
    /// Time step in s [default: the scene's, 1/30].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub dt: Option<f64>,

    /// Method by which steps advance in time: sdirk2 and sdirk3 have two and three stages, each as much work
    /// as a step of implicit Euler, and errors of second and third order.
    #[arg(long, value_name = "METHOD", value_parser = integrators(), default_value = "implicit-euler")]
    pub integrator: Integrator,

    /// Largest error of the motion from time steps, in body heights per second: each frame is made in steps
    /// as short as that requires. Best with --integrator sdirk2 and --newton full.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,

    /// Accuracy of each step: one Newton iteration with line search, or iterations until the residual is
    /// small.
    #[arg(long, value_enum, default_value_t = Newton::Single)]
    pub newton: Newton,
}

impl StepOptions {
    /// Settings with these overrides.
    #[must_use]
    pub fn apply(&self, settings: Settings) -> Settings {
        let &Self { integrator, tolerance, newton, dt } = self;
        let dt = dt.unwrap_or(settings.dt);
        Settings { dt, integrator, tolerance, newton, ..settings }
    }
}

fn integrators() -> impl TypedValueParser<Value = Integrator> {
    PossibleValuesParser::new(["implicit-euler", "sdirk2", "sdirk3"]).map(|name| match name.as_str() {
        "sdirk2" => Integrator::Sdirk2,
        "sdirk3" => Integrator::Sdirk3,
        _ => Integrator::ImplicitEuler,
    })
}
