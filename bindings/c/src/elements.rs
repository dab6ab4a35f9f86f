//! Linear tetrahedra: shapes at rest, gradients of their energies and stiffnesses.

use piola::batch::{REST, Tetrahedra};
use piola_bodies::mesh::TetMesh;

use crate::batch::{call, call_with};
use crate::error::{Code, guard};
use crate::lent::{self, Arrays};
use crate::material::Material;
use crate::options::{Options, Survey};
use crate::twins::twins;

/// Shapes of tetrahedra at rest: ten numbers each, the inverse of Dm row by row, 1/m, and the volume, m³, the
/// input of `piola_stiffnesses`. The columns of Dm are x1 - x0, x2 - x0, x3 - x0.
///
/// `positions` has three numbers for each node, m; `corners` four nodes, from 0, for each tetrahedron, with
/// det Dm > 0.
///
/// Errors: PIOLA_CODE_BODY for nodes that do not exist or belong to no tetrahedron, and volumes that are not
/// positive beyond rounding; tetrahedra are numbered from 1 in the message.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_rest_shapes(
    positions: *const f64,
    positions_length: usize,
    corners: *const usize,
    corners_length: usize,
    rest: *mut f64,
    rest_length: usize,
) -> Code {
    guard(|| {
        let mut arrays = Arrays::new();
        // SAFETY: arrays as long as stated.
        let (positions, corners, rest) = unsafe {
            (
                arrays.input("positions", positions, positions_length)?,
                arrays.input("corners", corners, corners_length)?,
                arrays.output("rest", rest, rest_length)?,
            )
        };
        let (positions, corners) =
            (lent::vectors("positions", positions)?, lent::corners("corners", corners)?);
        lent::demand_length("rest", rest.len(), REST, corners.len())?;
        let shapes = TetMesh::new(positions.to_vec(), corners.to_vec()).rest_shapes()?;
        for (shape, rest) in shapes.iter().zip(rest.as_chunks_mut::<REST>().0) {
            rest[..9].copy_from_slice(shape.inverse.as_flattened());
            rest[9] = shape.volume;
        }
        Ok(())
    })
}

twins!(
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
    material: *const Material,
    options: *const Options,
    F: *const E,
    F_length: usize,
    rest: *const E,
    rest_length: usize,
    gradients: *mut E,
    gradients_length: usize,
    stiffnesses: *mut E,
    stiffnesses_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = (
        [("F", F, F_length), ("rest", rest, rest_length)],
        [("gradients", gradients, gradients_length), ("stiffnesses", stiffnesses, stiffnesses_length)],
    );
    // SAFETY: the requirements of the header on its caller.
    unsafe {
        call(material, options, inputs, outputs, survey, |batch, [F, rest], [gradients, stiffnesses]| {
            Ok(batch.stiffnesses(F, rest, gradients, stiffnesses)?)
        })
    }
}

/// Gradients and stiffnesses as from `piola_stiffnesses`, with the nodes at `positions`, three numbers for
/// each, m: F = Ds Dm⁻¹ is computed on the way. `corners` has four nodes, from 0, for each tetrahedron.
///
/// In lines, `rest`, `gradients` and `stiffnesses` extend to the end of the last line; fill `rest` up with
/// shapes of tetrahedra with edges of length 1 along the axes.
///
/// Errors: PIOLA_CODE_VALUE for nodes that do not exist.
fn piola_stiffnesses_at, piola_stiffnesses_at_f32(
    material: *const Material,
    options: *const Options,
    positions: *const E,
    positions_length: usize,
    corners: *const usize,
    corners_length: usize,
    rest: *const E,
    rest_length: usize,
    gradients: *mut E,
    gradients_length: usize,
    stiffnesses: *mut E,
    stiffnesses_length: usize,
    survey: *mut Survey,
) {
    let (inputs, outputs) = (
        [("positions", positions, positions_length), ("rest", rest, rest_length)],
        [("gradients", gradients, gradients_length), ("stiffnesses", stiffnesses, stiffnesses_length)],
    );
    guard(|| {
        let mut arrays = Arrays::new();
        // SAFETY: the requirements of the header on its caller.
        unsafe {
            let corners = lent::corners("corners", arrays.input("corners", corners, corners_length)?)?;
            call_with(
                arrays,
                material,
                options,
                inputs,
                outputs,
                survey,
                |batch, [positions, rest], [gradients, stiffnesses]| {
                    let positions = lent::vectors("positions", positions)?;
                    let tetrahedra = Tetrahedra::new(positions.len(), corners)?;
                    Ok(batch.stiffnesses_at(tetrahedra, positions, rest, gradients, stiffnesses)?)
                },
            )
        }
    })
}
);
