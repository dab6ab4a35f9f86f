//! The charts, as SVG.

use crate::Report;

mod heat;
mod panel;
mod point;
mod steps;

pub(crate) use point::best_settings;

pub(crate) struct Chart {
    pub(crate) file: String,
    pub(crate) svg: String,
    pub(crate) caption: String,
}

/// Charts of the sections that were measured.
pub(crate) fn draw(report: &Report) -> Result<Vec<Chart>, String> {
    let mut charts = Vec::new();
    if !report.rows.is_empty() {
        charts.extend(point::draw(&report.rows)?);
        charts.extend(heat::draw(&report.rows)?);
    }
    if !report.steps.is_empty() {
        charts.push(steps::draw(&report.steps)?);
    }
    Ok(charts)
}
