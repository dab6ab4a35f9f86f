//! A scene that is played with: every act has its effect before some step, and the same acts before the same steps give
//! the same bits.
//!
//! This module knows no threads, no clock on the wall and no sockets.

use std::collections::BTreeMap;

use piola::mesh::embed::Anchor;
use piola::step::StepReport;
use serde::{Deserialize, Serialize};

use super::protocol::Act;
use super::state::State;
use piola_scenes::energy::Energy;
use piola_scenes::error::Error;
use piola_scenes::geometry::Geometry;
use piola_scenes::play::Play;
use piola_scenes::settings::Settings;

/// More would be no pulls by people.
const MAX_PULLS: usize = 64;
/// Numbers of hands in files are below it, so that there are others for hands to come.
const MAX_HAND: u64 = 1 << 62;
/// How far a pull may lead from where the vertex is at rest, in body heights.
const REACH: f64 = 100.0;
/// How fast a hand moves at most, in body heights per second.
///
/// A mouse is somewhere else from one step to the next. A body torn along that fast, tens of heights in a second, may fold
/// into itself and find another equilibrium from which no elastic energy brings it back.
const SPEED: f64 = 4.0;

/// A body, what it is made of at present, and who pulls at it.
#[derive(Debug)]
pub struct Session {
    geometry: Geometry,
    /// As they are now.
    settings: Settings,
    energy_at_start: Energy,
    play: Play,
    pulls: BTreeMap<u64, Held>,
    saved: Option<State>,
    steps: u64,
}

/// What a hand holds, and where it draws it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Held {
    /// A vertex of the surface.
    pub vertex: usize,
    /// The point that the hand is on its way to, m.
    pub target: [f64; 3],
    /// Where the hand is, m; a spring joins it to the vertex.
    pub place: [f64; 3],
}

