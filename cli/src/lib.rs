//! Pictures of scenes, and scenes in a browser: the parts of the command `piola` that other programs can use.
//!
//! [`render`] draws a deforming surface in software; [`view`] plays a scene for a page in a browser, where it can be pulled
//! with the mouse. Scenes themselves are in `piola-scenes`, which knows nothing of this crate.

pub mod render;
pub mod view;
