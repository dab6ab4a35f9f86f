//! A moment of a scene in motion, to continue from.

use piola_bodies::step::Integrator;
use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::play::Play;
use crate::settings::{Files, Settings};

/// Complete state of a scene in motion, which determines all later steps to the last bit; JSON keeps every
/// bit of it. Only backward differences restart, without the step before.
///
/// A body from files is not part of it, nor are their names: [`with_files`](Self::with_files) supplies them
/// again, and a checksum detects another body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moment {
    settings: Settings,
    /// [`Geometry::checksum`] of the body.
    body: u32,
    clock: Clock,
    /// Position of each node, m.
    positions: Vec<[f64; 3]>,
    /// Velocity of each node, m/s.
    velocities: Vec<[f64; 3]>,
    /// Acceleration of each node, m/s², after steps of an integrator that has them: they determine the
    /// accuracy to which the next step is solved.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    accelerations: Vec<[f64; 3]>,
}

impl Moment {
    /// The present moment of a body with these settings.
    #[must_use]
    pub fn of(settings: &Settings, geometry: &Geometry, play: &Play) -> Self {
        let simulation = play.simulation();
        let counts = play.clock().frame() > 0 && settings.integrator != Integrator::ImplicitEuler;
        Self {
            settings: settings.clone(),
            body: geometry.checksum(),
            clock: play.clock(),
            positions: simulation.positions().to_vec(),
            velocities: simulation.velocities().to_vec(),
            accelerations: if counts { simulation.accelerations().to_vec() } else { Vec::new() },
        }
    }

    /// Takes the body from files, or, with `None`, that of the program.
    #[must_use]
    pub fn with_files(mut self, files: Option<Files>) -> Self {
        self.settings.files = files;
        self
    }

    /// The scene and its overrides, with material and time step as they were.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Number and time of the last step.
    #[must_use]
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// The scene in motion again, by the body that [`Geometry::load`] makes of the settings.
    ///
    /// # Errors
    /// [`Error::OtherBody`] if it is another one, [`Error::Unsound`] if the clock is wrong, [`Error::Setup`]
    /// unless there is one finite position, velocity and acceleration for each node, and those of
    /// [`Play::new`].
    pub fn resume(&self, geometry: &Geometry) -> Result<Play, Error> {
        if !self.clock.is_sound() || self.clock.dt() != self.settings.dt {
            return Err(Error::Unsound("its clock is wrong"));
        }
        if self.body != geometry.checksum() {
            return Err(Error::OtherBody { body: self.settings.body_name() });
        }
        let mut play = Play::new(&self.settings, geometry)?;
        play.resume(self.clock, &self.positions, &self.velocities)?;
        if !self.accelerations.is_empty() {
            play.simulation_mut().set_accelerations(&self.accelerations)?;
        }
        Ok(play)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Newton;
    use crate::scene::{Body, HORSE, TWIST};

    fn moment() -> (Moment, Geometry) {
        moment_after(&Settings::new(&HORSE).with_body(Body::BAR), 1)
    }

    fn moment_after(settings: &Settings, frames: usize) -> (Moment, Geometry) {
        let geometry = Geometry::load(settings).expect("a body of the program");
        let mut play = Play::new(settings, &geometry).expect("a scene that plays");
        (0..frames).for_each(|_| drop(play.step().expect("a step")));
        (Moment::of(settings, &geometry, &play), geometry)
    }

    fn written(moment: &Moment) -> String {
        serde_json::to_string(moment).expect("JSON")
    }

    #[test]
    fn the_steps_to_come_are_the_same_to_the_last_bit() {
        let (moment, geometry) = moment();
        let mut play = moment.resume(&geometry).expect("a moment that plays");
        let read: Moment = serde_json::from_str(&written(&moment)).expect("a moment");
        let mut again = read.resume(&geometry).expect("a moment that plays");
        for _ in 0..3 {
            play.step().expect("a step");
            again.step().expect("a step");
        }
        let end = |play| written(&Moment::of(moment.settings(), &geometry, play));
        assert!(end(&play) == end(&again), "the moment went on in another way");
        assert_eq!(play.clock().frame(), 4);
    }

    /// Integrators of higher order use them to judge the accuracy of a step.
    #[test]
    fn accelerations_go_on_as_well() {
        for integrator in [Integrator::Sdirk2, Integrator::Sdirk3] {
            let settings = Settings::new(&TWIST).with_integrator(integrator).with_newton(Newton::Full);
            let (whole, geometry) = moment_after(&settings, 12);
            for frame in [0, 1, 7, 11] {
                let (moment, _) = moment_after(&settings, frame);
                let mut play = moment.resume(&geometry).expect("a moment that plays");
                (frame..12).for_each(|_| drop(play.step().expect("a step")));
                let end = written(&Moment::of(&settings, &geometry, &play));
                assert!(end == written(&whole), "{integrator:?} went on in another way after frame {frame}");
            }
        }
    }

    #[test]
    fn another_body_is_refused_by_name() {
        let (moment, _) = moment();
        let dinosaur = Geometry::of(Body::DINOSAUR).expect("a body of the program");
        let error = moment.resume(&dinosaur).expect_err("another body").to_string();
        assert!(error.contains("another body than bar"), "{error}");
        let files = Files { mesh: "cage.msh".into(), surface: None };
        let moment = moment.with_files(Some(files));
        assert!(!written(&moment).contains("cage"), "a moment names a file");
        let error = moment.resume(&dinosaur).expect_err("another body").to_string();
        assert!(error.contains("cage.msh"), "{error}");
    }

    #[test]
    fn a_moment_to_which_no_steps_lead_is_refused() {
        let (moment, geometry) = moment();
        let refused = |change: &dyn Fn(&mut Moment), guilty: &str| {
            let mut changed = moment.clone();
            change(&mut changed);
            let error = changed.resume(&geometry).expect_err(guilty).to_string();
            assert!(error.contains(guilty), "`{guilty}` is not in: {error}");
        };
        refused(&|moment| moment.clock = Clock::new(0.5), "clock");
        refused(&|moment| moment.positions.truncate(2), "found 2");
        refused(&|moment| moment.velocities[3][1] = f64::NAN, "finite");
        refused(&|moment| moment.accelerations = vec![[0.0; 3]; 2], "found 2");
        refused(&|moment| moment.settings.density = -1.0, "density");
    }
}
