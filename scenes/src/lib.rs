//! Bodies that collapse, invert and recover: scenes, and what a run of one measures and writes.
//!
//! A [`Scene`](scene::Scene) describes what happens to a body; [`Settings`](settings::Settings) say what a run does differently;
//! [`Play`](play::Play) plays it; [`run()`](run::run) does so to the end and leaves surfaces and a summary in a folder.
//!
//! The crate holds no mechanics, draws no pictures, and knows nothing of the command `piola`, whose crate is `piola-cli`.

pub mod clock;
pub mod energy;
pub mod error;
pub mod fields;
pub mod gauge;
pub mod geometry;
pub mod measure;
pub mod output;
pub mod play;
pub mod region;
pub mod run;
pub mod scene;
pub mod settings;
pub mod settle;
pub mod trial;
