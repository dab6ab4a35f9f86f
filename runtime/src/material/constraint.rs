//! Conditions on the parameters of a material, for fits to measurements.

use super::Text;

/// A condition on parameters, as a function of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// The condition.
    pub limit: Limit,
    /// A measure of the distance to the limit, positive inside: for `a > b` the difference a − b.
    pub value: f64,
    /// The derivative of the value with respect to each number among the parameters, lists entry by entry.
    pub gradient: Vec<f64>,
}

/// A limit on the parameters of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// A comparison of `admissible(…)`, as declared.
    Admissible(Text),
    /// The shear modulus at rest is positive.
    ShearModulus,
    /// The bulk modulus at rest is not negative.
    BulkModulus,
    /// A comparison of `domain(…)`, as declared.
    Domain(Text),
}
