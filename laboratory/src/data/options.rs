//! Options for a file of measurements whose header does not describe its columns, and mistakes in files.

use super::unit::StressUnit;
use crate::curve::Mode;

/// Choice of columns, test and unit for a file of measurements.
///
/// A column is chosen by its header, or by its number counted from 1; after `=` may be a header in plain form
/// that replaces its own: `Dehnung`, `3`, `3=stretch`, `Dehnung=strain [%]`. Without `=`, a header that is
/// not in plain form means a nominal strain, or a nominal stress.
///
/// ```
/// use piola_laboratory::data::{Measurements, ReadOptions};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let options = ReadOptions {
///     test: Some("uniaxial".parse()?),
///     unit: Some("MPa".parse()?),
///     strain: Some("1=stretch".into()),
///     stress: Some("Spannung".into()),
/// };
/// let reading = Measurements::read_with("Streckung;Spannung\n1,02;0,5\n1,05;1,1\n", &options)?;
/// assert_eq!((reading.measurements.points[1].control, reading.measurements.points[1].stress), (1.05, 1.1e6));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// The test of lines that name none.
    pub test: Option<Mode>,
    /// The unit of stresses whose header names none.
    pub unit: Option<StressUnit>,
    /// The column of the strain, the stretch, the shear or the volume.
    pub strain: Option<String>,
    /// The column of the stress or the pressure.
    pub stress: Option<String>,
}

/// A mistake in a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {mistake}")]
pub struct DataError {
    /// The line, counted from 1.
    pub line: u64,
    /// The mistake, and what to write; [`NO_TEST`] if nothing names the test.
    pub mistake: String,
}

/// The mistake of a file without a test.
pub const NO_TEST: &str = "there is no column `mode`, and nothing else names the test; add one with uniaxial, equibiaxial, \
                           pure_shear, simple_shear or volumetric in each line, or give the test (`--mode uniaxial`, \
                           `ReadOptions::test`)";

impl DataError {
    pub(super) fn at(line: u64, mistake: impl Into<String>) -> Self {
        Self { line, mistake: mistake.into() }
    }
}
