//! Surfaces as binary PLY files, which ParaView, Blender and MeshLab read as a sequence.

use std::io::{self, Write};

/// Writes a triangle surface: positions in metres, triangles as triples of vertices from 0.
///
/// # Errors
/// If `target` cannot be written to.
pub fn write_ply(target: &mut impl Write, vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> io::Result<()> {
    write!(
        target,
        "ply\nformat binary_little_endian 1.0\n\
         element vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices.len(),
        triangles.len()
    )?;
    for coordinate in vertices.as_flattened() {
        target.write_all(&coordinate.to_le_bytes())?;
    }
    for triangle in triangles {
        target.write_all(&[3])?;
        for vertex in triangle {
            target.write_all(&vertex.to_le_bytes())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_has_the_bytes_that_the_format_says() -> io::Result<()> {
        let mut bytes = Vec::new();
        write_ply(&mut bytes, &[[0.0, 1.0, -2.0], [0.5; 3], [3.0; 3]], &[[2, 0, 1]])?;
        let text = String::from_utf8_lossy(&bytes);
        let header = text.split_once("end_header\n").map(|(header, _)| header).unwrap_or_default();
        assert!(header.contains("element vertex 3\n") && header.contains("element face 1\n"), "{header}");
        let body = &bytes[header.len() + "end_header\n".len()..];
        assert_eq!(body.len(), 3 * 12 + 13);
        assert_eq!(body[8..12], [0, 0, 0, 0xc0], "−2 in little-endian order");
        assert_eq!(body[36..], [3, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
        Ok(())
    }
}
