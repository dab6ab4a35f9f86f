//! Bodies that collapse, invert and recover: scenes, and the measurements and files of a run.
//!
//! A [`Scene`](scene::Scene) describes what happens to a body; [`Settings`](settings::Settings) override its
//! defaults; [`Play`](play::Play) plays it; [`Course`](run::Course) does so to the end and leaves surfaces
//! and a summary in a folder.
//!
//! The crate holds no mechanics, draws no pictures, and is independent of the command `piola`, whose crate is
//! `piola-cli`.

pub mod clock;
pub mod error;
pub mod fields;
pub mod geometry;
pub mod material;
pub mod measure;
pub mod moment;
#[cfg(feature = "clap")]
pub mod options;
pub mod output;
pub mod play;
pub mod recovery_trial;
pub mod region;
pub mod run;
pub mod scene;
pub mod settings;
pub mod statics;
pub mod unit;
