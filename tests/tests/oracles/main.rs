//! The oracles: numbers of many digits against known constants and identities, the calculus of random
//! energies against formulas done by hand.

mod multiprecision;
mod random;
