#![doc = include_str!("../README.md")]

pub mod device;
pub mod mesh;
pub mod points;
pub mod tetrahedra;

/// A sentence for the user.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// First part of all names in the emitted WGSL; the files `*.wgsl` of this crate contain it literally.
pub const PREFIX: &str = "energy";
