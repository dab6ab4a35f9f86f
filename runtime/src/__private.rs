//! Names that generated code uses: no part of the public interface, and free to change with every version.

pub use crate::lanes::Mask;
pub use crate::material::constructor::*;
pub use crate::material::differences::by_values;
pub use crate::material::{
    Blocks, Constraint, Curvature, Declared, Description, Fittable, Form, Graded, Inversion, Limit,
    MaterialError, Mixed, Moduli, Parameter, ParameterValue, PerLane, Typical, Unit,
};
pub use crate::quotient::*;
#[cfg(feature = "serde")]
pub use serde;
pub use std::{borrow::Cow::Borrowed, option::Option, result::Result, vec::Vec};

pub use crate::Real;
