//! Bodies: meshes of linear tetrahedra with materials and densities.

use std::sync::Arc;

use piola_bodies::mesh::{Group, TetMesh};

use crate::error::{Code, Failure};
use crate::functions::functions;
use crate::lent::plain;
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

functions! {
/// Makes a body of nodes at `positions`, three numbers each, m, and tetrahedra, `corners` with four nodes
/// each, from 0, and det [x1 - x0, x2 - x0, x3 - x0] > 0, which `piola_turn_tets` brings about.
///
/// `part_of` has the part of each tetrahedron, from 0; it may be null, with a length of 0, if there is one
/// part. The body keeps its materials, whose handles may be freed.
///
/// Errors: PIOLA_CODE_BODY for an invalid body: nodes without tetrahedron, volumes and densities that are not
/// positive, a material with values for another number of tetrahedra; the message numbers tetrahedra from 1.
fn piola_body_new(positions: &[f64], corners: &[usize], part_of: &[usize], parts: &[Part], body: New<Body>) {
    let (positions, corners) = (lent::rows("positions", positions)?, lent::rows("corners", corners)?);
    body.give(|| {
        let mut mesh = TetMesh::new(positions.to_vec(), corners.to_vec());
        mesh.groups = groups(part_of, corners.len(), parts.len())?;
        let part = |(k, part): (usize, &Part)| {
            // SAFETY: a handle, as the header requires.
            let material = unsafe { lent::value("parts[].material", part.material) }?.for_body()?;
            let group = mesh.groups.get(k).map(|group| group.name.clone());
            Ok(piola_bodies::system::Part { group, material, density: part.density })
        };
        let parts: Result<Vec<_>, Failure> = parts.iter().enumerate().map(part).collect();
        Ok(Body(Arc::new(piola_bodies::system::Body::from_parts(&mesh, parts?)?)))
    })
}

/// Lumped masses of the nodes, kg, one number each.
fn piola_body_masses(body: &Body, masses: &mut [f64]) {
    lent::demand_length("masses", masses.len(), 1, body.0.masses().len())?;
    masses.copy_from_slice(body.0.masses());
    Ok(())
}
}

/// Frees a body, or does nothing with null. Simulations of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_body_free(body: Option<Box<Body>>) {
    handle::free(body);
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
