//! The test that a column or an option names.

use std::str::FromStr;

use crate::curve::{Mode, ModeError};

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
