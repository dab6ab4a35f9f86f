//! Pictures of a deforming surface, drawn in software: [`contact_sheet`].
//!
//! A body of clay on a pale floor under a warm key light and a cool sky, each tile one frame of the motion,
//! all seen by one camera that fits the whole of it. Everything is deterministic, and no graphics device is
//! needed.
//!
//! This module depends on surfaces and colours only: not on meshes of tetrahedra, scenes or files.

mod camera;
mod image;
mod label;
mod light;
mod raster;
mod sheet;

pub use image::Image;
pub use sheet::{Frame, contact_sheet};

type Vector = nalgebra::Vector3<f32>;

/// A triangulated surface in space. Both sides of it are visible.
#[derive(Clone, Copy, Debug)]
struct Surface<'a> {
    vertices: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
}

impl Surface<'_> {
    fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize].into())
    }
}
