//! A bar of linear tetrahedra, bent out of shape.

use piola_bodies::mesh::tetrahedral_box;

use crate::Error;

/// Linear tetrahedra with the positions of their nodes.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Positions of the nodes now, m.
    pub positions: Vec<[f32; 3]>,
    /// Four nodes of each element.
    pub corners: Vec<[u32; 4]>,
    /// Dm⁻¹ row by row, 1/m, and the volume, m³, of each element.
    pub rest: Vec<[f32; 10]>,
}

/// A bar with `cells` cubes along its axes, six tetrahedra each, stretched, twisted about its first axis, and
/// waved so that each element has another deformation gradient. All J are positive.
///
/// # Errors
/// There are no cells, or too many for the memory.
pub fn bar(cells: [usize; 3]) -> Result<Mesh, Error> {
    let size = cells.map(|count| count as f64 / cells[0] as f64);
    let middle = [size[1] / 2.0, size[2] / 2.0];
    let at_rest = tetrahedral_box(cells, size)?;
    let shapes = at_rest.rest_shapes()?;
    Ok(Mesh {
        positions: at_rest.positions.iter().map(|&at| deformed(at, middle).map(|x| x as f32)).collect(),
        corners: at_rest.tets.iter().map(|tet| tet.map(|node| node as u32)).collect(),
        rest: shapes.iter().map(|shape| shape.components().map(|x| x as f32)).collect(),
    })
}

/// Deformed position of a point of the bar: half of a turn over its length, a stretch between 0.5 and 1.5
/// along it, and one between 0.6 and 1.4 across.
fn deformed([x, y, z]: [f64; 3], middle: [f64; 2]) -> [f64; 3] {
    use std::f64::consts::PI;
    let across = 1.0 + 0.4 * (4.0 * PI * x).cos();
    let [y, z] = [y - middle[0], z - middle[1]].map(|x| x * across);
    let (sin, cos) = (PI * x).sin_cos();
    let along = x + 0.5 / (6.0 * PI) * (6.0 * PI * x).sin();
    [along + 0.05 * (9.0 * y).sin() * z, cos * y - sin * z, sin * y + cos * z]
}
