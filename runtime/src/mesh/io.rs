//! Meshes and surfaces from files.
//!
//! The readers are the project's own: an error must name file and line, and surface vertices must keep the order
//! of the file. `mshio` gives neither lines nor physical names, `tobj` no lines, and it renumbers vertices.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

mod msh;
mod obj;
mod tetgen;

pub use msh::{parse_msh, read_msh};
pub use obj::{parse_surface_obj, read_surface_obj};
pub use tetgen::read_tetgen;

use super::{Group, TetMesh};

/// A triangle surface, such as one that is drawn in place of the tetrahedra it is embedded in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Position of each vertex, m, in the order of the file.
    pub positions: Vec<[f64; 3]>,
    /// Vertices of each triangle, from 0, in the orientation of the file.
    pub triangles: Vec<[usize; 3]>,
}

/// Why a file gave no mesh.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is not what it should be.
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, from 1; one past the last where the file ends too early.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { path, source } => write!(f, "{}: cannot be read: {source}", path.display()),
            Self::Malformed { path, line, problem } => write!(f, "{}:{line}: {problem}", path.display()),
        }
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Unreadable { source, .. } => Some(source),
            Self::Malformed { .. } => None,
        }
    }
}

/// Reads a file and hands its text to a parser, whose complaints then name the file.
fn read<T>(path: &Path, parse: impl FnOnce(&str) -> Result<T, Problem>) -> Result<T, ReadError> {
    let bytes =
        std::fs::read(path).map_err(|source| ReadError::Unreadable { path: path.to_owned(), source })?;
    // Names in other encodings are no reason to refuse a mesh.
    named(path, parse(&String::from_utf8_lossy(&bytes)))
}

/// Lets a complaint name the file.
fn named<T>(path: &Path, parsed: Result<T, Problem>) -> Result<T, ReadError> {
    parsed.map_err(|Problem { line, text }| ReadError::Malformed {
        path: path.to_owned(),
        line,
        problem: text,
    })
}

/// What is wrong with which line, from 1.
#[derive(Debug, PartialEq)]
struct Problem {
    line: usize,
    text: String,
}

/// A line and its number, read word by word.
struct Line<'a> {
    number: usize,
    text: &'a str,
    words: std::str::SplitAsciiWhitespace<'a>,
}

impl<'a> Line<'a> {
    fn new(number: usize, text: &'a str) -> Self {
        Self { number, text, words: text.split_ascii_whitespace() }
    }

    fn problem(&self, text: impl Into<String>) -> Problem {
        Problem { line: self.number, text: text.into() }
    }

    /// The next word as a number; `what` it is goes into the complaint.
    fn number<N: FromStr>(&mut self, what: &str) -> Result<N, Problem> {
        match self.words.next() {
            None => Err(self.problem(format!("{what} is missing"))),
            Some(word) => word.parse().map_err(|_| self.problem(format!("expected {what}, found `{word}`"))),
        }
    }

    /// The same, where the line may have ended.
    fn number_if_any<N: FromStr>(&mut self, what: &str) -> Result<Option<N>, Problem> {
        if self.words.clone().next().is_none() { Ok(None) } else { self.number(what).map(Some) }
    }

    /// The next word as a finite number.
    fn coordinate(&mut self, what: &str) -> Result<f64, Problem> {
        let x: f64 = self.number(what)?;
        if x.is_finite() { Ok(x) } else { Err(self.problem(format!("{what} is {x}; it must be finite"))) }
    }

    /// The next three words as a point.
    fn point(&mut self) -> Result<[f64; 3], Problem> {
        Ok([
            self.coordinate("the x coordinate")?,
            self.coordinate("the y coordinate")?,
            self.coordinate("the z coordinate")?,
        ])
    }
}

/// The lines of a file in order.
struct Cursor<'a> {
    lines: std::str::Lines<'a>,
    /// Number of the line last read, from 1.
    number: usize,
    /// What begins a comment, which is read as if it were not there.
    comment: Option<char>,
}

impl<'a> Cursor<'a> {
    fn new(text: &'a str) -> Self {
        Self { lines: text.lines(), number: 0, comment: None }
    }

    fn with_comments(text: &'a str, comment: char) -> Self {
        Self { comment: Some(comment), ..Self::new(text) }
    }

    /// The next line that is not blank.
    fn next_filled(&mut self) -> Option<Line<'a>> {
        loop {
            let text = self.lines.next()?;
            self.number += 1;
            let text = self.comment.and_then(|comment| text.split(comment).next()).unwrap_or(text);
            if !text.trim().is_empty() {
                return Some(Line::new(self.number, text));
            }
        }
    }

    /// The same where `what` is expected.
    fn next(&mut self, what: &str) -> Result<Line<'a>, Problem> {
        self.next_filled().ok_or_else(|| Problem {
            line: self.number + 1,
            text: format!("the file ends where {what} is expected"),
        })
    }
}

/// The mesh without the nodes of no tetrahedron, in groups neither, whose nodes are then ascending.
fn keep_used_nodes(mesh: TetMesh) -> TetMesh {
    let mut renumbered = vec![None; mesh.positions.len()];
    mesh.tets.iter().flatten().for_each(|&node| renumbered[node] = Some(0));
    let mut positions = Vec::new();
    for (number, position) in renumbered.iter_mut().zip(mesh.positions) {
        if let Some(number) = number {
            *number = positions.len();
            positions.push(position);
        }
    }
    let groups = mesh.groups.into_iter().map(|group| {
        let mut nodes: Vec<usize> = group.nodes.into_iter().filter_map(|node| renumbered[node]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        Group { nodes, ..group }
    });
    // Every node of a tetrahedron is in use, so that the default is never taken.
    let tets = mesh.tets.iter().map(|tet| tet.map(|node| renumbered[node].unwrap_or_default())).collect();
    TetMesh { positions, tets, groups: groups.collect(), ..mesh }
}
