//! Random energies, and what their compiled forms must compute: a search for what nobody thought of.
//!
//! * [`expression`]: what an energy is made of, each part with its text and its value;
//! * [`generator`]: declarations of random energies as source text, each from a seed;
//! * [`hard`]: stretches at which digits are easily lost;
//! * [`polynomial`]: Taylor polynomials in three stretches, the calculus of the oracle;
//! * [`quantity`]: values in 256 bits, with estimates of their digits;
//! * [`oracle`]: what each value must be, from the generator's own expression;
//! * [`judge`]: all of it for one seed. The interpreter executes the programs, with the bits of generated
//!   code: see `tests/interpreted.rs`.
//!
//! The oracle shares no code with the compiler of declarations: not its parser, not its graph, not its
//! calculus.

pub mod expression;
pub mod generator;
pub mod hard;
pub mod judge;
pub mod oracle;
pub mod polynomial;
pub mod quantity;
