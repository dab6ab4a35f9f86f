//! Bodies: meshes of linear tetrahedra with materials and densities.

use std::sync::Arc;

use piola_bodies::mesh::{Group, TetMesh};

use crate::error::{Code, Failure, guard};
use crate::lent::{Arrays, plain};
use crate::material::Material;
use crate::options::Survey;
use crate::{handle, lent};

/// An elastic body at rest. Immutable: threads may share it.
pub struct Body(pub(crate) Arc<piola_bodies::system::Body>);

/// The material and the density of a part of a body.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Part {
    /// The material.
    pub material: *const Material,
    /// Mass density at rest, kg/m³.
    pub density: f64,
}
plain!(Part);

/// Makes a body of nodes at `positions`, three numbers each, m, and tetrahedra, `corners` with four nodes
/// each, from 0, and det [x1 - x0, x2 - x0, x3 - x0] > 0.
///
/// `part_of` has the part of each tetrahedron, from 0; it may be null, with a length of 0, if there is one
/// part. The body keeps its materials, whose handles may be freed.
///
/// Errors: PIOLA_CODE_BODY for an invalid body: nodes without tetrahedron, volumes and densities that are not
/// positive, a material with values for another number of tetrahedra; the message numbers tetrahedra from 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_body_new(
    positions: *const f64,
    positions_length: usize,
    corners: *const usize,
    corners_length: usize,
    part_of: *const usize,
    part_of_length: usize,
    parts: *const Part,
    parts_length: usize,
    body: *mut *mut Body,
) -> Code {
    guard(|| {
        let mut arrays = Arrays::new();
        // SAFETY: arrays as long as stated, handles, and room for a handle.
        unsafe {
            let positions =
                lent::vectors("positions", arrays.input("positions", positions, positions_length)?)?;
            let corners = lent::corners("corners", arrays.input("corners", corners, corners_length)?)?;
            let part_of = arrays.input("part_of", part_of, part_of_length)?;
            let parts = arrays.input("parts", parts, parts_length)?;
            handle::give("body", body, || {
                let mut mesh = TetMesh::new(positions.to_vec(), corners.to_vec());
                mesh.groups = groups(part_of, corners.len(), parts.len())?;
                let part = |(k, part): (usize, &Part)| {
                    let material = lent::value("parts[].material", part.material)?.for_body()?;
                    let group = mesh.groups.get(k).map(|group| group.name.clone());
                    Ok(piola_bodies::system::Part { group, material, density: part.density })
                };
                let parts: Result<Vec<_>, Failure> = parts.iter().enumerate().map(part).collect();
                Ok(Body(Arc::new(piola_bodies::system::Body::from_parts(&mesh, parts?)?)))
            })
        }
    })
}

/// Lumped masses of the nodes, kg, one number each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_body_masses(
    body: *const Body,
    masses: *mut f64,
    masses_length: usize,
) -> Code {
    guard(|| {
        // SAFETY: a handle, and an array as long as stated.
        let (body, masses) =
            unsafe { (lent::value("body", body)?, Arrays::new().output("masses", masses, masses_length)?) };
        lent::demand_length("masses", masses.len(), 1, body.0.masses().len())?;
        masses.copy_from_slice(body.0.masses());
        Ok(())
    })
}

/// Frees a body, or does nothing with null. Simulations of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_body_free(body: *mut Body) {
    // SAFETY: a handle that is not used any more.
    unsafe { handle::free(body) }
}

/// The parts as groups of a mesh; none where one part has all tetrahedra.
fn groups(part_of: &[usize], tetrahedra: usize, parts: usize) -> Result<Vec<Group>, Failure> {
    if part_of.is_empty() && parts == 1 {
        return Ok(Vec::new());
    }
    lent::demand_length("part_of", part_of.len(), 1, tetrahedra)?;
    let group = |part: usize| Group { name: part.to_string(), dimension: 3, ..Group::default() };
    let mut groups: Vec<Group> = (0..parts).map(group).collect();
    for (tetrahedron, &part) in part_of.iter().enumerate() {
        let group = groups.get_mut(part).ok_or_else(|| {
            let message = format_args!("`part_of[{tetrahedron}]` is {part}; there are {parts} parts, from 0");
            Failure::new(Code::Value, message)
        })?;
        group.tets.push(tetrahedron);
    }
    Ok(groups)
}

/// A survey of elements, which are sorted by part, as one of tetrahedra in the order of the caller.
pub(crate) fn of_tetrahedra(survey: piola::Survey, body: &piola_bodies::system::Body) -> Survey {
    let first = survey.first.and_then(|element| body.elements().get(element)).map(|element| element.tag - 1);
    piola::Survey { first, ..survey }.into()
}
