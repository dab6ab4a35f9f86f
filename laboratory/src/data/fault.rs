//! Mistakes in files of measurements.

use piola::__private::message::{number, quoted};

use crate::curve::{Mode, ModeError};

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
    #[error(
        "there is no table; write `mode,stretch,nominal_stress_MPa`, then lines such as `uniaxial,1.5,0.37`"
    )]
    NoTable,
    /// The file is a spreadsheet, or another archive.
    #[error("this is not text but an archive, as spreadsheets are; save the sheet as CSV")]
    Archive,
    /// The header does not determine the columns of the strain and the stress.
    #[error(
        "{problem}; the columns are {}. Write a header such as `stretch,nominal_stress_MPa`, or give the columns by name or \
         number and what they hold: `--strain \"1=strain [%]\" --stress \"2=stress [MPa]\"` (`ReadOptions::strain`). \
         Divide forces by the cross-section and elongations by the length at rest",
        listed(columns)
    )]
    Columns {
        /// The reason.
        problem: String,
        /// The header, column by column; where there is none, the first row.
        columns: Vec<String>,
    },
    /// No unit of stress is named.
    #[error(
        "`{}` names no unit of stress; write it there, as in `stress [MPa]`, or give it (`--unit MPa`, \
         `ReadOptions::unit`)",
        quoted(found)
    )]
    NoUnit {
        /// The header of the stress, or its number.
        found: String,
    },
    /// Nothing names the test.
    #[error(
        "there is no column `mode`, and nothing else names the test; add one with uniaxial, equibiaxial, pure_shear, \
         simple_shear or volumetric in each line, or give the test (`--mode uniaxial`, `ReadOptions::test`)"
    )]
    NoMode,
    /// A row has another number of fields than the header.
    #[error(
        "{found} fields where the header has {expected}; write as many{}",
        if found > expected { ", and decimals with a point, or columns separated by semicolons or tabs" } else { "" }
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
    #[error(
        "`{}` under `{}` is not a number{}", quoted(found), quoted(column),
        if *decimal == ',' { ": decimals of this file have a comma, and thousands no mark" } else { "" }
    )]
    Number {
        /// The header of its column.
        column: String,
        /// The text there.
        found: String,
        /// The mark of decimals of the file.
        decimal: char,
    },
    /// Every comma of the numbers may be one of decimals or of thousands.
    #[error(
        "`{}` may be {} or {}, like every number with a comma here; write decimals with a point, and thousands without a \
         mark",
        quoted(found), quoted(&found.replace(',', "")), quoted(&found.replace(',', "."))
    )]
    Thousands {
        /// The first such number.
        found: String,
    },
    /// A stretch, a shear, a volume or a stress is out of range.
    #[error("{quantity} is {}; it must be {requirement}", number(*value))]
    Range {
        /// The quantity, such as `the stretch`.
        quantity: &'static str,
        /// The value as given, stresses in Pa.
        value: f64,
        /// The range, and advice about what else the number may be.
        requirement: &'static str,
    },
    /// A quantity that the test does not have.
    #[error("`{}` is not a quantity of the test {mode}", quoted(column))]
    NotOfTest {
        /// The header of the column.
        column: String,
        /// The test.
        mode: Mode,
    },
    /// A point that is unlikely to be what its header and its test mean.
    #[error(
        "{mode} {} = {} has a stress of {} Pa{question}: a strain is written under `strain` or `strain [%]`, a compression \
         with negative strain and stress or under `compressive strain` and `compressive stress`",
        mode.letter(), number(*control), number(*stress)
    )]
    Sign {
        /// The test.
        mode: Mode,
        /// The control.
        control: f64,
        /// The stress, Pa.
        stress: f64,
        /// The reason, and what the numbers may be instead.
        question: &'static str,
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

/// Columns with their numbers.
fn listed(columns: &[String]) -> String {
    const MOST: usize = 12;
    let columns = (1..).zip(columns).map(|(number, column)| format!("{number} `{}`", quoted(column)));
    let (shown, others) = (columns.clone().take(MOST).collect::<Vec<_>>(), columns.skip(MOST).count());
    let more = if others > 0 { format!(" and {others} more") } else { String::new() };
    shown.join(", ") + &more
}
