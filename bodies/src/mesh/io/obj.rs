//! Surfaces from Wavefront OBJ files: `v` and `f` lines, all others are skipped.

use std::path::Path;

use piola::__private::message::quoted;

use super::foreign;
use super::text::{Cursor, Line, Problem, ReadError, read, read_text};

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
/// Polygons are halved until triangles are left, which is right for convex ones. Indices may count from the
/// end, and may carry texture and normal indices, which are skipped like every line other than `v` and `f`.
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
    read_text(name.as_ref(), text, parse)
}

fn parse(text: &str) -> Result<Surface, Problem> {
    let mut surface = Surface::default();
    let mut polygon = Vec::new();
    let mut cursor = Cursor::new(text, None);
    while let Some(mut line) = cursor.next_filled() {
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
                halve(&polygon, &mut surface.triangles);
            }
            _ => {}
        }
    }
    if surface.triangles.is_empty() {
        let text = match foreign::recognised(text) {
            Some((name, _)) if surface.positions.is_empty() => {
                format!("the file is in {name}, not in OBJ; `meshio convert OLD NEW.obj` converts a surface")
            }
            _ => "the file ends without a face".to_owned(),
        };
        return Err(Problem { line: cursor.number + 1, text });
    }
    Ok(surface)
}

/// Adds the triangles of a polygon by repeated halving, which makes them compact. In a fan all of them would
/// reach from the first vertex across the polygon, and drawing a large fan would visit every pixel for each.
fn halve(polygon: &[usize], triangles: &mut Vec<[usize; 3]>) {
    if let [first, _, .., last] = *polygon {
        let middle = polygon.len() / 2;
        halve(&polygon[..=middle], triangles);
        triangles.push([first, polygon[middle], last]);
        halve(&polygon[middle..], triangles);
    }
}

/// Parses a word such as `7`, `7/1`, `7//3` or `-1` as an index from 0.
fn vertex(line: &Line<'_>, word: &str, vertices: usize) -> Result<usize, Problem> {
    let index: i64 =
        word.split('/').next().and_then(|number| number.parse().ok()).ok_or_else(|| {
            line.problem(format!("expected the index of a vertex, found `{}`", quoted(word)))
        })?;
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
    fn polygons_become_triangles_and_indices_may_count_from_the_end() {
        let text = "# square\no one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -4/2 -2 -1\n";
        let surface = parse(text).expect("a good file");
        assert_eq!(surface.positions.len(), 4);
        assert_eq!(surface.triangles, [[0, 1, 2], [0, 2, 3], [0, 2, 3]]);
    }

    /// Their boxes, through which a picture searches, add up to a few times the box of the polygon.
    #[test]
    fn large_polygons_become_compact_triangles_of_the_same_area() {
        let count = 6000;
        let vertex = |k: usize| (k as f64 / count as f64 * std::f64::consts::TAU).sin_cos();
        let mut text: String =
            (0..count).map(|k| format!("v {0} {1} 0\n", vertex(k).1, vertex(k).0)).collect();
        text += &(1..=count).fold("f".to_owned(), |line, k| format!("{line} {k}"));
        let surface = parse(&text).expect("a good file");
        assert_eq!(surface.triangles.len(), count - 2);
        let (mut area, mut boxes) = (0.0, 0.0);
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.map(|vertex| surface.positions[vertex]);
            area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
            let size = crate::mesh::Bounds::around(&[a, b, c]).size();
            boxes += size[0] * size[1];
        }
        // A polygon of n sides in the unit circle; its rounding is far below the 16 digits that are printed.
        let expected = 0.5 * count as f64 * (std::f64::consts::TAU / count as f64).sin();
        assert!((area - expected).abs() <= 1e-12, "{area} for {expected}");
        assert!(boxes <= 3.0 * 4.0, "boxes of {boxes} in one of 4");
    }

    #[test]
    fn other_encodings_are_named() -> Result<(), Box<dyn std::error::Error>> {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let folder = std::env::temp_dir().join(format!("piola-utf-16-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let file = folder.join("surface.obj");
        for bytes in
            [&[&[0xff, 0xfe][..], &little].concat(), &[&[0xfe, 0xff][..], &big].concat(), &little, &big]
        {
            std::fs::write(&file, bytes)?;
            let error = read_surface_obj(&file).expect_err("UTF-16").to_string();
            assert!(error.ends_with("surface.obj:1: the file is in UTF-16; save it as UTF-8"), "{error}");
        }
        std::fs::write(&file, [&[0xef, 0xbb, 0xbf][..], text.as_bytes()].concat())?;
        assert_eq!(read_surface_obj(&file)?, parse_surface_obj(text, "plain.obj")?);
        std::fs::remove_dir_all(&folder)?;
        Ok(())
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
        check("v 0 \u{1b}[2J 0\n", 1, "expected the y coordinate, found `\\u{1b}[2J`");
        check("v 0 0 0\nf 1 \u{7}a 1\n", 2, "expected the index of a vertex, found `\\u{7}a`");
        check("v 0 0 0\nf 1 1\n", 2, "a face needs at least 3 vertices, not 2");
        check("v 0 0 0\n", 2, "the file ends without a face");
        let stl = "the file is in STL, not in OBJ; `meshio convert OLD NEW.obj` converts a surface";
        check("solid bar\nfacet normal 0 0 1\n", 3, stl);
        check("", 1, "the file ends without a face");
    }
}
