//! Elements of a rank as a body of piola, whose nodes are the owned nodes and the copies.

use piola_bodies::mesh::{Group, TetMesh};
use piola_bodies::system::{Body, Part};
use piola_scenes::error::Error as SceneError;
use piola_scenes::material::MaterialPart;

use crate::error::Error;
use crate::share::Share;

/// Body of the elements of a share, which have the numbers of their parts.
///
/// # Errors
/// [`Error::Scene`] for an invalid element, such as a flat one, or for a material.
pub fn body(share: &Share, parts: &[MaterialPart]) -> Result<Body, Error> {
    let Share { elements, places, .. } = share;
    if elements.is_empty() {
        return Ok(Body::empty());
    }
    let mut mesh = TetMesh::new(
        places.iter().map(|place| place.rest).collect(),
        elements.iter().map(|&(nodes, ..)| nodes).collect(),
    );
    mesh.tags = elements.iter().map(|&(_, tag, _)| tag as usize).collect();
    let mut in_body = Vec::new();
    for (number, part) in parts.iter().enumerate() {
        let tets: Vec<usize> = (0..elements.len()).filter(|&tet| elements[tet].2 == number as u64).collect();
        if !tets.is_empty() {
            let (name, material) = (number.to_string(), part.material.build()?.elements);
            mesh.groups.push(Group { name: name.clone(), dimension: 3, nodes: Vec::new(), tets });
            in_body.push(Part { group: Some(name), material, density: part.density });
        }
    }
    Ok(Body::from_parts(&mesh, in_body).map_err(SceneError::from)?)
}
