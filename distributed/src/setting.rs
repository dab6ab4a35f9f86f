//! Setting of a run: the body of a scene, read and divided, with pins, prescribed motions and springs.

use piola_bodies::mesh::{Bounds, TetMesh};
use piola_bodies::step::Spring;
use piola_bodies::system::Pins;
use piola_scenes::geometry::{Geometry, NOTHING_PULLED};
use piola_scenes::play::{self, DragSprings};
use piola_scenes::region;
use serde::{Deserialize, Serialize};

use crate::command::{Move, Task};
use crate::error::Error;
use crate::part::MaterialPart;
use crate::portion::{Element, Place, Portion};
use crate::share::Share;
use crate::team::Team;

/// Setting of a run on one rank.
#[derive(Debug)]
pub(crate) struct Setting {
    /// Nodes and elements of this rank.
    pub(crate) share: Share,
    /// Properties of the whole body, equal on all ranks.
    pub(crate) body: BodyFacts,
    /// Springs of each pull, at the owned nodes of this rank.
    pub(crate) pulls: Vec<DragSprings>,
    moves: Vec<Move>,
}

/// Properties of the whole body, equal on all ranks.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct BodyFacts {
    /// Bounding box at rest, m.
    pub(crate) bounds: Bounds,
    /// Checksum of the mesh.
    pub(crate) checksum: u32,
    /// Properties of the mesh that may be unintended.
    pub(crate) warnings: Vec<String>,
    /// Stiffness of each spring of each pull, N/m.
    stiffnesses: Vec<f64>,
}

/// Maximum number of pulls, and of moves: the marks of a node have a bit for each.
const MOST: usize = 24;

/// Mark of nodes that are held, or have a prescribed motion.
const PINNED: u64 = 1;

/// Mark of the nodes of a pull.
fn pull_mark(number: usize) -> u64 {
    2 << number
}

/// Mark of the nodes of a move.
fn move_mark(number: usize) -> u64 {
    1 << (32 + number)
}

impl Setting {
    /// Reads the body on rank 0 and divides it. The elements of the parts have the materials with the numbers
    /// 1, 2, …; all other elements have the material with the number 0.
    pub(crate) fn new(team: &Team, task: &Task) -> Result<Self, Error> {
        let Task { settings, moves, .. } = task;
        if moves.len() > MOST || settings.scene.pulls.len() > MOST {
            return Err(Error::usage(format!("at most {MOST} motions can be prescribed")));
        }
        let (places, elements, facts) = team.on_first(|| read(task))?;
        let facts = team.broadcast(0, facts);
        let body: BodyFacts = serde_json::from_slice(&facts)
            .map_err(|error| Error::usage(format!("the ranks run different programs: {error}")))?;
        let share = Share::of(team, Portion::spread(team, places, elements))?;
        let pulls = settings.scene.pulls.iter().enumerate().map(|(number, &pull)| DragSprings {
            pull,
            nodes: (0..share.owned)
                .filter(|&node| share.places[node].marks & pull_mark(number) != 0)
                .map(|node| (node, share.places[node].rest))
                .collect(),
            bounds: body.bounds,
            stiffness: body.stiffnesses[number],
        });
        Ok(Self { pulls: pulls.collect(), moves: moves.clone(), share, body })
    }

    /// Springs at owned nodes at the end of a time interval, s.
    pub(crate) fn springs(&self, start: f64, end: f64) -> Vec<Spring> {
        self.pulls.iter().flat_map(|pull| pull.during(start, end)).collect()
    }

    /// Position of a pinned node at a time, s, if it has a prescribed motion.
    pub(crate) fn place(&self, node: usize, time: f64) -> Option<[f64; 3]> {
        let Place { rest, marks, .. } = self.share.places[node];
        let mut moved = None;
        for (number, motion) in self.moves.iter().enumerate() {
            if marks & move_mark(number) != 0 {
                let done = (time / motion.reached).clamp(0.0, 1.0);
                let at = moved.get_or_insert(rest);
                (0..3).for_each(|c| at[c] += done * motion.displacement[c]);
            }
        }
        moved
    }

    /// Height of the body, m.
    pub(crate) fn height(&self) -> f64 {
        self.body.bounds.size()[1]
    }
}

/// Places, elements and properties of the whole body; the properties are in JSON.
type WholeBody = (Vec<Place>, Vec<Element>, Vec<u8>);

fn read(Task { settings, parts, moves }: &Task) -> Result<WholeBody, Error> {
    let geometry = Geometry::load(settings)?;
    let mesh = &geometry.mesh;
    let young = settings.material.build()?.moduli.young();
    let mut pins = play::pins(settings, mesh)?;
    let mut marks = vec![0_u64; mesh.positions.len()];
    for (number, motion) in moves.iter().enumerate() {
        let moved = match (mesh.group(&motion.nodes), region::parse(&motion.nodes)) {
            (None, Ok(region)) => Pins::in_box(mesh, region),
            _ => Pins::of_group(mesh, &motion.nodes),
        };
        let moved = moved.map_err(|error| Error::usage(format!("--move {}: {error}", motion.nodes)))?;
        moved.nodes().iter().for_each(|&node| marks[node] |= move_mark(number));
        pins = pins.and(&moved);
    }
    pins.nodes().iter().for_each(|&node| marks[node] |= PINNED);
    let (mut stiffnesses, mut warnings) = (Vec::new(), geometry.warnings());
    for (number, &pull) in settings.scene.pulls.iter().enumerate() {
        let springs = DragSprings::new(pull, mesh, young);
        springs.nodes.iter().for_each(|&(node, _)| marks[node] |= pull_mark(number));
        if springs.nodes.is_empty() {
            warnings.push(NOTHING_PULLED.into());
        }
        stiffnesses.push(springs.stiffness);
    }
    let start = play::start_positions(settings, &geometry, &pins);
    let places = (0..mesh.positions.len())
        .map(|node| Place { rest: mesh.positions[node], start: start[node], marks: marks[node] })
        .collect();
    let materials = materials(parts, mesh)?;
    let elements = mesh
        .tets
        .iter()
        .enumerate()
        .map(|(tet, &[a, b, c, d])| [a, b, c, d, mesh.tag(tet), materials[tet]].map(|word| word as u64));
    let facts = BodyFacts { bounds: mesh.bounds(), checksum: geometry.checksum(), warnings, stiffnesses };
    let facts = serde_json::to_vec(&facts).map_err(Error::usage)?;
    Ok((places, elements.collect(), facts))
}

/// Number of the material of each element: 1, 2, … for the members of the groups of these parts, otherwise 0.
fn materials(parts: &[(String, MaterialPart)], mesh: &TetMesh) -> Result<Vec<usize>, Error> {
    let mut materials = vec![0; mesh.tets.len()];
    for (number, (name, _)) in parts.iter().enumerate() {
        let group = mesh.groups.iter().find(|group| group.dimension == 3 && group.name == *name);
        let group =
            group.ok_or_else(|| Error::usage(format!("the mesh has no group `{name}` of tetrahedra")))?;
        for &element in &group.tets {
            if std::mem::replace(&mut materials[element], number + 1) != 0 {
                let tag = mesh.tag(element);
                return Err(Error::usage(format!("element {tag} has two materials")));
            }
        }
    }
    Ok(materials)
}
