//! The body of a scene, read and divided, with pins, prescribed motions and springs.

use piola_bodies::mesh::Bounds;
use piola_bodies::system::{Pins, parts_of_tets};
use piola_scenes::error::Error as SceneError;
use piola_scenes::geometry::{Geometry, NOTHING_PULLED};
use piola_scenes::play::{self, DragSprings};
use piola_scenes::region;
use serde::{Deserialize, Serialize};

use crate::command::{Move, Task};
use crate::error::Error;
use crate::portion::{Element, Place, Portion};
use crate::share::Share;
use crate::team::Team;

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

/// Reads the body on rank 0 and divides it: the share of this rank, properties of the whole body, and the
/// springs of each pull at owned nodes. The material of an element is the number of its part.
pub(crate) fn divided(team: &Team, task: &Task) -> Result<(Share, BodyFacts, Vec<DragSprings>), Error> {
    let Task { settings, moves, .. } = task;
    if moves.len() > MOST || settings.scene.pulls.len() > MOST {
        return Err(Error::usage(format!("at most {MOST} motions can be prescribed")));
    }
    let (places, elements, facts) = team.on_first(|| read(task))?;
    let body: BodyFacts = serde_json::from_slice(&team.broadcast(0, facts))
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
    let pulls = pulls.collect();
    Ok((share, body, pulls))
}

/// Position of a pinned node at a time, s, if it has a prescribed motion.
pub(crate) fn moved(moves: &[Move], &Place { rest, marks, .. }: &Place, time: f64) -> Option<[f64; 3]> {
    let mut moved = None;
    for (number, motion) in moves.iter().enumerate() {
        if marks & move_mark(number) != 0 {
            let done = (time / motion.reached).clamp(0.0, 1.0);
            let at = moved.get_or_insert(rest);
            (0..3).for_each(|c| at[c] += done * motion.displacement[c]);
        }
    }
    moved
}

/// Places, elements and properties of the whole body; the properties are in JSON.
type WholeBody = (Vec<Place>, Vec<Element>, Vec<u8>);

fn read(Task { settings, moves }: &Task) -> Result<WholeBody, Error> {
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
    let parts = settings.all_parts();
    let groups: Vec<_> = parts.iter().map(|part| part.group.as_deref()).collect();
    let materials = parts_of_tets(mesh, &groups).map_err(SceneError::from)?;
    let elements = mesh
        .tets
        .iter()
        .enumerate()
        .map(|(tet, &[a, b, c, d])| [a, b, c, d, mesh.tag(tet), materials[tet]].map(|word| word as u64));
    let facts = BodyFacts { bounds: mesh.bounds(), checksum: geometry.checksum(), warnings, stiffnesses };
    let facts = serde_json::to_vec(&facts).map_err(Error::usage)?;
    Ok((places, elements.collect(), facts))
}
