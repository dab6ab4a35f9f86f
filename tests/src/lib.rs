//! The judge: what piola must satisfy, by oracles that share no code with it.
//!
//! * [`baselines`]: how the tangent is computed elsewhere;
//! * [`cases`]: reference values to 25 digits and how a result is judged against them;
//! * [`declared`]: an energy's expressions, for what its compiled form cannot say;
//! * [`multiprecision`]: a real number of 100 digits and more, in which gradients are oracles for quotients;
//! * [`mod@quotients`]: what flips and twists must be, to more digits than any format holds;
//! * [`stability`]: the table of errors in `STABILITY.md`;
//! * `tests/reference.rs`: all of them, with a table of the worst errors;
//! * `tests/suite.rs`: the catalogue against an interpreter of its declarations, and the contract of every material;
//! * `tests/tidy.rs`: the rules of the house.

pub mod baselines;
pub mod cases;
pub mod declared;
pub mod multiprecision;
pub mod quotients;
pub mod stability;
