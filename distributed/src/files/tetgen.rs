//! Parallel reader of TetGen's files: each rank reads a part of the bytes.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Seek, SeekFrom};
use std::path::Path;

use piola_bodies::mesh::{NodeLines, TetLines};

use super::{NO_GROUP, Part, Rows};
use crate::error::Error;
use crate::portion::Homes;
use crate::team::Team;

/// Reads a `.ele` file and the `.node` file with the same name; `path` is one of them. The nodes must be
/// numbered consecutively; the lines may be in any order.
///
/// # Errors
/// [`Error::OnRank`], with the place at which a file is malformed.
pub(super) fn read(team: &Team, path: &Path) -> Result<Part, Error> {
    let (node_file, tet_file) = (path.with_extension("node"), path.with_extension("ele"));
    let nodes = part(team, &node_file, NodeLines::of_first_line, NodeLines::node);
    let (format, nodes) = team.agree(nodes)?;
    check_count(team, &node_file, "nodes", nodes.len(), format.count)?;
    let tets = part(team, &tet_file, TetLines::of_first_line, TetLines::tet);
    let (tet_format, tets) = team.agree(tets)?;
    check_count(team, &tet_file, "tetrahedra", tets.len(), tet_format.count)?;

    let least = nodes.iter().map(|node| node.number).min().map_or(f64::INFINITY, |number| number as f64);
    let first = team.min(least) as usize;
    let index = |number: usize| number.checked_sub(first).filter(|&node| node < format.count);
    let no_node = |number: usize| {
        let problem = format!("node {number} is not one of the {} nodes from {first} on", format.count);
        Error::Options(format!("{}: {problem}", tet_file.display()))
    };
    let corners = tets.iter().map(|tet| {
        let corner = |number: usize| index(number).map(|node| node as u64).ok_or_else(|| no_node(number));
        let [a, b, c, d] = tet.corners.map(corner);
        Ok([a?, b?, c?, d?])
    });
    let corners: Vec<[u64; 4]> = team.agree(corners.collect())?;

    // Send nodes to their homes.
    let homes = Homes::new(format.count as u64, team.size());
    let (mut rows, mut members, mut stray) = (Vec::new(), Vec::new(), None);
    for node in &nodes {
        match index(node.number) {
            Some(index) => {
                let [x, y, z] = node.position.map(f64::to_bits);
                rows.push([index as u64, x, y, z]);
                if node.marker != 0 {
                    members.push([index as u64, 2, node.marker as u64]);
                }
            }
            None => stray = stray.or(Some(node.number)),
        }
    }
    drop(nodes);
    let mut here = team.exchange_rows(&homes.sort(team, rows)).concat();
    here.sort_unstable_by_key(|row| row[0]);
    let wanted = homes.range(team.rank());
    // First node that is missing, or occurs twice.
    let out_of_order = (0..here.len().max((wanted.end - wanted.start) as usize)).find_map(|place| {
        let expected = Some(wanted.start + place as u64).filter(|node| wanted.contains(node));
        let found = here.get(place).map(|row| row[0]);
        (expected != found)
            .then(|| expected.into_iter().chain(found).min().unwrap_or_default() as usize + first)
    });
    let ordered = match stray.or(out_of_order) {
        None => Ok(()),
        Some(number) => Err(Error::Options(format!(
            "{}: the nodes must be numbered consecutively, each once, so that ranks can read them in parts; see node {number}",
            node_file.display(),
        ))),
    };
    team.agree(ordered)?;

    let before: usize = team.all(tets.len())[..team.rank()].iter().sum();
    let elements = corners.iter().zip(&tets).enumerate().map(|(place, (&[a, b, c, d], tet))| {
        let group = tet.region.unwrap_or(NO_GROUP) as u64;
        [a, b, c, d, (before + place) as u64, tet.number as u64, group]
    });
    let rows = Rows { nodes: here, elements: elements.collect(), members, repeats: false };
    Ok(Part { is_oriented: false, ..Part::new(team, homes, rows, &BTreeMap::new())? })
}

/// Reads the first line of a file, and the other lines that begin in this rank's part of the bytes.
fn part<F, L>(
    team: &Team,
    path: &Path,
    first: impl Fn(&str) -> Result<F, String>,
    line: impl Fn(&F, &str) -> Result<Option<L>, String>,
) -> Result<(F, Vec<L>), Error> {
    let unreadable =
        |error: io::Error| Error::Options(format!("{}: cannot be read: {error}", path.display()));
    let malformed =
        |at: u64, problem: String| Error::Options(format!("{}, at byte {at}: {problem}", path.display()));
    let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
    let length = file.get_ref().metadata().map_err(unreadable)?.len();
    let (mut at, mut bytes) = (0, Vec::new());
    let mut next = |file: &mut BufReader<File>, at: &mut u64| -> Result<String, Error> {
        bytes.clear();
        *at += file.read_until(b'\n', &mut bytes).map_err(unreadable)? as u64;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    let format = loop {
        let begun = at;
        let text = next(&mut file, &mut at)?;
        let is_blank = text.split('#').next().is_none_or(|text| text.trim().is_empty());
        if !is_blank || at == begun {
            break first(&text).map_err(|problem| malformed(begun, problem))?;
        }
    };
    let share = |rank: usize| at + ((length - at) as u128 * rank as u128 / team.size() as u128) as u64;
    let (begin, end) = (share(team.rank()), share(team.rank() + 1));
    if begin > at {
        // A line that begins before this part belongs to the previous rank.
        file.seek(SeekFrom::Start(begin - 1)).map_err(unreadable)?;
        at = begin - 1;
        next(&mut file, &mut at)?;
    }
    let mut lines = Vec::new();
    while at < end {
        let begun = at;
        let text = next(&mut file, &mut at)?;
        lines.extend(line(&format, &text).map_err(|problem| malformed(begun, problem))?);
    }
    Ok((format, lines))
}

/// Checks that the ranks together have read as many lines as the first line announces.
fn check_count(team: &Team, path: &Path, what: &str, here: usize, announced: usize) -> Result<(), Error> {
    let found = team.count(here);
    if found == announced {
        return Ok(());
    }
    Err(Error::Options(format!(
        "{}: its first line announces {announced} {what}, but it has {found}",
        path.display()
    )))
}
