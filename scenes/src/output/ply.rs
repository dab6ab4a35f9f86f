//! Surfaces as binary PLY files, which ParaView, Blender and MeshLab read as a sequence.

use std::io::{self, Error, ErrorKind, Write};

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

/// The positions in a file that [`write_ply`] has written.
///
/// # Errors
/// [`ErrorKind::InvalidData`] if it has another format.
pub fn read_vertices(file: &[u8]) -> io::Result<Vec<[f32; 3]>> {
    const END: &[u8] = b"\nend_header\n";
    let read = || {
        let header = file.windows(END.len()).position(|bytes| bytes == END)?;
        let text = std::str::from_utf8(&file[..header]).ok()?;
        let count = text.lines().find_map(|line| line.strip_prefix("element vertex "))?;
        let length = count.parse::<usize>().ok()?.checked_mul(12)?;
        let (coordinates, _) = file[header + END.len()..].get(..length)?.as_chunks::<4>();
        let (vertices, _) = coordinates.as_chunks::<3>();
        Some(vertices.iter().map(|vertex| vertex.map(f32::from_le_bytes)).collect())
    };
    let malformed = || Error::new(ErrorKind::InvalidData, "it is not a surface that piola has written");
    read().ok_or_else(malformed)
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
        let body_at = header.len() + "end_header\n".len();
        let body = &bytes[body_at..];
        assert_eq!(body.len(), 3 * 12 + 13);
        assert_eq!(body[8..12], [0, 0, 0, 0xc0], "−2 in little-endian order");
        assert_eq!(body[36..], [3, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
        assert_eq!(read_vertices(&bytes)?, [[0.0, 1.0, -2.0], [0.5; 3], [3.0; 3]]);
        for length in 0..body_at + 36 {
            assert!(read_vertices(&bytes[..length]).is_err(), "cut off after {length} bytes");
        }
        Ok(())
    }
}
