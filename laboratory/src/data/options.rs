//! Options for test and unit of a file of measurements that does not name them.

use super::test::Test;
use super::unit::StressUnit;

/// Test and unit for a file of measurements that names none.
///
/// ```
/// use piola_laboratory::curve::Mode;
/// use piola_laboratory::data::{Measurements, ReadOptions};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let options = ReadOptions::default().with_test(Mode::Uniaxial).with_unit("MPa".parse()?);
/// let reading = Measurements::read_with("1,02;0,5\n1,05;1,1\n", &options)?;
/// assert_eq!((reading.measurements.points[1].control, reading.measurements.points[1].stress), (1.05, 1.1e6));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ReadOptions {
    /// The test of lines that name none.
    pub test: Option<Test>,
    /// The unit of stresses whose header names none.
    pub unit: Option<StressUnit>,
}

impl ReadOptions {
    /// Options with another [`test`](Self::test).
    #[must_use]
    pub fn with_test(self, test: impl Into<Test>) -> Self {
        Self { test: Some(test.into()), ..self }
    }

    /// Options with another [`unit`](Self::unit).
    #[must_use]
    pub fn with_unit(self, unit: StressUnit) -> Self {
        Self { unit: Some(unit), ..self }
    }
}
