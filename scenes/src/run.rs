//! A scene played to its end, with files.

use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::geometry::Geometry;
use crate::output::{
    CAGES_FILE, Ended, Folder, Names, SUMMARY_FILE, Summary, cage_file, frame_file, read_vertices, write_pvd,
};
use crate::settings::Settings;
use crate::watch::Watch;

mod course;
mod progress;

use course::{Course, Setup};

/// Files that a run leaves.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Output {
    /// The folder for surfaces and the summary.
    pub folder: PathBuf,
    /// Whether the tetrahedra are written with [`crate::fields`], too.
    pub vtu: bool,
    /// Treatment of files that are in the folder already.
    pub existing: Existing,
}

/// Treatment of files that are in a folder already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Existing {
    /// A complete run replaces an earlier one; files that no run has written are kept, and refused if they
    /// have the name of a result.
    #[default]
    Keep,
    /// A complete run replaces whatever files have the names of its own.
    Replace,
    /// The run in the folder goes on.
    Resume,
}

impl Output {
    /// Surfaces and the summary, in a folder.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into(), vtu: false, existing: Existing::Keep }
    }

    /// Writes the tetrahedra as well, or not.
    #[must_use]
    pub fn with_vtu(mut self, vtu: bool) -> Self {
        self.vtu = vtu;
        self
    }

    /// Chooses the treatment of files that are in the folder already.
    #[must_use]
    pub fn with_existing(mut self, existing: Existing) -> Self {
        self.existing = existing;
        self
    }
}

/// A run whose summary can still be added to.
#[derive(Debug)]
pub struct Finished {
    /// Results of the run.
    pub summary: Summary,
    /// The body at rest, and its surface.
    pub geometry: Geometry,
    /// Mean distance that nodes have moved up to each frame, m.
    pub motion: Vec<f64>,
    folder: Folder,
    vtu: bool,
}

/// A run whose files are all in their place.
#[derive(Debug)]
pub struct Closed {
    /// Results of the run.
    pub summary: Summary,
    /// The folder with its files.
    pub folder: PathBuf,
    /// Folders in that of the run which hold runs that were cut off.
    pub leftovers: Vec<PathBuf>,
}

/// Plays a scene to its end, or goes on with a run that was cut off.
///
/// Whatever ends it after the first step, the frames before are kept with a summary that says what happened.
///
/// # Errors
/// An error of the settings, the body or the folder, and one of the first step or its files: nothing is
/// written then. [`Error::Interrupted`] if `watch` stops the run before its first step.
pub fn run(settings: &Settings, output: &Output, watch: &mut dyn Watch) -> Result<Finished, Error> {
    let mut setup = Setup::new(settings, output.vtu)?;
    let names = Names { last_frame: settings.frames, vtu: output.vtu };
    refuse_inputs(settings, &output.folder, names)?;
    let course = match output.existing {
        Existing::Resume => Course::resume(setup, Folder::reopen(&output.folder, names)?)?,
        existing => {
            setup.play.check_start(settings, &setup.geometry)?;
            let folder = Folder::prepare(&output.folder, names, existing == Existing::Replace)?;
            Course::begin(setup, folder)?
        }
    };
    course.play(watch)
}

/// Refuses a run that would write over one of the files that it reads.
fn refuse_inputs(settings: &Settings, folder: &Path, names: Names) -> Result<(), Error> {
    let Some(files) = &settings.files else { return Ok(()) };
    let is_output = |path: &Path| {
        let name = path.file_name().and_then(|name| name.to_str());
        let real =
            |path: &Path| fs::canonicalize(if path.as_os_str().is_empty() { Path::new(".") } else { path });
        let inside = path.parent().and_then(|parent| real(parent).ok());
        name.is_some_and(|name| names.contain(name)) && inside.is_some() && inside == real(folder).ok()
    };
    match [Some(&files.mesh), files.surface.as_ref()].into_iter().flatten().find(|path| is_output(path)) {
        Some(path) => Err(Error::InputAsOutput { path: path.clone() }),
        None => Ok(()),
    }
}

impl Finished {
    /// Positions of the surface in a frame, m, as they were written.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn surface_in(&self, frame: usize) -> io::Result<Vec<[f32; 3]>> {
        read_vertices(BufReader::new(File::open(self.folder.path().join(frame_file(frame)))?))
    }

    /// Adds a file to the run; one that cannot be written becomes a failure of the run.
    pub fn add(&mut self, name: &str, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) {
        if let Err(error) = self.folder.replace(name, content) {
            self.summary.failures.push(error.to_string());
        }
    }

    /// Writes the summary, and puts all files in their place.
    ///
    /// # Errors
    /// [`Error::Exchange`] if an earlier run cannot be replaced, and [`Error::Write`] if the summary cannot
    /// be written. All frames are kept.
    pub fn close(mut self) -> Result<Closed, Error> {
        self.folder.release();
        if self.vtu {
            let dt = self.summary.dt;
            let frames = (0..=self.summary.frames).map(|frame| (frame as f64 * dt, cage_file(frame)));
            self.add(CAGES_FILE, |file| write_pvd(file, frames));
        }
        let Self { summary, mut folder, .. } = self;
        let written = folder.replace(SUMMARY_FILE, |file| summary.write_json(file));
        let leftovers = folder.leftovers().to_vec();
        let folder = folder.finish(written.is_ok() && summary.ended == Ended::Finished)?;
        written.map(|()| Closed { summary, folder, leftovers })
    }
}
