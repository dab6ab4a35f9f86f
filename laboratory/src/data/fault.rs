//! Mistakes in files of measurements.

/// A mistake in a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {fault}")]
pub struct DataError {
    /// The line, counted from 1.
    pub line: u64,
    /// The mistake.
    #[source]
    pub fault: Fault,
}

/// A mistake in a line of a file of measurements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Nothing names the test.
    #[error(
        "there is no column `mode`, and nothing else names the test; add one with uniaxial, equibiaxial, pure_shear, \
         simple_shear or volumetric in each line, or give the test (`--mode uniaxial`, `ReadOptions::test`)"
    )]
    NoMode,
    /// Another mistake, and what to write.
    #[error("{0}")]
    Other(String),
}

impl DataError {
    pub(super) fn at(line: u64, mistake: impl Into<String>) -> Self {
        Self { line, fault: Fault::Other(mistake.into()) }
    }
}
