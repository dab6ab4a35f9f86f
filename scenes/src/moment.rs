//! A moment of a scene in motion, to continue from.

use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::play::Play;
use crate::settings::{Files, Settings};

/// Everything that determines the steps to come of a scene, to the last bit; JSON keeps every bit of it.
///
/// A body from files is not part of it, nor are their names: [`with_files`](Self::with_files) gives them
/// again, and a checksum tells whether it is the body that it was.
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
}

impl Moment {
    /// The present moment of a body that moves as these settings say.
    #[must_use]
    pub fn of(settings: &Settings, geometry: &Geometry, play: &Play) -> Self {
        let simulation = play.simulation();
        Self {
            settings: settings.clone(),
            body: geometry.checksum(),
            clock: play.clock(),
            positions: simulation.positions().to_vec(),
            velocities: simulation.velocities().to_vec(),
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
    /// unless there is one finite position and velocity for each node, and those of [`Play::new`].
    pub fn resume(&self, geometry: &Geometry) -> Result<Play, Error> {
        if !self.clock.is_sound() || self.clock.dt() != self.settings.dt {
            return Err(Error::Unsound("its clock is wrong"));
        }
        if self.body != geometry.checksum() {
            return Err(Error::OtherBody { body: self.settings.body_name() });
        }
        let mut play = Play::new(&self.settings, geometry)?;
        play.resume(self.clock, &self.positions, &self.velocities)?;
        Ok(play)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Body, HORSE};

    fn moment() -> (Moment, Geometry) {
        let settings = Settings::new(&HORSE).with_body(Body::BAR);
        let geometry = Geometry::load(&settings).expect("a body of the program");
        let mut play = Play::new(&settings, &geometry).expect("a scene that plays");
        play.step().expect("a step");
        (Moment::of(&settings, &geometry, &play), geometry)
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
        refused(&|moment| moment.settings.density = -1.0, "density");
    }
}
