//! The geometry of a run: tetrahedra, and the surface that is drawn instead of them.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::fmt;
use std::ops::RangeInclusive;
use std::path::Path;

use piola_bodies::mesh::{
    Anchor, ReadError, Surface, TetMesh, embed, parse_msh, parse_surface_obj, read_msh, read_surface_obj,
    read_tetgen, tetrahedral_box,
};

use crate::error::{Error, in_range};
use crate::scene::{Body, Shape};
use crate::settings::Settings;

/// Largest distance of a surface vertex from the tetrahedra, as a share of the diagonal of their bounding
/// box.
///
/// Extrapolation magnifies the motion of a tetrahedron by the distance over the tetrahedron's size.
pub const REACH: f64 = 0.02;

/// Usual lengths of bodies, m; beyond these, coordinates may be in another unit.
const USUAL: RangeInclusive<f64> = 1e-4..=20.0;

/// Tetrahedra, and the surface that is drawn instead of them.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// The tetrahedra at rest.
    pub mesh: TetMesh,
    /// Triangles of the surface.
    pub triangles: Vec<[u32; 3]>,
    /// The point of the tetrahedra to which each vertex of the surface is attached.
    pub embedding: Vec<Anchor>,
}

impl Geometry {
    /// The body of the settings: from their files, or one that comes with the program.
    ///
    /// # Errors
    /// [`Error::Read`] if a file cannot be read or is malformed, [`Error::Usage`] if its tetrahedra are not a
    /// valid body or the surface lies outside of them, [`Error::OutOfRange`] for its size.
    pub fn load(settings: &Settings) -> Result<Self, Error> {
        let Some(files) = &settings.files else { return Self::of(settings.body) };
        let mesh = match files.mesh.extension().and_then(OsStr::to_str) {
            Some("node" | "ele") => read_tetgen(&files.mesh),
            _ => read_msh(&files.mesh),
        };
        let mut mesh =
            if settings.only_tetrahedra { mesh.or_else(ReadError::only_tetrahedra)? } else { mesh? };
        settings.unit.convert(&mut mesh.positions);
        let mesh_name = files.mesh.display().to_string();
        let Some(file) = &files.surface else { return Self::bare(mesh, &mesh_name) };
        let mut surface = read_surface_obj(file)?;
        settings.unit.convert(&mut surface.positions);
        Self::new(mesh, &mesh_name, &surface, &file.display().to_string())
    }

    /// The geometry of a body that comes with the program.
    ///
    /// # Errors
    /// Like [`Geometry::load`].
    pub fn of(body: Body) -> Result<Self, Error> {
        match body.shape {
            Shape::Files { mesh, surface } => {
                let (mesh_name, surface_name) = (format!("{}.msh", body.name), format!("{}.obj", body.name));
                let mesh = parse_msh(mesh, Path::new(&mesh_name))?;
                let surface = parse_surface_obj(surface, Path::new(&surface_name))?;
                Self::new(mesh, &mesh_name, &surface, &surface_name)
            }
            Shape::Box { cells, size } => {
                Self::bare(usable(body.name, tetrahedral_box(cells, size))?, body.name)
            }
        }
    }

    /// Tetrahedra that are drawn by their boundary.
    fn bare(mesh: TetMesh, name: &str) -> Result<Self, Error> {
        let surface = boundary(&mesh);
        Self::new(mesh, name, &surface, name)
    }

