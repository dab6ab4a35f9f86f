//! Tetrahedra with fields as VTU files, and their sequence as a PVD file, for ParaView.
//!
//! Arrays are base64 inside the XML, little-endian, each behind its length in bytes as a 64-bit integer
//! \[VTK, "VTK XML file formats"\].

use std::io::{self, Write};

/// VTK's number for a linear tetrahedron.
const TETRAHEDRON: u8 = 10;

/// A field of so many components, for each node or each cell.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// What it is called.
    pub name: &'a str,
    /// How many numbers belong to a node or cell.
    pub components: usize,
    /// The numbers, those of a node or cell together.
    pub values: &'a [f64],
}

/// Writes tetrahedra at their present positions, m, with fields of nodes and of tetrahedra.
///
/// # Errors
/// Where `target` cannot be written to.
pub fn write_vtu(
    target: &mut impl Write,
    positions: &[[f64; 3]],
    tets: &[[usize; 4]],
    nodal: &[Field<'_>],
    elemental: &[Field<'_>],
) -> io::Result<()> {
    writeln!(
        target,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
        positions.len(),
        tets.len()
    )?;
    let points = Field { name: "points", components: 3, values: positions.as_flattened() };
    section(target, "Points", &[points])?;
    let nodes = tets.as_flattened().iter().flat_map(|&node| (node as i64).to_le_bytes());
    let ends = (1..=tets.len()).flat_map(|tet| (4 * tet as i64).to_le_bytes());
    writeln!(target, "<Cells>")?;
    array(target, "Int64", "connectivity", 1, &nodes.collect::<Vec<_>>())?;
    array(target, "Int64", "offsets", 1, &ends.collect::<Vec<_>>())?;
    array(target, "UInt8", "types", 1, &vec![TETRAHEDRON; tets.len()])?;
    writeln!(target, "</Cells>")?;
    section(target, "PointData", nodal)?;
    section(target, "CellData", elemental)?;
    writeln!(target, "</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// Writes which file shows which time, s.
///
/// # Errors
/// Where `target` cannot be written to.
pub fn write_pvd(target: &mut impl Write, files: impl IntoIterator<Item = (f64, String)>) -> io::Result<()> {
    writeln!(target, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>")?;
    for (time, file) in files {
        writeln!(target, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>")?;
    }
    writeln!(target, "</Collection>\n</VTKFile>")
}

fn section(target: &mut impl Write, name: &str, fields: &[Field<'_>]) -> io::Result<()> {
    writeln!(target, "<{name}>")?;
    for field in fields {
        let bytes: Vec<u8> = field.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        array(target, "Float64", field.name, field.components, &bytes)?;
    }
    writeln!(target, "</{name}>")
}

fn array(target: &mut impl Write, kind: &str, name: &str, components: usize, bytes: &[u8]) -> io::Result<()> {
    let length = (bytes.len() as u64).to_le_bytes();
    write!(
        target,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">"
    )?;
    target.write_all(&base64(&[&length, bytes].concat()))?;
    writeln!(target, "</DataArray>")
}

/// Four letters for each three bytes [RFC 4648, section 4].
fn base64(bytes: &[u8]) -> Vec<u8> {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let at = |k: usize| u32::from(three.get(k).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() { letter } else { b'=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        // Its test vectors, section 10.
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text.as_bytes());
        }
    }

    #[test]
    fn a_tetrahedron_can_be_read_back() -> io::Result<()> {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
        let field = Field { name: "det F", components: 1, values: &[1.5] };
        let mut bytes = Vec::new();
        write_vtu(&mut bytes, &positions, &[[0, 1, 2, 3]], &[], &[field])?;
        let text = String::from_utf8(bytes).expect("ASCII");
        assert!(text.contains("NumberOfPoints=\"4\" NumberOfCells=\"1\""), "{text}");
        let array = |name: &str| {
            let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).expect("the array");
            decode(rest.split(['>', '<']).nth(1).expect("its content"))
        };
        let numbers = |bytes: &[u8]| -> Vec<f64> {
            let eight = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().expect("eight bytes"));
            bytes.chunks(8).map(eight).collect()
        };
        let points = array("points");
        assert_eq!(points[..8], 96u64.to_le_bytes());
        assert_eq!(numbers(&points[8..]), positions.as_flattened());
        assert_eq!(array("det F"), [8u64.to_le_bytes(), 1.5f64.to_le_bytes()].concat());
        assert_eq!(array("types"), [&1u64.to_le_bytes()[..], &[TETRAHEDRON]].concat());
        assert_eq!(array("offsets"), [8u64, 4].map(u64::to_le_bytes).concat());
        assert_eq!(array("connectivity"), [32u64, 0, 1, 2, 3].map(u64::to_le_bytes).concat());
        Ok(())
    }

    fn decode(text: &str) -> Vec<u8> {
        let value = |letter: u8| match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            _ => 63,
        };
        let mut bytes = Vec::new();
        for four in text.as_bytes().chunks(4) {
            let letters = four.iter().filter(|&&letter| letter != b'=');
            let count = letters.clone().count();
            let bits = letters.fold(0u32, |bits, &letter| bits << 6 | u32::from(value(letter)));
            let bits = bits << (6 * (4 - count));
            bytes.extend(&bits.to_be_bytes()[1..count]);
        }
        bytes
    }
}
