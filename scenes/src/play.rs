//! A scene in motion.

use std::sync::Arc;

use piola::__private::message::{number, quoted};
use piola::material::{Moduli, Text};
use piola_bodies::mesh::{Bounds, TetMesh};
use piola_bodies::step::divided::Machine;
use piola_bodies::step::{
    self, AdaptiveReport, Integrator, NewtonSettings, Simulation, StepError, StepReport,
};
use piola_bodies::system::{Body, Part, PinError, Pins};
use piola_laboratory::AtRest;
use piola_laboratory::curve::Volume;

use crate::clock::Clock;
use crate::error::{Error, in_range, list};
use crate::fields;
use crate::geometry::{Geometry, NOTHING_PULLED};
use crate::material::{self, MaterialPart, MaterialSpec, Parameters};
use crate::output::{Newton, Overview, StepCounts, short};
use crate::region;
use crate::scene::Pull;
use crate::settings::Settings;

mod start;

pub use start::start_positions;

/// Stiffness of all springs of a pull together, relative to a cube of the body's material and height.
const DRAG_STIFFNESS: f64 = 10.0;

/// Share of a frame below which an event and the frame's end count as simultaneous: times of frames are
/// rounded.
const NEAR: f64 = 1e-6;

/// A scene in motion, step by step.
#[derive(Debug)]
pub struct Play {
    /// The scene and its overrides, with the present material and time step: change that by
    /// [`set_dt`](Self::set_dt).
    pub settings: Settings,
    /// The body at rest, and its surface.
    pub geometry: Arc<Geometry>,
    /// Height of the body at rest, m.
    pub height: f64,
    /// The body and its state, to be moved or pushed before the next step.
    pub simulation: Simulation,
    /// Name of the material, in the catalogue or of its declaration.
    pub material: Text,
    /// Parameters of the material.
    pub parameters: Parameters,
    /// Small-strain moduli of the material.
    pub moduli: Moduli,
    /// The body before its first step.
    pub overview: Overview,
    /// Number of the step and its time: set by [`resume`](Self::resume).
    pub clock: Clock,
    /// Counts of the time steps of the last frame.
    pub steps: StepCounts,
    /// Springs that act in addition to those of the scene, from the next step on.
    pub drags: Vec<step::Spring>,
    pulls: Vec<DragSprings>,
}

impl Play {
    /// A scene before its first step, with the body that [`Geometry::load`] makes of the settings.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], or an error of the material, the pins, the body or the solver.
    pub fn new(settings: Settings, geometry: impl Into<Arc<Geometry>>) -> Result<Self, Error> {
        settings.check()?;
        let geometry: Arc<Geometry> = geometry.into();
        let mesh = &geometry.mesh;
        let simulation = at_start(&settings, &geometry)?;
        let info = settings.material.build()?;
        let young = info.moduli.young();
        let pulls = settings.scene.pulls.iter().map(|&pull| DragSprings::new(pull, mesh, young)).collect();
        let mut play = Self {
            height: mesh.bounds().size()[1],
            overview: Overview::default(),
            simulation,
            material: info.name,
            parameters: info.parameters,
            moduli: info.moduli,
            clock: Clock::new(settings.dt),
            steps: StepCounts::default(),
            drags: Vec::new(),
            pulls,
            settings,
            geometry,
        };
        let start = play.clock.time();
        play.pull(start, start)?;
        play.overview = play.overview()?;
        Ok(play)
    }

