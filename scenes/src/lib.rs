//! Bodies that collapse, invert and recover: the scenes behind the command `piola`.
//!
//! A [`Scene`](scene::Scene) describes what happens to a body; [`Settings`](settings::Settings) say what a run does
//! differently; [`Play`](play::Play) plays it; [`run()`](run::run) does so to the end and leaves surfaces, a picture and a summary in a folder.
//!
//! [`view`] plays it for a page in a browser, where it can be pulled with the mouse.
//!
//! [`laboratory`] puts a material of the catalogue on the bench of `piola-laboratory`.
//!
//! The crate holds no mechanics, models no contact with the floor that its pictures show, and opens no window.

pub mod clock;
pub mod energy;
pub mod error;
pub mod fields;
pub mod gauge;
pub mod geometry;
pub mod laboratory;
pub mod measure;
pub mod output;
pub mod play;
pub mod region;
pub mod render;
pub mod run;
pub mod scene;
pub mod settings;
pub mod settle;
pub mod trial;
pub mod view;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
