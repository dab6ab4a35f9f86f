//! Options for a file of measurements whose header does not describe its columns.

use std::str::FromStr;

use piola::__private::message::quoted;

use super::unit::StressUnit;
use crate::curve::{Mode, ModeError};

/// Choice of columns, test and unit for a file of measurements.
///
/// ```
/// use piola_laboratory::curve::Mode;
/// use piola_laboratory::data::{Measurements, ReadOptions};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let options = ReadOptions::default()
///     .with_strain("1=stretch")
///     .with_stress("Spannung")
///     .with_test(Mode::Uniaxial)
///     .with_unit("MPa".parse()?);
/// let reading = Measurements::read_with("Streckung;Spannung\n1,02;0,5\n1,05;1,1\n", &options)?;
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
    /// The column of the strain, the stretch, the shear or the volume.
    pub strain: Option<ColumnChoice>,
    /// The column of the stress or the pressure.
    pub stress: Option<ColumnChoice>,
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

    /// Options with another [`strain`](Self::strain).
    #[must_use]
    pub fn with_strain(self, column: impl Into<ColumnChoice>) -> Self {
        Self { strain: Some(column.into()), ..self }
    }

    /// Options with another [`stress`](Self::stress).
    #[must_use]
    pub fn with_stress(self, column: impl Into<ColumnChoice>) -> Self {
        Self { stress: Some(column.into()), ..self }
    }
}

/// A column by its header, or by its number counted from 1; and, after `=`, a header in plain form that
/// replaces its own: `Dehnung`, `3`, `3=stretch`, `Dehnung=strain [%]`.
///
/// Without `=`, a header that is not in plain form means a nominal strain, or a nominal stress.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnChoice {
    /// The header of the column, or its number.
    pub column: String,
    /// The header that replaces its own.
    pub holds: Option<String>,
}

impl From<&str> for ColumnChoice {
    fn from(text: &str) -> Self {
        let (column, holds) = text.rsplit_once('=').map_or((text, None), |(column, own)| (column, Some(own)));
        Self { column: column.trim().into(), holds: holds.map(|own| own.trim().into()) }
    }
}

impl ColumnChoice {
    /// The number of the column, unless it is a name.
    pub(super) fn number(&self) -> Option<usize> {
        self.column.parse().ok()
    }

    /// The index of the column among those with these headers.
    pub(super) fn place(&self, names: &[&str]) -> Result<usize, String> {
        let named = |name: &&str| name.trim().eq_ignore_ascii_case(&self.column);
        let place = names.iter().position(named).or(self.number().and_then(|number| number.checked_sub(1)));
        let quoted = quoted(&self.column);
        place.filter(|place| *place < names.len()).ok_or_else(|| format!("there is no column `{quoted}`"))
    }
}

/// A test by its name in data: a mode, with a flag for compression.
///
/// ```
/// use piola_laboratory::curve::Mode;
/// use piola_laboratory::data::Test;
///
/// # fn main() -> Result<(), piola_laboratory::curve::ModeError> {
/// assert_eq!("EB".parse::<Test>()?, Mode::Equibiaxial.into());
/// assert!("uniaxial compression".parse::<Test>()?.is_compression);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Test {
    /// The mode.
    pub mode: Mode,
    /// True if the name means compression: such data lie below rest.
    pub is_compression: bool,
}

impl From<Mode> for Test {
    fn from(mode: Mode) -> Self {
        Self { mode, is_compression: false }
    }
}

impl FromStr for Test {
    type Err = ModeError;

    /// Every name of a [`Mode`].
    fn from_str(text: &str) -> Result<Self, ModeError> {
        let name = text.trim().to_lowercase();
        Ok(Self { mode: text.parse()?, is_compression: name.contains("compress") || name == "uc" })
    }
}
