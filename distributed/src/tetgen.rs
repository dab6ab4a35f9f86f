//! Parallel reader of TetGen's files: each rank reads a part of the bytes, so that none holds the whole mesh.
//!
//! This module does not depend on materials, pins or prescribed motions.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Seek, SeekFrom};
use std::path::Path;

use piola::mesh::{NodeLines, TetLines};

use crate::error::Error;
use crate::portion::Homes;
use crate::team::Team;

/// Part of a mesh on a rank.
#[derive(Debug)]
pub struct Part {
    /// Homes of all nodes.
    pub homes: Homes,
    /// Position, m, and boundary marker of each node that is at home on this rank.
    pub nodes: Vec<([f64; 3], i64)>,
    /// Elements: four nodes, in either orientation, number and region. Each element is on one rank.
    pub elements: Vec<([u64; 4], u64, Option<i64>)>,
    /// Number of nodes of the file that do not belong to a tetrahedron, and are left out.
    pub dropped: usize,
}

/// Reads a `.ele` file and the `.node` file with the same name; `path` is one of them. The nodes must be
/// numbered consecutively; the lines may be in any order.
///
/// # Errors
/// [`Error::OnRank`], with the place at which a file is malformed.
pub fn read(team: &Team, path: &Path) -> Result<Part, Error> {
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
    let mut rows = Vec::new();
    let mut stray = None;
    for node in &nodes {
        match index(node.number) {
            Some(index) => {
                let [x, y, z] = node.position.map(f64::to_bits);
                rows.push([index as u64, x, y, z, node.marker as u64]);
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

    // Nodes without a tetrahedron are left out, and the others are renumbered.
    let mut touched: Vec<u64> = corners.as_flattened().to_vec();
    touched.sort_unstable();
    touched.dedup();
    let mut is_used = vec![false; here.len()];
    for [node] in team.exchange_rows(&homes.sort(team, touched.iter().map(|&node| [node]))).concat() {
        is_used[(node - wanted.start) as usize] = true;
    }
    let used = is_used.iter().filter(|&&used| used).count();
    let mut next = team.all(used)[..team.rank()].iter().sum::<usize>() as u64;
    let new: Vec<u64> = is_used
        .iter()
        .map(|&used| {
            let number = next;
            next += u64::from(used);
            number
        })
        .collect();
    let answers = homes.ask(team, &touched, |node| [new[node]]);
    let total = team.count(used);
    let new_homes = Homes::new(total as u64, team.size());
    let rows = here.iter().zip(&new).zip(&is_used).filter(|&(_, &used)| used);
    let rows = rows.map(|((&[_, x, y, z, marker], &number), _)| [number, x, y, z, marker]);
    let mut here = team.exchange_rows(&new_homes.sort(team, rows)).concat();
    here.sort_unstable_by_key(|row| row[0]);

    let renumbered = |node: u64| match touched.binary_search(&node) {
        Ok(at) => answers[at][0],
        Err(_) => node,
    };
    let elements = corners
        .iter()
        .zip(&tets)
        .map(|(corners, tet)| (corners.map(&renumbered), tet.number as u64, tet.region))
        .collect();
    let nodes =
        here.iter().map(|&[_, x, y, z, marker]| ([x, y, z].map(f64::from_bits), marker as i64)).collect();
    Ok(Part { homes: new_homes, nodes, elements, dropped: format.count - total })
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
