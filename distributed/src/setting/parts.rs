//! Body that no rank reads as a whole, with the marks of its nodes.

use std::collections::BTreeSet;
use std::path::Path;

use piola_bodies::mesh::Bounds;
use piola_bodies::system::PinError;
use piola_scenes::error::Error as SceneError;
use piola_scenes::geometry::{GeometryWarning, check_bounds, size_warning};
use piola_scenes::play::DragSprings;
use piola_scenes::region;
use piola_scenes::settings::Settings;

use super::{BodyFacts, Move, PINNED, materials, move_mark, pull_mark};
use crate::error::Error;
use crate::files::{self, Part};
use crate::portion::{Place, Portion};
use crate::share::Share;
use crate::team::Team;

/// Selection of nodes of a body.
#[derive(Clone, Copy)]
enum Nodes<'a> {
    InBox(Bounds),
    /// Nodes of all groups with this name.
    OfGroup(&'a str),
}

/// Reads a file in parts, divides the mesh, and marks the nodes. The result is `None` if one rank must read
/// the file as a whole.
///
/// # Errors
/// The errors of [`super::Setting::new`].
pub(super) fn read(
    team: &Team,
    path: &Path,
    settings: &Settings,
    groups: &[String],
    moves: &[Move],
) -> Result<Option<(Share, BodyFacts)>, Error> {
    let Some(mut part) = files::read(team, path)? else { return Ok(None) };
    for position in &mut part.nodes {
        *position = position.map(|x| settings.unit.to_metres(x));
    }
    let bounds = bounds(team, &part);
    check_bounds(bounds)?;
    let mut marks = Marks { team, part: &part, bounds, marks: vec![0; part.nodes.len()] };

    match settings.scene.pinned {
        Some(pinned) if settings.pins.is_empty() => {
            let nodes = Nodes::InBox(region::within(bounds, pinned));
            marks.set(PINNED, nodes, &format!("of the scene {}", settings.scene.name))?;
        }
        _ => {}
    }
    for pin in &settings.pins {
        marks.set(PINNED, selected(pin, &part)?, &format!("`{pin}`"))?;
    }
    for (number, motion) in moves.iter().enumerate() {
        let nodes = selected(&motion.nodes, &part)?;
        marks.set(PINNED | move_mark(number), nodes, &format!("`{}`", motion.nodes))?;
    }
    let young = settings.material.build()?.moduli.young();
    let (mut stiffnesses, mut is_idle) = (Vec::new(), false);
    for (number, pull) in settings.scene.pulls.iter().enumerate() {
        let count = marks.add(pull_mark(number), Nodes::InBox(region::within(bounds, pull.region)));
        is_idle |= count == 0;
        stiffnesses.push(DragSprings::stiffness_of_each(count, bounds, young));
    }

    let Marks { marks, .. } = marks;
    let places = part.nodes.iter().zip(marks);
    let places = places.map(|(&rest, marks)| Place { rest, start: rest, marks }).collect();
    let members = |name: &str| {
        let group = part.groups.iter().find(|group| group.dimension == 3 && group.name == name);
        group.map(|group| group.members.as_slice())
    };
    let tags: Vec<u64> = part.elements.iter().map(|&(_, tag)| tag).collect();
    let materials = team.agree(materials(groups, &tags, members))?;
    let elements = part.elements.iter().zip(materials);
    let elements = elements.map(|(&([a, b, c, d], tag), material)| [a, b, c, d, tag, material]).collect();
    let mut share = Share::of(team, Portion { homes: part.homes, places, elements })?;
    if !part.is_oriented {
        share.turn_inverted();
    }
    let dropped = (part.dropped > 0).then_some(GeometryWarning::NodesDropped { nodes: part.dropped });
    let idle = is_idle.then_some(GeometryWarning::NothingPulled);
    let warnings = [size_warning(bounds), dropped, in_pieces(team, &share), idle];
    let facts = BodyFacts {
        bounds,
        checksum: checksum(team, &part),
        warnings: warnings.iter().flatten().map(ToString::to_string).collect(),
        stiffnesses,
    };
    Ok(Some((share, facts)))
}

/// Warns of a body that is not connected.
fn in_pieces(team: &Team, share: &Share) -> Option<GeometryWarning> {
    let pieces = share.pieces(team);
    let (largest, [_, tetrahedra]) = (pieces.iter().copied().max()?, share.totals);
    (pieces.len() > 1).then_some(GeometryWarning::InPieces { pieces: pieces.len(), largest, tetrahedra })
}