    /// Checks that the material is defined at the positions of the body.
    ///
    /// # Errors
    /// [`Error::Usage`], with the materials that could start there.
    pub fn check_start(&mut self) -> Result<(), Error> {
        let has_energy = |simulation: &mut Simulation| simulation.energies().elastic.is_finite();
        if has_energy(&mut self.simulation) {
            return Ok(());
        }
        let Self { settings, geometry, simulation, .. } = &*self;
        let can_start = |name: &&str| {
            let of = |material| Settings { material, parts: Vec::new(), ..settings.clone() };
            let other = MaterialSpec::typical(name).and_then(|typical| at_start(&of(typical), geometry));
            other.is_ok_and(|mut simulation| has_energy(&mut simulation))
        };
        let energies = fields::energies(simulation);
        let mut parts = settings.all_parts().into_iter().zip(simulation.body().materials());
        let undefined = parts.find(|(_, (_, tets))| energies[tets.clone()].iter().any(|x| !x.is_finite()));
        let undefined = undefined.map_or_else(|| settings.material.clone(), |(part, _)| part.material);
        let (name, description) = (undefined.build()?.name, undefined.description()?);
        let (scene, domain) = (settings.scene.name, &description.domain);
        let reason =
            format!("the scene `{scene}` starts where `{name}` is not defined: its domain is {domain}");
        Err(Error::Usage(match description.refusal.as_ref().filter(|_| !description.extends) {
            None => {
                format!("{reason}; leave out --inversion refuse, or choose a scene that starts elsewhere")
            }
            Some(refusal) => {
                let others = material::names().filter(can_start).collect::<Vec<_>>().join(", ");
                format!(
                    "{reason}, and it cannot be extended: {refusal}; choose a scene that starts elsewhere, such as \
                     `stretch`, or another --material or --part: {others}"
                )
            }
        }))
    }

    /// Properties of the body at its start, without parts that have no tetrahedra.
    fn overview(&self) -> Result<Overview, Error> {
        let Self { settings, geometry, simulation, .. } = self;
        let (mesh, body) = (&geometry.mesh, simulation.body());
        let (nodes, held) = (mesh.positions.len(), simulation.pinned().len());
        let (mut materials, mut warnings) = (Vec::new(), geometry.warnings());
        if held == nodes {
            warnings.push(format!("all {nodes} nodes are held, and nothing can move; hold fewer by --pin"));
        } else if held == 0 && settings.gravity != 0.0 {
            warnings.push("no node is held, and the body falls; hold some by --pin".into());
        }
        let is_part = |name: &str| settings.parts.iter().any(|part| part.group.as_deref() == Some(name));
        let others = mesh.groups.iter().filter(|group| group.dimension == 3 && !is_part(&group.name));
        let others: Vec<_> = others.map(|group| &group.name).collect();
        let parts = settings.all_parts().into_iter().zip(body.materials());
        for (MaterialPart { group, material, density }, _) in parts.filter(|(_, (_, tets))| !tets.is_empty())
        {
            let info = material.build()?;
            let (name, at_rest) = (info.name, AtRest { moduli: info.moduli, volume: Volume::Free });
            if !(1.0..=3e4).contains(&density) {
                warnings.push(format!(
                    "the density of {name} is {} kg/m³; is that meant? 1 g/cm³ is 1000 kg/m³, and 1 t/mm³ is 1e12 kg/m³",
                    number(density)
                ));
            }
            warnings.extend(at_rest.warning());
            let groups = group.map_or_else(|| list(&others), |group| list(&[group]));
            let values = |values: Vec<f64>| values.into_iter().map(short).collect::<Vec<_>>().join(",");
            let values = info.parameters.into_iter().map(|(name, list)| format!(" {name}={}", values(list)));
            let material = format!("{name}{}, {} kg/m³", values.collect::<String>(), short(density));
            materials.push(format!("{material}; groups of the mesh: {groups}; at rest {at_rest}"));
        }
        if self.pulls.iter().any(|springs| springs.nodes.is_empty()) {
            warnings.push(NOTHING_PULLED.into());
        }
        let volume = body.elements().iter().map(|element| element.shape.volume).sum();
        let (tets, size, mass) = (mesh.tets.len(), mesh.bounds().size(), body.masses().iter().sum());
        // No zero has a sign.
        let gravity = [0.0, 0.0 - settings.gravity, 0.0];
        Ok(Overview { tets, nodes, held, size, volume, mass, gravity, materials, warnings })
    }

    /// Changes the length of the steps that follow, s.
    ///
    /// # Errors
    /// [`Error::OutOfRange`].
    pub fn set_dt(&mut self, dt: f64) -> Result<(), Error> {
        let settings = Settings { dt, ..self.settings.clone() };
        settings.check()?;
        self.settings = settings;
        self.clock = self.clock.with_dt(dt);
        Ok(())
    }

