//! Surfaces from Wavefront OBJ files: `v` and `f` lines, all others are skipped.

use std::path::Path;

use super::text::{Line, Problem, ReadError, named, read};

/// Triangle surface, such as one that is drawn in place of the tetrahedra it is embedded in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Position of each vertex, m, in the order of the file.
    pub positions: Vec<[f64; 3]>,
    /// Vertices of each triangle, from 0, in the orientation of the file.
    pub triangles: Vec<[usize; 3]>,
}

/// Reads the triangles of a Wavefront OBJ file.
///
/// Polygons become fans around their first vertex. Indices may count from the end, and may carry texture and
/// normal indices, which are skipped like every line other than `v` and `f`.
///
/// # Errors
/// [`ReadError`], which names the line if it is malformed or names a vertex that does not precede it.
pub fn read_surface_obj(path: impl AsRef<Path>) -> Result<Surface, ReadError> {
    read(path.as_ref(), parse)
}

/// Parses the triangles of a Wavefront OBJ file from text in memory; `name` stands for the file in errors.
///
/// Otherwise like [`read_surface_obj`].
///
/// # Errors
/// [`ReadError::Malformed`].
pub fn parse_surface_obj(text: &str, name: impl AsRef<Path>) -> Result<Surface, ReadError> {
    named(name.as_ref(), parse(text))
}

fn parse(text: &str) -> Result<Surface, Problem> {
    let mut surface = Surface::default();
    let mut polygon = Vec::new();
    let mut end = 1;
    for (index, text) in text.lines().enumerate() {
        let mut line = Line::new(index + 1, text);
        end = index + 2;
        match line.words.next() {
            Some("v") => surface.positions.push(line.point()?),
            Some("f") => {
                polygon.clear();
                while let Some(word) = line.words.next() {
                    polygon.push(vertex(&line, word, surface.positions.len())?);
                }
                if polygon.len() < 3 {
                    return Err(
                        line.problem(format!("a face needs at least 3 vertices, not {}", polygon.len()))
                    );
                }
                surface
                    .triangles
                    .extend(polygon.windows(2).skip(1).map(|edge| [polygon[0], edge[0], edge[1]]));
            }
            _ => {}
        }
    }
    if surface.triangles.is_empty() {
        return Err(Problem { line: end, text: "the file ends without a face".to_owned() });
    }
    Ok(surface)
}

/// Parses a word such as `7`, `7/1`, `7//3` or `-1` as an index from 0.
fn vertex(line: &Line<'_>, word: &str, vertices: usize) -> Result<usize, Problem> {
    let index: i64 = word
        .split('/')
        .next()
        .and_then(|number| number.parse().ok())
        .ok_or_else(|| line.problem(format!("expected the index of a vertex, found `{word}`")))?;
    let from_start = if index < 0 { vertices as i64 + index } else { index - 1 };
    match usize::try_from(from_start) {
        Ok(vertex) if vertex < vertices => Ok(vertex),
        _ => Err(line.problem(format!("the face names vertex {index}, but {vertices} precede it"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_become_fans_and_indices_may_count_from_the_end() {
        let text = "# square\no one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -4/2 -2 -1\n";
        let surface = parse(text).expect("a good file");
        assert_eq!(surface.positions.len(), 4);
        assert_eq!(surface.triangles, [[0, 1, 2], [0, 2, 3], [0, 2, 3]]);
    }

    #[track_caller]
    fn check(text: &str, line: usize, problem: &str) {
        assert_eq!(parse(text), Err(Problem { line, text: problem.to_owned() }));
    }

    #[test]
    fn problems_name_the_line() {
        check("v 0 0 0\nv 0 x 0\n", 2, "expected the y coordinate, found `x`");
        check("v 0 0\n", 1, "the z coordinate is missing");
        check("v 0 0 inf\n", 1, "the z coordinate is inf; it must be finite");
        check("v 0 0 0\n\nf 1 1 2\n", 3, "the face names vertex 2, but 1 precede it");
        check("v 0 0 0\nf 1 0 1\n", 2, "the face names vertex 0, but 1 precede it");
        check(
            "v 0 0 0\nf 1 -9223372036854775808 1\n",
            2,
            "the face names vertex -9223372036854775808, but 1 precede it",
        );
        check("v 0 0 0\nf 1 a 1\n", 2, "expected the index of a vertex, found `a`");
        check("v 0 0 0\nf 1 1\n", 2, "a face needs at least 3 vertices, not 2");
        check("v 0 0 0\n", 2, "the file ends without a face");
        check("", 1, "the file ends without a face");
    }
}
