//! Tetrahedra with fields as VTU files, and their sequence as a PVD file, for ParaView.
//!
//! Arrays are base64 inside the XML, little-endian, each behind its length in bytes as a 64-bit integer
//! \[VTK, "VTK XML file formats"\].

use std::io::{self, Write};

use data_encoding::BASE64;

/// Cell type of a linear tetrahedron in VTK.
const TETRAHEDRON: u8 = 10;

/// A field of values at each node or cell.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// Name in ParaView.
    pub name: &'a str,
    /// Number of components of a node or cell.
    pub components: usize,
    /// All components, those of a node or cell together.
    pub values: &'a [f64],
}

/// Writes tetrahedra at their current positions, m, with fields of nodes and of tetrahedra, as VTU.
///
/// # Errors
/// If `target` cannot be written to.
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

/// Writes a list of files and their times, s, as PVD.
///
/// # Errors
/// If `target` cannot be written to.
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
    let text = BASE64.encode(&[&length, bytes].concat());
    writeln!(
        target,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{text}</DataArray>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let content = rest.split(['>', '<']).nth(1).expect("its content");
            BASE64.decode(content.as_bytes()).expect("base64")
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
}
