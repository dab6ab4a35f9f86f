//! Names that generated code uses: no part of the public interface, and free to change with every version.

pub use crate::lanes::Mask;
pub use crate::material::{ParameterValue, PerLane};
pub use crate::quotient::*;
#[cfg(feature = "serde")]
pub use serde;