    /// Properties of the mesh that are rarely intended, in sentences. A body can be made of it. A sentence
    /// that begins with `note: ` is about something that changes nothing.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mesh = &self.mesh;
        let mut warnings = Vec::new();
        let length = mesh.bounds().size().into_iter().fold(0.0, f64::max);
        if !USUAL.contains(&length) {
            // In single precision, the length has no digits of rounding.
            let length = length as f32;
            warnings.push(format!(
                "the body is {length} m long; is that meant? --unit names the unit of the mesh, such as --unit mm"
            ));
        }
        if !mesh.left_out.is_empty() {
            warnings.push(format!(
                "only linear tetrahedra are read; left out of the body, which lacks their volume: {}",
                mesh.left_out
            ));
        }
        if mesh.dropped_nodes > 0 {
            let nodes = mesh.dropped_nodes;
            warnings.push(format!("{nodes} nodes of the file belong to no tetrahedron and were left out"));
        }
        if let tets @ 1.. = mesh.turned_tets {
            let reason = "have their nodes in the order of a negative volume and were turned";
            warnings.push(format!("note: {tets} tetrahedra of the file {reason}"));
        }
        let components = mesh.connected_components();
        if let [largest, _, ..] = components[..] {
            warnings.push(format!(
                "the mesh is in {} pieces that share no node and move independently, the largest of {largest} of the \
                 {} tetrahedra; nodes that are meant to be one must be merged in the mesh generator",
                components.len(),
                mesh.tets.len()
            ));
        }
        warnings
    }

    fn new(mesh: TetMesh, mesh_name: &str, surface: &Surface, surface_name: &str) -> Result<Self, Error> {
        let diagonal = check_body(&mesh, mesh_name)?;
        let embedding = usable(surface_name, embed(&mesh, surface, REACH * diagonal))?;
        let triangles =
            surface.triangles.iter().map(|triangle| triangle.map(|vertex| vertex as u32)).collect();
        Ok(Self { mesh, triangles, embedding })
    }

    /// A checksum of everything that steps and pulls depend on: nodes at rest, tetrahedra, groups, triangles
    /// and where the surface is attached. Names of files and tags of elements are left out.
    #[must_use]
    pub fn checksum(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new();
        let mut whole = |numbers: &mut dyn Iterator<Item = u64>| {
            let mut count: u64 = 0;
            for number in numbers {
                sum.update(&number.to_le_bytes());
                count += 1;
            }
            // Where a list ends is part of it.
            sum.update(&count.to_le_bytes());
        };
        let index = |&index: &usize| index as u64;
        let bits = |x: &f64| x.to_bits();
        whole(&mut self.mesh.positions.as_flattened().iter().map(bits));
        whole(&mut self.mesh.tets.as_flattened().iter().map(index));
        for group in &self.mesh.groups {
            whole(&mut group.name.bytes().map(u64::from));
            whole(&mut group.nodes.iter().chain(&group.tets).map(index));
        }
        whole(&mut self.triangles.as_flattened().iter().map(|&vertex| u64::from(vertex)));
        whole(&mut self.embedding.iter().flat_map(|anchor| &anchor.nodes).map(index));
        whole(&mut self.embedding.iter().flat_map(|anchor| &anchor.weights).map(bits));
        sum.finalize()
    }

    /// Positions of the surface's vertices, m, for these positions of the nodes, m; in the precision of files
    /// and pictures.
    #[must_use]
    pub fn surface_at(&self, positions: &[[f64; 3]]) -> Vec<[f32; 3]> {
        self.embedding.iter().map(|anchor| anchor.position(positions).map(|x| x as f32)).collect()
    }
}

/// Checks that the tetrahedra make a body of a size that can be simulated and drawn; returns the diagonal of
/// its bounding box, m.
fn check_body(mesh: &TetMesh, name: &str) -> Result<f64, Error> {
    usable(name, mesh.rest_shapes())?;
    let bounds = mesh.bounds();
    let diagonal = bounds.size().iter().map(|side| side * side).sum::<f64>().sqrt();
    let farthest = bounds.min.iter().chain(&bounds.max).fold(0.0, |far: f64, x| far.max(x.abs()));
    let requirement = "from 1e-9 to 1e9 m; are its coordinates in metres?";
    in_range("the diagonal of the body", diagonal, 1e-9..=1e9, requirement)?;
    let requirement = "at most 1e12 m; are they in metres?";
    in_range("the farthest coordinate of the body", farthest, 0.0..=1e12, requirement)?;
    Ok(diagonal)
}

/// Warning of a scene that pulls at a region without nodes of the body.
pub const NOTHING_PULLED: &str =
    "no node of the body lies where the scene pulls, and nothing is pulled there";

