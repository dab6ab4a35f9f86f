//! Mistakes in files of measurements.

use piola::__private::message::{number, quoted};

use crate::curve::{Mode, ModeError, ResponseError};

/// Sizes of controls and of stresses, Pa, that measurements may have.
pub(crate) const CONTROLS: (f64, f64) = (1e-6, 1e6);
pub(crate) const STRESSES: (f64, f64) = (1e-100, 1e100);

/// A mistake in a file of measurements.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {fault}")]
pub struct DataError {
    /// The line, counted from 1.
    pub line: u64,
    /// The mistake.
    #[source]
    pub fault: Fault,
}

/// A mistake in a line of a file of measurements.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The file is empty.
    #[error("there is no table; {HEADER}, then lines such as `uniaxial,1.5,0.37`")]
    NoHeader,
    /// The file is a spreadsheet, or another archive.
    #[error("this is not text but an archive, as spreadsheets are; save the sheet as CSV")]
    Archive,
    /// A column is missing.
    #[error("the header `{}` has no column of a {quantity}; {HEADER}, or {WORDS}", quoted(found))]
    NoColumn {
        /// The quantity that is missing: a stretch or a stress.
        quantity: &'static str,
        /// The header as given.
        found: String,
    },
    /// A force or an elongation instead of a stress or a strain.
    #[error(
        "`{}` is a force or a length, from which no stress or strain follows without the size of the specimen: divide \
         forces by the cross-section at rest and elongations by the length at rest, and name the columns `stress [MPa]` \
         and `strain`",
        quoted(found)
    )]
    NoSize {
        /// The header of the column.
        found: String,
    },
    /// Two columns hold the same quantity.
    #[error("the columns `{}` and `{}` are both of {quantity}; keep one, or rename the other", quoted(&found[0]), quoted(&found[1]))]
    ColumnTwice {
        /// The quantity.
        quantity: &'static str,
        /// The headers of the columns.
        found: [String; 2],
    },
    /// Stress of an unnamed kind next to a true strain.
    #[error(
        "`{}` stands next to a true strain: is it a true stress, or a nominal one, force by area at rest? Write `true stress` \
         or `nominal stress`",
        quoted(found)
    )]
    WhichStress {
        /// The header of the stress.
        found: String,
    },
    /// No unit of stress is named.
    #[error(
        "`{}` names no unit of stress; write it there, as in `stress [MPa]`, or give it (`--unit MPa`, \
         `ReadOptions::with_unit`)",
        quoted(found)
    )]
    NoUnit {
        /// The header of the stress, or which column it is.
        found: String,
    },
    /// The header and the row of units below it name different units.
    #[error("`{}` has the unit `{}` in the row below it; keep one", quoted(header), quoted(below))]
    UnitTwice {
        /// The header of the column.
        header: String,
        /// The unit below it.
        below: String,
    },
    /// The unit of a strain is not known.
    #[error(
        "the unit `{}` of `{}` is not known; write `strain [%]`, `strain [‰]`, `strain [µε]` or `strain [-]`, with numbers \
         in that unit",
        quoted(found),
        quoted(header)
    )]
    StrainUnit {
        /// The header of the column.
        header: String,
        /// The text that stands for a unit.
        found: String,
    },
    /// Nothing names the test.
    #[error(
        "there is no column `mode`, and nothing else names the test; add one with uniaxial, equibiaxial, pure_shear, \
         simple_shear or volumetric in each line, or give the test (`--mode uniaxial`, `ReadOptions::with_test`)"
    )]
    NoMode,
    /// Columns without a header, which are not a stretch and a stress.
    #[error("there is no header above {columns} columns; {HEADER}, or {WORDS}")]
    Columns {
        /// Number of columns in the data.
        columns: usize,
    },
    /// A row has another number of fields than the header.
    #[error(
        "{found} fields where the header has {expected}; write as many{}",
        if found > expected { ", and decimals with a point where commas separate columns" } else { "" }
    )]
    Fields {
        /// Fields of the row.
        found: usize,
        /// Fields of the header.
        expected: usize,
    },
    /// Unknown test.
    #[error(transparent)]
    Mode(
        /// The name as given.
        #[from]
        ModeError,
    ),
    /// Text instead of a finite number.
    #[error("`{}` under `{}` is not a number", quoted(found), quoted(column))]
    Number {
        /// The header of its column.
        column: String,
        /// The text there.
        found: String,
    },
    /// A comma or a point in a number may be one of decimals, or one of thousands.
    #[error(
        "`{}` may have a mark of decimals or one of thousands; write decimals with one mark in the whole file, and \
         thousands without any",
        quoted(found)
    )]
    Decimals {
        /// The text there.
        found: String,
    },
    /// No specimen can be brought to that stretch, shear or volume.
    #[error("{reason}{remedy}")]
    Control {
        /// The reason.
        #[source]
        reason: ResponseError,
        /// Advice about what the number may be instead, to be put behind the reason.
        remedy: &'static str,
    },
    /// A stretch, a shear or a volume is out of bounds.
    #[error(
        "{} is {}; it must be at most {:e}{}", mode.quantity(), number(*control), CONTROLS.1,
        if *mode == Mode::SimpleShear { "" } else { " and at least 1e-6" }
    )]
    ControlRange {
        /// The test.
        mode: Mode,
        /// The control as given.
        control: f64,
    },
    /// A stress is out of bounds.
    #[error(
        "the stress is {} Pa; it must be at most {:e} Pa, and at least {:e} Pa if it is not 0: does the header name the right unit?",
        number(*stress), STRESSES.1, STRESSES.0
    )]
    StressRange {
        /// The stress, Pa.
        stress: f64,
    },
    /// A quantity that the test does not have.
    #[error("`{}` is not a quantity of the test {mode}", quoted(column))]
    NotOfTest {
        /// The header of the column.
        column: String,
        /// The test.
        mode: Mode,
    },
    /// The stress has another sign than the strain.
    #[error(
        "{mode} {} = {} has a stress of {} Pa, of another sign than its strain: {}a strain is written under `strain` or \
         `strain [%]`, a compression with negative strain and stress or under `compressive strain` and `compressive stress`",
        mode.letter(), number(*control), number(*stress),
        if *control < mode.rest() && *stress > 0.0 { "is the number a strain, or a compression? " } else { "" }
    )]
    Sign {
        /// The test.
        mode: Mode,
        /// The control.
        control: f64,
        /// The stress, Pa.
        stress: f64,
    },
    /// A test called compression with points beyond rest.
    #[error(
        "a compression reaches {} = {} with {} Pa: strain and stress of compression are negative, or positive in columns \
         named `compressive strain` and `compressive stress`",
        mode.letter(), number(*control), number(*stress)
    )]
    Compression {
        /// The test.
        mode: Mode,
        /// The control.
        control: f64,
        /// The stress, Pa.
        stress: f64,
    },
    /// Stretches as large as strains in percent.
    #[error(
        "`{}` of {mode} makes {} from {} to {}: are the numbers percent? Then write `strain [%]`; if they are as large as \
         that, `{}`",
        quoted(column), mode.letter(), number(*range.start()), number(*range.end()),
        if *is_stretch { "stretch [-]" } else { "strain [-]" }
    )]
    Percent {
        /// The header of the column.
        column: String,
        /// The test.
        mode: Mode,
        /// The least and the greatest control.
        range: std::ops::RangeInclusive<f64>,
        /// True if they stand under `stretch`.
        is_stretch: bool,
    },
    /// No point except the rest state.
    #[error("below this header there is no point but rest; write lines such as `uniaxial,1.5,0.37`")]
    NoPoints,
}

const HEADER: &str = "write `mode,stretch,nominal_stress_MPa` above the points";
const WORDS: &str = "name columns by `stretch`, `strain`, `true strain`, `shear strain`, `volume ratio`, `volume strain` and \
                     `stress`, `true stress`, `pressure`, with a unit as in `strain [%]`, `stress [MPa]`";

impl Fault {
    /// The fault with what a number that cannot be a control may be instead.
    pub(super) fn with_remedy(self, remedy: &'static str) -> Self {
        match self {
            Self::Control { reason, .. } => Self::Control { reason, remedy },
            fault => fault,
        }
    }
}
