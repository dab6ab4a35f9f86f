//! Formats that are not read, recognised by their words, and the next step from each.

/// Conversion of the formats that meshio reads.
pub(super) const BY_MESHIO: &str = "`meshio convert OLD NEW.msh --output-format gmsh22 --ascii` converts it";
const BY_HAND: &str = "no command converts it; with its points and tetrahedra as arrays in Python, \
     `meshio.write_points_cells(\"NEW.msh\", points, {\"tetra\": tets}, file_format=\"gmsh22\", binary=False)` writes a mesh";
const CUT: &str = "the lines between `*VERTICES` and `*ELEMENTS`, saved as NEW.node, and those from the one below `TET` \
     to the next blank one, saved as NEW.ele, are TetGen's files";
const FILLED: &str = "it is a surface without tetrahedra; `echo 'Merge \"OLD\"; Surface Loop(1) = {1}; Volume(1) = \
     {1};' > NEW.geo` and `gmsh NEW.geo -3 -format msh41 -o NEW.msh` fill a closed one";

/// First words of a line, the format that has one of them, and the next step.
const FORMATS: [(&str, &str, &str); 11] = [
    ("vtk", "VTK", BY_MESHIO),
    ("<vtkfile", "VTK's XML (VTU)", BY_MESHIO),
    ("meshversionformatted", "Medit's format", BY_MESHIO),
    ("*keyword", "LS-DYNA's format", BY_HAND),
    ("<febio_spec", "FEBio's format", BY_HAND),
    ("tets", "the format .tet", BY_HAND),
    ("*vertices", "VegaFEM's format", CUT),
    ("*heading *part *node", "Abaqus' format", BY_MESHIO),
    ("off", "OFF", FILLED),
    ("facet", "STL", FILLED),
    ("v", "Wavefront OBJ", FILLED),
];

/// Name of the format of a text in which a line begins with a word of [`FORMATS`], behind `#` and numbers,
/// and the next step from there.
pub(super) fn recognised(text: &str) -> Option<(&'static str, &'static str)> {
    // Comments may precede the word.
    text.lines().take(1000).find_map(|line| {
        let mut words = line.split(|c: char| matches!(c, ',' | '>') || c.is_whitespace());
        let word = words.find(|word| !["", "#"].contains(word) && word.parse::<f64>().is_err())?;
        let is_word = |first: &str| first.eq_ignore_ascii_case(word);
        FORMATS.iter().find(|format| format.0.split(' ').any(is_word)).map(|&(_, name, next)| (name, next))
    })
}
