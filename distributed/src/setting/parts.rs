//! Body that no rank reads as a whole, with the marks of its nodes.

use std::collections::BTreeSet;
use std::path::Path;

use piola::mesh::Bounds;
use piola::system::PinError;
use piola_scenes::error::Error as SceneError;
use piola_scenes::geometry::{GeometryWarning, check_bounds, size_warning};
use piola_scenes::play::DragSprings;
use piola_scenes::region;
use piola_scenes::settings::Settings;

use super::{BodyFacts, Move, PINNED, move_mark, pull_mark};
use crate::error::Error;
use crate::portion::{Place, Portion};
use crate::team::Team;
use crate::tetgen::{self, Part};

/// Selection of nodes of a body.
#[derive(Clone, Copy)]
enum Nodes {
    InBox(Bounds),
    /// Nodes with this marker, and nodes of tetrahedra of this region.
    OfGroup(i64),
}

/// Reads TetGen's files in parts, and marks the nodes.
///
/// # Errors
/// The errors of [`super::Setting::new`].
pub(super) fn read(
    team: &Team,
    path: &Path,
    settings: &Settings,
    groups: &[String],
    moves: &[Move],
) -> Result<(Portion, BodyFacts), Error> {
    let mut part = tetgen::read(team, path)?;
    for (position, _) in &mut part.nodes {
        *position = position.map(|x| settings.unit.to_metres(x));
    }
    let bounds = bounds(team, &part);
    check_bounds(bounds)?;
    let known = groups_of(team, &part);
    let mut marks = Marks { team, part: &part, bounds, marks: vec![0; part.nodes.len()] };

    match settings.scene.pinned {
        Some(pinned) if settings.pins.is_empty() => {
            let nodes = Nodes::InBox(region::within(bounds, pinned));
            marks.set(PINNED, nodes, &format!("of the scene {}", settings.scene.name))?;
        }
        _ => {}
    }
    for pin in &settings.pins {
        marks.set(PINNED, selected(pin, &known)?, &format!("`{pin}`"))?;
    }
    for (number, motion) in moves.iter().enumerate() {
        let nodes = selected(&motion.nodes, &known)?;
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
    let places = places.map(|(&(rest, _), marks)| Place { rest, start: rest, marks }).collect();
    let number_of = |region: Option<i64>| {
        let name = region.map(|region| region.to_string());
        name.and_then(|name| groups.iter().position(|group| *group == name)).map_or(0, |group| group + 1)
    };
    let elements: Vec<_> = part
        .elements
        .iter()
        .map(|&([a, b, c, d], tag, region)| [a, b, c, d, tag, number_of(region) as u64])
        .collect();
    for (number, name) in groups.iter().enumerate() {
        let here = elements.iter().filter(|element| element[5] == number as u64 + 1).count();
        if team.count(here) == 0 {
            return Err(Error::Options(format!("the mesh has no group `{name}` of tetrahedra")));
        }
    }
    let dropped = (part.dropped > 0).then_some(GeometryWarning::NodesDropped { nodes: part.dropped });
    let idle = is_idle.then_some(GeometryWarning::NothingPulled);
    let warnings = [size_warning(bounds), dropped, idle];
    let facts = BodyFacts {
        bounds,
        checksum: checksum(team, &part),
        warnings: warnings.iter().flatten().map(ToString::to_string).collect(),
        stiffnesses,
    };
    Ok((Portion { homes: part.homes, places, elements }, facts))
}

/// Bounding box of the nodes of all ranks, m.
fn bounds(team: &Team, part: &Part) -> Bounds {
    let positions: Vec<[f64; 3]> = part.nodes.iter().map(|&(position, _)| position).collect();
    let Bounds { min, max } = Bounds::around(&positions);
    Bounds { min: min.map(|x| team.min(x)), max: max.map(|x| team.max(x)) }
}

/// Markers and regions of all ranks.
fn groups_of(team: &Team, part: &Part) -> BTreeSet<i64> {
    let markers = part.nodes.iter().map(|&(_, marker)| marker).filter(|&marker| marker != 0);
    let regions = part.elements.iter().filter_map(|&(_, _, region)| region);
    let here: BTreeSet<i64> = markers.chain(regions).collect();
    let here: Vec<u64> = here.into_iter().map(|group| group as u64).collect();
    team.exchange(&vec![here; team.size()]).concat().into_iter().map(|group| group as i64).collect()
}

/// Nodes selected by a text: the name of a group, or else a box. The name of a group takes precedence.
fn selected(text: &str, known: &BTreeSet<i64>) -> Result<Nodes, Error> {
    if let Some(&group) = known.iter().find(|group| group.to_string() == text) {
        return Ok(Nodes::OfGroup(group));
    }
    region::parse(text).map(Nodes::InBox).map_err(|source| {
        let groups = known.iter().map(ToString::to_string).collect();
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
    /// [`Error::Scene`] for a box without nodes.
    fn set(&mut self, mark: u64, nodes: Nodes, what: &str) -> Result<(), Error> {
        match (self.add(mark, nodes), nodes) {
            (0, Nodes::InBox(bounds)) => {
                let source = PinError::EmptyBox { bounds, body: self.bounds }.into();
                Err(Error::Scene(SceneError::Pin { pin: what.to_owned(), source }))
            }
            _ => Ok(()),
        }
    }

    /// Marks nodes; returns the number of marked nodes on all ranks.
    fn add(&mut self, mark: u64, nodes: Nodes) -> usize {
        let homes = &self.part.homes;
        let mut is_chosen: Vec<bool> = self
            .part
            .nodes
            .iter()
            .map(|&(position, marker)| match nodes {
                Nodes::InBox(bounds) => bounds.contains(position),
                Nodes::OfGroup(group) => marker == group,
            })
            .collect();
        if let Nodes::OfGroup(group) = nodes {
            let elements = self.part.elements.iter().filter(|&&(.., region)| region == Some(group));
            let corners: BTreeSet<u64> = elements.flat_map(|&(corners, ..)| corners).collect();
            let rows = homes.sort(self.team, corners.into_iter().map(|node| [node]));
            let first = homes.range(self.team.rank()).start;
            for [node] in self.team.exchange_rows(&rows).concat() {
                is_chosen[(node - first) as usize] = true;
            }
        }
        let chosen = self.marks.iter_mut().zip(&is_chosen).filter(|&(_, &is_chosen)| is_chosen);
        self.team.count(chosen.map(|(marks, _)| *marks |= mark).count())
    }
}

/// Checksum of nodes and elements that does not depend on the number of ranks.
fn checksum(team: &Team, part: &Part) -> u32 {
    let mut whole = crc32fast::Hasher::new();
    let nodes = part
        .nodes
        .iter()
        .flat_map(|&([x, y, z], marker)| [x, y, z].map(f64::to_bits).into_iter().chain([marker as u64]));
    let elements = part.elements.iter().flat_map(|&(corners, tag, region)| {
        corners.into_iter().chain([tag, region.unwrap_or_default() as u64])
    });
    for words in [nodes.collect::<Vec<_>>(), elements.collect()] {
        let mut here = crc32fast::Hasher::new();
        words.iter().for_each(|word| here.update(&word.to_le_bytes()));
        let (sums, lengths) = (team.all(here.finalize() as usize), team.all(8 * words.len()));
        for (sum, length) in sums.into_iter().zip(lengths) {
            whole.combine(&crc32fast::Hasher::new_with_initial_len(sum as u32, length as u64));
        }
    }
    whole.finalize()
}