    /// Continues from a state of the same body: positions, m, and velocities, m/s, one for each node.
    ///
    /// # Errors
    /// [`Error::Setup`] unless there is one finite position and velocity for each node.
    pub fn resume(
        &mut self,
        clock: Clock,
        positions: &[[f64; 3]],
        velocities: &[[f64; 3]],
    ) -> Result<(), Error> {
        self.simulation.set_positions(positions)?;
        self.simulation.set_velocities(velocities)?;
        self.clock = clock;
        // Springs that replace none are drawn from where they are now, as those of the run were.
        self.simulation.set_springs(&[])?;
        self.pull(clock.time(), clock.time())
    }

    /// Makes the next frame, in the rayon pool of the caller: one time step, or as many as the tolerance
    /// requires. A step also ends whenever a pull changes abruptly, even between two frames.
    ///
    /// # Errors
    /// [`Error::Step`] or [`Error::Setup`], or [`Error::OutOfRange`] if no time is left; the state before the
    /// step is then untouched.
    pub fn step(&mut self) -> Result<StepReport, Error> {
        let clock = self.clock.next();
        in_range("the time after the step", clock.time(), f64::MIN..=f64::MAX, "finite")?;
        let (first, last) = stretches(&self.pulls, self.clock);
        let before = (!first.is_empty()).then(|| self.simulation.clone());
        match self.make(&first, last, clock.frame) {
            Ok((report, counts)) => {
                (self.clock, self.steps) = (clock, counts);
                Ok(report)
            }
            Err(error) => {
                if let Some(before) = before {
                    self.simulation = before;
                }
                Err(error)
            }
        }
    }

    /// Makes the stretches of a frame.
    fn make(
        &mut self,
        first: &[Stretch],
        last: Stretch,
        frame: usize,
    ) -> Result<(StepReport, StepCounts), Error> {
        let tolerance = self.settings.tolerance.map(|share| share * self.height);
        let (mut counts, mut iterations) = (StepCounts::default(), 0);
        let mut advance = |stretch: Stretch| -> Result<StepReport, Error> {
            self.pull(stretch.start, stretch.end)?;
            let made = rayon::scope(|_| stretch.make(&mut self.simulation, tolerance));
            let (report, made) = made.map_err(|source| Error::Step { frame, source })?;
            counts += made;
            iterations += report.newton.iterations;
            Ok(report)
        };
        first.iter().try_for_each(|&stretch| advance(stretch).map(drop))?;
        let mut report = advance(last)?;
        report.newton.iterations = iterations;
        Ok((report, counts))
    }

    /// Sets the springs of the scene as they are at the end of this stretch of time, s, and those that act in
    /// addition.
    fn pull(&mut self, start: f64, end: f64) -> Result<(), Error> {
        let scene = self.pulls.iter().flat_map(|springs| springs.during(start, end));
        let springs: Vec<step::Spring> = scene.chain(self.drags.iter().copied()).collect();
        Ok(self.simulation.set_springs(&springs)?)
    }
}

/// Part of a frame in which no pull changes abruptly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stretch {
    /// Time at its begin, s.
    pub start: f64,
    /// Time at its end, s.
    pub end: f64,
    /// Its length, s: that of the clock for a whole frame, to the last bit.
    pub length: f64,
}

impl Stretch {
    /// Makes one step, or as many as a tolerance, m/s, requires, by a body on one machine or on many.
    ///
    /// # Errors
    /// Those of [`Simulation::step`] and [`Simulation::advance_within`].
    pub fn make<M: Machine>(
        self,
        simulation: &mut Simulation<M>,
        tolerance: Option<f64>,
    ) -> Result<(StepReport, StepCounts), StepError> {
        let Some(tolerance) = tolerance else {
            let counts = StepCounts { taken: 1, ..StepCounts::default() };
            return Ok((simulation.step_here(self.length)?, counts));
        };
        let AdaptiveReport { taken, refused, unresolved, step, .. } =
            simulation.advance_within_here(self.length, tolerance)?;
        Ok((step, StepCounts { taken, refused, unresolved }))
    }
}

/// Parts of the next frame: those that end when a pull changes abruptly, and the last.
#[must_use]
pub fn stretches(pulls: &[DragSprings], clock: Clock) -> (Vec<Stretch>, Stretch) {
    let next = clock.next();
    let near = NEAR * next.dt;
    let (now, last) = (clock.time(), next.time());
    let events = || pulls.iter().flat_map(|springs| [springs.pull.reached, springs.pull.released]);
    let mut start = events().find(|event| (event - now).abs() <= near).unwrap_or(now);
    let is_between = |&event: &f64| event - start > near && last - event > near;
    let mut between: Vec<f64> = events().filter(is_between).collect();
    between.sort_unstable_by(f64::total_cmp);
    between.dedup();
    let mut first = Vec::new();
    for end in between {
        first.push(Stretch { start, end, length: end - start });
        start = end;
    }
    let length = if first.is_empty() { next.dt } else { last - start };
    (first, Stretch { start, end: last, length })
}

