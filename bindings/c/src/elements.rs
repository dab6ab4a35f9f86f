//! Linear tetrahedra: shapes at rest, gradients of their energies and stiffnesses.

use piola::batch::{REST, Tetrahedra};
use piola_bodies::mesh::TetMesh;

use crate::functions::functions;
use crate::lent;
use crate::material::Material;
use crate::options::Survey;

functions! {
/// Shapes of tetrahedra at rest: ten numbers each, the inverse of Dm row by row, 1/m, and the volume, m³, the
/// input of `piola_stiffnesses`. The columns of Dm are x1 - x0, x2 - x0, x3 - x0.
///
/// `positions` has three numbers for each node, m; `corners` four nodes, from 0, for each tetrahedron, with
/// det Dm > 0, which `piola_turn_tets` brings about.
///
/// Errors: PIOLA_CODE_BODY for nodes that do not exist or belong to no tetrahedron, and volumes that are not
/// positive beyond rounding; tetrahedra are numbered from 1 in the message.
fn piola_rest_shapes(positions: &[f64], corners: &[usize], rest: &mut [f64]) {
    let (positions, corners) = (lent::rows("positions", positions)?, lent::rows("corners", corners)?);
    lent::demand_length("rest", rest.len(), REST, corners.len())?;
    let shapes = TetMesh::new(positions.to_vec(), corners.to_vec()).rest_shapes()?;
    for (shape, rest) in shapes.iter().zip(rest.as_chunks_mut().0) {
        *rest = shape.components();
    }
    Ok(())
}

/// Swaps two nodes of each tetrahedron with det Dm < 0 in `corners`. The order of nodes is a convention of
/// the program that wrote the mesh.
///
/// `positions` and `corners` are those of `piola_rest_shapes`. Flat tetrahedra, and those with a node that
/// does not exist, remain as they are. `turned`, which may be null, receives the number of swaps.
fn piola_turn_tets(positions: &[f64], corners: &mut [usize], turned: Out<usize>) {
    let tets = lent::rows("corners", corners)?.to_vec();
    let mesh = TetMesh::new(lent::rows("positions", positions)?.to_vec(), tets).turn_tets();
    corners.copy_from_slice(mesh.tets.as_flattened());
    turned.write(mesh.turned_tets)
}
}

functions! {
    E = f64, f32: " in single precision.";

/// Gradients of the energies of linear tetrahedra in the positions of their nodes, N, and filtered
/// stiffnesses, N/m, from deformation gradients F = Ds Dm⁻¹, nine numbers each, and shapes at rest, ten
/// numbers each as from `piola_rest_shapes`.
///
/// Gradients have 12 numbers, coordinate a of node n at 3n+a: forces are minus these. Stiffnesses have 144
/// numbers, row by row: row and column 3n+a for coordinate a of node n.
///
/// The filter acts on dP/dF and is pulled back to the nodes.
fn piola_stiffnesses, piola_stiffnesses_f32(
    material: &Material,
    options: Options,
    F: &[E],
    rest: &[E],
    gradients: &mut [E],
    stiffnesses: &mut [E],
    survey: Out<Survey>,
) {
    survey.write(options.batch(material)?.stiffnesses(F, rest, gradients, stiffnesses)?.into())
}

/// Gradients and stiffnesses as from `piola_stiffnesses`, with the nodes at `positions`, three numbers for
/// each, m: F = Ds Dm⁻¹ is computed on the way. `corners` has four nodes, from 0, for each tetrahedron.
///
/// In lines, `rest`, `gradients` and `stiffnesses` extend to the end of the last line; fill `rest` up with
/// shapes of tetrahedra with edges of length 1 along the axes.
///
/// Errors: PIOLA_CODE_VALUE for nodes that do not exist.
fn piola_stiffnesses_at, piola_stiffnesses_at_f32(
    material: &Material,
    options: Options,
    positions: &[E],
    corners: &[usize],
    rest: &[E],
    gradients: &mut [E],
    stiffnesses: &mut [E],
    survey: Out<Survey>,
) {
    let (positions, corners) = (lent::rows("positions", positions)?, lent::rows("corners", corners)?);
    let tetrahedra = Tetrahedra::new(positions.len(), corners)?;
    let batch = options.batch(material)?;
    survey.write(batch.stiffnesses_at(tetrahedra, positions, rest, gradients, stiffnesses)?.into())
}
}
