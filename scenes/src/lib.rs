//! Bodies that collapse, invert and recover: the scenes behind the command `piola`.

pub mod energy;
pub mod error;
pub mod geometry;
pub mod measure;
pub mod output;
pub mod region;
pub mod render;
pub mod run;
pub mod scene;
pub mod settings;