/// The body of the settings before the first step.
fn at_start(settings: &Settings, geometry: &Geometry) -> Result<Simulation, Error> {
    let pins = pins(settings, &geometry.mesh)?;
    let part = |MaterialPart { group, material, density }| -> Result<Part, Error> {
        let info = material.build()?;
        let young = info.moduli.young();
        // Forces on bodies of such a material, and their squares, stay in the range of f64.
        in_range("Young's modulus of the material", young, 1e-12..=1e21, "from 1e-12 to 1e21 Pa")?;
        Ok(Part { group, material: info.elements, density })
    };
    let parts = settings.all_parts().into_iter().map(part).collect::<Result<_, Error>>()?;
    let body = Body::from_parts(&geometry.mesh, parts)?;
    let mut simulation = Simulation::new(body, &pins, step_settings(settings))?;
    simulation.set_positions(&start_positions(settings, geometry, &pins))?;
    Ok(simulation)
}

/// Settings of the steps of a scene.
#[must_use]
pub fn step_settings(settings: &Settings) -> step::SimulationSettings {
    let newton = match settings.newton {
        Newton::Single => NewtonSettings::single(),
        // Steps of higher order would else be solved to more digits than implicit Euler's, stage by stage.
        Newton::Full if settings.integrator != Integrator::ImplicitEuler => {
            NewtonSettings { error_share: 0.03, ..Default::default() }
        }
        Newton::Full => NewtonSettings::default(),
    };
    let (gravity, damping) = ([0.0, -settings.gravity, 0.0], settings.scene.damping);
    step::SimulationSettings { gravity, damping, integrator: settings.integrator, newton }
}

/// The nodes that the settings pin, or else those that the scene pins.
///
/// # Errors
/// [`Error::Usage`].
pub fn pins(settings: &Settings, mesh: &TetMesh) -> Result<Pins, Error> {
    let holds_nothing = |pin: &str, error: PinError| {
        Error::Usage(format!("the pin {pin} holds nothing: {error}; choose a place with --pin"))
    };
    if settings.pins.is_empty() {
        let Some(pinned) = settings.scene.pinned else { return Ok(Pins::none()) };
        let pin = format!("of the scene {}", settings.scene.name);
        let region = region::within(mesh.bounds(), pinned);
        return Pins::in_box(mesh, region).map_err(|error| holds_nothing(&pin, error));
    }
    settings.pins.iter().try_fold(Pins::none(), |all, pin| {
        // What could be a box may also be the name of a group; then the user who named it means the group.
        let pins = match (mesh.group(pin), region::parse(pin)) {
            (None, Ok(region)) => Pins::in_box(mesh, region),
            (Some(_), _) => Pins::of_group(mesh, pin),
            (None, Err(error)) => {
                let groups: Vec<_> = mesh.groups.iter().map(|group| &group.name).collect();
                let (pin, groups) = (quoted(pin), list(&groups));
                return Err(Error::Usage(format!(
                    "`{pin}` is neither a group of the mesh (it has {groups}) nor a box; {error}"
                )));
            }
        };
        Ok(all.and(&pins.map_err(|error| holds_nothing(&format!("`{pin}`"), error))?))
    })
}

/// Springs by which a scene pulls at nodes of a body.
#[derive(Clone, Debug)]
pub struct DragSprings {
    /// The pull of the scene.
    pub pull: Pull,
    /// The nodes with their places at rest, m.
    pub nodes: Vec<(usize, [f64; 3])>,
    /// Bounding box of the body, m.
    pub bounds: Bounds,
    /// Stiffness of the spring at each node, N/m.
    pub stiffness: f64,
}

