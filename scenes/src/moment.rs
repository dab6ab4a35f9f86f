//! A moment of a scene in motion, to continue from.

use std::path::Path;
use std::sync::Arc;

use piola_bodies::step::Integrator;
use serde::{Deserialize, Serialize};

use crate::clock::Clock;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::play::Play;
use crate::settings::Settings;

/// Complete state of a scene in motion, which determines all later steps to the last bit; JSON keeps every
/// bit of it.
///
/// A body from files is not part of it, nor are their names: set the files of the settings again. A checksum
/// detects another body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moment {
    /// The scene and its overrides, with material and time step as they were.
    pub settings: Settings,
    /// [`Geometry::checksum`] of the body.
    body: u32,
    /// Number and time of the last step.
    pub clock: Clock,
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
    /// The present moment.
    #[must_use]
    pub fn of(play: &Play) -> Self {
        let Play { settings, geometry, simulation, clock, .. } = play;
        let counts = clock.frame > 0 && settings.integrator != Integrator::ImplicitEuler;
        Self {
            settings: settings.clone(),
            body: geometry.checksum(),
            clock: *clock,
            positions: simulation.positions().to_vec(),
            velocities: simulation.velocities().to_vec(),
            accelerations: if counts { simulation.accelerations().to_vec() } else { Vec::new() },
        }
    }

    /// The scene in motion again, by the body that [`Geometry::load`] makes of the settings.
    ///
    /// # Errors
    /// [`Error::Usage`] if it is another one or the clock is wrong, [`Error::Setup`] unless there is one
    /// finite position, velocity and acceleration for each node, and those of [`Play::new`].
    pub fn resume(&self, geometry: impl Into<Arc<Geometry>>) -> Result<Play, Error> {
        let geometry: Arc<Geometry> = geometry.into();
        if !self.clock.is_sound() || self.clock.dt != self.settings.dt {
            return Err(Error::Usage("the state cannot be resumed: its clock is wrong".into()));
        }
        if self.body != geometry.checksum() {
            let Settings { files, body, .. } = &self.settings;
            let name = files.as_ref().map_or(Path::new(body.name), |files| &files.mesh);
            return Err(Error::Usage(format!(
                "the state belongs to another body than {}; give the mesh that it was saved with by --mesh (and \
                 --surface), or none for a body of the program",
                name.display()
            )));
        }
        let mut play = Play::new(self.settings.clone(), geometry)?;
        play.resume(self.clock, &self.positions, &self.velocities)?;
        if !self.accelerations.is_empty() {
            play.simulation.set_accelerations(&self.accelerations)?;
        }
        Ok(play)
    }
}