impl Session {
    /// The scene before its first step.
    ///
    /// # Errors
    /// Where the settings make no sense or do not fit the body.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        let settings = Settings { energy: settings.energy.explicit()?, ..settings };
        let geometry = Geometry::load(&settings)?;
        let play = Play::new(&settings, &geometry)?;
        let (pulls, energy_at_start) = (BTreeMap::new(), settings.energy.clone());
        Ok(Self { geometry, settings, energy_at_start, play, pulls, saved: None, steps: 0 })
    }

    /// Goes on from where a state was kept, to the last bit.
    ///
    /// # Errors
    /// As [`Session::new`], and where the state does not fit the body.
    pub fn resume(state: State) -> Result<Self, Error> {
        let mut session = Self::new(state.settings.clone())?;
        session.go_to(&state)?;
        session.saved = Some(state);
        Ok(session)
    }

    /// The state, to go on from.
    #[must_use]
    pub fn state(&self) -> State {
        let simulation = self.play.simulation();
        State::new(
            self.settings.clone(),
            self.energy_at_start.clone(),
            self.play.clock(),
            [simulation.positions(), simulation.velocities()],
            self.pulls.clone(),
        )
    }

    /// The body's shape at rest, and its surface.
    #[must_use]
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// What is played, with material and time step as they are now.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The body in motion.
    #[must_use]
    pub fn play(&self) -> &Play {
        &self.play
    }

    /// Who pulls at what, beside the scene.
    pub fn pulls(&self) -> impl Iterator<Item = (u64, Held)> {
        self.pulls.iter().map(|(&hand, &held)| (hand, held))
    }

    /// The state that was kept last.
    #[must_use]
    pub fn saved(&self) -> Option<&State> {
        self.saved.as_ref()
    }

    /// How many steps have been made in this session, whatever was reset between them.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Makes the next step, in the rayon pool where it is called.
    ///
    /// # Errors
    /// [`Error::Step`]; the state before the step is then untouched.
    pub fn step(&mut self) -> Result<StepReport, Error> {
        let way = SPEED * self.geometry.mesh.bounds().size()[1] * self.settings.dt;
        let mut pulls = self.pulls.clone();
        for held in pulls.values_mut() {
            held.place = towards(held.place, held.target, way);
        }
        let springs = pulls.values().filter_map(|held| {
            let anchor = self.geometry.anchor(held.vertex)?;
            Some(self.play.pull_at(anchor, held.place))
        });
        self.play.hold(springs.collect());
        let report = self.play.step()?;
        self.pulls = pulls;
        self.steps += 1;
        Ok(report)
    }

    /// Does what a page asks for, before the next step.
    ///
    /// # Errors
    /// Where it cannot be done. The state is then as before.
    pub fn apply(&mut self, act: &Act) -> Result<(), Error> {
        match act {
            &Act::Pull { hand, vertex, target } => self.pull(hand, vertex, target),
            Act::Release { hand } => {
                self.pulls.remove(hand);
                Ok(())
            }
            Act::ReleaseAll {} => {
                self.pulls.clear();
                Ok(())
            }
            Act::Material { name, as_stiff } => {
                let energy = self.material(name, *as_stiff)?;
                self.change(Settings { energy, ..self.settings.clone() })
            }
            Act::Parameter { name, values } => {
                let energy = self.settings.energy.clone().with(name, values.clone());
                self.change(Settings { energy, ..self.settings.clone() })
            }
            &Act::TimeStep { seconds } => {
                let settings = Settings { dt: seconds, ..self.settings.clone() };
                settings.check()?;
                self.settings = settings;
                self.play.set_dt(seconds);
                Ok(())
            }
            Act::Reset {} => {
                self.play = Play::new(&self.settings, &self.geometry)?;
                self.pulls.clear();
                Ok(())
            }
            Act::Save {} => {
                self.saved = Some(self.state());
                Ok(())
            }
            Act::Restore {} => {
                let nothing = || Error::Setup { reason: "no state has been saved yet".into() };
                let state = self.saved.take().ok_or_else(nothing)?;
                let result = self.go_to(&state);
                self.saved = Some(state);
                result
            }
        }
    }

    fn pull(&mut self, hand: u64, vertex: usize, target: [f64; 3]) -> Result<(), Error> {
        let anchor = self.check(vertex, target)?;
        // One that holds already moves on; a new one begins where the vertex is.
        let holds = self.pulls.get(&hand).filter(|held| held.vertex == vertex).map(|held| held.place);
        let place = holds.unwrap_or_else(|| anchor.position(self.play.simulation().positions()));
        if self.pulls.len() >= MAX_PULLS && !self.pulls.contains_key(&hand) {
            let (quantity, value) = ("the number of pulls", (MAX_PULLS + 1) as f64);
            return Err(Error::OutOfRange { quantity, value, requirement: "at most 64" });
        }
        self.pulls.insert(hand, Held { vertex, target, place });
        Ok(())
    }

    /// The point of the body that a pull holds, if there is that vertex and the target is not out of the world.
    fn check(&self, vertex: usize, target: [f64; 3]) -> Result<Anchor, Error> {
        let anchor = self.geometry.anchor(vertex).ok_or(Error::OutOfRange {
            quantity: "the vertex of a pull",
            value: vertex as f64,
            requirement: "one of the surface",
        })?;
        let rest = &self.geometry.mesh;
        let reach = REACH * rest.bounds().size()[1];
        let place = anchor.position(&rest.positions);
        // What is no number is nowhere near.
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

    /// The material of that name, with the parameters that it had at the start, or else typical ones.
    fn material(&self, name: &str, as_stiff: bool) -> Result<Energy, Error> {
        if self.energy_at_start.is(name) {
            return Ok(self.energy_at_start.clone());
        }
        if as_stiff { Energy::like(name, self.play.moduli()).explicit() } else { Energy::typical(name) }
    }

    /// Makes the body another one where it is, with the speed that it has.
    fn change(&mut self, settings: Settings) -> Result<(), Error> {
        let mut play = Play::new(&settings, &self.geometry)?;
        let simulation = self.play.simulation();
        play.resume(self.play.clock(), simulation.positions(), simulation.velocities())?;
        (self.play, self.settings) = (play, settings);
        Ok(())
    }

    /// Makes the state what it was. All or nothing.
    fn go_to(&mut self, state: &State) -> Result<(), Error> {
        let unsound =
            |reason: &str| Error::File { reason: format!("the state cannot be gone on from: {reason}") };
        if !state.clock.is_sound() || state.clock.dt() != state.settings.dt {
            return Err(unsound("its clock is wrong"));
        }
        let mut play = Play::new(&state.settings, &self.geometry)?;
        play.resume(state.clock, &state.positions, &state.velocities)?;
        if state.pulls.len() > MAX_PULLS || state.pulls.keys().any(|&hand| hand >= MAX_HAND) {
            return Err(unsound("it has too many pulls"));
        }
        for held in state.pulls.values() {
            self.check(held.vertex, held.target)?;
            self.check(held.vertex, held.place)?;
        }
        self.play = play;
        self.settings = state.settings.clone();
        self.energy_at_start = state.energy_at_start.clone();
        self.pulls = state.pulls.clone();
        Ok(())
    }
}

/// From one point to another, but at most so far.
fn towards(from: [f64; 3], to: [f64; 3], way: f64) -> [f64; 3] {
    let by: [f64; 3] = std::array::from_fn(|c| to[c] - from[c]);
    let distance = by.iter().map(|x| x * x).sum::<f64>().sqrt();
    if distance <= way { to } else { std::array::from_fn(|c| from[c] + way / distance * by[c]) }
}