impl DragSprings {
    /// The springs of all nodes in the region of a pull; `young`, Pa, is the small-strain Young's modulus of
    /// the body.
    #[must_use]
    pub fn new(pull: Pull, mesh: &TetMesh, young: f64) -> Self {
        let bounds = mesh.bounds();
        let region = region::within(bounds, pull.region);
        let places = mesh.positions.iter().copied().enumerate();
        let nodes: Vec<_> = places.filter(|&(_, place)| region.contains(place)).collect();
        let stiffness = DRAG_STIFFNESS * (young * bounds.size()[1]) / nodes.len().max(1) as f64;
        Self { pull, nodes, bounds, stiffness }
    }

    /// The springs at the end of a stretch of time, s; none once released before it.
    pub fn during(&self, start: f64, end: f64) -> impl Iterator<Item = step::Spring> {
        let Pull { reached, released, .. } = self.pull;
        let share = (start < released).then(|| (end / reached).clamp(0.0, 1.0));
        share.into_iter().flat_map(move |share| {
            self.nodes.iter().map(move |&(node, rest)| {
                let target = self.pull.motion.place(rest, share, self.bounds);
                step::Spring::on_node(node, target, self.stiffness)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Body, HORSE, Motion, Scene, TWIST};

    #[test]
    fn no_step_leads_beyond_all_time() {
        let settings = Settings { body: Body::BAR, ..Settings::new(&HORSE) };
        let geometry = Geometry::load(&settings).expect("a body of the program");
        let mut play = Play::new(settings, geometry).expect("a scene that plays");
        let late = r#"{"frame":1,"dt":1e300,"since_frame":1,"since_time":1.7976931348623157e308}"#;
        let late: Clock = serde_json::from_str(late).expect("a clock");
        let rest = &play.geometry.mesh.positions.clone();
        play.resume(late, rest, &vec![[0.0; 3]; rest.len()]).expect("a state of the body");
        let refused = play.step().map(drop).expect_err("no time is left");
        assert!(
            matches!(refused, Error::OutOfRange { quantity: "the time after the step", .. }),
            "{refused}"
        );
        assert_eq!(play.clock, late);
    }

    /// The bar, drawn sideways by its upper end and let go after 0.2 s.
    fn drawn(dt: f64) -> Play {
        const PULL: Pull = Pull {
            region: Bounds { min: [f64::NEG_INFINITY, 0.9, f64::NEG_INFINITY], max: [f64::INFINITY; 3] },
            motion: Motion::Shift([0.5, 0.0, 0.0]),
            reached: 0.1,
            released: 0.2,
        };
        static DRAWN: Scene = Scene { pulls: &[PULL], ..TWIST };
        let settings = Settings { dt, ..Settings::new(&DRAWN) };
        let geometry = Geometry::load(&settings).expect("a body of the program");
        Play::new(settings, geometry).expect("a scene that plays")
    }

    /// The springs, and the steps of time, by which each of some frames was made.
    fn springs_and_steps(mut play: Play, frames: usize) -> Vec<(bool, usize)> {
        let mut frame = || {
            play.step().expect("a step");
            (!play.simulation.springs().is_empty(), play.steps.taken)
        };
        (0..frames).map(|_| frame()).collect()
    }

    #[test]
    fn a_pull_acts_through_the_step_that_ends_when_it_is_let_go() {
        let (pulled, free) = ((true, 1), (false, 1));
        assert_eq!(springs_and_steps(drawn(0.05), 6), [pulled, pulled, pulled, pulled, free, free]);
        // 0.1 is reached and 0.2 passed within frames.
        let frames = springs_and_steps(drawn(0.08), 4);
        assert_eq!(frames, [pulled, (true, 2), (false, 2), free]);
        // Multiples of a third and a seventh of 0.2 are rounded.
        for parts in [3, 7] {
            let frames = springs_and_steps(drawn(0.2 / f64::from(parts)), parts as usize + 1);
            assert!(frames[..parts as usize].iter().all(|&(is_pulled, _)| is_pulled), "{frames:?}");
            assert_eq!(frames[parts as usize], free);
        }
    }

    #[test]
    fn a_pull_is_where_it_is_reached_at_once() {
        let mut play = drawn(0.08);
        let target = |play: &Play| play.simulation.springs()[0].target;
        play.step().expect("a step");
        let early = target(&play);
        play.step().expect("a step");
        assert_eq!(target(&play)[1], early[1]);
        let rest = play.pulls[0].nodes[0].1;
        assert_eq!(target(&play)[0], rest[0] + 0.5 * play.height);
    }
}
