//! Text files read line by line and word by word, with errors that name the line.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use piola::__private::message::{printable, quoted};
use thiserror::Error;

use crate::mesh::TetMesh;
use crate::mesh::elements::TETRAHEDRON;

/// Remedy for a file of Gmsh with elements other than linear tetrahedra.
pub(super) const IN_GMSH: &str =
    "mesh it with these alone (in Gmsh, without `Recombine` and with `-order 1`)";

/// Reason why a file cannot be read as a mesh or a surface.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", shown(path))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The contents do not follow the format.
    #[error("{}:{line}: {problem}", shown(path))]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, from 1; one past the last if the file ends too early.
        line: usize,
        /// Description of the problem.
        problem: String,
    },
    /// The volume is not made of linear tetrahedra only.
    #[error(
        "{}: {}",
        shown(path),
        mesh.left_out.clone().and(TETRAHEDRON, mesh.tets.len()).refusal(IN_GMSH)
    )]
    OtherElements {
        /// The file.
        path: PathBuf,
        /// The linear tetrahedra, with the other elements in [`TetMesh::left_out`].
        mesh: Box<TetMesh>,
    },
}

impl ReadError {
    /// Linear tetrahedra of a mesh that is refused for its other volume elements: a body that lacks their
    /// volume. [`TetMesh::left_out`] counts them.
    ///
    /// ```
    /// use piola_bodies::mesh::{ReadError, parse_msh};
    ///
    /// let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
    ///     $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 0\n$EndNodes\n\
    ///     $Elements\n2\n1 4 0 1 2 3 4\n2 7 0 1 2 5 3 4\n$EndElements\n";
    /// let mesh = parse_msh(text, "mixed.msh").or_else(ReadError::only_tetrahedra)?;
    /// assert_eq!((mesh.tets.len(), mesh.left_out.to_string().as_str()), (1, "1 pyramid"));
    /// # Ok::<(), ReadError>(())
    /// ```
    ///
    /// # Errors
    /// Any other error, unchanged.
    pub fn only_tetrahedra(self) -> Result<TetMesh, Self> {
        match self {
            Self::OtherElements { mesh, .. } => Ok(*mesh),
            other => Err(other),
        }
    }
}

/// A path as it may be shown.
fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

/// Reads a file and parses its text; errors name the file.
pub(super) fn read<T>(path: &Path, parse: impl FnOnce(&str) -> Result<T, Problem>) -> Result<T, ReadError> {
    let bytes =
        std::fs::read(path).map_err(|source| ReadError::Unreadable { path: path.to_owned(), source })?;
    if is_utf_16(&bytes) {
        let problem = "the file is in UTF-16; save it as UTF-8".to_owned();
        return Err(ReadError::Malformed { path: path.to_owned(), line: 1, problem });
    }
    // Names in other encodings must not make a mesh invalid.
    read_text(path, &String::from_utf8_lossy(&bytes), parse)
}

/// Parses text from a file without the byte order mark before it; errors name the file.
pub(super) fn read_text<T>(
    path: &Path,
    text: &str,
    parse: impl FnOnce(&str) -> Result<T, Problem>,
) -> Result<T, ReadError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    parse(text).map_err(|Problem { line, text }| ReadError::Malformed {
        path: path.to_owned(),
        line,
        problem: text,
    })
}

/// True if bytes begin with the byte order mark of UTF-16, or with a character of two bytes, one of them
/// zero.
fn is_utf_16(bytes: &[u8]) -> bool {
    match *bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        [first, second, ..] => (first == 0) != (second == 0),
        _ => false,
    }
}

/// A problem and its line, from 1.
#[derive(Debug, PartialEq)]
pub(super) struct Problem {
    pub(super) line: usize,
    pub(super) text: String,
}

/// A line with its number, read word by word.
pub(super) struct Line<'a> {
    number: usize,
    pub(super) text: &'a str,
    pub(super) words: std::str::SplitAsciiWhitespace<'a>,
}

impl Line<'_> {
    pub(super) fn problem(&self, text: impl Into<String>) -> Problem {
        Problem { line: self.number, text: text.into() }
    }

    /// Parses the next word as a number, which errors call `what`.
    pub(super) fn number<N: FromStr>(&mut self, what: &str) -> Result<N, Problem> {
        match self.words.next() {
            None => Err(self.problem(format!("{what} is missing"))),
            Some(word) => {
                word.parse().map_err(|_| self.problem(format!("expected {what}, found `{}`", quoted(word))))
            }
        }
    }

    /// Parses the next word as a number; `None` at the end of the line.
    pub(super) fn number_if_any<N: FromStr>(&mut self, what: &str) -> Result<Option<N>, Problem> {
        if self.words.clone().next().is_none() { Ok(None) } else { self.number(what).map(Some) }
    }

    pub(super) fn coordinate(&mut self, what: &str) -> Result<f64, Problem> {
        let x: f64 = self.number(what)?;
        if x.is_finite() { Ok(x) } else { Err(self.problem(format!("{what} is {x}; it must be finite"))) }
    }

    pub(super) fn point(&mut self) -> Result<[f64; 3], Problem> {
        Ok([
            self.coordinate("the x coordinate")?,
            self.coordinate("the y coordinate")?,
            self.coordinate("the z coordinate")?,
        ])
    }
}

pub(super) struct Cursor<'a> {
    lines: std::str::Lines<'a>,
    /// Number of the line last read, from 1.
    pub(super) number: usize,
    /// The start of a comment, which is skipped.
    comment: Option<char>,
}

impl<'a> Cursor<'a> {
    /// Text in which comments begin with a character, if there are any.
    pub(super) fn new(text: &'a str, comment: Option<char>) -> Self {
        Self { lines: text.lines(), number: 0, comment }
    }

    /// Reads the next line that is not blank.
    pub(super) fn next_filled(&mut self) -> Option<Line<'a>> {
        loop {
            let text = self.lines.next()?;
            self.number += 1;
            let text = self.comment.and_then(|comment| text.split(comment).next()).unwrap_or(text);
            if !text.trim().is_empty() {
                return Some(Line { number: self.number, text, words: text.split_ascii_whitespace() });
            }
        }
    }

    /// Reads the next line that is not blank; at the end of the file an error that `what` is expected.
    pub(super) fn next(&mut self, what: &str) -> Result<Line<'a>, Problem> {
        self.next_filled().ok_or_else(|| Problem {
            line: self.number + 1,
            text: format!("the file ends where {what} is expected"),
        })
    }
}
