//! Interactive scene: every act takes effect before some step, and the same acts before the same steps give
//! the same bits.
//!
//! This module is independent of threads, clocks and sockets.

use std::collections::BTreeMap;
use std::sync::Arc;

use piola_bodies::mesh::Anchor;
use piola_bodies::step::{Spring, StepReport};
use piola_declare::Energy;
use piola_scenes::error::Error;
use piola_scenes::geometry::Geometry;
use piola_scenes::material::MaterialSpec;
use piola_scenes::moment::Moment;
use piola_scenes::play::Play;
use piola_scenes::settings::Settings;

use crate::protocol::Act;
use crate::state::{Drag, MAX_DRAG, State};
use crate::typed;

/// Maximum number of simultaneous pulls.
const MAX_PULLS: usize = 64;
/// Greatest distance of a pull's target from the rest position of the vertex, in body heights.
const REACH: f64 = 100.0;
/// Greatest speed of a drag, in body heights per second.
///
/// A mouse jumps from one step to the next. A body pulled that fast, tens of heights in a second, may fold
/// into itself and find another equilibrium from which no elastic energy brings it back.
const SPEED: f64 = 4.0;

/// A scene in motion, and the pulls of pages at it.
#[derive(Debug)]
pub struct Session {
    play: Play,
    material_at_start: MaterialSpec,
    pulls: BTreeMap<u64, Drag>,
    saved: Option<State>,
}

impl Session {
    /// A session before the first step of its scene.
    ///
    /// # Errors
    /// An error of the settings or of the body, or of a material that is not defined at the start.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        let material_at_start = settings.material.explicit()?;
        let settings = Settings { material: material_at_start.clone(), ..settings };
        let geometry = Geometry::load(&settings)?;
        let play = at_start(settings, geometry)?;
        Ok(Self { play, material_at_start, pulls: BTreeMap::new(), saved: None })
    }

    /// Continues from a saved state, to the last bit.
    ///
    /// # Errors
    /// Like [`Session::new`], and those of [`Moment::resume`].
    pub fn resume(state: State) -> Result<Self, Error> {
        let geometry = Geometry::load(&state.moment.settings)?;
        Self::at(state, geometry)
    }

    /// A session at a state, if all of the state fits the body.
    fn at(state: State, geometry: impl Into<Arc<Geometry>>) -> Result<Self, Error> {
        let play = state.moment.resume(geometry)?;
        let refused = |reason| Error::Usage(format!("the state cannot be resumed: {reason}"));
        if state.pulls.len() > MAX_PULLS {
            return Err(refused("it has more than 64 pulls"));
        }
        if state.pulls.keys().any(|&number| number >= MAX_DRAG) {
            return Err(refused("the number of a pull is 2^62 or more"));
        }
        for drag in state.pulls.values() {
            anchor_for(&play, drag.vertex, drag.target)?;
            anchor_for(&play, drag.vertex, drag.place)?;
        }
        let (material_at_start, pulls) = (state.material_at_start.clone(), state.pulls.clone());
        Ok(Self { play, material_at_start, pulls, saved: Some(state) })
    }

    /// The present state, to be resumed.
    #[must_use]
    pub fn state(&self) -> State {
        State::new(Moment::of(&self.play), self.material_at_start.clone(), self.pulls.clone())
    }

    /// The body in motion, with the current material and time step.
    #[must_use]
    pub fn play(&self) -> &Play {
        &self.play
    }

    /// Pulls of pages, with their numbers.
    pub fn pulls(&self) -> impl Iterator<Item = (u64, Drag)> {
        self.pulls.iter().map(|(&number, &drag)| (number, drag))
    }

    /// The state that was saved last.
    #[must_use]
    pub fn saved(&self) -> Option<&State> {
        self.saved.as_ref()
    }

    /// Makes the next step, in the rayon pool of the caller.
    ///
    /// # Errors
    /// [`Error::Step`]; the state before the step is then untouched.
    pub fn step(&mut self) -> Result<StepReport, Error> {
        let way = SPEED * self.play.height * self.play.settings.dt;
        let mut pulls = self.pulls.clone();
        for drag in pulls.values_mut() {
            drag.place = towards(drag.place, drag.target, way);
        }
        // As stiff as a cube of the body's material and height.
        let stiffness = self.play.moduli.young() * self.play.height;
        let anchors = &self.play.geometry.embedding;
        let springs = pulls.values().filter_map(|drag| {
            let anchor = *anchors.get(drag.vertex)?;
            Some(Spring { anchor, target: drag.place, stiffness })
        });
        self.play.drags = springs.collect();
        let report = self.play.step()?;
        self.pulls = pulls;
        Ok(report)
    }

    /// Executes an act of a page, before the next step.
    ///
    /// # Errors
    /// The reason why the act is refused; the state is then as before.
    pub fn apply(&mut self, act: &Act) -> Result<(), Error> {
        match act {
            &Act::Pull { drag, vertex, target } => self.pull(drag, vertex, target),
            Act::Release { drag } => {
                self.pulls.remove(drag);
                Ok(())
            }
            Act::ReleaseAll {} => {
                self.pulls.clear();
                Ok(())
            }
            Act::Material { name, as_stiff } => self.change(self.material(name, *as_stiff)?),
            Act::Energy { text, parameters } => self.declare(typed::energy(text, parameters)?, parameters),
            Act::Parameter { name, values } => {
                let material = self.play.settings.material.clone();
                self.change(material.with_parameter(name, values.clone()))
            }
            &Act::TimeStep { seconds } => self.play.set_dt(seconds),
            Act::Reset {} => {
                self.play = at_start(self.play.settings.clone(), self.play.geometry.clone())?;
                self.pulls.clear();
                Ok(())
            }
            Act::Save {} => {
                self.saved = Some(self.state());
                Ok(())
            }
            Act::Restore {} => {
                let none = || Error::Usage("no state has been saved yet".into());
                let state = self.saved.clone().ok_or_else(none)?;
                *self = Self::at(state, self.play.geometry.clone())?;
                Ok(())
            }
        }
    }

    /// Replaces the material by an energy with these values, as [`Act::Energy`] does by its text.
    ///
    /// # Errors
    /// An error of the material; the state is then as before.
    pub fn declare(&mut self, energy: Energy, parameters: &BTreeMap<String, Vec<f64>>) -> Result<(), Error> {
        let Play { settings, moduli, .. } = &self.play;
        let material = typed::material(energy, parameters, &settings.material, *moduli)?;
        self.change(material)
    }

    fn pull(&mut self, number: u64, vertex: usize, target: [f64; 3]) -> Result<(), Error> {
        let anchor = anchor_for(&self.play, vertex, target)?;
        // One that holds already moves on; a new one begins where the vertex is.
        let holds = self.pulls.get(&number).filter(|drag| drag.vertex == vertex).map(|drag| drag.place);
        let place = holds.unwrap_or_else(|| anchor.position(self.play.simulation.positions()));
        if self.pulls.len() >= MAX_PULLS && !self.pulls.contains_key(&number) {
            let (quantity, value) = ("the number of pulls", (MAX_PULLS + 1) as f64);
            return Err(Error::OutOfRange { quantity, value, requirement: "at most 64" });
        }
        self.pulls.insert(number, Drag { vertex, target, place });
        Ok(())
    }

    /// The material of that name, with the parameters that it had at the start, or else typical ones.
    fn material(&self, name: &str, as_stiff: bool) -> Result<MaterialSpec, Error> {
        if self.material_at_start.is(name) {
            return Ok(self.material_at_start.clone());
        }
        if as_stiff {
            MaterialSpec::matching(name, self.play.moduli).explicit()
        } else {
            MaterialSpec::typical(name)
        }
    }

    /// Replaces the body by one of another material with the same positions and velocities.
    fn change(&mut self, material: MaterialSpec) -> Result<(), Error> {
        let Play { settings, geometry, simulation, clock, .. } = &self.play;
        let mut play = Play::new(Settings { material, ..settings.clone() }, geometry.clone())?;
        play.resume(*clock, simulation.positions(), simulation.velocities())?;
        self.play = play;
        Ok(())
    }
}

