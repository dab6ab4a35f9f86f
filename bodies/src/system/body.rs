//! A body: a mesh with masses and a material for each of its elements.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use piola::__private::message::number;
use piola::batch::TileMaterial;
use piola::batch::element::TILE;
use thiserror::Error;

use super::element::Tetrahedron;
use crate::mesh::{TetMesh, no_such_group};

/// Material and density of a part of a mesh.
pub struct Part {
    /// Name of the group of tetrahedra; `None` for all tetrahedra that no other part names.
    pub group: Option<String>,
    /// Anything that implements [`Material`](piola::Material), or a
    /// [`PerPoint`](piola::material::PerPoint) of them.
    pub material: Box<dyn TileMaterial<f64>>,
    /// Mass density at rest, kg/m³.
    pub density: f64,
}

/// Elastic body: a mesh with a material and a density for each of its parts.
///
/// Everything is in f64. A clone shares the materials and copies the rest.
#[derive(Clone)]
pub struct Body {
    rest: Vec<[f64; 3]>,
    masses: Vec<f64>,
    /// Elements of one material are contiguous; `runs` holds the end of each.
    elements: Vec<Tetrahedron>,
    runs: Vec<Run>,
}

/// Contiguous elements of one material.
#[derive(Clone)]
struct Run {
    material: Arc<dyn TileMaterial<f64>>,
    end: usize,
}

impl fmt::Debug for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (nodes, elements, materials) = (self.rest.len(), self.elements.len(), self.runs.len());
        write!(f, "Body {{ nodes: {nodes}, elements: {elements}, materials: {materials} }}")
    }
}

impl Body {
    /// A body of one material; `density` in kg/m³.
    ///
    /// # Errors
    /// [`BodyError`] of the mesh, the density, the mass of a node, or a material with parameters for each
    /// point.
    pub fn new(
        mesh: &TetMesh,
        material: impl TileMaterial<f64> + 'static,
        density: f64,
    ) -> Result<Self, BodyError> {
        Self::from_parts(mesh, vec![Part { group: None, material: Box::new(material), density }])
    }

    /// A body of several parts, which together hold each tetrahedron exactly once.
    ///
    /// # Errors
    /// Any [`BodyError`]: of the mesh, a density, a material with parameters for each point, or a group; or
    /// an error for a tetrahedron that belongs to no part or to two.
    pub fn from_parts(mesh: &TetMesh, parts: Vec<Part>) -> Result<Self, BodyError> {
        let shapes = mesh.rest_shapes().map_err(|error| BodyError(error.to_string()))?;
        let groups: Vec<_> = parts.iter().map(|part| part.group.as_deref()).collect();
        let part_of_tet = parts_of_tets(mesh, &groups)?;

        let mut densities = vec![0.0; shapes.len()];
        let mut elements = Vec::with_capacity(shapes.len());
        let mut runs = Vec::with_capacity(parts.len());
        for (index, Part { material, density, .. }) in parts.into_iter().enumerate() {
            if !(density > 0.0 && density.is_finite()) {
                let density = number(density);
                return Err(BodyError(format!(
                    "the density is {density} kg/m³; it must be positive and finite"
                )));
            }
            let start = elements.len();
            for tet in (0..shapes.len()).filter(|&tet| part_of_tet[tet] == index) {
                densities[tet] = density;
                elements.push(Tetrahedron { nodes: mesh.tets[tet], shape: shapes[tet], tag: mesh.tag(tet) });
            }
            let count = elements.len() - start;
            if let Some(materials) = material.properties().points.filter(|&materials| materials != count) {
                return Err(BodyError(format!(
                    "there are {materials} materials for a part of {count} elements: give one for all, or one \
                     for each"
                )));
            }
            runs.push(Run { material: material.into(), end: elements.len() });
        }
        // A quarter of the mass of each tetrahedron around a node.
        let mut masses = vec![0.0; mesh.positions.len()];
        for ((nodes, shape), density) in mesh.tets.iter().zip(&shapes).zip(densities) {
            for &node in nodes {
                masses[node] += density * shape.volume / 4.0;
            }
        }
        if let Some(node) = masses.iter().position(|mass| !mass.is_normal()) {
            let fault = if masses[node] > 1.0 { "overflows" } else { "underflows" };
            return Err(BodyError(format!(
                "the mass of node {node} (from 0) {fault}; are the units of the mesh and of the density right?"
            )));
        }
        Ok(Self { rest: mesh.positions.clone(), masses, elements, runs })
    }

