//! The judge: what piola must satisfy, by oracles that share no code with it.
//!
//! * [`cases`]: reference values to 25 digits and how a result is judged against them;
//! * [`declarations`]: energies as text, with remarks for their judges;
//! * [`declared`]: an energy's expressions, for what its compiled form cannot say;
//! * [`multiprecision`]: a real number of 100 digits and more, in which gradients are oracles for quotients;
//! * [`mod@quotients`]: what flips and twists must be, to more digits than any format holds;
//! * [`ways`]: functions of numbers by every back end;
//! * [`energies`]: the catalogue behind pointers; [`compiled`]: the evaluation of a point, compiled once;
//! * [`answers`]: all that a batch computes;
//! * [`twins`]: compiled and interpreted materials, compared;
//! * [`emitted`]: energies as source text, executed by programs of `emitted/`;
//! * [`bits`]: deformation gradients of arbitrary finite entries; [`soundness`]: what must hold at each of
//!   them;
//! * [`random`]: energies that nobody wrote, and what they must compute;
//! * `baselines/`, a crate of its own: other ways to a tangent, and the table of their errors and ours in
//!   `STABILITY.md`;
//! * `speed/`, a crate of its own: what is timed and counted;
//! * `tests/reference.rs`: all reference cases, with a table of the worst errors;
//! * `tests/bits.rs`: the catalogue at random patterns of bits;
//! * `tests/declarations/`: contract, expressions, batches, constructors and printed C of the catalogue and
//!   of the folder `declarations/`, and the messages about mistaken declarations;
//! * `tests/oracles/`: the oracles themselves, against known values;
//! * `tidy/`, a crate of its own: the rules that all sources follow.
//!
//! With `PIOLA_FULL` in the environment, as `.ci/run` has it, some tests judge more cases.

pub mod answers;
pub mod bits;
pub mod cases;
pub mod compiled;
pub mod declarations;
pub mod declared;
pub mod emitted;
pub mod energies;
pub mod multiprecision;
pub mod quotients;
pub mod random;
pub mod soundness;
pub mod twins;
pub mod ways;

/// True if the tests judge all cases that they have: with `PIOLA_FULL` in the environment.
pub fn is_full() -> bool {
    std::env::var_os("PIOLA_FULL").is_some()
}