/// Bounding box of the nodes of all ranks, m.
fn bounds(team: &Team, part: &Part) -> Bounds {
    let Bounds { min, max } = Bounds::around(&part.nodes);
    Bounds { min: min.map(|x| team.min(x)), max: max.map(|x| team.max(x)) }
}

/// Nodes selected by a text: the name of a group, or else a box. The name of a group takes precedence.
fn selected<'a>(text: &'a str, part: &Part) -> Result<Nodes<'a>, Error> {
    if part.groups.iter().any(|group| group.name == text) {
        return Ok(Nodes::OfGroup(text));
    }
    region::parse(text).map(Nodes::InBox).map_err(|source| {
        let groups = part.groups.iter().map(|group| group.name.clone()).collect();
        Error::Scene(SceneError::UnknownPin { pin: text.to_owned(), groups, source })
    })
}

/// Marks of the nodes that are at home on a rank.
struct Marks<'a> {
    team: &'a Team,
    part: &'a Part,
    bounds: Bounds,
    marks: Vec<u64>,
}

impl Marks<'_> {
    /// Marks nodes.
    ///
    /// # Errors
    /// [`Error::Scene`] for a box or a group without nodes.
    fn set(&mut self, mark: u64, nodes: Nodes<'_>, what: &str) -> Result<(), Error> {
        if self.add(mark, nodes) > 0 {
            return Ok(());
        }
        let source = match nodes {
            Nodes::InBox(bounds) => PinError::EmptyBox { bounds, body: self.bounds },
            Nodes::OfGroup(name) => PinError::EmptyGroup { name: name.to_owned() },
        };
        Err(Error::Scene(SceneError::Pin { pin: what.to_owned(), source: source.into() }))
    }

    /// Marks nodes; returns the number of marked nodes on all ranks.
    fn add(&mut self, mark: u64, nodes: Nodes<'_>) -> usize {
        let Part { homes, nodes: positions, elements, groups, .. } = self.part;
        let mut is_chosen = vec![false; positions.len()];
        match nodes {
            Nodes::InBox(bounds) => {
                let is_inside = positions.iter().map(|&position| bounds.contains(position));
                is_chosen = is_inside.collect();
            }
            Nodes::OfGroup(name) => {
                let first = homes.range(self.team.rank()).start;
                for group in groups.iter().filter(|group| group.name == name) {
                    if group.dimension == 3 {
                        let corners: BTreeSet<u64> =
                            group.members.iter().flat_map(|&element| elements[element].0).collect();
                        let rows = homes.sort(self.team, corners.into_iter().map(|node| [node]));
                        let chosen = self.team.exchange_rows(&rows).concat();
                        chosen.iter().for_each(|[node]| is_chosen[(node - first) as usize] = true);
                    } else {
                        group.members.iter().for_each(|&node| is_chosen[node] = true);
                    }
                }
            }
        }
        let chosen = self.marks.iter_mut().zip(&is_chosen).filter(|&(_, &is_chosen)| is_chosen);
        self.team.count(chosen.map(|(marks, _)| *marks |= mark).count())
    }
}

/// Checksum of nodes, elements and groups that does not depend on the number of ranks.
fn checksum(team: &Team, part: &Part) -> u32 {
    let mut whole = crc32fast::Hasher::new();
    let nodes = part.nodes.iter().flat_map(|position| position.map(f64::to_bits));
    let elements = part.elements.iter().flat_map(|&(corners, tag)| corners.into_iter().chain([tag]));
    let mut lists = vec![nodes.collect::<Vec<_>>(), elements.collect()];
    let first_element: usize = team.all(part.elements.len())[..team.rank()].iter().sum();
    let first_node = part.homes.range(team.rank()).start as usize;
    for group in &part.groups {
        whole.update(group.name.as_bytes());
        let first = if group.dimension == 3 { first_element } else { first_node };
        lists.push(group.members.iter().map(|member| (first + member) as u64).collect());
    }
    for words in lists {
        let mut here = crc32fast::Hasher::new();
        words.iter().for_each(|word| here.update(&word.to_le_bytes()));
        let (sums, lengths) = (team.all(here.finalize() as usize), team.all(8 * words.len()));
        for (sum, length) in sums.into_iter().zip(lengths) {
            whole.combine(&crc32fast::Hasher::new_with_initial_len(sum as u32, length as u64));
        }
    }
    whole.finalize()
}
