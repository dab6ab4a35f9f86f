//! Elastic bodies that are larger than a machine: piola's elements, divided among the ranks of MPI, with the
//! solvers of PETSc.
//!
//! The mathematics of materials and elements is piola's: each rank evaluates its elements by piola's kernels,
//! and steps as [`piola::step`] says. What is here is how a mesh is divided ([`portion`], [`share`]), what
//! ranks send each other ([`team`], [`petsc`]), and the objective of a step as sums over ranks
//! ([`minimisation`]).
//!
//! Every rank calls every function, in one order. An error that concerns one rank is told to all, and ends
//! them together.
//!
//! There is no contact, and no surface embedded in the tetrahedra.

pub mod checkpoint;
pub mod coarse;
pub mod command;
pub mod division;
pub mod elastic;
pub mod error;
pub mod minimisation;
pub mod output;
pub mod petsc;
pub mod portion;
pub mod run;
pub mod setting;
pub mod share;
pub mod simulation;
pub mod system;
pub mod team;
pub mod tetgen;
pub mod varied;