    /// Body without nodes: the part of a machine that has no elements of a divided body.
    #[doc(hidden)]
    #[must_use]
    pub fn empty() -> Self {
        Self { rest: Vec::new(), masses: Vec::new(), elements: Vec::new(), runs: Vec::new() }
    }

    /// Rest position of each node, m.
    #[must_use]
    pub fn rest(&self) -> &[[f64; 3]] {
        &self.rest
    }

    /// Lumped mass of each node, kg.
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// The elements, sorted by part.
    #[must_use]
    pub fn elements(&self) -> &[Tetrahedron] {
        &self.elements
    }

    pub(crate) fn material(&self, element: usize) -> &dyn TileMaterial<f64> {
        self.runs[self.runs.partition_point(|run| run.end <= element)].material.as_ref()
    }

    /// Index of an element among those of its part.
    pub(crate) fn number_in_part(&self, element: usize) -> usize {
        let run = self.runs.partition_point(|run| run.end <= element);
        element - run.checked_sub(1).map_or(0, |before| self.runs[before].end)
    }

    /// The material of each part, with the range of its elements in [`elements`](Self::elements).
    pub fn materials(&self) -> impl Iterator<Item = (&dyn TileMaterial<f64>, Range<usize>)> {
        let starts = [0].into_iter().chain(self.runs.iter().map(|run| run.end));
        self.runs.iter().zip(starts).map(|(run, start)| (run.material.as_ref(), start..run.end))
    }

    /// Elements in groups of one material that fill a tile, except for the last group of a material.
    pub(crate) fn groups(&self) -> impl Iterator<Item = (&dyn TileMaterial<f64>, Range<usize>)> {
        self.materials().flat_map(|(material, run)| {
            run.clone().step_by(TILE).map(move |start| (material, start..run.end.min(start + TILE)))
        })
    }
}

/// Index of the part of each tetrahedron, for the [groups](Part::group) of the parts.
///
/// # Errors
/// [`BodyError`] for a missing group, or a tetrahedron that belongs to no part or to two.
pub fn parts_of_tets(mesh: &TetMesh, groups: &[Option<&str>]) -> Result<Vec<usize>, BodyError> {
    let mut assigned = vec![None; mesh.tets.len()];
    for (index, group) in groups.iter().enumerate() {
        let &Some(name) = group else { continue };
        let of_tets = || mesh.groups.iter().filter(|group| group.dimension == 3);
        let group = of_tets().find(|group| group.name == name);
        let group = group.ok_or_else(|| BodyError(no_such_group(name, of_tets(), " of tetrahedra")))?;
        for &tet in &group.tets {
            match assigned.get_mut(tet) {
                Some(slot @ None) => *slot = Some(index),
                _ => {
                    let element = mesh.tag(tet);
                    return Err(BodyError(format!(
                        "element {element} has two materials: it belongs to two parts"
                    )));
                }
            }
        }
    }
    let rest = groups.iter().position(Option::is_none);
    let each = assigned.into_iter().enumerate();
    let missing = |tet| format!("element {} has no material: it belongs to no part", mesh.tag(tet));
    each.map(|(tet, part)| part.or(rest).ok_or_else(|| BodyError(missing(tet)))).collect()
}

/// Reason why a mesh and its parts are not a body, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct BodyError(String);
