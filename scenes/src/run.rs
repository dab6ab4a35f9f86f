//! Run of a scene to its end, with files.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use std::sync::Arc;

use crate::error::Error;
use crate::geometry::Geometry;
use crate::output::{
    CAGES_FILE, Folder, SUMMARY_FILE, Summary, cage_file, frame_file, read_vertices, write_pvd,
};

mod course;
mod progress;

pub use course::{Course, speed};

/// Files of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// The folder for surfaces and the summary: a new one, unless a run is resumed.
    pub folder: PathBuf,
    /// True to write the tetrahedra with [`crate::fields`], too.
    pub vtu: bool,
    /// True to continue the run in the folder.
    pub resume: bool,
}

/// A run whose summary can still be added to.
#[derive(Debug)]
pub struct Finished {
    /// Results of the run.
    pub summary: Summary,
    /// The body at rest, and its surface.
    pub geometry: Arc<Geometry>,
    /// Mean distance that nodes have moved up to each frame, m.
    pub motion: Vec<f64>,
    folder: Folder,
    vtu: bool,
}

impl Finished {
    /// Positions of the surface in a frame, m, as they were written.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn surface_in(&self, frame: usize) -> io::Result<Vec<[f32; 3]>> {
        read_vertices(&fs::read(self.folder.path.join(frame_file(frame)))?)
    }

    /// Adds a file to the run; one that cannot be written becomes a failure of the run.
    pub fn add(&mut self, name: &str, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) {
        if let Err(error) = self.folder.write(name, true, content) {
            self.summary.failures.push(error.to_string());
        }
    }

    /// Writes the summary and returns it.
    ///
    /// # Errors
    /// [`Error::Write`] if it cannot be written. All frames are kept.
    pub fn close(mut self) -> Result<Summary, Error> {
        if self.vtu {
            let dt = self.summary.dt;
            let frames = (0..=self.summary.frames).map(|frame| (frame as f64 * dt, cage_file(frame)));
            self.add(CAGES_FILE, |file| write_pvd(file, frames));
        }
        let Self { summary, folder, .. } = self;
        folder.write(SUMMARY_FILE, true, |file| {
            serde_json::to_writer_pretty(&mut *file, &summary)?;
            writeln!(file)
        })?;
        Ok(summary)
    }
}