/// The point of the body that a pull holds, if the vertex exists and the target is within reach.
fn anchor_for(play: &Play, vertex: usize, target: [f64; 3]) -> Result<Anchor, Error> {
    let anchor = *play.geometry.embedding.get(vertex).ok_or(Error::OutOfRange {
        quantity: "the vertex of a pull",
        value: vertex as f64,
        requirement: "one of the surface",
    })?;
    let reach = REACH * play.height;
    let place = anchor.position(&play.geometry.mesh.positions);
    // NaN is not near.
    let is_near = |x: f64, place: f64| (x - place).abs() <= reach;
    match target.into_iter().zip(place).find(|&(x, place)| !is_near(x, place)) {
        None => Ok(anchor),
        Some((value, _)) => Err(Error::OutOfRange {
            quantity: "a coordinate of a pull's target",
            value,
            requirement: "at most a hundred body heights from where the vertex is at rest",
        }),
    }
}

/// The body at the start of the scene, if its material is defined there.
fn at_start(settings: Settings, geometry: impl Into<Arc<Geometry>>) -> Result<Play, Error> {
    let mut play = Play::new(settings, geometry)?;
    play.check_start()?;
    Ok(play)
}

/// Moves from one point towards another by a limited distance.
fn towards(from: [f64; 3], to: [f64; 3], way: f64) -> [f64; 3] {
    let by: [f64; 3] = std::array::from_fn(|c| to[c] - from[c]);
    let distance = by.iter().map(|x| x * x).sum::<f64>().sqrt();
    if distance <= way { to } else { std::array::from_fn(|c| from[c] + way / distance * by[c]) }
}