/// The faces of tetrahedra that no other tetrahedron shares, seen from outside counter-clockwise, with their
/// nodes.
fn boundary(mesh: &TetMesh) -> Surface {
    let faces = || mesh.tets.iter().flat_map(|&[a, b, c, d]| [[a, c, b], [a, b, d], [a, d, c], [b, c, d]]);
    let sorted = |mut face: [usize; 3]| {
        face.sort_unstable();
        face
    };
    let mut counts = HashMap::new();
    for face in faces().map(sorted) {
        *counts.entry(face).or_insert(0) += 1;
    }
    let mut vertices = HashMap::new();
    let mut surface = Surface::default();
    for face in faces().filter(|&face| counts[&sorted(face)] == 1) {
        let triangle = face.map(|node| {
            *vertices.entry(node).or_insert_with(|| {
                surface.positions.push(mesh.positions[node]);
                surface.positions.len() - 1
            })
        });
        surface.triangles.push(triangle);
    }
    surface
}

/// Names the file in an error about its content.
fn usable<T>(file: &str, result: Result<T, impl fmt::Display>) -> Result<T, Error> {
    result.map_err(|error| Error::Usage(format!("{file}: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::max_distance;

    #[test]
    fn what_is_seldom_meant_is_told() -> Result<(), Box<dyn std::error::Error>> {
        let mut mesh = tetrahedral_box([2, 1, 1], [2.0, 1.0, 1.0])?;
        let of = |mesh: &TetMesh| Geometry::new(mesh.clone(), "mesh", &Surface::default(), "none");
        assert_eq!(of(&mesh)?.warnings(), [""; 0]);

        // A copy next to it, with other nodes, and a node far away.
        let nodes = mesh.positions.len();
        mesh.tets.extend(mesh.tets.clone().iter().map(|tet| tet.map(|node| node + nodes)));
        mesh.positions.extend(mesh.positions.clone().iter().map(|[x, y, z]| [x + 2.0, *y, *z]));
        mesh.positions.push([1e7; 3]);
        let warnings = of(&mesh.without_unused_nodes())?.warnings();
        assert!(warnings[0].starts_with("1 nodes of the file belong to no tetrahedron"), "{warnings:?}");
        assert!(
            warnings[1].contains("in 2 pieces") && warnings[1].contains("of 12 of the 24"),
            "{warnings:?}"
        );
        assert_eq!(warnings.len(), 2);
        Ok(())
    }

    #[test]
    fn bodies_of_absurd_size_are_refused() {
        let scaled = |scale: f64, away: f64| {
            let mut mesh = tetrahedral_box([1; 3], [scale; 3]).expect("a box");
            mesh.positions.iter_mut().for_each(|x| x[0] += away);
            check_body(&mesh, "box").map_err(|error| error.to_string())
        };
        assert_eq!(scaled(1.0, 0.0), Ok(3f64.sqrt()));
        for (scale, away) in [(1e-100, 0.0), (1e40, 0.0), (1e6, 1e13)] {
            let error = scaled(scale, away).expect_err("absurd");
            assert!(error.contains("metres"), "{error}");
        }
    }

    #[test]
    fn surfaces_of_the_program_are_where_their_files_have_them() -> Result<(), Error> {
        for body in Body::ALL {
            let Shape::Files { surface, .. } = body.shape else { continue };
            let surface = parse_surface_obj(surface, Path::new(body.name))?;
            let Geometry { mesh, embedding, .. } = Geometry::of(*body)?;
            let places: Vec<_> = embedding.iter().map(|anchor| anchor.position(&mesh.positions)).collect();
            assert_eq!(places.len(), surface.positions.len());
            // Barycentric coordinates err by the condition of a tetrahedron, far below 100 here.
            let error = max_distance(&surface.positions, &places);
            assert!(error <= 100.0 * f64::EPSILON, "{}: {error:e}", body.name);
        }
        Ok(())
    }

    #[test]
    fn the_boundary_of_two_tetrahedra_is_closed_and_faces_outwards() {
        let positions =
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        let surface = boundary(&TetMesh::new(positions, vec![[0, 1, 2, 3], [1, 4, 2, 3]]));
        assert_eq!((surface.positions.len(), surface.triangles.len()), (5, 6));
        // The divergence theorem gives the volume: 1/6 and 1/3.
        let volume: f64 = surface
            .triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|vertex| nalgebra::Vector3::from(surface.positions[vertex]));
                a.dot(&b.cross(&c)) / 6.0
            })
            .sum();
        assert!((volume - 0.5).abs() < 1e-15, "{volume}");
    }
}
