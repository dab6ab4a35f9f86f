//! The files of the report.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::data::Report;
use crate::{charts, page};

/// The page.
pub(crate) const PAGE: &str = "report.md";

/// The numbers.
const NUMBERS: &str = "report.json";

/// A folder that can be written to.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// Makes it if it is not there, before anything is measured in vain.
    pub(crate) fn prepare(folder: &Path) -> Result<Self, String> {
        fs::create_dir_all(folder).map_err(|error| about(folder, error))?;
        Ok(Self(folder.to_owned()))
    }

    /// The numbers of the run before.
    pub(crate) fn read(&self) -> Result<Report, String> {
        let file = self.0.join(NUMBERS);
        let text = fs::read_to_string(&file).map_err(|error| about(&file, error))?;
        // Once in a run, since what was measured has its names from the program.
        let text: &'static str = text.leak();
        serde_json::from_str(text).map_err(|error| about(&file, error))
    }

    /// Writes charts, page and numbers. What was not measured leaves no chart.
    pub(crate) fn write(&self, report: &Report) -> Result<(), String> {
        let charts = charts::draw(report)?;
        let page = page::tell(report, &charts);
        let numbers = serde_json::to_string_pretty(report).map_err(|error| error.to_string())?;
        for chart in &charts {
            self.put(&chart.file, &chart.svg)?;
        }
        self.put(NUMBERS, &numbers)?;
        self.put(PAGE, &page)
    }

    /// Whole or not at all.
    fn put(&self, name: &str, text: &str) -> Result<(), String> {
        let (file, unfinished) = (self.0.join(name), self.0.join(format!("{name}.unfinished")));
        fs::write(&unfinished, text).map_err(|error| about(&unfinished, error))?;
        fs::rename(&unfinished, &file).map_err(|error| about(&file, error))
    }
}

fn about(file: &Path, error: impl Display) -> String {
    format!("{}: {error}", file.display())
}

/// The commit that is checked out, where there is Git and a checkout; with a mark where files differ from it.
pub(crate) fn commit() -> Option<String> {
    let describe = ["describe", "--always", "--dirty", "--abbrev=12"];
    let output = Command::new("git").current_dir(env!("CARGO_MANIFEST_DIR")).args(describe).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
